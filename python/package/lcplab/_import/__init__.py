"""Scenes from models that MuJoCo compiles: MJCF and URDF."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from lcplab._import import actuators, bodies, contacts, elements, joints, shapes, tendons
from lcplab._import.model import Model
from lcplab._import.refused import Log, Refusal
from lcplab._lcplab import InputError

__all__ = ["Imported", "Refusal", "scene"]


@dataclass(frozen=True)
class Imported:
    """A translated model: the fields of a scene, what has no counterpart, and remarks."""

    scene: dict[str, Any]
    refusals: list[Refusal]
    notes: list[str]

    def check(self) -> None:
        """Raise an error that lists all refusals, if there are any.

        Raises
        ------
        InputError
            With one line for each element.
        """
        if self.refusals:
            raise InputError("\n".join(str(refusal) for refusal in self.refusals))


def scene(model: Any, data: Any = None) -> Imported:
    """Translate a model of MuJoCo at the state of its data, by default its initial state."""
    read, log = Model(model, data), Log()
    touching = {geom for pair in contacts.pairs(read) for geom in pair}
    listed, owners = _fixed_bodies(read, touching, log)
    is_fixed = {body["name"] for body in listed}
    for root in read.moving():
        own = bodies.inertia(read, root)
        geoms = [geom for geom in range(model.ngeom) if read.root(model.geom_bodyid[geom]) == root and geom in touching]
        shape, axes, used = shapes.of_group(read, root, geoms, own, log)
        owners |= {geom: read.names[root] for geom in used}
        listed.append({
            "name": read.names[root], **shape, **bodies.state(read, root, own, axes),
            **bodies.compensation(read, root, log),
        })
    constraints = [found for root in read.moving() for found in joints.of_group(read, root, log)]
    constraints += elements.equalities(read, log) + tendons.constraints(read, log)
    constraints += actuators.constraints(read, log)
    joined = {frozenset(each["bodies"]) for each in constraints if len(each["bodies"]) == 2}
    usual, pairs = contacts.friction(read, owners, joined, is_fixed, log)
    elements.check_options(read, log)
    contacts.check_geoms(read, owners, log)
    described: dict[str, Any] = {
        "title": model.names.split(b"\0")[0].decode() or "imported model",
        "gravity": bodies.gravity(read).tolist(),
        "step": {"dt": float(model.opt.timestep)},
        "contact": {"friction": usual},
        "bodies": listed,
    }
    described |= {"constraints": constraints} if constraints else {}
    described |= {"pairs": pairs} if pairs else {}
    return Imported(described, list(dict.fromkeys(log.refusals)), log.notes)


def _fixed_bodies(read: Model, touching: set[int], log: Log) -> tuple[list[dict[str, Any]], dict[int, str]]:
    """A fixed body for each geom that something can touch and that does not move, and the names by geom."""
    listed: list[dict[str, Any]] = []
    owners: dict[int, str] = {}
    for geom in sorted(touching):
        root = read.root(read.model.geom_bodyid[geom])
        if not read.is_fixed(root):
            continue
        name = read.name("geom", geom)
        while name in read.names or name in owners.values():
            name += " (fixed)"
        body = shapes.fixed(read, geom, name, log)
        if body is not None:
            listed.append(body)
            owners[geom] = name
    return listed, owners
