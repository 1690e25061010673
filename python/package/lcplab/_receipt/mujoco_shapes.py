"""MuJoCo's shapes, the pairs of them that its rules let collide, and its contacts."""

from __future__ import annotations

from typing import Any

import numpy as np

from lcplab._receipt import collision
from lcplab._receipt import mujoco as reader
from lcplab._receipt.findings import Report
from lcplab._receipt.geometry import Shape

KINDS = {0: "plane", 2: "sphere", 3: "capsule", 6: "box"}
OTHERS = {1: "height field", 4: "ellipsoid", 5: "cylinder", 7: "mesh", 8: "signed distance field"}
#: More shapes than these have too many pairs.
MOST = 400


def check(model: Any, data: Any) -> Report:
    """The stage collision of the poses that the engine's contacts were found at."""
    import mujoco

    flags = mujoco.mjtDisableBit
    if model.opt.disableflags & int(flags.mjDSBL_CONTACT):
        return Report(not_checked=["collision: contacts are disabled"])
    if model.ngeom > MOST:
        return Report(not_checked=[f"collision: the model has more than {MOST} shapes"])
    shapes = _shapes(model, data)
    if np.any(getattr(data, "tree_asleep", np.array([-1])) >= 0):
        return Report(not_checked=["collision: some trees are asleep"])
    return collision.check(shapes, _pairs(model), _contacts(data))


def _shapes(model: Any, data: Any) -> dict[int, Shape]:
    import mujoco

    shapes = {}
    for geom, kind in enumerate(model.geom_type):
        body = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_BODY, int(model.geom_bodyid[geom]))
        shapes[geom] = Shape(
            KINDS.get(int(kind), OTHERS.get(int(kind), "shape")),
            np.array(model.geom_size[geom]),
            np.array(data.geom_xpos[geom]),
            np.array(data.geom_xmat[geom]).reshape(3, 3),
            body or f"body {int(model.geom_bodyid[geom])}",
        )
    return shapes


def _pairs(model: Any) -> list[tuple[int, int]]:
    """Pairs by MuJoCo's documentation, "Collision detection": types, welded bodies, parents, exclusions."""
    import mujoco

    types, affinities = np.asarray(model.geom_contype), np.asarray(model.geom_conaffinity)
    bodies = np.asarray(model.geom_bodyid)
    roots = np.asarray(model.body_weldid)[bodies]
    above = np.asarray(model.body_weldid)[np.asarray(model.body_parentid)[roots]]
    collide = (types[:, None] & affinities) | (affinities[:, None] & types) != 0
    collide &= roots[:, None] != roots
    if not model.opt.disableflags & int(mujoco.mjtDisableBit.mjDSBL_FILTERPARENT):
        is_parent = (roots[:, None] == above) | (above[:, None] == roots)
        collide &= ~(is_parent & (roots[:, None] != 0) & (roots != 0))
    least, most = np.minimum(bodies[:, None], bodies), np.maximum(bodies[:, None], bodies)
    collide &= ~np.isin((least << 16) + most, np.asarray(model.exclude_signature))
    for one, other in zip(model.pair_geom1, model.pair_geom2):
        collide[one, other] = collide[other, one] = True
    return [(int(one), int(other)) for one, other in zip(*np.nonzero(np.triu(collide, 1)))]


def _contacts(data: Any) -> dict[tuple[int, int], float]:
    found: dict[tuple[int, int], float] = {}
    for number in range(data.ncon):
        contact = data.contact[number]
        one, other = sorted(reader.shapes_of(contact))
        found[one, other] = min(found.get((one, other), np.inf), float(contact.dist))
    return found
