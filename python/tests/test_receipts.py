"""Receipts of steps with known answers, and of steps in which one thing was changed."""

import json
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

import lcplab

#: 2 kg fall at 3 m/s on a row of compliance 1/2: x = 3 N s, v = -1.5 m/s.
STOP = {"mass": [[2.0]], "jacobian": [[1.0]], "bias": [0.0], "compliance": 0.5, "target": [-3.0]}


def stop(**more):
    return lcplab.EngineStep.of("mine", **{**STOP, "forces": [3.0], "motion": [-1.5], **more})


def slide():
    """1 kg is pressed down at 2 m/s and slides at 4: on the cone x = (5, 3) / 2 with mu = 0.6, by hand.

    w = v + x/2 of the normal and the tangent must be (0.6, -1) s times the dual cone's surface.
    """
    force = np.array([2.5, -1.5])
    left = np.array([0.6, 1.0])  # orthogonal to the force
    motion = left - 0.5 * force
    return lcplab.EngineStep.of(
        "mine", mass=np.eye(2), jacobian=np.eye(2), bias=[0.0, 0.0], compliance=0.5, target=motion - force,
        forces=force, motion=motion, lo=[0.0, -np.inf], friction_index=[-1, 0], mu=[0.0, 0.6],
    )


@pytest.mark.parametrize("step", [stop(), slide()])
def test_an_exact_step_is_ok(step):
    receipt = lcplab.receipt(step)
    assert receipt.ok and receipt.motion_error < 1e-7, str(receipt)
    assert "collision" in receipt.not_checked and "assembly" in receipt.not_checked


def test_a_wrong_answer_is_the_solvers():
    step = stop(forces=[2.0], motion=[-2.0])  # v is that of the forces
    receipt = lcplab.receipt(step)
    assert receipt.stage == "solver" and receipt.row == 0
    true = np.sqrt(2) * 0.5
    assert receipt.bound >= true and receipt.bound < 2 * true


def test_a_right_motion_with_wrong_forces_is_written_back_wrongly():
    receipt = lcplab.receipt(stop(forces=[1.5]))
    assert receipt.stage == "write-back" and receipt.motion_error < 1e-12


def test_a_rigid_row_tells_wrong_forces_from_a_wrong_motion_too():
    rigid = {"compliance": 0.0, "motion": [0.0]}  # 2 kg at -3 m/s are stopped by 6 N s
    assert lcplab.receipt(stop(**rigid, forces=[6.0])).ok
    wrong_forces = lcplab.receipt(stop(**rigid, forces=[7.5]))
    assert wrong_forces.stage == "write-back" and wrong_forces.motion_error < 1e-12
    wrong_motion = lcplab.receipt(stop(compliance=0.0, forces=[6.0], motion=[0.1]))
    assert wrong_motion.stage == "write-back" and wrong_motion.bound >= 0.1 * np.sqrt(2)
    assert lcplab.receipt(stop(compliance=0.0, forces=[5.0], motion=[-0.5])).stage == "solver"


def test_right_forces_with_a_wrong_motion_are_written_back_wrongly():
    receipt = lcplab.receipt(stop(motion=[-1.4]))
    assert receipt.stage == "write-back"
    assert receipt.bound >= 0.1 * np.sqrt(2)


def test_reported_generalized_forces_are_compared_with_those_of_the_rows():
    good, bad = (stop(reported_push=np.array([push])) for push in (3.0, 0.0))
    assert lcplab.receipt(good).ok
    assert lcplab.receipt(bad).stage == "write-back"


def test_assembly_is_compared_with_what_the_adapter_expects():
    expected = {"expected_jacobian": [[1.0]], "expected_bias": np.zeros(1), "expected_target": np.array([-3.0])}
    good = lcplab.receipt(stop(**expected))
    assert good.ok and "assembly" not in good.not_checked
    assert "assembly: all but J, the bias and the free motion" in good.not_checked
    for wrong in (
        {"expected_jacobian": [[-1.0]]}, {"expected_jacobian": [[0.0]]}, {"expected_bias": np.array([0.3])},
        {"expected_target": np.array([-3.1])},
    ):
        receipt = lcplab.receipt(stop(**{**expected, **wrong}))
        assert receipt.stage == "assembly" and receipt.motion_error < 1e-7
    for name, values in (("expected_bias", np.zeros(2)), ("expected_jacobian", [[1.0, 0.0]])):
        with pytest.raises(lcplab.InputError, match=name):
            stop(**{name: values})


@pytest.mark.parametrize("row", [0, 1])
@pytest.mark.parametrize("name", ["expected_jacobian", "expected_bias"])
def test_an_expected_value_that_is_not_a_number_is_rejected_in_every_row(name, row):
    values = np.eye(2) if name == "expected_jacobian" else np.zeros(2)
    values[row] = np.nan
    step = lcplab.EngineStep.of("mine", np.eye(2), np.eye(2), [0.0, 0.0], [-1.0, -1.0], [1.0, 1.0], **{name: values})
    assert lcplab.receipt(step).stage == "assembly"


