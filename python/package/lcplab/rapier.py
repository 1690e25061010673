"""Rapier: a step of free bodies for receipts, and as a problem file.

Rapier reports the points of its solve only without substeps and without recycled contacts:

>>> parameters = world.integration_parameters  # doctest: +SKIP
>>> parameters.num_solver_iterations, parameters.contact_recycling = 1, False  # doctest: +SKIP
>>> parameters.friction_model = rapier3d.FrictionModel.COULOMB  # doctest: +SKIP
>>> before = lcplab.rapier.state(world)  # doctest: +SKIP
>>> world.step()  # doctest: +SKIP
>>> lcplab.receipt(lcplab.rapier.step(world, before))  # doctest: +SKIP
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from lcplab._receipt import files, rapier
from lcplab._receipt.rapier import state
from lcplab._receipt.step import Array, Step

__all__ = ["problem", "state", "step"]


def step(world: Any, before: tuple[Array, Array]) -> Step:
    """The last step of a world, for :func:`lcplab.receipt`. Nothing is changed.

    Parameters
    ----------
    world : rapier3d.PhysicsWorld
        After the step; ``rapier3d`` 0.36.
    before : (poses, velocities)
        The :func:`state` before the step.

    Raises
    ------
    InputError
        If the world has joints, restitution, or settings with which its rows cannot be computed.
    """
    return rapier.read(world, before)


def problem(world: Any, before: tuple[Array, Array], path: str | os.PathLike[str] | None = None) -> dict[str, Any]:
    """The problem that Rapier posed in its last step: the object of a problem file, with masses and rows.

    With ``path``, it is written to this file, and Rapier's impulses next to it, to ``STEM.x.json``.
    """
    own = step(world, before)
    if path is not None:
        place = Path(path)
        files.write(own, place, files.answer_of(place))
    return files.problem(own)
