"""The difference of two steps of the same state is divided into the parts of their stages, by closed forms of one contact."""

import numpy as np
import pytest

import lcplab

MASS, COMPLIANCE, FALL = 2.0, 0.5, -3.0


def exact(target=FALL, bias=0.0, mass=MASS):
    """Force and motion of one compliant contact: (1/m + γ) x = -(u* + bias)."""
    force = max(0.0, -(target + bias) / (1 / mass + COMPLIANCE))
    return force, target + force / mass


def step(target=FALL, bias=0.0, mass=MASS, error=0.0, kind="normal", rows=1):
    """A step with ``rows`` equal contacts that share the force; ``error`` is the solver's, in its force."""
    force, _ = exact(target, bias, mass)
    force += error
    return lcplab.EngineStep.of(
        "mine", mass=[[mass]], jacobian=[[1.0]] * rows, bias=[bias] * rows, compliance=COMPLIANCE * rows, target=[target],
        forces=[force / rows] * rows, motion=[target + force / mass], version="1",
        rows=[lcplab.EngineRow(f"{kind} {row}", kind, ("ball", "floor")) for row in range(rows)],
    )


def effect():
    """The norm of the change by the contact."""
    return np.sqrt(MASS) * (exact()[1] - FALL)


def test_equal_steps_have_no_difference():
    parts = lcplab.attribution(step(), step())
    assert parts.difference == 0 and max(*parts.solver, parts.free_motion, parts.rows) < 1e-9


def test_an_error_of_a_solver_is_that_solvers():
    parts = lcplab.attribution(step(), step(error=0.3))
    expected = np.sqrt(MASS) * 0.3 / MASS / effect()
    assert parts.difference == pytest.approx(expected) and parts.solver[1] == pytest.approx(expected)
    assert max(parts.solver[0], parts.free_motion, parts.rows) < 1e-9
    assert lcplab.attribution(step(error=0.3), step()).solver[1] < 1e-9


def test_another_free_motion_is_of_assembly():
    parts = lcplab.attribution(step(), step(target=-2.0))
    expected = np.sqrt(MASS) * (exact(-2.0)[1] - exact()[1]) / effect()
    assert parts.free_motion == pytest.approx(expected) and parts.difference == pytest.approx(expected)
    assert max(*parts.solver, parts.rows) < 1e-9


def test_other_numbers_of_the_same_rows_are_of_assembly_and_other_rows_of_collision():
    parts = lcplab.attribution(step(), step(bias=0.5))
    expected = np.sqrt(MASS) * (exact()[1] - exact(bias=0.5)[1]) / effect()
    assert parts.rows == pytest.approx(expected) and parts.rows_are_of == "assembly"
    assert max(*parts.solver, parts.free_motion) < 1e-9
    # Two contacts of twice the compliance move the ball as one does.
    other = lcplab.attribution(step(), step(rows=2, bias=0.5))
    assert other.rows == pytest.approx(expected) and other.rows_are_of == "collision"
    assert "collision: rows" in str(other)


def test_two_steps_of_one_engine_have_different_names():
    parts = lcplab.attribution(step(), step(error=0.3))
    assert parts.engines == ("mine 1 (first)", "mine 1 (second)")


def test_steps_with_other_degrees_of_freedom_are_invalid():
    falling = lcplab.EngineStep.of("mine", mass=np.eye(2), jacobian=np.zeros((0, 2)), bias=[], target=[0, 0], forces=[])
    with pytest.raises(lcplab.InputError, match="1 and 2 degrees of freedom"):
        lcplab.attribution(step(), falling)


def test_a_problem_that_lcplab_does_not_solve_is_named():
    rolling = lcplab.EngineStep.of(
        "mine", mass=np.eye(4), jacobian=np.eye(4), bias=[0.0] * 4, compliance=0.5, target=[-1.0, 0, 0, 0],
        forces=[2 / 3, 0, 0, 0], lo=[0, -np.inf, -np.inf, -np.inf], friction_index=[-1, 0, 0, 0], mu=[0, 0.5, 0.5, 0.5],
    )
    with pytest.raises(lcplab.InputError, match="does not solve the problem of mine.*3 friction rows"):
        lcplab.attribution(rolling, rolling)
