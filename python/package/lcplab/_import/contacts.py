"""Which bodies may touch, and their friction."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from lcplab._import.model import Model
from lcplab._import.refused import Log
from lcplab._receipt import mujoco_shapes
from lcplab._receipt.mujoco import is_disabled

Pair = tuple[int, int]


@dataclass(frozen=True)
class Surface:
    """Friction of two geoms: the coefficients of both tangents, and the dimension of the contact."""

    friction: tuple[float, float]
    dimension: int
    #: The element of the model that states them: a pair or a geom, and its number.
    place: tuple[str, int]


def pairs(model: Model) -> list[Pair]:
    """The pairs of geoms that MuJoCo lets collide."""
    if is_disabled(model.model, "CONTACT", "CONSTRAINT"):
        return []
    return mujoco_shapes.pairs(model.model)


def friction(
    model: Model, owners: dict[int, str], joined: set[frozenset[str]], is_fixed: set[str], log: Log
) -> tuple[float, list[dict[str, Any]]]:
    """The usual coefficient of friction, and the pairs of bodies that differ from it or do not touch.

    ``owners`` has the body of each geom that is part of the scene, ``joined`` the bodies that constraints join.
    """
    touching: dict[frozenset[str], list[Pair]] = {}
    for one, other in pairs(model):
        if one in owners and other in owners:
            touching.setdefault(frozenset((owners[one], owners[other])), []).append((one, other))
    coefficients: dict[frozenset[str], float] = {}
    counts = Counter(owners.values())
    for names, geoms in touching.items():
        first, second = sorted(names)
        label, place = f"{first}, {second}", ("geom", geoms[0][1])
        if names in joined:
            log.refuse("contact", label, "joined bodies do not touch in a scene", place=place)
            continue
        if len(geoms) < counts[first] * counts[second]:
            log.refuse("contact", label, "only some geoms of these bodies collide with each other", place=place)
        coefficients[names] = _of_bodies(model, first, second, geoms, log)
    usual = Counter(coefficients.values()).most_common(1)[0][0] if coefficients else 0.0
    names_in_order = list(dict.fromkeys(owners.values()))
    listed: list[dict[str, Any]] = []
    for k, first in enumerate(names_in_order):
        for second in names_in_order[k + 1 :]:
            names = frozenset((first, second))
            if names in coefficients:
                if coefficients[names] != usual:
                    listed.append({"bodies": [first, second], "friction": coefficients[names]})
            elif names not in joined and not names <= is_fixed:
                listed.append({"bodies": [first, second], "without_contact": True})
    return usual, listed


def _of_bodies(model: Model, first: str, second: str, geoms: Iterable[Pair], log: Log) -> float:
    """The coefficient of friction of two bodies; the smallest one if their geoms differ and this is skipped."""
    label, found = f"{first}, {second}", dict[float, tuple[str, int]]()
    refused: dict[str, tuple[str, int]] = {}
    for pair in geoms:
        surface = surface_of(model, pair)
        if surface.dimension > 3:
            reason = f"condim = {surface.dimension}: a scene has no torsional and rolling friction"
            refused.setdefault(reason, surface.place)
        if surface.friction[0] != surface.friction[1]:
            refused.setdefault("different friction along two tangents has no counterpart", surface.place)
        found.setdefault(min(surface.friction) if surface.dimension > 1 else 0.0, surface.place)
    if len(found) > 1:
        values = ", ".join(f"{value:g}" for value in sorted(found))
        refused[f"its geoms have different friction: {values}"] = list(found.values())[-1]
    for reason, place in refused.items():
        log.refuse("contact", label, reason, place=place)
    return min(found)


def surface_of(model: Model, pair: Pair) -> Surface:
    """MuJoCo's rule: an explicit pair, else the geom of higher priority, else the larger values."""
    own = model.model
    for number in range(own.npair):
        if {int(own.pair_geom1[number]), int(own.pair_geom2[number])} == set(pair):
            values = own.pair_friction[number]
            return Surface((float(values[0]), float(values[1])), int(own.pair_dim[number]), ("pair", number))
    priorities = own.geom_priority[list(pair)]
    chosen = [pair[int(np.argmax(priorities))]] if priorities[0] != priorities[1] else list(pair)
    coefficient = float(np.max(own.geom_friction[chosen, 0]))
    stated = chosen[int(np.argmax(own.geom_condim[chosen]))]
    return Surface((coefficient, coefficient), int(own.geom_condim[stated]), ("geom", stated))


def check_geoms(model: Model, owners: dict[int, str], log: Log) -> None:
    """Margins and other properties of surfaces that a scene does not have."""
    own = model.model
    for geom, body in owners.items():
        for field, what in (("margin", "contacts act at a distance"), ("adhesion", "adhesion"), ("surfacevel", "a moving surface")):
            if hasattr(own, f"geom_{field}") and np.any(getattr(own, f"geom_{field}")[geom]):
                reason = f"{field}: {what}, which has no counterpart"
                log.refuse("geom", model.name("geom", geom), reason, body, ("geom", geom))
    for number in range(own.npair):
        if own.pair_margin[number]:
            name = model.name("pair", number)
            log.refuse("pair", name, "margin: contacts act at a distance, which has no counterpart", place=("pair", number))
