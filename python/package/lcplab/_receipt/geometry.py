"""Signed distances of shapes in closed form: planes, spheres, capsules and boxes.

Negative where shapes overlap. A plane is ``z <= 0`` of its axes, a capsule lies along its z.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from lcplab._receipt.step import Array


@dataclass(frozen=True)
class Shape:
    """A shape at its pose: ``axes`` in columns, sizes in m."""

    #: ``"plane"``, ``"sphere"`` (radius), ``"capsule"`` (radius, half length) or ``"box"`` (half edges).
    kind: str
    size: Array
    center: Array
    axes: Array
    name: str = ""
    #: The distance (m) from which on it has contacts; negative if only where it overlaps more.
    margin: float = 0.0


@dataclass(frozen=True)
class Many:
    """Shapes of one kind: sizes and centers, (n, 3), and axes, (n, 3, 3)."""

    size: Array
    center: Array
    axes: Array

    @classmethod
    def of(cls, shapes: Sequence[Shape]) -> Many:
        """These shapes."""
        sizes = np.zeros((len(shapes), 3))
        for row, shape in zip(sizes, shapes):
            row[: len(shape.size)] = shape.size
        return cls(sizes, np.array([shape.center for shape in shapes]), np.array([shape.axes for shape in shapes]))

    def local(self, points: Array) -> Array:
        """A point for each shape in its axes, (n, 3)."""
        return _along(points - self.center, self.axes)

    @property
    def ends(self) -> tuple[Array, Array]:
        """The ends of capsules' lines, (n, 3) each."""
        half = self.axes[:, :, 2] * self.size[:, 1:2]
        return self.center - half, self.center + half


def distance(first: Shape, second: Shape) -> float | None:
    """The signed distance (m); None where there is no closed form for the pair.

    Of two boxes that overlap it is the depth along the best of the 15 separating axes; apart, a lower bound.

    Examples
    --------
    >>> at = lambda x: np.array([x, 0.0, 0.0])
    >>> ball = Shape("sphere", np.array([0.1]), at(0.15), np.eye(3))
    >>> box = Shape("box", np.full(3, 0.2), at(0.0), np.eye(3))
    >>> round(distance(ball, box), 12)
    -0.15
    """
    return distances([first], [second])[0]


def distances(firsts: Sequence[Shape], seconds: Sequence[Shape]) -> list[float | None]:
    """The signed distances of pairs; those of the same kinds are computed together."""
    found: list[float | None] = [None] * len(firsts)
    groups: dict[tuple[str, str], list[tuple[int, Shape, Shape]]] = {}
    for number, (first, second) in enumerate(zip(firsts, seconds)):
        if (first.kind, second.kind) not in _PAIRS:
            first, second = second, first
        groups.setdefault((first.kind, second.kind), []).append((number, first, second))
    for kinds, group in groups.items():
        if kinds in _PAIRS:
            numbers, one, other = zip(*group)
            for number, gap in zip(numbers, _PAIRS[kinds](Many.of(one), Many.of(other)).tolist()):
                found[number] = gap
    return found


def _along(vectors: Array, axes: Array) -> Array:
    """The components of vectors along axes in columns, (n, 3)."""
    return np.asarray(np.einsum("ni,nij->nj", vectors, axes))


def _plane_sphere(plane: Many, ball: Many) -> Array:
    return np.asarray(plane.local(ball.center)[:, 2] - ball.size[:, 0])


def _plane_capsule(plane: Many, rod: Many) -> Array:
    first, last = rod.ends
    return np.asarray(np.minimum(plane.local(first)[:, 2], plane.local(last)[:, 2]) - rod.size[:, 0])


def _plane_box(plane: Many, box: Many) -> Array:
    # The lowest corner is that against the normal along each axis of the box.
    reach = np.sum(np.abs(_along(plane.axes[:, :, 2], box.axes)) * box.size, axis=1)
    return np.asarray(plane.local(box.center)[:, 2] - reach)


def _sphere_sphere(first: Many, second: Many) -> Array:
    return np.asarray(_length(first.center - second.center) - first.size[:, 0] - second.size[:, 0])


def _sphere_capsule(ball: Many, rod: Many) -> Array:
    return _point_to_line(ball.center, *rod.ends) - ball.size[:, 0] - rod.size[:, 0]


def _sphere_box(ball: Many, box: Many) -> Array:
    beyond = np.abs(box.local(ball.center)) - box.size
    outside = _length(np.maximum(beyond, 0.0))
    return np.asarray(outside + np.minimum(beyond.max(axis=1), 0.0) - ball.size[:, 0])


