"""Shrinks a rejected step: fewer rows that show the same error."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lcplab._receipt.step import Step, Triplets

#: The number of smaller steps that are tried.
MOST_TRIED = 200


def without(step: Step, is_removed: NDArray[np.bool_]) -> Step:
    """The step without these rows, whose forces become a part of the motion without constraints.

    Motion and forces of the other rows stay as they are, and obey or violate their laws as before.
    """
    kept = np.flatnonzero(~is_removed)
    place = np.full(len(step), -1, dtype=np.int64)
    place[kept] = np.arange(len(kept))
    push = step.push(np.where(is_removed, step.forces, 0.0))
    normal = step.friction_index[kept]

    def lines(triplets: Triplets) -> Triplets:
        own = ~is_removed[triplets[0]]
        return place[triplets[0][own]], triplets[1][own], np.ascontiguousarray(triplets[2][own])

    return replace(
        step,
        jacobian=lines(step.jacobian),
        target=step.target + np.linalg.solve(step.dense_mass(), push),
        friction_index=np.where(normal < 0, -1, place[normal]),
        reported_push=None if step.reported_push is None else step.reported_push - push,
        expected_jacobian=None if step.expected_jacobian is None else lines(step.expected_jacobian),
        expected_bias=None if step.expected_bias is None else step.expected_bias[kept],
        expected_target=None,
        rows=[step.rows[row] for row in kept.tolist()] if len(step.rows) == len(step) else (),
        **{name: getattr(step, name)[kept] for name in ("bias", "compliance", "forces", "lo", "hi", "mu")},
    )


def shrunk(step: Step, shows_it: Callable[[Step], bool]) -> Step:
    """The step with as few rows as this search finds that still shows it; halves, quarters and so on are tried.

    A contact's rows are removed together.
    """
    normal = np.where(step.friction_index < 0, np.arange(len(step)), step.friction_index)
    groups = np.unique(normal)
    tried, size = 0, max(1, len(groups) // 2)
    while True:
        for start in range(0, len(groups), size):
            rest = np.delete(groups, slice(start, start + size))
            if not len(rest) or tried == MOST_TRIED:
                continue
            tried += 1
            if shows_it(without(step, ~np.isin(normal, rest))):
                groups = rest
                break
        else:
            if size == 1:
                return without(step, ~np.isin(normal, groups))
            size //= 2
