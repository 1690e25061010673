"""MuJoCo's shapes, the pairs of them that its rules let collide, and its contacts."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from lcplab._receipt import collision, mujoco_points
from lcplab._receipt import mujoco as reader
from lcplab._receipt.findings import Finding, Report
from lcplab._receipt.geometry import EXACT, Many, Shape, outward, surface_distance
from lcplab._receipt.kept import Kept
from lcplab._receipt.step import Array, Rows

KINDS = {0: "plane", 2: "sphere", 3: "capsule", 6: "box"}
PLANE, SPHERE, CAPSULE, BOX = 0, 2, 3, 6
OTHERS = {1: "height field", 4: "ellipsoid", 5: "cylinder", 7: "mesh", 8: "signed distance field"}
#: Whether the closed form of two kinds is exact.
_ARE_EXACT = np.zeros((max(OTHERS) + 1, max(OTHERS) + 1), dtype=bool)
for _one, _first in KINDS.items():
    for _other, _second in KINDS.items():
        _ARE_EXACT[_one, _other] = (_first, _second) in EXACT or (_second, _first) in EXACT
#: Values of a contact's ``exclude``: it has rows, or it is farther apart than its margin without the gap.
INCLUDED, IN_GAP = 0, 1
#: More shapes than these have too many pairs.
MOST = 1_000


def check(model: Any, data: Any) -> Report:
    """The stage collision of the poses that the engine's contacts were found at."""
    if reader.is_disabled(model, "CONTACT", "CONSTRAINT"):
        return Report(not_checked=["collision: contacts are disabled"])
    if model.ngeom > MOST:
        return Report(not_checked=[f"collision: the model has more than {MOST} shapes"])
    if reader.are_asleep(data):
        return Report(not_checked=["collision: some trees are asleep"])
    near = _near(model, data)
    report = collision.check(_shapes(model, data, near), near, _contacts(data))
    report.findings += _without_rows(model, data) + _off_surfaces(model, data)
    if data.ncon:
        points = mujoco_points.check(model, data, _margins(model)), mujoco_points.twice(model, data, _ARE_EXACT)
        report.findings += [finding for finding in points if finding]
    if data.ncon and reader.shapes_of(data).min() < 0:
        report.not_checked.append("collision: contacts of flexes")
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


def _off_surfaces(model: Any, data: Any) -> list[Finding]:
    """The contact whose ends, half its distance along the normal from its position, are farthest from the two surfaces,
    and the one whose normal differs most from theirs."""
    if not data.ncon:
        return []
    kinds, shapes, contacts = np.asarray(model.geom_type), reader.shapes_of(data), data.contact
    of_pair = kinds[shapes]
    exact = np.flatnonzero((shapes.min(axis=1) >= 0) & _ARE_EXACT[of_pair[:, 0], of_pair[:, 1]])
    if len(exact) == 0:
        return []
    normals = np.array(contacts.frame)[exact, :3]
    half = np.array(contacts.dist)[exact, None] / 2 * normals
    ends = np.array(contacts.pos)[exact, None] + np.stack([-half, half], axis=1)
    geoms = shapes[exact]
    apart, sizes = np.zeros(geoms.shape), _smallest(model)[geoms].min(axis=1)
    size, centers, axes = np.array(model.geom_size), np.array(data.geom_xpos), np.array(data.geom_xmat).reshape(-1, 3, 3)
    sides, turned = np.stack([normals, -normals], axis=1), np.zeros(geoms.shape)
    for number in np.unique(kinds[geoms]).tolist():
        own = kinds[geoms] == number
        these = geoms[own]
        many = Many(size[these], centers[these], axes[these])
        apart[own] = surface_distance(KINDS[number], many, ends[own])
        if number != BOX:
            turned[own] = np.abs(outward(KINDS[number], many, ends[own]) - sides[own]).max(axis=1)
    # A plane touches both end spheres of a capsule, and that of the higher end may do so inside of the capsule.
    is_on_plane = (kinds[geoms] == CAPSULE) & (kinds[geoms] == PLANE).any(axis=1)[:, None]
    apart[is_on_plane & (apart < 0)] = 0.0
    turned[is_on_plane] = 0.0
    findings = []
    for what, errors in (
        ("position, normal and distance of a contact do not lead to the surfaces of its shapes", np.abs(apart).max(axis=1) / sizes),
        ("the normal of a contact is not that of the surfaces of its shapes", turned.max(axis=1)),
    ):
        worst = int(np.argmax(errors))
        bodies = tuple(reader.names_of(model).geoms[geom] for geom in geoms[worst])
        findings.append(Finding("collision", what, float(errors[worst]), collision.LIMIT, None, bodies))
    return findings


