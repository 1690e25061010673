"""Contact points of MuJoCo: each deep corner of a box and end of a capsule on a plane has one of its own, and none is there twice."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lcplab._receipt import collision
from lcplab._receipt import mujoco as reader
from lcplab._receipt.findings import Finding
from lcplab._receipt.step import Array

Flags = NDArray[np.bool_]

PLANE, CAPSULE, BOX = 0, 3, 6
#: MuJoCo makes at most this number of contacts of a box with a plane, of corners that are lower than its center.
MOST = 4
CORNERS = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))


def check(model: Any, data: Any, margins: Array) -> Finding | None:
    """The deepest point without a contact; None if there are no such pairs. ``margins``: of each shape (m), (ngeom,)."""
    kinds, shapes = np.asarray(model.geom_type), reader.shapes_of(data)
    of_pair = np.where(shapes < 0, -1, kinds[shapes])
    at: dict[tuple[int, int], list[Array]] = {}
    positions = np.array(data.contact.pos)
    for number in np.flatnonzero((of_pair == PLANE).any(axis=1) & np.isin(of_pair, (BOX, CAPSULE)).any(axis=1)).tolist():
        plane, other = shapes[number] if of_pair[number, 0] == PLANE else shapes[number, ::-1]
        at.setdefault((int(plane), int(other)), []).append(positions[number])
    worst = None
    for (plane, other), found in at.items():
        ignored = -min(float(margins[plane]), 0.0) - min(float(margins[other]), 0.0)
        points, overlaps, size = _deep_points(model, data, plane, other)
        is_deep = overlaps > ignored + collision.LIMIT * size
        if is_deep.sum() > MOST:
            continue
        apart = np.linalg.norm(points[is_deep][:, None] - np.array(found), axis=2).min(axis=1, initial=np.inf)
        error = float(apart.max(initial=0.0)) / size
        if worst is None or not error <= worst.error:
            names = reader.names_of(model).geoms
            what = "a corner or end of a shape is below a plane without a contact of its own"
            worst = Finding("collision", what, error, collision.LIMIT, None, (names[plane], names[other]))
    return worst


def twice(model: Any, data: Any, are_exact: Flags) -> Finding | None:
    """Two contacts of the same shapes at the same point; None if there are none.

    ``are_exact``: the pairs of kinds to look at, (kinds, kinds). Of two parallel capsules MuJoCo itself can find the same contact
    from both sides.
    """
    kinds, shapes = np.asarray(model.geom_type), reader.shapes_of(data)
    of_pair = kinds[shapes]
    is_own = (shapes.min(axis=1, initial=0) >= 0) & are_exact[of_pair[:, 0], of_pair[:, 1]]
    own = np.flatnonzero(is_own & (of_pair != CAPSULE).any(axis=1))
    seen = set()
    for pair, point in zip(shapes[own].tolist(), np.array(data.contact.pos)[own].tolist()):
        contact = (*sorted(pair), *point)
        if contact in seen:
            names = reader.names_of(model).geoms
            what = "two shapes have the same contact twice"
            return Finding("collision", what, np.inf, 0.0, None, (names[pair[0]], names[pair[1]]))
        seen.add(contact)
    return None


def _deep_points(model: Any, data: Any, plane: int, other: int) -> tuple[Array, Array, float]:
    """Where the contacts of a shape's lowest points are, (n, 3), how deep these are (m), (n,), and the shape's size (m)."""
    normal = np.array(data.geom_xmat[plane]).reshape(3, 3)[:, 2]
    axes, size = np.array(data.geom_xmat[other]).reshape(3, 3), np.array(model.geom_size[other])
    if model.geom_type[other] == BOX:
        arms = (CORNERS * size) @ axes.T
        arms = arms[arms @ normal <= 0]
        smallest = float(size.min())
    else:
        arms = np.array([-1.0, 1.0])[:, None] * size[1] * axes[:, 2] - size[0] * normal
        smallest = float(size[0])
    lowest = np.array(data.geom_xpos[other]) + arms
    overlaps = -(lowest - np.array(data.geom_xpos[plane])) @ normal
    return lowest + overlaps[:, None] / 2 * normal, overlaps, smallest
