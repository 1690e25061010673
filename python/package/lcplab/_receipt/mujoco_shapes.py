"""MuJoCo's shapes, the pairs of them that its rules let collide, and its contacts."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from lcplab._receipt import collision
from lcplab._receipt import mujoco as reader
from lcplab._receipt.findings import Finding, Report
from lcplab._receipt.geometry import Shape
from lcplab._receipt.step import Array

KINDS = {0: "plane", 2: "sphere", 3: "capsule", 6: "box"}
OTHERS = {1: "height field", 4: "ellipsoid", 5: "cylinder", 7: "mesh", 8: "signed distance field"}
#: Values of a contact's ``exclude``: it has rows, or it is farther apart than its margin without the gap.
INCLUDED, IN_GAP = 0, 1
#: More shapes than these have too many pairs.
MOST = 400


def check(model: Any, data: Any) -> Report:
    """The stage collision of the poses that the engine's contacts were found at."""
    if reader.is_disabled(model, "CONTACT", "CONSTRAINT"):
        return Report(not_checked=["collision: contacts are disabled"])
    if model.ngeom > MOST:
        return Report(not_checked=[f"collision: the model has more than {MOST} shapes"])
    if reader.are_asleep(data):
        return Report(not_checked=["collision: some trees are asleep"])
    report = collision.check(_shapes(model, data), pairs(model), _contacts(data))
    report.findings += _without_rows(model, data)
    return report


def _without_rows(model: Any, data: Any) -> list[Finding]:
    """A contact within its margin that has no constraint rows, although the engine does not exclude it."""
    if not data.ncon:
        return []
    contacts, shapes = data.contact, reader.shapes_of(data)
    exclude = np.array(contacts.exclude)
    included = (exclude == INCLUDED) | ((exclude == IN_GAP) & (np.array(contacts.dist) < np.array(contacts.includemargin)))
    lost = np.flatnonzero((np.array(contacts.efc_address) < 0) & included & (shapes.min(axis=1) >= 0))
    for number in lost[:1].tolist():
        bodies = tuple(reader.names_of(model).geoms[geom] for geom in shapes[number])
        return [Finding("assembly", f"contact {number} has no constraint rows", np.inf, 0.0, None, bodies)]
    return []


def _shapes(model: Any, data: Any) -> dict[int, Shape]:
    kinds = [KINDS.get(kind, OTHERS.get(kind, "shape")) for kind in np.asarray(model.geom_type).tolist()]
    margins, names = _margins(model).tolist(), reader.names_of(model).geoms
    sizes, centers = np.array(model.geom_size), np.array(data.geom_xpos)
    axes = np.array(data.geom_xmat).reshape(-1, 3, 3)
    return {geom: Shape(*own) for geom, own in enumerate(zip(kinds, sizes, centers, axes, names, margins))}


def _margins(model: Any) -> Array:
    """The margin of each shape (m), (ngeom,)."""
    import mujoco

    if model.opt.enableflags & int(mujoco.mjtEnableBit.mjENBL_OVERRIDE):
        return np.full(model.ngeom, float(model.opt.o_margin))
    return np.array(model.geom_margin, dtype=float)


_pairs: tuple[list[Any], list[tuple[int, int]]] | None = None
#: What the pairs of a model depend on.
RULES = ("geom_contype", "geom_conaffinity", "geom_bodyid", "body_weldid", "body_parentid", "body_dofnum", "exclude_signature",
         "pair_geom1", "pair_geom2", "pair_margin")


def pairs(model: Any) -> list[tuple[int, int]]:
    """The pairs of the model that was read last are kept while nothing changes that they depend on."""
    global _pairs
    rules = [model.opt.disableflags, *(np.asarray(getattr(model, name)).tobytes() for name in RULES)]
    kept = _pairs
    if kept is None or kept[0] != rules:
        kept = _pairs = rules, _pairs_of(model)
    return list(kept[1])


def _pairs_of(model: Any) -> list[tuple[int, int]]:
    """Pairs by MuJoCo's documentation, "Collision detection": types, welded bodies, parents, exclusions.

    Two bodies that cannot move, such as the world and a mocap body, do not collide.
    """
    types, affinities = np.asarray(model.geom_contype), np.asarray(model.geom_conaffinity)
    bodies = np.asarray(model.geom_bodyid)
    roots = np.asarray(model.body_weldid)[bodies]
    above = np.asarray(model.body_weldid)[np.asarray(model.body_parentid)[roots]]
    collide = (types[:, None] & affinities) | (affinities[:, None] & types) != 0
    movable = _are_movable(model)[bodies]
    collide &= (roots[:, None] != roots) & (movable[:, None] | movable)
    if not reader.is_disabled(model, "FILTERPARENT"):
        is_parent = (roots[:, None] == above) | (above[:, None] == roots)
        collide &= ~(is_parent & (roots[:, None] != 0) & (roots != 0))
    least, most = np.minimum(bodies[:, None], bodies), np.maximum(bodies[:, None], bodies)
    collide &= ~np.isin((least << 16) + most, np.asarray(model.exclude_signature))
    for one, other, margin in zip(model.pair_geom1, model.pair_geom2, model.pair_margin):
        # A pair with a negative margin has no contact where it overlaps less.
        collide[one, other] = collide[other, one] = margin >= 0
    return [(int(one), int(other)) for one, other in zip(*np.nonzero(np.triu(collide, 1)))]


def _are_movable(model: Any) -> NDArray[np.bool_]:
    """Whether a body or one of its ancestors has degrees of freedom, (nbody,)."""
    movable = np.asarray(model.body_dofnum) > 0
    for body, parent in enumerate(model.body_parentid):
        movable[body] |= movable[parent]
    return movable


def _contacts(data: Any) -> dict[tuple[int, int], float]:
    found: dict[tuple[int, int], float] = {}
    shapes = np.sort(reader.shapes_of(data), axis=1).tolist()
    for (one, other), distance in zip(shapes, np.array(data.contact.dist).tolist()):
        found[one, other] = min(found.get((one, other), np.inf), distance)
    return found
