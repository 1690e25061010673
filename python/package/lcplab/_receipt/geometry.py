"""Signed distances of shapes in closed form: planes, spheres, capsules and boxes.

Negative where shapes overlap. A plane is ``z <= 0`` of its axes, a capsule lies along its z.
"""

from __future__ import annotations

from collections.abc import Callable
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

    def local(self, point: Array) -> Array:
        """A point in its axes."""
        return np.asarray((point - self.center) @ self.axes)

    @property
    def radius(self) -> float:
        """Of a sphere around it; infinite for a plane."""
        reach = {"plane": np.inf, "sphere": self.size[0], "capsule": self.size[:2].sum()}
        return float(reach.get(self.kind, np.linalg.norm(self.size)))

    @property
    def ends(self) -> Array:
        """The ends of a capsule's line, (2, 3)."""
        half = self.axes[:, 2] * self.size[1]
        return np.array([self.center - half, self.center + half])

    @property
    def corners(self) -> Array:
        """The corners of a box, (8, 3)."""
        signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T
        return np.asarray(self.center + (signs * self.size) @ self.axes.T)


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
    for one, other in ((first, second), (second, first)):
        pair = _PAIRS.get((one.kind, other.kind))
        if pair:
            return float(pair(one, other))
    return None


def _plane_sphere(plane: Shape, ball: Shape) -> float:
    return float(plane.local(ball.center)[2] - ball.size[0])


def _plane_capsule(plane: Shape, rod: Shape) -> float:
    return float(min(plane.local(end)[2] for end in rod.ends) - rod.size[0])


def _plane_box(plane: Shape, box: Shape) -> float:
    return float(min(plane.local(corner)[2] for corner in box.corners))


def _sphere_sphere(first: Shape, second: Shape) -> float:
    return float(np.linalg.norm(first.center - second.center) - first.size[0] - second.size[0])


def _sphere_capsule(ball: Shape, rod: Shape) -> float:
    return _point_to_line(ball.center, *rod.ends) - float(ball.size[0] + rod.size[0])


def _sphere_box(ball: Shape, box: Shape) -> float:
    beyond = np.abs(box.local(ball.center)) - box.size
    outside = float(np.linalg.norm(np.maximum(beyond, 0.0)))
    return outside + min(float(beyond.max()), 0.0) - float(ball.size[0])


def _capsule_capsule(first: Shape, second: Shape) -> float:
    (a, b), (c, d) = first.ends, second.ends
    apart = min(_point_to_line(a, c, d), _point_to_line(b, c, d), _point_to_line(c, a, b), _point_to_line(d, a, b))
    u, v, w = b - a, d - c, a - c
    across = u @ u * (v @ v) - (u @ v) ** 2
    if across > 1e-12 * (u @ u) * (v @ v):
        s = ((u @ v) * (v @ w) - (v @ v) * (u @ w)) / across
        t = ((u @ u) * (v @ w) - (u @ v) * (u @ w)) / across
        if 0 <= s <= 1 and 0 <= t <= 1:
            apart = min(apart, float(np.linalg.norm(w + s * u - t * v)))
    return apart - float(first.size[0] + second.size[0])


def _box_box(first: Shape, second: Shape) -> float:
    crossed = np.cross(first.axes.T[:, None], second.axes.T[None, :]).reshape(9, 3)
    axes = np.vstack([first.axes.T, second.axes.T, crossed])
    lengths = np.linalg.norm(axes, axis=1)
    axes = axes[lengths >= 1e-9] / lengths[lengths >= 1e-9, None]
    reach = sum(np.abs(axes @ box.axes) @ box.size for box in (first, second))
    return float(np.max(np.abs(axes @ (second.center - first.center)) - reach))


def _point_to_line(point: Array, start: Array, end: Array) -> float:
    along = end - start
    length = float(along @ along)
    part = 0.0 if length == 0 else min(max(float((point - start) @ along) / length, 0.0), 1.0)
    return float(np.linalg.norm(point - start - part * along))


_PAIRS: dict[tuple[str, str], Callable[[Shape, Shape], float]] = {
    ("plane", "sphere"): _plane_sphere,
    ("plane", "capsule"): _plane_capsule,
    ("plane", "box"): _plane_box,
    ("sphere", "sphere"): _sphere_sphere,
    ("sphere", "capsule"): _sphere_capsule,
    ("sphere", "box"): _sphere_box,
    ("capsule", "capsule"): _capsule_capsule,
    ("box", "box"): _box_box,
}
#: Pairs whose closed form is exact both apart and overlapping, so that the engine's distance must be the same.
EXACT = frozenset(pair for pair in _PAIRS if pair != ("box", "box"))
