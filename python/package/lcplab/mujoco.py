"""MuJoCo: the contact problem of a step as a problem file, and models as scenes."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from lcplab._import import Imported, Refusal, scene
from lcplab._receipt import files, mujoco

__all__ = ["Imported", "Refusal", "problem", "scene"]


def problem(model: Any, data: Any, path: str | os.PathLike[str] | None = None) -> dict[str, Any]:
    """The problem that MuJoCo posed in its last step: the object of a problem file, with masses and rows.

    With ``path``, it is written to this file, and MuJoCo's forces next to it, to ``STEM.x.json``. The data, after
    ``mj_step`` or ``mj_forward``, are not changed.

    Raises
    ------
    InputError
        If friction cannot be written as a problem, such as torsional friction in an elliptic cone.
    """
    step = mujoco.read(model, data)
    if path is not None:
        place = Path(path)
        files.write(step, place, files.answer_of(place))
    return files.problem(step)
