"""Newton's method on the engine's problem: an accurate motion, and the number of steps to it.

The motion of a step whose rows are all compliant minimizes a smooth convex function (Gauss's principle). A wrong
Hessian only converges more slowly. If an engine stopped at its iteration cap, the number of steps with the exact Hessian shows
whether the problem was hard. The accurate motion also tightens a loose bound.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from lcplab._receipt.limits import ROUNDING
from lcplab._receipt.step import Array, Rows, Step

#: Steps of Newton's method, and rows and degrees of freedom, at most.
MOST, MOST_ROWS = 100, 2_000
#: An engine's method is slow if it takes more than this many times the steps.
EXCESS = 4.0
#: The method stops at this gradient, relative to that of the motion without constraints.
SMALL = 1e-12


@dataclass(frozen=True)
class Work:
    """Iterations of the engine and of Newton's method with the exact Hessian."""

    engine: int
    newton: int | None
    #: The engine's method.
    method: str

    @property
    def is_excessive(self) -> bool:
        """Whether the engine's Newton method took many more steps than it needs."""
        return self.method == "newton" and self.newton is not None and self.engine > EXCESS * self.newton

    def __str__(self) -> str:
        if self.newton is None:
            return f"{self.engine} iterations; Newton's method with the exact Hessian does not converge in {MOST}"
        return f"{self.engine} iterations; Newton's method with the exact Hessian needs {self.newton}"


@dataclass(frozen=True)
class Solution:
    """An accurate motion and the number of Newton steps to it, None if there were too many."""

    motion: Array
    steps: int | None


def compare(step: Step, solution: Solution | None) -> Work:
    """The engine's iterations and those of Newton's method."""
    return Work(step.iterations, solution.steps if solution else None, step.method)


def solve(step: Step) -> Solution | None:
    """The exact motion by Newton's method from the free motion; None if a row is rigid, or there are too many."""
    size = len(step.target)
    if np.any(step.compliance <= 0) or max(size, len(step)) > MOST_ROWS:
        return None
    mass, jacobian = step.dense_mass(), step.dense_jacobian()
    motion, first = step.target.copy(), 0.0
    for steps in range(MOST):
        forces, slope = forces_at(step, jacobian @ motion + step.bias)
        gradient = mass @ (motion - step.target) - jacobian.T @ forces
        first = first or float(np.linalg.norm(gradient))
        if np.linalg.norm(gradient) <= SMALL * first:
            return Solution(motion, steps)
        hessian = mass + jacobian.T @ slope @ jacobian
        change = -np.asarray(np.linalg.solve(hessian, gradient), dtype=float)
        motion = motion + _length(step, mass, jacobian, motion, change) * change
    return Solution(motion, None)


def _length(step: Step, mass: Array, jacobian: Array, motion: Array, change: Array) -> float:
    """The zero of the slope along a change, which grows: by bisection."""

    def slope(length: float) -> float:
        at = motion + length * change
        forces, _ = forces_at(step, jacobian @ at + step.bias)
        return float(change @ (mass @ (at - step.target) - jacobian.T @ forces))

    low, high = 0.0, 1.0
    if abs(slope(1.0)) <= 1e-3 * abs(slope(0.0)):
        return 1.0
    while slope(high) < 0 and high < 1e6:
        low, high = high, 2 * high
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (middle, high) if slope(middle) < 0 else (low, middle)
    return (low + high) / 2


def forces_at(step: Step, speed: Array) -> tuple[Array, Array]:
    """The forces of compliant rows at a velocity of the rows, and minus their derivative, (n, n)."""
    wanted = -speed / step.compliance
    forces = np.clip(wanted, step.lo, step.hi)
    slope = np.diag(np.where(forces == wanted, 1 / step.compliance, 0.0))
    for rows, root, cone in _cones(step):
        own, derivative = _onto_cone(root * wanted[rows], cone)
        forces[rows] = own / root
        slope[np.ix_(rows, rows)] = derivative / np.outer(root, root)
    return forces, slope


def are_forces_of_motion(step: Step) -> bool:
    """Whether the forces are, to rounding, those that the motion asks for: nearest to -(J v + bias) / compliance."""
    if np.any(step.compliance <= 0):
        return False
    wanted = -(step.along(step.motion) + step.bias) / step.compliance
    forces, root = np.clip(wanted, step.lo, step.hi), np.sqrt(step.compliance)
    terms = (step.size_along(step.motion) + np.abs(step.bias)) / root
    for rows, own, cone in _cones(step):
        forces[rows] = _onto_cone(own * wanted[rows], cone)[0] / own
        terms[rows] = terms[rows].max()
    return bool(np.all(root * np.abs(step.forces - forces) <= ROUNDING[step.bits] * terms))


def _cones(step: Step) -> Iterator[tuple[Rows, Array, float]]:
    """The rows of each cone, the normal one first, roots of their compliance, and the slope in the norm of it."""
    for normal in np.unique(step.friction_index[step.friction_index >= 0]):
        rows = np.concatenate([[normal], np.flatnonzero(step.friction_index == normal)])
        root = np.sqrt(step.compliance[rows])
        yield rows, root, float((root[1:] * step.mu[rows[1:]] / root[0]).mean())


def _onto_cone(point: Array, slope: float) -> tuple[Array, Array]:
    """The nearest point of the circular cone |y_t| <= slope y_n, and its derivative."""
    normal, side = point[0], point[1:]
    length = float(np.linalg.norm(side))
    if length <= slope * normal:
        return point, np.eye(len(point))
    if slope * length <= -normal:
        return np.zeros_like(point), np.zeros((len(point), len(point)))
    axis = np.concatenate([[1.0], slope * side / length]) / np.sqrt(1 + slope**2)
    reach = float(axis @ point)
    across = np.zeros((len(point), len(point)))
    across[1:, 1:] = np.eye(len(side)) - np.outer(side, side) / length**2
    return reach * axis, np.outer(axis, axis) + reach * slope / (np.sqrt(1 + slope**2) * length) * across
