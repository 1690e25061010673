"""Rows of contact points, n, t1 and t2 each, for engines that report points and forces instead of their problem."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from lcplab._receipt.step import Array, Row, Step


class ContactRows:
    """The rows of a step in the engine's own degrees of freedom.

    Parameters
    ----------
    size : int
        The number of degrees of freedom.
    """

    def __init__(self, size: int) -> None:
        self.size = size
        self.jacobian: list[Array] = []
        self.bias: list[float] = []
        self.compliance: list[float] = []
        self.forces: list[float] = []
        self.mu: list[float] = []
        self.rows: list[Row] = []

    def __len__(self) -> int:
        return len(self.rows)

    def add(
        self, names: tuple[str, str], lines: Array, forces: Array, bias: float, compliance: Array, mu: float
    ) -> None:
        """Add a point.

        Parameters
        ----------
        names : (str, str)
            The two bodies.
        lines : array
            The velocity with which the first body leaves the second along n, t1 and t2, as rows of J, (3, k).
        forces : array
            The engine's impulses along them (N s), (3,).
        bias : float
            What the row of n adds to J v (m/s).
        compliance : array
            In m/s per N s, (3,).
        mu : float
            The coefficient of friction.
        """
        point = len(self.rows) // 3
        for kind in ("normal", "friction", "friction"):
            self.rows.append(Row(f"{kind}: {', '.join(names)}, point {point}", kind, names))
        self.jacobian.extend(lines)
        self.forces.extend(float(force) for force in forces)
        self.bias += [bias, 0.0, 0.0]
        self.compliance += [float(part) for part in compliance]
        self.mu.append(mu)

    def dense_jacobian(self) -> Array:
        """J, (n, k)."""
        return np.array(self.jacobian).reshape(len(self), self.size)

    def normal(self, mass: Array, target: Array) -> Array:
        """The impulses along the normals of these rows without friction, (points,)."""
        from lcplab import solve

        jacobian = self.dense_jacobian()[::3]
        matrix = jacobian @ np.linalg.solve(mass, jacobian.T) + np.diag(self.compliance[::3])
        return solve((matrix + matrix.T) / 2, jacobian @ target + np.array(self.bias[::3])).x

    def step(
        self, engine: str, bounds: Array, mass: Array, target: Array, motion: Array, no_bound: str = "", **more: Any
    ) -> Step:
        """The step whose friction has these bounds (N s) along both tangents, (points,).

        If the engine does not report all rows, which ``no_bound`` says, these bounds are not known.
        """
        if no_bound:
            bounds = np.full(len(bounds), np.inf)
        most = np.column_stack([np.full(len(bounds), np.inf), bounds, bounds]).ravel()
        least = np.column_stack([np.zeros(len(bounds)), -bounds, -bounds]).ravel()
        return Step.of(
            engine, mass, self.dense_jacobian(), self.bias, target, self.forces, motion, compliance=self.compliance,
            lo=least, hi=most, rows=self.rows, no_bound=no_bound, **more,
        )


def axes_along(normal: Array, preferred: Sequence[float] | None = None) -> Array:
    """The normal and two tangents as rows, (3, 3); the first tangent is orthogonal to the preferred axis."""
    axis = np.eye(3)[np.abs(normal).argmin()] if preferred is None else np.array(preferred, dtype=float)
    along = np.cross(axis, normal)
    along /= np.linalg.norm(along)
    return np.array([normal, along, np.cross(normal, along)])
