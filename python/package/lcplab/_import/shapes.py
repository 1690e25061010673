"""Shapes for collision: those geoms of a group that can touch something."""

from __future__ import annotations

from typing import Any

import numpy as np

from lcplab._import import bodies
from lcplab._import.bodies import Inertia, quaternion
from lcplab._import.model import Array, Model
from lcplab._import.refused import Log
from lcplab._receipt.mujoco_shapes import OTHERS

PLANE, HEIGHT_FIELD, SPHERE, CAPSULE, ELLIPSOID, CYLINDER, BOX, MESH = range(8)
#: A center of a shape within this part of its size is the center of mass.
SAME = 1e-12

Shape = Any


def of_geom(model: Model, geom: int) -> Shape | str:
    """The shape of a geom in its own axes, or why there is none."""
    own = model.model
    kind, size = int(own.geom_type[geom]), [float(value) for value in own.geom_size[geom]]
    if kind == PLANE:
        return {"plane": [0.0, 0.0, 1.0]}
    if kind == SPHERE:
        return {"sphere": size[0]}
    if kind in (CAPSULE, CYLINDER):
        return {"capsule" if kind == CAPSULE else "cylinder": {"radius": size[0], "length": 2 * size[1]}}
    if kind == BOX:
        return {"box": [2 * half for half in size]}
    if kind == MESH:
        return {"hull": _hull(model, int(own.geom_dataid[geom])).tolist()}
    return f"type {OTHERS.get(kind, 'unknown')!r} has no counterpart"


def _hull(model: Model, mesh: int) -> Array:
    """The vertices of a mesh's convex hull, in the mesh's axes."""
    own = model.model
    first = int(own.mesh_vertadr[mesh])
    vertices = np.asarray(own.mesh_vert[first : first + int(own.mesh_vertnum[mesh])], dtype=float)
    graph = int(own.mesh_graphadr[mesh])
    if graph < 0:
        return np.unique(vertices, axis=0)
    # The graph holds the numbers of vertices and faces, the addresses of edges, and the vertices.
    count = int(own.mesh_graph[graph])
    chosen = np.asarray(own.mesh_graph[graph + 2 + count : graph + 2 + 2 * count])
    return np.unique(vertices[chosen], axis=0)


def of_group(
    model: Model, root: int, geoms: list[int], own: Inertia, log: Log
) -> tuple[dict[str, Any], Array, list[int]]:
    """The shape of a moving group as fields of a body, the body's principal axes as columns, and the geoms used."""
    found: list[tuple[int, Shape]] = []
    for geom in geoms:
        shape = of_geom(model, geom)
        if isinstance(shape, str):
            log.refuse("geom", model.name("geom", geom), shape, model.names[root], ("geom", geom))
        else:
            found.append((geom, shape))
    if not found:
        return {"shape": {"sphere": _radius(own)}, "without_contact": True}, bodies.principal_axes(own, None), []
    used = [geom for geom, _ in found]
    geom, shape = found[0]
    turn = model.data.geom_xmat[geom].reshape(3, 3)
    center = model.data.geom_xpos[geom]
    axes = bodies.principal_axes(own, turn)
    is_centered = np.linalg.norm(center - own.center) <= SAME * max(1.0, float(np.linalg.norm(own.center)))
    if len(found) == 1 and is_centered and "hull" not in shape and np.array_equal(axes, turn):
        return {"shape": shape}, axes, used
    return {"shape": {"compound": [_part(model, *each, own.center, axes) for each in found]}}, axes, used


def _part(model: Model, geom: int, shape: Shape, center: Array, axes: Array) -> dict[str, Any]:
    """A part of a compound, in the body's principal axes."""
    turn = axes.T @ model.data.geom_xmat[geom].reshape(3, 3)
    place = axes.T @ (model.data.geom_xpos[geom] - center)
    return {"shape": shape, "position": place.tolist(), "rotation": {"quaternion": quaternion(turn)}}


def _radius(own: Inertia) -> float:
    """The radius of the ball that stands for a body without shape: that of a homogeneous ball of its largest moment."""
    return float(np.sqrt(2.5 * np.linalg.eigvalsh(own.tensor)[-1] / own.mass))


def fixed(model: Model, geom: int, name: str, log: Log) -> dict[str, Any] | None:
    """A fixed body for a geom of the world."""
    shape = of_geom(model, geom)
    if isinstance(shape, str):
        log.refuse("geom", model.name("geom", geom), shape, place=("geom", geom))
        return None
    turn = model.data.geom_xmat[geom].reshape(3, 3)
    place = {"position": model.data.geom_xpos[geom].tolist()}
    if "plane" in shape:
        return {"name": name, "fixed": True, "shape": {"plane": turn[:, 2].tolist()}, **place}
    return {"name": name, "fixed": True, "shape": shape, **place, "rotation": {"quaternion": quaternion(turn)}}
