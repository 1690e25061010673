"""Contact points of MuJoCo: each deep corner of a box and end of a capsule on a plane has one of its own, and none is there twice."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lcplab._receipt import collision
from lcplab._receipt import mujoco as reader
from lcplab._receipt.findings import Finding
from lcplab._receipt.step import Array, Rows

Flags = NDArray[np.bool_]

PLANE, CAPSULE, BOX = 0, 3, 6
#: MuJoCo makes at most this number of contacts of a box with a plane, of corners that are lower than its center.
MOST = 4
CORNERS = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))


def check(model: Any, data: Any, margins: Array) -> Finding | None:
    """The deepest point without a contact; None if there are no such pairs. ``margins``: of each shape (m), (ngeom,)."""
    kinds, shapes = np.asarray(model.geom_type), reader.shapes_of(data)
    is_swapped = kinds[shapes[:, 1]] == PLANE
    planes, others = np.where(is_swapped[:, None], shapes[:, ::-1], shapes).T
    worst = None
    for kind in (BOX, CAPSULE):
        own = np.flatnonzero((shapes.min(axis=1) >= 0) & (kinds[planes] == PLANE) & (kinds[others] == kind))
        if len(own) == 0:
            continue
        codes, pair = np.unique(planes[own] * model.ngeom + others[own], return_inverse=True)
        plane, other = np.divmod(codes, model.ngeom)
        points, overlaps, size = _lowest_points(model, data, plane, other, kind)
        # The point that each contact belongs to.
        apart = np.linalg.norm(points[pair] - np.array(data.contact.pos)[own, None], axis=2)
        nearest = apart.argmin(axis=1)
        is_near = apart.min(axis=1) <= collision.LIMIT * size[pair]
        has_contact = np.zeros(overlaps.shape, dtype=bool)
        has_contact[pair[is_near], nearest[is_near]] = True
        ignored = np.maximum(-margins[plane], 0.0) + np.maximum(-margins[other], 0.0)
        is_deep = overlaps > (ignored + collision.LIMIT * size)[:, None]
        is_lost = is_deep & ~has_contact & (is_deep.sum(axis=1) <= MOST)[:, None]
        errors = np.where(is_lost, overlaps, 0.0).max(axis=1) / size
        deepest = int(np.argmax(errors))
        if worst is None or not errors[deepest] <= worst.error:
            names = reader.names_of(model).geoms
            what = "a corner or end of a shape is below a plane without a contact of its own"
            bodies = (names[plane[deepest]], names[other[deepest]])
            worst = Finding("collision", what, float(errors[deepest]), collision.LIMIT, None, bodies)
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


def _lowest_points(model: Any, data: Any, planes: Rows, others: Rows, kind: int) -> tuple[Array, Array, Array]:
    """Contacts at the corners or ends of shapes on planes: their points, (pairs, n, 3), overlaps (m), (pairs, n), negative for
    corners above a box's center, and the sizes of the shapes (m), (pairs,)."""
    centers, every = np.array(data.geom_xpos), np.array(data.geom_xmat).reshape(-1, 3, 3)
    normals, axes, sizes = every[planes][:, :, 2], every[others], np.array(model.geom_size)[others]
    if kind == BOX:
        arms = (CORNERS * sizes[:, None]) @ np.swapaxes(axes, 1, 2)
        smallest = sizes.min(axis=1)
    else:
        half = sizes[:, 1, None] * axes[:, :, 2]
        arms = np.stack([half, -half], axis=1) - (sizes[:, 0, None] * normals)[:, None]
        smallest = sizes[:, 0]
    lowest = centers[others][:, None] + arms
    overlaps = -((lowest - centers[planes][:, None]) @ normals[:, :, None])[..., 0]
    points = lowest + overlaps[..., None] / 2 * normals[:, None]
    if kind == BOX:
        overlaps = np.where((arms @ normals[:, :, None])[..., 0] <= 0, overlaps, -1.0)
    return points, overlaps, smallest
