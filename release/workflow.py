"""Checks that .github/workflows/release.yml names what the repository packages."""

import re
import tomllib
from fnmatch import fnmatch
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FILE = ".github/workflows/release.yml"

# The environment that PyPI trusts, and the names of the scripts that the workflow runs.
ENVIRONMENT = "pypi"
SCRIPTS = ["python/Cargo.toml", "release/archive.py", "release/pyodide.py", "site/check.sh"]


def disagreements(version: str) -> list[str]:
    """What the workflow names otherwise than the repository."""
    text = (ROOT / FILE).read_text(encoding="utf-8")
    wrong = [f"{name} is not used, or does not exist" for name in SCRIPTS if not used(name, text)]
    wrong += wheels(text, version) + programs(text, version)
    if not re.search(rf"^    environment: {ENVIRONMENT}$", text, re.MULTILINE):
        wrong.append(f"no job has the environment {ENVIRONMENT}")
    return [f"{FILE}: {reason}" for reason in wrong]


def used(name: str, text: str) -> bool:
    return name in text and (ROOT / name).is_file()


def wheels(text: str, version: str) -> list[str]:
    """The uploaded wheels are those of python/pyproject.toml, and publishing waits for all of them."""
    package = tomllib.loads((ROOT / "python/pyproject.toml").read_text(encoding="utf-8"))["project"]["name"]
    wheel = f"dist/{package}-{version}-cp310-abi3-any.whl"
    wrong = [] if uploaded(wheel, text) else [f"uploads no {wheel}"]
    built = len(re.findall(r"- \{ platform: ", text))
    expected = [int(count) for count in re.findall(r"= (\d+) \]", text)]
    if not expected or set(expected) != {built}:
        wrong.append(f"builds {built} wheels, but publishes {expected}")
    return wrong


def programs(text: str, version: str) -> list[str]:
    """Each archive that release/archive.py writes is uploaded, with its SHA-256."""
    wrong = []
    for target in re.findall(r"- \{ target: ([^,]+),", text):
        archive = f"dist/lcplab-{version}-{target}.tar.gz"
        here = text.replace("${{ matrix.target }}", target)
        wrong += [f"uploads no {name}" for name in (archive, f"{archive}.sha256") if not uploaded(name, here)]
    return wrong


def uploaded(name: str, text: str) -> bool:
    return any(fnmatch(name, pattern) for pattern in re.findall(r"^          path: (\S+)$", text, re.MULTILINE))
