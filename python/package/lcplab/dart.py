"""DART: the contact problem of a step as a problem file.

>>> before = lcplab.dart.state(world)  # doctest: +SKIP
>>> world.step()  # doctest: +SKIP
>>> lcplab.receipt(world, before=before)  # doctest: +SKIP
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from lcplab._receipt import files, dart
from lcplab._receipt.dart import State, state

__all__ = ["problem", "state"]


def problem(
    world: Any, before: State, path: str | os.PathLike[str] | None = None
) -> dict[str, Any]:
    """The problem that DART posed in its last step: the object of a problem file, with masses and rows.

    With ``path``, it is written to this file, and DART's impulses next to it, to ``STEM.x.json``. ``before`` is the
    :func:`state` before the step. Nothing of a world is changed.

    Raises
    ------
    InputError
        If ``before`` is missing or does not fit.
    """
    step = dart.read(world, before)
    if path is not None:
        place = Path(path)
        files.write(step, place, files.answer_of(place))
    return files.problem(step)
