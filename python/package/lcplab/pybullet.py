"""PyBullet: a step of free bodies for receipts, and as a problem file.

>>> before = lcplab.pybullet.state()  # doctest: +SKIP
>>> pybullet.stepSimulation()  # doctest: +SKIP
>>> lcplab.receipt(lcplab.pybullet.step(before))  # doctest: +SKIP
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from lcplab._receipt import files, pybullet
from lcplab._receipt.pybullet import DAMPING, state
from lcplab._receipt.step import Array, Step

__all__ = ["problem", "state", "step"]


def step(before: tuple[Array, Array], client: int = 0, *, damping: float = DAMPING) -> Step:
    """The last step of a client, for :func:`lcplab.receipt`. Nothing is changed.

    Parameters
    ----------
    before : (poses, velocities)
        The :func:`state` before the step.
    client : int
        The client's number.
    damping : float
        Linear and angular damping (1/s) of all bodies, which PyBullet does not report; 0.04 for new bodies.

    Raises
    ------
    InputError
        If a body has joints, or ``before`` is the state of other bodies.
    """
    return pybullet.read(client, before, damping)


def problem(
    before: tuple[Array, Array], client: int = 0, path: str | os.PathLike[str] | None = None, *, damping: float = DAMPING
) -> dict[str, Any]:
    """The problem that PyBullet posed in its last step: the object of a problem file, with masses and rows.

    With ``path``, it is written to this file, and PyBullet's impulses next to it, to ``STEM.x.json``.
    """
    own = step(before, client, damping=damping)
    if path is not None:
        place = Path(path)
        files.write(own, place, files.answer_of(place))
    return files.problem(own)
