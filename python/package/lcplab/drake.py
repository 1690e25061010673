"""Drake: the contact problem of a step as a problem file.

>>> before = lcplab.drake.state(plant, context)  # doctest: +SKIP
>>> simulator.AdvanceTo(context.get_time() + plant.time_step())  # doctest: +SKIP
>>> lcplab.receipt(plant, context, before=before)  # doctest: +SKIP
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from lcplab._receipt import files, drake
from lcplab._receipt.drake import state
from lcplab._receipt.step import Array, Step

__all__ = ["problem", "state", "step"]


def step(plant: Any, context: Any, before: tuple[Array, Array], *, stiction_tolerance: float | None = None) -> Step:
    """The last step of a plant, for :func:`lcplab.receipt`. Nothing is changed.

    ``stiction_tolerance`` (m/s) is that of the plant, which Drake does not report; the default is Drake's own.

    Raises
    ------
    InputError
        If ``before`` does not fit, or the plant is continuous.
    """
    return drake.read(plant, context, before, stiction_tolerance)


def problem(
    plant: Any, context: Any, before: tuple[Array, Array], path: str | os.PathLike[str] | None = None
) -> dict[str, Any]:
    """The problem that Drake posed in its last step: the object of a problem file, with masses and rows.

    With ``path``, it is written to this file, and Drake's impulses next to it, to ``STEM.x.json``. ``before`` is the
    :func:`state` before the step. Nothing of a discrete plant is changed.

    Raises
    ------
    InputError
        If ``before`` is missing or does not fit.
    """
    own = step(plant, context, before)
    if path is not None:
        place = Path(path)
        files.write(own, place, files.answer_of(place))
    return files.problem(own)
