"""Steps of Rapier: its impulses cause its motion, and enough sweeps solve the problem that is read."""

import numpy as np
import pytest

import lcplab
import lcplab.rapier

rapier3d = pytest.importorskip("rapier3d")
DT = 0.01


def world(sweeps, friction=0.5):
    """Three boxes, the heaviest on top, that fall on a floor, slide and tilt."""
    made = rapier3d.PhysicsWorld(gravity=(0, 0, -9.81))
    parameters = made.integration_parameters
    parameters.dt, parameters.num_solver_iterations, parameters.contact_recycling = DT, 1, False
    parameters.friction_model = rapier3d.FrictionModel.COULOMB
    parameters.num_internal_stabilization_iterations = sweeps
    made.add_body(rapier3d.RigidBody.fixed(), colliders=[rapier3d.Collider.cuboid(5, 5, 0.1).friction(friction)])
    for k, mass in enumerate((1, 2, 20)):
        moments = rapier3d.MassProperties((0, 0, 0), mass, (0.01 * mass, 0.02 * mass, 0.015 * mass))
        body = rapier3d.RigidBody.dynamic().can_sleep(False).additional_mass_properties(moments)
        place = rapier3d.Isometry3((0.02 * k, 0.01 * k, 0.21 + 0.2 * k), rapier3d.Rotation3(1.0, 0.0, 0.0, 0.0))
        body = body.position(place).linvel((0.3 if k == 2 else 0.0, 0.1, 0.0)).angvel((0.0, 0.1 * k, 0.4))
        made.add_body(body, colliders=[rapier3d.Collider.cuboid(0.1, 0.1, 0.1).density(0.0).friction(friction)])
    return made


def steps(made, count):
    """A step read at every tenth time."""
    made.step()  # Rapier adds up the masses
    for number in range(count):
        before = lcplab.rapier.state(made)
        made.step()
        if number % 10 == 9:
            yield lcplab.rapier.step(made, before)


def test_the_impulses_cause_the_motion_to_single_precision():
    for step in steps(world(sweeps=1), 60):
        caused = step.target + np.linalg.solve(step.dense_mass(), step.push(step.forces))
        change = np.abs(step.motion - step.target).max()
        assert len(step) > 0 and change > 0.01
        assert np.abs(caused - step.motion).max() < 3e-5 * change


def test_many_sweeps_solve_the_problem_and_one_does_not():
    for sweeps, is_solved in ((2000, True), (1, False)):
        found = [lcplab.receipt(step, limit=1e-3) for step in steps(world(sweeps), 60)]
        assert all(receipt.ok for receipt in found) == is_solved, [str(receipt) for receipt in found]
        assert all(receipt.stage in (None, "solver") for receipt in found)


def test_one_line_writes_the_problem_of_a_step(tmp_path):
    made = world(sweeps=2000)
    made.step()
    for _ in range(10):
        before = lcplab.rapier.state(made)
        made.step()
    file = lcplab.rapier.problem(made, before, tmp_path / "frame.json")
    assert file["model"] == "coulomb-cone" and len(lcplab.Problem.read(tmp_path / "frame.json")) == len(file["b"])
    assert (tmp_path / "frame.x.json").exists()


def test_a_world_whose_points_are_not_reported_is_refused_with_what_to_set():
    made = world(sweeps=1)
    with pytest.raises(lcplab.InputError, match="a body has no mass"):
        lcplab.rapier.state(made)
    made.step()
    before = lcplab.rapier.state(made)
    made.integration_parameters.num_solver_iterations = 4
    made.integration_parameters.contact_recycling = True
    with pytest.raises(lcplab.InputError, match="num_solver_iterations: is 4, must be 1") as refused:
        lcplab.rapier.step(made, before)
    assert "contact_recycling: is True, must be False" in str(refused.value)
    with pytest.raises(lcplab.InputError, match=r"before: poses have the shape \(2, 7\)"):
        lcplab.rapier.step(made, tuple(part[:2] for part in before))
