"""An environment of its own for each release of an engine."""

from __future__ import annotations

import json
import os
import re
import subprocess
import venv
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import lcplab

#: Seconds for an installation and for a scene.
INSTALLATION, SCENE = 1200, 900
NPM = "npm:"


class Unavailable(Exception):
    """A release that cannot be installed here, with the last line of the reason."""


class Environment:
    """A folder with NumPy, this lcplab and the packages that are named, those of npm as ``npm:NAME@VERSION``."""

    def __init__(self, place: Path, packages: Sequence[str]) -> None:
        name = re.sub(r"[^a-z0-9.]+", "-", "-".join(packages))
        self.folder = place.resolve() / name
        self.packages = packages
        self.python = self.folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")

    def install(self) -> None:
        """Make it, unless it is there.

        Raises
        ------
        Unavailable
            If a package cannot be installed.
        """
        complete = self.folder / "complete"
        if complete.exists():
            return
        venv.create(self.folder, with_pip=True, clear=True)
        pip = ("-m", "pip", "install", "--quiet", "--disable-pip-version-check", "numpy")
        self._run([self.python, *pip, *(own for own in self.packages if not own.startswith(NPM))], INSTALLATION)
        self._install_from_npm([own.removeprefix(NPM) for own in self.packages if own.startswith(NPM)])
        reported = self._run([self.python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"], SCENE)
        (Path(reported.strip()) / "lcplab").symlink_to(Path(lcplab.__file__).parent, target_is_directory=True)
        complete.touch()

    def _install_from_npm(self, packages: Sequence[str]) -> None:
        npm = ("npm", "install", "--silent", "--no-audit", "--no-fund", "--ignore-scripts", "--prefix", self.folder)
        if packages:
            self._run([*npm, *packages], INSTALLATION)

    def replay(self, scene: str, *more: str | Path) -> dict[str, Any]:
        """What a scene's run says here; ``more`` are options of ``lcplab.defects.replay``.

        Raises
        ------
        Unavailable
            If the scene does not run.
        """
        reported = self._run([self.python, "-m", "lcplab.defects.replay", scene, *more], SCENE)
        replayed: dict[str, Any] = json.loads(reported.splitlines()[-1])
        return replayed

    def _run(self, command: Sequence[str | Path], seconds: int) -> str:
        surroundings = {**os.environ, "JAX_PLATFORMS": "cpu", "PYTHONNOUSERSITE": "1"}
        try:
            # Python imports from the current folder first, where a folder may have an engine's name.
            done = subprocess.run(
                command, capture_output=True, text=True, timeout=seconds, env=surroundings, cwd=self.folder
            )
        except (OSError, subprocess.TimeoutExpired) as error:
            raise Unavailable(str(error)) from error
        if done.returncode:
            lines = done.stderr.strip().splitlines() or [f"exit code {done.returncode}"]
            raise Unavailable(lines[-1])
        return done.stdout