def test_a_free_motion_that_inputs_do_not_ask_for_is_rejected_without_rows():
    free = lcplab.EngineStep.of("mine", [[2.0]], np.zeros((0, 1)), [], [-3.0], [], [-3.0], expected_target=np.array([-1.5]))
    receipt = lcplab.receipt(free)
    assert receipt.stage == "assembly" and receipt.findings[0].error == pytest.approx(1.0)


def test_a_step_without_rows_is_never_ok():
    free = lcplab.EngineStep.of("mine", [[2.0]], np.zeros((0, 1)), [], [-3.0], [], [-3.0])
    receipt = lcplab.receipt(free)
    assert receipt.verdict == "no rows" and not receipt.ok and not receipt.is_rejected
    assert lcplab.receipt(replace(free, motion=np.array([-2.0]))).stage == "write-back"


@pytest.mark.parametrize("broken", [{"motion": [np.nan]}, {"forces": [np.inf]}])
def test_numbers_that_are_not_finite_are_wrong(broken):
    assert lcplab.receipt(stop(**broken)).stage == "solver"


def test_a_step_in_which_nothing_moves_is_ok():
    assert lcplab.receipt(stop(target=[0.0], forces=[0.0], motion=[0.0])).motion_error == 0


def test_an_engine_at_its_iteration_cap_is_unconverged_and_not_wrong():
    wrong = stop(forces=[2.0], motion=[-2.0], method="pgs", iterations=50, has_converged=False)
    assert lcplab.receipt(wrong).verdict == "unconverged"


def test_a_newton_method_that_takes_many_times_the_steps_it_needs_is_wrong():
    wrong = stop(forces=[2.0], motion=[-2.0], method="newton", iterations=100, has_converged=False)
    receipt = lcplab.receipt(wrong)
    assert receipt.verdict == "wrong" and receipt.work.newton <= 2


def test_a_cone_without_compliance_has_no_bound_and_is_judged_by_its_law():
    assert lcplab.receipt(stop(compliance=0.0, forces=[6.0], motion=[0.0])).ok
    compliant = slide()
    wrong = lcplab.receipt(replace(compliant, compliance=np.zeros(2)))  # its motion violates w_n >= mu |w_t|
    assert wrong.stage == "solver" and wrong.motion_error is None and wrong.residual > 0.1
    left = compliant.motion + 0.5 * compliant.forces
    right = replace(compliant, compliance=np.zeros(2), motion=left, target=left - compliant.forces)
    receipt = lcplab.receipt(right)
    assert receipt.ok and receipt.residual < 1e-12
    assert "because row 0 of a friction cone has no compliance" in str(receipt)


def test_without_a_bound_on_the_motion_write_back_is_still_checked():
    coulomb = replace(slide(), compliance=np.zeros(2))
    assert lcplab.receipt(replace(coulomb, motion=coulomb.motion + 0.1)).stage == "write-back"


def test_unknown_normal_rows_and_friction_models_are_invalid():
    with pytest.raises(lcplab.InputError, match="friction_index"):
        lcplab.receipt(replace(stop(), friction_index=np.array([7])))
    with pytest.raises(lcplab.InputError, match="model"):
        stop(model="coulomb")


def test_a_run_counts_frames_and_knows_those_of_its_baseline(tmp_path):
    wrong = stop(forces=[2.0], motion=[-2.0])
    run = lcplab.receipts([stop(), wrong, stop()])
    assert not run.ok and run.rejected == ["mine 1"] and run.stages == {"solver": 1}
    assert run.counts["1e-3"] == 1
    run.save(tmp_path / "known.json")
    again = lcplab.receipts([stop(), wrong, stop()], baseline=tmp_path / "known.json")
    assert again.ok and again.known == ["mine 1"]
    worse = lcplab.receipts([wrong, wrong, stop()], baseline=tmp_path / "known.json")
    assert not worse.ok


def test_a_run_whose_errors_grow_more_than_chance_explains_is_worse():
    def at(error):
        return stop(forces=[3.0], motion=[-1.5 + error])

    base = lcplab.receipts([at(1e-9 * (k % 7)) for k in range(100)]).to_json()
    assert lcplab.receipts([at(1e-9 * (k % 7)) for k in range(100)], baseline=base).ok
    now = lcplab.receipts([at(1e-7) for _ in range(100)], baseline=base)
    assert now.worse and not now.rejected and not now.ok


def test_files_are_read_back_with_the_same_receipt(tmp_path):
    for k, step in enumerate([stop(), stop(forces=[2.0], motion=[-2.0])]):
        lcplab.receipt(step).write(tmp_path / f"{k}.json", tmp_path / f"{k}.x.json")
    run = lcplab.receipts([tmp_path])
    assert [receipt.verdict for receipt in run.receipts.values()] == ["ok", "wrong"]
    problem = lcplab.Problem.read(tmp_path / "0.json")
    assert lcplab.judge(problem, x=[3.0])
    assert json.loads((tmp_path / "0.json").read_text())["motion"]["level"] == "velocity"


