"""Tendons: a straight one between two bodies is a rope and a spring; others have no counterpart."""

from __future__ import annotations

from typing import Any

import numpy as np

from lcplab._import.model import Model
from lcplab._import.refused import Log

#: The lengths (m) of a spring's dead band that count as the same.
SAME = 1e-9
#: Properties by which a tendon acts on bodies, without those that a rope or a spring has.
OTHERS = ("stiffnesspoly", "dampingpoly", "frictionloss", "armature")
ALL = ("stiffness", "damping", "limited", *OTHERS)


def constraints(model: Model, log: Log) -> list[dict[str, Any]]:
    """The ropes and springs of the tendons that exert forces by themselves."""
    found = []
    for number in range(model.model.ntendon):
        acts = [field for field in ALL if _has(model, number, field)]
        if not acts:
            continue
        translated = _straight(model, number, acts)
        if isinstance(translated, str):
            log.refuse("tendon", model.name("tendon", number), translated, place=("tendon", number))
        else:
            found += translated
    return found


def _has(model: Model, number: int, field: str) -> bool:
    values = getattr(model.model, f"tendon_{field}", None)
    return values is not None and bool(np.any(values[number]))


def _straight(model: Model, number: int, acts: list[str]) -> list[dict[str, Any]] | str:
    """The constraints of a tendon between two sites, or why there are none."""
    own, data = model.model, model.data
    listed = ", ".join(acts)
    path = slice(own.tendon_adr[number], own.tendon_adr[number] + own.tendon_num[number])
    is_site = own.wrap_type[path] == int(model.mujoco.mjtWrap.mjWRAP_SITE)
    if len(is_site) != 2 or not is_site.all():
        return f"{listed} of a tendon that is not a straight line between two sites has no counterpart"
    if others := [field for field in acts if field in OTHERS]:
        return f"{', '.join(others)} of a tendon has no counterpart"
    ends = [(model.root(int(own.site_bodyid[site])), data.site_xpos[site].tolist()) for site in own.wrap_objid[path]]
    if ends[0][0] == ends[1][0] or all(model.is_fixed(root) for root, _ in ends):
        return f"{listed} of a tendon within one body has no counterpart"
    ends.sort(key=lambda end: not model.is_fixed(end[0]))  # the world's point comes first
    base = {"bodies": model.bodies_of(*(root for root, _ in ends)), "points": [point for _, point in ends]}
    found: list[dict[str, Any]] = []
    if "limited" in acts:
        lower, upper = own.tendon_range[number]
        margin, length = float(own.tendon_margin[number]), float(data.ten_length[number])
        if lower + margin > 0:
            return f"range: a shortest length, {lower + margin:g}, has no counterpart"
        if length > upper - margin + SAME:
            return f"range: the length {length:g} exceeds {upper - margin:g}"
        found.append({"kind": "rope", **base, "length": float(upper - margin)})
    if "stiffness" in acts or "damping" in acts:
        stiffness, damping = float(own.tendon_stiffness[number]), float(own.tendon_damping[number])
        shortest, longest = (float(value) for value in own.tendon_lengthspring[number])
        if stiffness and (longest - shortest > SAME or longest <= 0):
            return "stiffness: a spring with a range of rest lengths or without length has no counterpart"
        length = longest if stiffness else float(data.ten_length[number])
        found.append({"kind": "spring", **base, "length": length, "stiffness": stiffness, "damping": damping})
    return found
