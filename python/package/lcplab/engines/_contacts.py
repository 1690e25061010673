"""The contact problem of an engine's step, put together from the state of its bodies."""

from __future__ import annotations

from typing import Any

import numpy as np

from lcplab import Problem
from lcplab.engines import Array, Description, Posed, Unsupported, turned


class Contacts:
    """The contacts of free bodies in a step at velocity level: w = J (u* + M⁻¹Jᵀx) + bias + γx.

    x are impulses (N s), rows n, t1, t2 for each point, and w are the velocities (m/s) with which the first body
    leaves the second. u has [v; ω] of each free body, (6 bodies,), in world axes. u* is u at the start of the
    step and what gravity and the torque −ω × Iω add to it, both as they are at the start.
    """

    def __init__(self, scene: Description, poses: Array, velocities: Array, dt: float) -> None:
        if scene["constraints"]:
            raise Unsupported("rows other than contacts")
        self.bodies, self.poses, self.dt = scene["bodies"], poses, dt
        free = [k for k, body in enumerate(self.bodies) if not body["fixed"]]
        #: The first entry in u of each free body.
        self.first = {k: 6 * number for number, k in enumerate(free)}
        self.target: Array = velocities[free].ravel()
        self.gravity, self.mass = np.zeros(len(self.target)), np.zeros((len(self.target),) * 2)
        for k, i in self.first.items():
            axes = np.array([turned(poses[k, 3:], axis) for axis in np.eye(3)]).T
            inertia = axes @ np.diag(self.bodies[k]["inertia"]) @ axes.T
            self.mass[i : i + 3, i : i + 3] = self.bodies[k]["mass"] * np.eye(3)
            self.mass[i + 3 : i + 6, i + 3 : i + 6] = inertia
            self.gravity[i : i + 3] = dt * np.array(scene["gravity"])
            omega = velocities[k, 3:]
            self.target[i + 3 : i + 6] -= dt * np.linalg.solve(inertia, np.cross(omega, inertia @ omega))
        self.target += self.gravity
        self.jacobian: list[Array] = []
        self.bias: list[float] = []
        self.compliance: list[float] = []
        self.x: list[float] = []
        self.rows: list[dict[str, Any]] = []

    def lines(self, pair: tuple[int, int], places: tuple[Array, Array], axes: Array) -> Array:
        """The rows of J of two bodies that touch at a place (m) of each, along axes n, t1, t2, (3, 6 bodies)."""
        lines = np.zeros((3, len(self.target)))
        for k, place, sign in zip(pair, places, (1, -1)):
            if (i := self.first.get(k)) is not None:
                lines[:, i : i + 6] = sign * np.hstack([axes, np.cross(place - self.poses[k, :3], axes)])
        return lines

    def add(self, pair: tuple[int, int], lines: Array, x: Array, bias: float, compliance: Array | None = None) -> None:
        """A point: its rows of J, the engine's impulses (N s), the bias along n (m/s) and γ (m/s per N s)."""
        names = [self.bodies[k]["name"] for k in pair]
        point = len(self.rows) // 3
        for number, kind in enumerate(("normal", "friction", "friction")):
            label = f"{kind} {' '.join(names)} {number}, point {point}"
            self.rows.append({"label": label, "kind": kind, "unit": "N s", "bodies": names})
        self.jacobian.extend(lines)
        self.x.extend(x)
        self.bias += [bias, 0.0, 0.0]
        self.compliance.extend(np.zeros(3) if compliance is None else compliance)

    def posed(self, words: str, mu: float | None = None, most: Array | None = None) -> Posed:
        """The problem with Coulomb's cone of ``mu``, or with these bounds (N s) of n, ±t1 and ±t2, (points, 3)."""
        if not self.rows:
            raise Unsupported("nothing touches")
        jacobian, points = np.array(self.jacobian), len(self.rows) // 3
        matrix = jacobian @ np.linalg.solve(self.mass, jacobian.T) + np.diag(self.compliance)
        given: dict[str, Any] = {"A": (matrix + matrix.T) / 2, "b": jacobian @ self.target + np.array(self.bias)}
        if most is None:
            normal = 3 * np.arange(points)[:, None]
            given |= {"friction_index": np.hstack([-1 + 0 * normal, normal, normal]).ravel(), "model": "coulomb-cone",
                      "mu": np.tile([0, mu, mu], points)}
        else:
            given |= {"lo": np.hstack([np.zeros((points, 1)), -most[:, 1:]]).ravel(), "hi": most.ravel()}
        # What a step of its weight is to the heaviest body counts as something.
        scale = max(np.linalg.norm(self.gravity[i : i + 3]) * self.mass[i, i] for i in self.first.values())
        motion = {"mass": triplets(np.triu(self.mass)), "jacobian": triplets(jacobian), "bias": self.bias,
                  "compliance": self.compliance, "target": self.target.tolist()}
        bodies = [{"name": self.bodies[k]["name"], "first": i, "count": 6} for k, i in self.first.items()]
        more = {"motion": motion, "rows": self.rows, "bodies": bodies, "gravity": self.gravity.tolist(), "dt": self.dt}
        return Posed(Problem(**given, scale=float(scale)), np.array(self.x), words, more, list(self.first))


def triplets(matrix: Array) -> list[list[Any]]:
    """The entries of a matrix that are not 0 as they stand in a problem file: row, column, value."""
    return [[int(i), int(j), float(matrix[i, j])] for i, j in np.argwhere(matrix)]