def test_the_command_rejects_the_frames_that_python_rejects(tmp_path):
    folder = tmp_path / "frames"
    folder.mkdir()
    for k, step in enumerate([stop(), stop(forces=[2.0], motion=[-2.0])]):
        lcplab.receipt(step).write(folder / f"{k}.json", folder / f"{k}.x.json")
    command = [sys.executable, "-m", "lcplab", "receipts", folder, "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    printed, own = json.loads(done.stdout), lcplab.receipts([folder])
    assert done.returncode == 1 and printed["rejected"] == {own.rejected[0]: "solver"}
    assert printed["receipts"] == {name: receipt.to_json() for name, receipt in own.receipts.items()}


def test_the_fixture_fails_a_test_with_a_rejected_step(pytester):
    pytester.makepyfile("""
        import lcplab

        def step(force, motion):
            return lcplab.EngineStep.of("mine", [[2.0]], [[1.0]], [0.0], [-3.0], [force], [motion], compliance=0.5)

        def test_good(lcplab_receipts):
            for _ in range(4):
                lcplab_receipts(step(3.0, -1.5), every=2)

        def test_bad(lcplab_receipts):
            lcplab_receipts(step(2.0, -2.0))
    """)
    result = pytester.runpytest()
    result.assert_outcomes(passed=1, failed=1)
    result.stdout.fnmatch_lines(["*3 frames, 1 rejected*"])
    assert pytester.runpytest("--lcplab-baseline", "b.json", "--lcplab-update").ret == 0
    pytester.runpytest("--lcplab-baseline", "b.json").assert_outcomes(passed=2)


def test_gravity_as_a_number_of_numpy_is_recorded_too(tmp_path):
    run = lcplab.receipts([stop(motion=[-1.5 + 1e-9], gravity=np.float64(9.0))])
    run.save(tmp_path / "known.json")
    assert lcplab.receipts([stop()], baseline=tmp_path / "known.json").ok


def test_forces_outside_their_bounds_are_the_solvers_where_the_motion_is_theirs():
    """Two rows share a load of 4 N s: any two forces with this sum have the right motion."""
    shared = {"jacobian": [[1.0], [1.0]], "bias": [0.0, 0.0], "motion": [-1.0]}
    assert lcplab.receipt(stop(**shared, forces=[2.0, 2.0])).ok
    receipt = lcplab.receipt(stop(**shared, forces=[5.0, -1.0]))
    assert receipt.stage == "solver" and "although the motion is within the limit" in str(receipt)


def test_a_coupled_box_is_judged_with_the_friction_limits_of_the_answer(tmp_path):
    """2 kg are pressed on a floor at 3 m/s and slide at 4 m/s: x = (6, -0.5 * 6) N s, and 2.5 m/s are left."""
    right = stop(
        mass=2 * np.eye(2), jacobian=np.eye(2), bias=[0.0, 0.0], compliance=0.0, target=[-3.0, 4.0],
        forces=[6.0, -3.0], motion=[0.0, 2.5], lo=[0.0, -np.inf], friction_index=[-1, 0], mu=[0.0, 0.5], model=None,
    )
    receipt = lcplab.receipt(right)
    assert receipt.ok and receipt.frozen and receipt.motion_error < 1e-7 and receipt.difference < 1e-7
    stuck = lcplab.receipt(replace(right, forces=np.array([6.0, -8.0]), motion=np.zeros(2)))
    assert stuck.stage == "solver" and stuck.difference == pytest.approx(2.5 / np.hypot(3, 4))
    assert "with the friction limits of this answer" in str(stuck)
    receipt.write(tmp_path / "a.json", tmp_path / "a.x.json")
    [again] = lcplab.receipts([tmp_path]).receipts.values()
    assert again.step.model is None and again.ok and again.frozen


@pytest.mark.parametrize("seed", range(5))
def test_the_motion_error_of_a_small_step_is_near_the_true_one_below_its_limit_too(seed):
    random = np.random.default_rng(seed)
    n, k, softness = 8, 12, 1e-4
    root, jacobian = 0.1 * random.normal(size=(k, k)), np.eye(n, k) + 0.05 * random.normal(size=(n, k))
    mass, target = root @ root.T + np.eye(k), random.normal(size=k)
    bias = np.full(n, -100.0)  # all contacts are closed: the exact motion solves linear equations
    exact = np.linalg.solve(mass + jacobian.T @ jacobian / softness, mass @ target - jacobian.T @ bias / softness)
    forces = -(jacobian @ exact + bias) / softness
    assert (forces > 0).all()
    forces *= 1 + 1e-5 * random.normal(size=n)
    motion = exact + 1e-5 * random.normal(size=k)
    step = lcplab.EngineStep.of("mine", mass=mass, jacobian=jacobian, bias=bias, compliance=softness, target=target,
                                forces=forces, motion=motion, method="pgs")
    receipt, true_error = lcplab.receipt(step), step.norm(motion - exact)
    assert receipt.ok and true_error * 0.999 <= receipt.bound <= 1.1 * true_error, (receipt.bound, true_error)
