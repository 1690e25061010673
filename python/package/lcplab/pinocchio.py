"""Pinocchio: a solve of constrained dynamics as a step for receipts, and as a problem file."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from lcplab._receipt import files, pinocchio
from lcplab._receipt.step import Array, Step

__all__ = ["problem", "step"]


def step(model: Any, data: Any, q: Array, v: Array, tau: Array, contacts: Sequence[Any], kept: Sequence[Any]) -> Step:
    """The last ``constraintDynamics(model, data, q, v, tau, contacts, kept)``, for :func:`lcplab.receipt`.

    Nothing is changed.

    Raises
    ------
    InputError
        If a contact is not a point in three coordinates (``CONTACT_3D``) in local axes.
    """
    return pinocchio.read(model, data, q, v, tau, contacts, kept)


def problem(
    model: Any, data: Any, q: Array, v: Array, tau: Array, contacts: Sequence[Any], kept: Sequence[Any],
    path: str | os.PathLike[str] | None = None,
) -> dict[str, Any]:
    """The problem that Pinocchio posed: the object of a problem file, with masses and rows.

    With ``path``, it is written to this file, and Pinocchio's forces next to it, to ``STEM.x.json``.
    """
    own = step(model, data, q, v, tau, contacts, kept)
    if path is not None:
        place = Path(path)
        files.write(own, place, files.answer_of(place))
    return files.problem(own)
