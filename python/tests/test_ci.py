"""The example of examples/ci: a good engine passes, and each of its planted bugs fails with its stage named.

Pytest and the steps of action.yml run as programs, as they do in continuous integration.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "examples" / "ci"
STAGES = {
    "no-friction-bound": "solver", "arm-sign": "assembly", "stale-impulses": "write-back", "impulse-twice": "write-back"
}
#: The number of scenes that show it: only in the pile do two balls touch, and only then has a contact a second arm.
SCENES = {"no-friction-bound": 2, "arm-sign": 1, "stale-impulses": 2, "impulse-twice": 2}
OPTIONS = ("baseline", "limit", "junit", "sarif", "out")


@pytest.fixture
def engine(tmp_path):
    """A copy of the repository's part that an engine's maintainer has, at its root."""
    ignored = shutil.ignore_patterns("__pycache__", "frames")
    shutil.copytree(EXAMPLE, tmp_path / "examples" / "ci", ignore=ignored)
    return tmp_path


def plant(bug, engine):
    """Apply the patch of a bug."""
    patch = engine / "examples" / "ci" / "bugs" / f"{bug}.patch"
    subprocess.run(["git", "apply", patch], cwd=engine, check=True, env=os.environ | {"GIT_DIR": "/nonexistent"})


def run(command, folder, **more):
    """The exit code and the output of a program."""
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    variables = os.environ | {"PATH": path, "PYTHONDONTWRITEBYTECODE": "1", "COLUMNS": "120", **more}
    done = subprocess.run(command, cwd=folder, env=variables, text=True, stdout=-1, stderr=subprocess.STDOUT)
    return done.returncode, done.stdout


def run_pytest(engine):
    """The engine's own tests."""
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "--lcplab-baseline", "known.json"]
    return run(command, engine / "examples" / "ci")


def run_action(engine, **inputs):
    """The steps of action.yml, one after the other, as a runner passes their inputs."""
    text = (ROOT / "action.yml").read_text(encoding="utf-8")
    scripts = [textwrap.dedent(script) for script in re.findall(r"^      run: \|\n((?:        .*\n)+)", text, re.M)]
    assert len(scripts) == 2
    variables = {name.upper(): inputs.get(name, "") for name in ("frames", *OPTIONS)}
    return run(["bash", "-e", "-o", "pipefail", "-c", "\n".join(scripts)], engine, SOURCE="no-such-folder", **variables)


def write_frames(engine):
    """The frames of the engine's scenes."""
    code, reported = run([sys.executable, "adapter.py", "frames"], engine / "examples" / "ci")
    assert code == 0, reported


def test_a_good_engine_passes(engine):
    code, reported = run_pytest(engine)
    assert code == 0 and "ok: 120 frames, 0 rejected" in reported, reported


@pytest.mark.parametrize("bug", STAGES)
def test_a_planted_bug_fails_with_its_stage(bug, engine):
    plant(bug, engine)
    code, reported = run_pytest(engine)
    assert code == 1 and len(re.findall(rf"Failed: \d+ of 60 steps rejected at {STAGES[bug]}\n", reported)) >= SCENES[bug], reported
    assert set(re.findall(r"verdict +wrong: ([a-z-]+)", reported)) == {STAGES[bug]}, reported


def test_the_action_passes_a_good_engine_and_writes_what_is_asked_for(engine):
    write_frames(engine)
    code, reported = run_action(
        engine, frames="examples/ci/frames\n", baseline="examples/ci/known_frames.json", junit="r.xml", sarif="r.sarif"
    )
    assert code == 0 and reported.startswith("ok: 10 frames"), reported
    assert 'failures="0"' in (engine / "r.xml").read_text()
    assert json.loads((engine / "r.sarif").read_text())["runs"][0]["results"] == []


def test_the_action_fails_on_a_planted_bug(engine):
    plant("no-friction-bound", engine)
    write_frames(engine)
    code, reported = run_action(
        engine, frames="examples/ci/frames", baseline="examples/ci/known_frames.json", sarif="r.sarif", out="worst"
    )
    assert code == 1 and "rejected at solver" in reported, reported
    results = json.loads((engine / "r.sarif").read_text())["runs"][0]["results"]
    assert {result["ruleId"] for result in results} == {"receipt/solver"}
    assert list((engine / "worst").glob("*/receipt.txt"))


def test_the_action_has_the_options_of_the_command():
    text = (ROOT / "action.yml").read_text(encoding="utf-8")
    inputs = re.findall(r"^  ([a-z]+):$", text.split("\nruns:")[0], re.M)
    assert inputs == ["frames", *OPTIONS]
    code, reported = run([sys.executable, "-m", "lcplab", "receipts", "--help"], ROOT)
    assert code == 0 and all(f"--{option} " in reported for option in OPTIONS)


@pytest.mark.parametrize("file", [ROOT / "action.yml", EXAMPLE / "workflow.yml"], ids=lambda file: file.name)
def test_a_value_without_quotation_marks_has_nothing_that_yaml_reads_as_a_key_or_a_comment(file):
    block = None
    for line in file.read_text(encoding="utf-8").splitlines():
        depth = len(line) - len(line.lstrip())
        if block is not None and (depth > block or not line.strip()):
            continue  # of a script
        block = depth if line.rstrip().endswith("|") else None
        key = re.match(r"\s*(?:- )?[\w-]+:(?: +(.*))?$", line)
        value = re.sub(r" +#.*$", "", key[1] or "") if key else ""
        if not value.startswith(('"', "'")):
            assert ": " not in value and not value.endswith(":"), line