def _capsule_capsule(first: Many, second: Many) -> Array:
    (a, b), (c, d) = first.ends, second.ends
    ends = [_point_to_line(a, c, d), _point_to_line(b, c, d), _point_to_line(c, a, b), _point_to_line(d, a, b)]
    u, v, w = b - a, d - c, a - c
    uu, vv, uv, uw, vw = (np.sum(one * other, axis=1) for one, other in ((u, u), (v, v), (u, v), (u, w), (v, w)))
    across = uu * vv - uv**2
    is_crossed = across > 1e-12 * uu * vv
    across = np.where(is_crossed, across, 1.0)
    s, t = (uv * vw - vv * uw) / across, (uu * vw - uv * uw) / across
    is_crossed &= (s >= 0) & (s <= 1) & (t >= 0) & (t <= 1)
    between = _length(w + s[:, None] * u - t[:, None] * v)
    apart = np.minimum(np.min(ends, axis=0), np.where(is_crossed, between, np.inf))
    return np.asarray(apart - first.size[:, 0] - second.size[:, 0])


def _box_box(first: Many, second: Many) -> Array:
    one, other = np.swapaxes(first.axes, 1, 2), np.swapaxes(second.axes, 1, 2)
    crossed = np.cross(one[:, :, None], other[:, None, :]).reshape(-1, 9, 3)
    lengths = _length(crossed)
    is_axis = lengths >= 1e-9
    crossed = crossed / np.where(is_axis, lengths, 1.0)[..., None]
    axes = np.concatenate([one, other, crossed], axis=1)
    reach = sum((np.abs(axes @ box.axes) @ box.size[..., None])[..., 0] for box in (first, second))
    gaps = np.abs(axes @ (second.center - first.center)[..., None])[..., 0] - reach
    gaps[:, 6:][~is_axis] = -np.inf
    return np.asarray(gaps.max(axis=1))


def _point_to_line(points: Array, starts: Array, ends: Array) -> Array:
    along, apart = ends - starts, points - starts
    length = np.sum(along**2, axis=1)
    part = np.clip(np.sum(apart * along, axis=1) / np.where(length == 0, 1.0, length), 0.0, 1.0)
    return _length(apart - part[:, None] * along)


def _length(vectors: Array) -> Array:
    return np.asarray(np.sqrt(np.sum(vectors**2, axis=-1)))


_PAIRS: dict[tuple[str, str], Callable[[Many, Many], Array]] = {
    ("plane", "sphere"): _plane_sphere,
    ("plane", "capsule"): _plane_capsule,
    ("plane", "box"): _plane_box,
    ("sphere", "sphere"): _sphere_sphere,
    ("sphere", "capsule"): _sphere_capsule,
    ("sphere", "box"): _sphere_box,
    ("capsule", "capsule"): _capsule_capsule,
    ("box", "box"): _box_box,
}
def surface_distance(kind: str, shapes: Many, points: Array) -> Array:
    """The signed distance (m) of a point from each shape of this kind, negative inside, (n,).

    Examples
    --------
    >>> ball = Many(np.array([[0.1, 0, 0]]), np.zeros((1, 3)), np.eye(3)[None])
    >>> round(surface_distance("sphere", ball, np.array([[0.3, 0, 0]])).item(), 12)
    0.2
    """
    no_size = np.zeros_like(points)
    dots = Many(no_size, points, np.zeros((len(points), 3, 3)))
    first, second = ("sphere", kind) if ("sphere", kind) in _PAIRS else (kind, "sphere")
    pair = (dots, shapes) if first == "sphere" else (shapes, dots)
    return _PAIRS[first, second](*pair)


def outward(kind: str, shapes: Many, points: Array) -> Array:
    """The outward unit normals of planes, spheres and capsules at points of their surfaces, (n, 3).

    Examples
    --------
    >>> ball = Many(np.array([[0.1, 0, 0]]), np.zeros((1, 3)), np.eye(3)[None])
    >>> outward("sphere", ball, np.array([[0.0, 0.1, 0.0]])).tolist()
    [[0.0, 1.0, 0.0]]
    """
    if kind == "plane":
        return np.asarray(shapes.axes[:, :, 2])
    inner = shapes.center
    if kind == "capsule":
        along, half = shapes.axes[:, :, 2], shapes.size[:, 1]
        part = np.clip(np.sum((points - inner) * along, axis=1), -half, half)
        inner = inner + part[:, None] * along
    apart = points - inner
    return np.asarray(apart / np.maximum(_length(apart), 1e-300)[:, None])


#: Pairs whose closed form is exact both apart and overlapping, so that the engine's distance must be the same.
EXACT = frozenset(pair for pair in _PAIRS if pair != ("box", "box"))