def _smallest_of(model: Any) -> Array:
    """The smallest radius or half edge (m) of each shape, (ngeom,); infinite for planes."""
    kinds, sizes = np.asarray(model.geom_type), np.array(model.geom_size)
    smallest = np.where(kinds == BOX, sizes.min(axis=1), sizes[:, 0])
    return np.where(kinds == PLANE, np.inf, smallest)


_smallest = Kept(_smallest_of, "geom_type", "geom_size")


def _shapes(model: Any, data: Any, near: list[tuple[int, int]]) -> dict[int, Shape]:
    """The shapes of these pairs."""
    margins, names, kinds = _margins(model).tolist(), reader.names_of(model).geoms, np.asarray(model.geom_type).tolist()
    sizes, centers = np.array(model.geom_size), np.array(data.geom_xpos)
    axes = np.array(data.geom_xmat).reshape(-1, 3, 3)

    def shape(geom: int) -> Shape:
        kind = KINDS.get(kinds[geom], OTHERS.get(kinds[geom], "shape"))
        return Shape(kind, sizes[geom], centers[geom], axes[geom], names[geom], margins[geom])

    return {geom: shape(geom) for geom in {geom for pair in near for geom in pair}}


def _margins(model: Any) -> Array:
    """The margin of each shape (m), (ngeom,)."""
    import mujoco

    if model.opt.enableflags & int(mujoco.mjtEnableBit.mjENBL_OVERRIDE):
        return np.full(model.ngeom, float(model.opt.o_margin))
    return np.array(model.geom_margin, dtype=float)


def _pairs_of(model: Any) -> tuple[Rows, Rows]:
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
    first, second = np.nonzero(np.triu(collide, 1))
    return first, second


#: The pairs of shapes that the engine must test, (pairs,) each, the smaller number first.
_pairs = Kept(
    _pairs_of, "opt.disableflags", "geom_contype", "geom_conaffinity", "geom_bodyid", "body_weldid", "body_parentid",
    "body_dofnum", "exclude_signature", "pair_geom1", "pair_geom2", "pair_margin",
)


def pairs(model: Any) -> list[tuple[int, int]]:
    """The pairs of shapes that the engine must test, the smaller number first."""
    first, second = _pairs(model)
    return list(zip(first.tolist(), second.tolist()))


def _radii_of(model: Any) -> Array:
    """The radius of a sphere around each shape (m), (ngeom,); infinite for planes."""
    kinds, sizes = np.asarray(model.geom_type), np.array(model.geom_size)
    whole = np.sqrt(np.sum(sizes**2, axis=1))
    radii = np.where(kinds == CAPSULE, sizes[:, 0] + sizes[:, 1], np.where(kinds == SPHERE, sizes[:, 0], whole))
    return np.where(kinds == PLANE, np.inf, radii)


_radii = Kept(_radii_of, "geom_type", "geom_size")


def _near(model: Any, data: Any) -> list[tuple[int, int]]:
    """The pairs whose bounding spheres overlap; of a plane, those that reach it."""
    (first, second), radii = _pairs(model), _radii(model)
    centers = np.array(data.geom_xpos)
    between = centers[second] - centers[first]
    near = np.sum(between**2, axis=1) <= (radii[first] + radii[second]) ** 2
    normals = np.array(data.geom_xmat)[:, 2::3]
    for plane, other, sign in ((first, second, 1.0), (second, first, -1.0)):
        own = np.flatnonzero(np.isinf(radii[plane]))
        if len(own):
            heights = sign * np.sum(between[own] * normals[plane[own]], axis=1)
            near[own] &= heights <= radii[other[own]]
    return list(zip(first[near].tolist(), second[near].tolist()))


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
