"""Numbers of a step that are not finite: the first one rejects the step, and nothing else can be computed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from lcplab._receipt.findings import Finding
from lcplab._receipt.step import Step

#: What a receipt with such a number does not check.
REST = "everything else, because a number is not finite"
#: The arrays of the rows: those of the problem, of which bounds may be infinite, and x.
ROWS = ("bias", "compliance", "mu", "lo", "hi", "forces")
#: The arrays of the degrees of freedom.
DOFS = ("target", "motion", "reported_push")


def of_step(step: Step) -> Finding | None:
    """The first entry of a step that is not finite; None if there is none.

    Examples
    --------
    >>> step = Step.of("mine", mass=[[2.0]], jacobian=[[1.0]], bias=[0.0], target=[-3.0], forces=[float("nan")])
    >>> of_step(step).what
    'forces[0] is nan'
    """
    for name in ("mass", "jacobian"):
        rows, columns, values = getattr(step, name)
        if not np.isfinite(values).all():
            entry = int(np.argmin(np.isfinite(values)))
            return _finding("assembly", f"{name}[{rows[entry]}, {columns[entry]}] is {values[entry]}")
    lo, hi = np.where(step.lo == -np.inf, 0, step.lo), np.where(step.hi == np.inf, 0, step.hi)
    problem = {"bias": step.bias, "compliance": step.compliance, "mu": step.mu, "lo": lo, "hi": hi,
               "target": step.target, "gravity": step.gravity}
    answer = {"forces": step.forces, "motion": step.motion}
    reported = {} if step.reported_push is None else {"reported_push": step.reported_push}
    return (
        in_arrays("assembly", problem, step) or in_arrays("solver", answer, step) or in_arrays("write-back", reported, step)
    )


def in_arrays(stage: str, arrays: Mapping[str, Any], step: Step) -> Finding | None:
    """The first entry of these arrays that is not finite, as an error of this stage."""
    for name, values in arrays.items():
        entries = np.asarray(values, dtype=float)
        if not np.isfinite(entries).all():
            entries = entries.reshape(-1)
            place = int(np.argmin(np.isfinite(entries)))
            row = place if name in ROWS else None
            bodies: tuple[str, ...] = ()
            if row is not None and row < len(step.rows):
                bodies = step.rows[row].bodies
            elif name in DOFS and place < len(step.dof_bodies):
                bodies = (step.dof_bodies[place],)
            return _finding(stage, f"{name}[{place}] is {entries[place]}", row, bodies)
    return None


def _finding(stage: str, what: str, row: int | None = None, bodies: tuple[str, ...] = ()) -> Finding:
    return Finding(stage, what, np.inf, 0.0, row, bodies)
