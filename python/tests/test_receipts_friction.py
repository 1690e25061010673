"""Receipts of steps with Coulomb friction, whose answers sweeps in NumPy find from the law alone."""

from dataclasses import replace

import numpy as np
import pytest

import lcplab

CONTACTS = 4


def swept(mass, jacobian, bias, compliance, target, mu, is_disc):
    """The forces after sweeps over contacts, each solved by its law with the other contacts fixed."""
    a = jacobian @ np.linalg.solve(mass, jacobian.T) + np.diag(compliance)
    b = jacobian @ target + bias
    x = np.zeros(len(b))
    for _ in range(20_000):
        before = x.copy()
        for n in range(0, len(b), 3):
            x[n] = max(0.0, x[n] - (a[n] @ x + b[n]) / a[n, n])
            if is_disc:
                rows, radius = [n + 1, n + 2], mu * x[n]
                step = x[rows] - (a[rows] @ x + b[rows]) / np.trace(a[np.ix_(rows, rows)])
                x[rows] = step * min(1.0, radius / max(np.linalg.norm(step), 1e-300))
            else:
                for t in (n + 1, n + 2):
                    x[t] = np.clip(x[t] - (a[t] @ x + b[t]) / a[t, t], -mu * x[n], mu * x[n])
        if np.abs(x - before).max() <= 1e-15 * np.abs(x).max():
            return x
    return None


def drawn(seed, model):
    """A random step: three bodies, four contacts, some of them sliding; half of the steps have compliance."""
    draw = np.random.default_rng(seed)
    k, n = 9, 3 * CONTACTS
    mass = np.diag(draw.uniform(0.5, 2, k))
    jacobian = draw.normal(size=(n, k)) * (draw.random((n, k)) < 0.6)
    if seed % 4 == 0:
        jacobian[3:6] = jacobian[:3]  # a redundant contact
    compliance = np.full(n, draw.choice([1e-2, 0.3]) if seed % 2 else 0.0)
    bias, target, mu = draw.normal(size=n) * 0.1, draw.normal(size=k), draw.uniform(0.1, 0.8)
    forces = swept(mass, jacobian, bias, compliance, target, mu, is_disc=model is not None)
    if forces is None or not forces.any():
        return None
    index = np.array([-1, 0, 0] * CONTACTS) + np.repeat(np.arange(0, n, 3), 3) * (np.arange(n) % 3 > 0)
    return lcplab.EngineStep.of(
        "sweeps", mass, jacobian, bias, target, forces, target + np.linalg.solve(mass, jacobian.T @ forces),
        compliance=compliance, lo=np.where(index < 0, 0.0, -np.inf), friction_index=index, mu=np.where(index < 0, 0, mu),
        model=model,
    )


@pytest.mark.parametrize("model", [None, "coulomb-cone"])
def test_answers_of_the_law_are_accepted_and_answers_with_other_friction_are_not(model):
    bounded = wrong = 0
    for seed in range(120):
        step = drawn(seed, model)
        if step is None:
            continue
        right = lcplab.receipt(step)
        assert not right.is_rejected, f"{seed}: {right}"
        if not right.ok:
            continue
        bounded += 1
        assert right.frozen and right.motion_error < 1e-6
        for factor in (0.0, 0.9, 1.1):
            forces = np.where(step.friction_index < 0, 1, factor) * step.forces
            motion = step.target + np.linalg.solve(step.dense_mass(), step.push(forces))
            change = step.norm(motion - step.motion) / step.effect
            other = lcplab.receipt(replace(step, forces=forces, motion=motion))
            if change > 1e-3:
                wrong += 1
                assert other.stage == "solver", f"{seed}, {factor}: {other}"
    assert bounded > 40 and wrong > 40, (bounded, wrong)
