"""The stage collision: finds shapes that overlap without a contact, and compares distances with those of the poses."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from lcplab._receipt.findings import Finding, Report
from lcplab._receipt.geometry import EXACT, Shape, distances

#: The largest accepted difference of distances, relative to the size of the smaller shape.
LIMIT = 1e-5
#: Capsules whose axes are closer than this, relative to their radius, have no normal.
CROSSED = 1e-3


def check(
    shapes: Mapping[int, Shape], pairs: Iterable[tuple[int, int]], contacts: Mapping[tuple[int, int], float]
) -> Report:
    """Compare distances with closed forms.

    Parameters
    ----------
    shapes : mapping
        The shapes by number.
    pairs : iterable of (int, int)
        The pairs that the engine must test and that may overlap, the smaller number first.
    contacts : mapping
        The smallest distance (m) of the contacts of a pair.
    """
    missing = Finding("collision", "two shapes overlap without a contact", 0.0, LIMIT)
    wrong = Finding("collision", "the distance of a contact differs from that of its shapes", 0.0, LIMIT)
    near = list(pairs)
    compared = [pair for pair in near if pair not in contacts or _may_be_exact(shapes[pair[0]], shapes[pair[1]])]
    unknown = {_kinds(shapes[one], shapes[other]) for one, other in set(near) - set(compared)}
    gaps = distances([shapes[one] for one, _ in compared], [shapes[other] for _, other in compared])
    for (one, other), gap in zip(compared, gaps):
        first, second = shapes[one], shapes[other]
        if gap is None:
            unknown.add(_kinds(first, second))
            continue
        reported = contacts.get((one, other))
        size = min(_size(first), _size(second))
        bodies = (first.name, second.name)
        if reported is None:
            ignored = -min(first.margin, 0.0) - min(second.margin, 0.0)
            error = max(0.0, -gap - ignored) / size
            if not error <= missing.error:
                what = f"two shapes overlap by {-gap:.2g} m without a contact"
                missing = Finding("collision", what, error, LIMIT, None, bodies)
        elif _is_exact(first, second, gap):
            error = abs(reported - gap) / size
            if not error <= wrong.error:
                what = f"the distance of a contact is {reported:.4g} m, but that of its shapes is {gap:.4g} m"
                wrong = Finding("collision", what, error, LIMIT, None, bodies)
        else:
            unknown.add(_kinds(first, second))
    not_checked = [f"collision: number, distances, positions and normals of {pair}" for pair in sorted(unknown)]
    return Report([missing, wrong] if near else [], not_checked)


def _kinds(first: Shape, second: Shape) -> str:
    return " and ".join(sorted((first.kind, second.kind)))


def _size(shape: Shape) -> float:
    """The smallest radius or half edge (m)."""
    if shape.kind == "plane":
        return np.inf
    return float(shape.size[0] if shape.kind in ("sphere", "capsule") else min(shape.size.tolist()))


def _may_be_exact(first: Shape, second: Shape) -> bool:
    """Whether the distance has a closed form that the engine's must equal; otherwise it only shows missing contacts."""
    kinds = (first.kind, second.kind)
    return kinds in EXACT or kinds[::-1] in EXACT


def _is_exact(first: Shape, second: Shape, gap: float) -> bool:
    if not _may_be_exact(first, second):
        return False
    if (first.kind, second.kind) == ("capsule", "capsule"):
        return gap + _size(first) + _size(second) > CROSSED * min(_size(first), _size(second))
    return True
