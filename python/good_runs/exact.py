"""The true motion of a step, by a method that lcplab does not contain, with a bound on its own error.

All rows are compliant, so the motion is the minimum of a strongly convex function of v alone:
f(v) = ½|v − u*|²_M + Σ ψ(J v + bias), where ψ's derivative is −x(v), the projection of −(J v + bias)/γ on the bounds or
the cone in the metric γ. Newton's method with exact line search finds it. Since f is 1-strongly convex in the norm of M,
the distance from the minimum is at most |∇f(v)| in the norm of M⁻¹.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Problem:
    """``cones`` lists, for each friction cone, its rows (the normal one first) and the coefficients of the others."""

    mass: np.ndarray
    jacobian: np.ndarray
    bias: np.ndarray
    compliance: np.ndarray
    target: np.ndarray
    lo: np.ndarray
    hi: np.ndarray
    cones: list

    def norm(self, motion):
        return float(np.sqrt(max(motion @ self.mass @ motion, 0.0)))


def forces(problem, motion):
    """x(v), and −dx/ds as a matrix (rows, rows)."""
    speed = problem.jacobian @ motion + problem.bias
    wanted = -speed / problem.compliance
    found = np.clip(wanted, problem.lo, problem.hi)
    slope = np.diag(((wanted > problem.lo) & (wanted < problem.hi)) / problem.compliance)
    for rows, mu in problem.cones:
        found[rows], slope[np.ix_(rows, rows)] = cone(wanted[rows], problem.compliance[rows], np.asarray(mu))
    return found, slope


def cone(wanted, compliance, mu):
    """The projection on |x_t / mu| ≤ x_n in the metric of the compliances, and −dx/ds.

    In z = x_t / mu the metric is isotropic for all engines here: compliance_t mu² is one number.
    """
    metrics = compliance[1:] * mu**2
    if np.ptp(metrics) > 1e-6 * metrics.max():
        raise ValueError("the metric of the friction rows is not isotropic")
    normal, metric = compliance[0], metrics[0]
    scale = np.concatenate([[1.0], mu])
    along = wanted / scale
    size = float(np.linalg.norm(along[1:]))
    if size <= along[0]:
        return wanted, np.diag(1 / compliance)
    if normal * along[0] + metric * size <= 0:
        return np.zeros_like(wanted), np.zeros((len(wanted),) * 2)
    height = (normal * along[0] + metric * size) / (normal + metric)
    direction = along[1:] / size
    found = np.concatenate([[height], height * direction]) * scale
    # The derivative of (height, height * direction) by (along_n, along_t).
    slope = np.zeros((len(wanted),) * 2)
    by_normal, by_size = normal / (normal + metric), metric / (normal + metric)
    slope[0, 0], slope[0, 1:] = by_normal, by_size * direction
    slope[1:, 0] = by_normal * direction
    across = np.eye(len(direction)) - np.outer(direction, direction)
    slope[1:, 1:] = by_size * np.outer(direction, direction) + height / size * across
    return found, scale[:, None] * slope / scale / compliance


def motion(problem, start, steps=100):
    """The minimum and the bound on its distance from the true one, in the norm of M."""
    now, root = np.array(start, dtype=float), np.linalg.cholesky(problem.mass)
    best, least = now, np.inf
    for _ in range(steps):
        found, slope = forces(problem, now)
        gradient = problem.mass @ (now - problem.target) - problem.jacobian.T @ found
        size = float(np.linalg.norm(np.linalg.solve(root, gradient)))
        if size < least:
            best, least = now, size
        if size <= 1e-13 * problem.norm(now - problem.target):
            break
        step = -np.linalg.solve(problem.mass + problem.jacobian.T @ slope @ problem.jacobian, gradient)
        now = now + length(problem, now, step) * step
    return best, least


def length(problem, now, step):
    """Where f is least along a step: the zero of its derivative, which increases."""

    def derivative(part):
        there = now + part * step
        return step @ (problem.mass @ (there - problem.target) - problem.jacobian.T @ forces(problem, there)[0])

    if derivative(1.0) <= 0:
        return 1.0
    low, high = 0.0, 1.0
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if derivative(middle) < 0 else (low, middle)
    return (low + high) / 2
