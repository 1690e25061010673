"""What the machine of a dry run can check. What it cannot is said at the end, and never counts as passed."""

import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# As `.ci/run systems` names them. One of the wheels is for Pyodide.
PYODIDE = "wasm32-unknown-emscripten"
TARGETS = ["x86_64-pc-windows-msvc", "aarch64-apple-darwin", "aarch64-unknown-linux-musl", PYODIDE]

# What no machine can check before a person presses the buttons.
ELSEWHERE = [
    "the workflows `ci.yml` and `release.yml`: only GitHub runs them",
    "wheels and programs for other systems than this one and Pyodide: here they are compiled at most; `release.yml` builds them, "
    "and runs all but the musllinux wheels",
    "uploads to PyPI and crates.io, and whether their names are still free",
    "changes of the public items since the release before, which `cargo semver-checks` finds: none came before 0.1.0",
]


class Machine:
    """Runs what gets a tool, and keeps a list of what could not be checked without one."""

    def __init__(self) -> None:
        self.missing: list[str] = []
        self.elsewhere = list(ELSEWHERE)

    def gets(self, what: str, *command: str | Path) -> bool:
        """Whether a command that gets a tool succeeds; `what` is checked with the tool."""
        try:
            done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
        except OSError as error:
            self.missing.append(f"{what}: {error}")
            return False
        if done.returncode:
            said = (done.stderr or done.stdout or "no message").strip().splitlines()
            reason = next((line for line in said if "error" in line.lower()), said[-1])
            self.missing.append(f"{what}: `{' '.join(map(str, command))}` says {reason}")
        return done.returncode == 0

    def targets(self) -> list[str]:
        """The systems for which this machine can compile."""
        uses = {name: f"compiling for {name}" for name in TARGETS}
        uses[PYODIDE] += ", and the wheels"
        return [name for name, use in uses.items() if self.gets(use, "rustup", "target", "add", name)]

    def unchecked(self) -> str:
        return "\n".join(f"- {reason}" for reason in [*self.missing, *self.elsewhere])
