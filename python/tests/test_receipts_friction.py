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
    accepted, wrong = {True: 0, False: 0}, {True: 0, False: 0}
    for seed in range(120):
        step = drawn(seed, model)
        if step is None:
            continue
        is_rigid = not step.compliance.any()
        right = lcplab.receipt(step)
        assert right.ok, f"{seed}: {right}"
        accepted[is_rigid] += 1
        if right.motion_error is None:
            assert is_rigid and model == "coulomb-cone" and right.residual < 1e-9
        else:
            assert right.frozen and right.motion_error < 1e-6
        for factor in (0.0, 0.9, 1.1):
            forces = np.where(step.friction_index < 0, 1, factor) * step.forces
            if change_of(step, forces) > 1e-3:
                wrong[is_rigid] += 1
                other = lcplab.receipt(moved(step, forces))
                assert other.stage == "solver", f"{seed}, {factor}: {other}"
    assert min(accepted.values()) > 20 and min(wrong.values()) > 20, (accepted, wrong)


def moved(step, forces):
    """The step with other forces and the motion that they cause."""
    return replace(step, forces=forces, motion=step.target + np.linalg.solve(step.dense_mass(), step.push(forces)))


def change_of(step, forces):
    """The change of the motion by other forces, relative to the change that the constraints cause."""
    return step.norm(moved(step, forces).motion - step.motion) / step.effect


def sideways(forces):
    """Friction turned by a right angle in each contact."""
    turned = forces.copy()
    turned[1::3], turned[2::3] = -forces[2::3], forces[1::3]
    return turned


def pulling(forces):
    """The largest normal impulse pulls."""
    turned = forces.copy()
    turned[3 * int(np.argmax(forces[::3]))] *= -1
    return turned


def without_one(forces):
    """The largest contact is left out, so that bodies move into each other."""
    left = forces.copy()
    first = 3 * int(np.argmax(forces[::3]))
    left[first : first + 3] = 0
    return left


@pytest.mark.parametrize("tamper", [sideways, pulling, without_one, lambda forces: 0 * forces, lambda forces: 1.01 * forces])
def test_rigid_contacts_under_coulombs_law_with_other_forces_are_rejected(tamper):
    tampered = 0
    for seed in range(0, 240, 2):
        step = drawn(seed, "coulomb-cone")
        if step is None or change_of(step, tamper(step.forces)) < 1e-3:
            continue
        tampered += 1
        receipt = lcplab.receipt(moved(step, tamper(step.forces)))
        assert receipt.stage == "solver", f"{seed}: {receipt}"
    assert tampered > 20


@pytest.mark.parametrize("tamper", [pulling, lambda forces: np.where(np.arange(len(forces)) % 3, 3, 1) * forces])
def test_forces_outside_their_cones_are_rejected_in_a_problem_that_is_not_known_completely(tamper):
    outside = 0
    for seed in range(1, 120, 2):
        step = drawn(seed, "coulomb-cone")
        if step is None:
            continue
        unknown = replace(step, no_bound="because of a closed loop")
        assert lcplab.receipt(unknown).verdict == "not checked"
        forces = tamper(step.forces)
        if (np.hypot(forces[1::3], forces[2::3]) > step.mu[1::3] * forces[::3] + 1e-2).any():
            outside += 1
            assert lcplab.receipt(moved(unknown, forces)).stage == "solver", seed
    assert outside > 10
