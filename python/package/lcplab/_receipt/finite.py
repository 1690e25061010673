"""Numbers that are not finite: the first one rejects the step, and nothing else can be computed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from lcplab._receipt.findings import Finding
from lcplab._receipt.step import Step

#: What a receipt with such a number does not check.
REST = "everything else, because a number is not finite"

def is_finite(step: Step) -> bool:
    """Whether all numbers of a step are finite; bounds may be infinite toward their own side.

    Examples
    --------
    >>> step = Step.of("mine", mass=[[2.0]], jacobian=[[1.0]], bias=[0.0], target=[-3.0], forces=[float("nan")])
    >>> is_finite(step)
    False
    """
    lo, hi = np.where(step.lo == -np.inf, 0, step.lo), np.where(step.hi == np.inf, 0, step.hi)
    parts: list[Any] = [step.mass[2], step.jacobian[2], step.bias, step.compliance, step.mu, lo, hi, step.target, step.forces,
             step.motion, [step.gravity], [] if step.reported_push is None else step.reported_push]
    return bool(np.isfinite(np.concatenate(parts)).all())


def in_arrays(stage: str, arrays: Mapping[str, Any]) -> Finding | None:
    """The first entry of these arrays that is not finite, as an error of this stage."""
    flat = [np.asarray(values, dtype=float).reshape(-1) for values in arrays.values()]
    if not flat or np.isfinite(np.concatenate(flat)).all():
        return None
    for name, values in arrays.items():
        entries = np.asarray(values, dtype=float).reshape(-1)
        if not np.isfinite(entries).all():
            place = int(np.argmin(np.isfinite(entries)))
            return Finding(stage, f"{name}[{place}] is {entries[place]}", np.inf, 0.0)
    return None
