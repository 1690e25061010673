"""Derivatives of solutions: closed forms, products in both directions, comparisons, JAX."""

import json
import subprocess
import sys

import numpy as np
import pytest
from test_examples import example

import lcplab
from lcplab import Problem, gradient


def test_one_contact_has_a_slope_on_one_side_of_its_kink():
    assert gradient(Problem([[4.0]], [-3])).dx_db.tolist() == [[-0.25]]
    kink = gradient(Problem([[4.0]], [0]))
    assert (kink.status, kink.kinks, kink.dx_db) == ("kink", [0], None)
    assert (kink.dx_db_right.tolist(), kink.dx_db_left.tolist()) == ([[0.0]], [[-0.25]])
    with pytest.raises(lcplab.InputError, match="kink at row 0"):
        kink.vjp([1])


@pytest.mark.parametrize("seed", range(8))
def test_both_products_agree_with_differences_of_other_solutions(seed):
    rng, n = np.random.default_rng(seed), 6
    G = rng.normal(size=(n, n))
    A, b = G @ G.T + np.eye(n), rng.normal(size=n)
    lo, hi = -rng.uniform(0.1, 0.5, n), rng.uniform(0.1, 0.5, n)
    found = gradient(Problem(A, b, lo=lo, hi=hi))
    changes = {name: rng.normal(size=np.shape(own)) for name, own in {"A": A, "b": b, "lo": lo, "hi": hi}.items()}
    moved = lambda t: lcplab.solve(A + t * changes["A"], b + t * changes["b"], lo + t * changes["lo"], hi + t * changes["hi"]).x
    expected = (moved(1e-6) - moved(-1e-6)) / 2e-6
    dx, du = found.jvp(**changes)
    assert du is None and np.allclose(dx, expected, atol=1e-7)
    v = rng.normal(size=n)
    gradients = found.vjp(v)
    assert np.isclose(v @ dx, sum(np.sum(gradients[name] * change) for name, change in changes.items()))


def test_friction_and_motion():
    contact = Problem([[2, 0], [0, 2]], [-4, -9], friction_index=[-1, 0], mu=[0, 0.5])
    assert gradient(contact).vjp([0, 1])["mu"].tolist() == [0, 2]
    assert gradient(contact).jvp(mu=[0, 1])[0].tolist() == [0, 2]
    assert gradient(contact).vjp([0, 1])["motion"] is None and gradient(contact).u is None


def test_a_matrix_of_another_program_is_compared():
    found = gradient(Problem([[2, 1], [1, 2]], [-1, -1]))
    assert found.compare(found.dx_db)["right"]
    wrong = found.compare(-found.dx_db)
    assert not wrong["right"] and wrong["faults"][0]["name"] == "sign" and "reversed" in wrong["text"]
    with pytest.raises(lcplab.InputError, match="must be 2 × 2"):
        found.compare([[1.0]])


def test_a_wrong_answer_and_a_cone_have_no_derivative():
    with pytest.raises(lcplab.InputError, match="no exact solution is known next to it"):
        gradient(Problem([[2.0]], [-1]), x=[3])
    cone = Problem(np.eye(3), [-2, -3, 0], friction_index=[-1, 0, 0], mu=[0, 0.5, 0.5], model="coulomb-cone")
    with pytest.raises(lcplab.InputError, match="derivatives are about boxes only"):
        gradient(cone)
    with pytest.raises(lcplab.InputError, match="unknown field `c`"):
        gradient(Problem([[2.0]], [-1])).jvp(c=[1])
    with pytest.raises(lcplab.InputError, match="must be finite, has NaN"):
        gradient(Problem([[2.0]], [-1])).vjp([np.nan])


def test_jax_differentiates_through_a_contact_solve():
    pytest.importorskip("jax")
    # Impulse i is 3 m/s times the mass of the balls from i on.
    assert np.allclose(example("gradient_jax").main(), 3 * np.triu(np.ones((3, 3))), atol=1e-12)


def test_the_push_of_a_ladder_against_a_wall_changes_with_its_angle_by_the_derivative_of_its_closed_form():
    # x_wall = m g dt L cos θ / (2 (L sin θ + r)): the moments about the point where the ladder touches the floor.
    angle, weight, L, r = np.radians(60), 10 * 9.81 * 0.01, 4.0, 0.05
    exact = -weight * L / 2 * (L + r * np.sin(angle)) / (L * np.sin(angle) + r) ** 2
    # Floor, its two tangents (the first points along the wall's normal), wall.
    assert np.allclose(example("gradient_pose").main(angle), [0, -exact, 0, exact], atol=1e-7)


@pytest.mark.parametrize("scene, step", [("stack", 1), ("dominoes", 5), ("bridge", 3), ("chain", 5), ("ragdoll", 10)])
def test_the_motion_of_a_scene_changes_by_its_derivative(scene, step, tmp_path):
    # In the stack and the dominoes four corners share a load: only the motion has a derivative.
    file = tmp_path / "step.json"
    subprocess.run([sys.executable, "-m", "lcplab", "export", scene, "--step", str(step), "--out", file], check=True)
    problem, motion = Problem.read(file), json.loads(file.read_text())["motion"]
    n, k = len(problem), len(motion["target"])
    M, J, target = np.zeros((k, k)), np.zeros((n, k)), np.array(motion["target"])
    for i, j, value in motion["mass"]:
        M[i, j] = M[j, i] = value
    for i, j, value in motion["jacobian"]:
        J[i, j] = value
    found = gradient(problem)
    assert found.is_of_motion == (scene in ("stack", "dominoes", "bridge"))

    def moved(change):
        b, friction = problem.b + J @ change, {"friction_index": problem.friction_index, "mu": problem.mu}
        x = lcplab.solve(problem.A, b, problem.lo, problem.hi, **friction).x
        return target + change + np.linalg.solve(M, J.T @ x)

    change = np.random.default_rng(1).normal(size=k)
    dx, du = found.jvp(target=change)
    assert (dx is None) == found.is_of_motion
    assert np.allclose(du, (moved(1e-6 * change) - moved(0 * change)) / 1e-6, atol=1e-7)
    # The mean of all velocities, differentiated backward.
    backward = found.vjp(np.zeros(n), u=np.ones(k))["motion"]["target"]
    assert np.isclose(backward @ change, du.sum(), atol=1e-9 * abs(du).sum())


def test_mujocos_derivative_of_a_step_is_the_exact_one():
    pytest.importorskip("mujoco")
    theirs, exact, without_contacts = example("gradient_mujoco").main()
    assert np.allclose(theirs, exact, rtol=1e-6, atol=1e-12)
    # The contacts take most of the motor's effect.
    assert abs(theirs[6]) < 0.05 * without_contacts[6]
