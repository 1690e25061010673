"""Receipts of numbers that are not finite, and of invalid input."""

import json
from dataclasses import replace

import numpy as np
import pytest

import lcplab

#: 2 kg fall at 3 m/s on a row of compliance 1/2: x = 3 N s, v = -1.5 m/s.
STOP = {
    "mass": [[2.0]], "jacobian": [[1.0]], "bias": [0.0], "compliance": 0.5, "target": [-3.0],
    "forces": [3.0], "motion": [-1.5],
}


def stop(**more):
    return lcplab.EngineStep.of("mine", **{**STOP, **more})


@pytest.mark.parametrize(
    ("name", "stage"),
    [
        ("mass", "assembly"), ("jacobian", "assembly"), ("bias", "assembly"), ("compliance", "assembly"),
        ("target", "assembly"), ("lo", "assembly"), ("hi", "assembly"), ("mu", "assembly"),
        ("forces", "solver"), ("motion", "solver"), ("reported_push", "write-back"),
    ],
)
def test_a_number_that_is_not_finite_is_rejected_with_its_stage_and_place(name, stage):
    wrong = np.full(np.shape(STOP.get(name, [0.0])) or 1, np.nan)
    receipt = lcplab.receipt(stop(**{name: wrong}))
    assert receipt.verdict == "wrong" and receipt.stage == stage
    assert f"{name}[0" in str(receipt) and "nan" in str(receipt)


def test_a_step_without_rows_whose_motion_is_not_finite_is_rejected():
    free = lcplab.EngineStep.of("mine", [[2.0]], np.zeros((0, 1)), [], [-3.0], [], [np.nan])
    assert lcplab.receipt(free).stage == "solver"


def test_the_norm_of_a_motion_that_is_not_finite_is_not_0():
    assert np.isnan(stop().norm(np.array([np.nan])))


def test_an_engine_at_its_iteration_cap_is_wrong_if_its_answer_is_not_finite():
    assert lcplab.receipt(stop(motion=[np.nan], method="pgs", iterations=9, has_converged=False)).verdict == "wrong"


def test_an_engine_at_its_iteration_cap_is_wrong_if_it_writes_back_something_else():
    capped = {"forces": [2.0], "motion": [-2.0], "method": "pgs", "iterations": 9, "has_converged": False}
    assert lcplab.receipt(stop(**capped, reported_push=np.array([2.0]))).verdict == "unconverged"
    receipt = lcplab.receipt(stop(**capped, reported_push=np.zeros(1)))
    assert receipt.verdict == "wrong" and receipt.stage == "write-back"


def test_a_rejected_step_that_is_not_finite_is_written_as_valid_json(tmp_path):
    def refuse(word):
        raise AssertionError(f"{word} is not JSON")

    lcplab.receipts([stop(bias=[np.nan])]).save_worst(tmp_path)
    files = list(tmp_path.rglob("*.json"))
    assert len(files) == 3
    for file in files:
        json.loads(file.read_text(), parse_constant=refuse)
    [again] = lcplab.receipts([file for file in files if file.name == "frame.json"]).receipts.values()
    assert again.stage == "assembly"


def test_an_explicit_limit_holds_whatever_the_engines_own_tolerance_is():
    """v is 1 mm/s off with the forces that cause it: an error of √2 mm/s of an effect of 1.5 √2, which is 6.7e-4."""
    off = stop(forces=[3.002], motion=[-1.499], own_tolerance=1.0)
    loose = lcplab.receipt(off)
    assert loose.limit == pytest.approx(1e-5) and loose.verdict == "unconverged" and loose.stopped_by == "tolerance"
    assert lcplab.receipt(off, limit=1e-4).is_rejected
    assert not lcplab.receipt(off, limit=1e-2).is_rejected
    assert lcplab.receipts([off], limit=1e-4).rejected


@pytest.mark.parametrize("limit", [np.nan, -1e-3])
def test_a_limit_that_is_no_length_is_invalid(limit):
    with pytest.raises(ValueError, match="limit"):
        lcplab.receipt(stop(), limit=limit)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"mass": [[2.0, 0.0]]}, r"mass: has the shape \(1, 2\), must have \(1, 1\)"),
        ({"jacobian": [[1.0], [2.0]]}, r"jacobian: has the shape \(2, 1\), must have \(1, 1\)"),
        ({"bias": [[0.0]]}, r"bias: has the shape \(1, 1\), must be a vector"),
        ({"forces": [3.0, 1.0]}, r"forces: has the shape \(2,\), must have \(1,\)"),
        ({"motion": [1.0, 1.0]}, r"motion: has the shape \(2,\), must have \(1,\)"),
        ({"lo": [0.0, 0.0]}, r"lo: has the shape \(2,\), must have \(1,\)"),
        ({"lo": 1.0, "hi": 0.0}, "lo: is above hi in row 0"),
        ({"mu": [-0.5]}, "mu: is negative in row 0"),
        ({"compliance": -1}, "compliance: is negative in row 0"),
        ({"mass": [[0.0]], "motion": None}, "mass: is not positive definite, so that the motion of the forces"),
        ({"friction_index": [0]}, "friction_index: row 0 names 0, must be another row or -1"),
        ({"friction_index": [0.5]}, "friction_index: row 0 names 0.5"),
        ({"forces": [3.0 + 1.0j]}, "forces: has the type complex128, must be real numbers"),
        ({"forces": ["3"]}, "forces: has the type <U1, must be real numbers"),
        ({"jacobian": [[1.0], [1.0, 2.0]]}, "jacobian: has the type object"),
        ({"level": "position"}, "level: is 'position', must be 'velocity' or 'acceleration'"),
        ({"reported_push": np.zeros(3)}, r"reported_push: has the shape \(3,\)"),
    ],
)
def test_arrays_of_other_shapes_or_kinds_are_invalid_with_their_names(wrong, message):
    with pytest.raises(lcplab.InputError, match=message):
        stop(**wrong)


def test_a_mass_matrix_that_is_not_symmetric_is_invalid():
    two = {"jacobian": [[1.0, 0.0]], "target": [-3.0, 0.0], "motion": [-1.5, 0.0]}
    with pytest.raises(lcplab.InputError, match=r"mass: is not symmetric: \[0, 1\] differs from \[1, 0\]"):
        stop(**two, mass=[[2.0, 1.0], [0.0, 2.0]])


def test_all_defects_are_named_in_one_message():
    with pytest.raises(lcplab.InputError) as error:
        stop(forces=[1.0, 2.0], motion=[], mu=-1.0)
    assert [line.split(":")[1] for line in str(error.value).splitlines()] == [" motion", " forces", " mu"]


def test_a_negative_compliance_is_invalid_in_files_and_in_steps_that_were_changed(tmp_path):
    with pytest.raises(lcplab.InputError, match="compliance: is -1 in row 0, must not be negative"):
        lcplab.receipt(replace(stop(), compliance=np.array([-1.0])))
    lcplab.receipt(stop()).write(tmp_path / "a.json", tmp_path / "a.x.json")
    problem = json.loads((tmp_path / "a.json").read_text())
    problem["motion"]["compliance"] = [-1]
    (tmp_path / "a.json").write_text(json.dumps(problem))
    with pytest.raises(lcplab.InputError, match="a.json: compliance: is -1 in row 0"):
        lcplab.receipts([tmp_path])


@pytest.mark.parametrize("mass", [-2.0, 0.0])
def test_a_mass_that_is_not_positive_is_an_error_of_assembly(mass, tmp_path):
    receipt = lcplab.receipt(stop(mass=[[mass]]))
    assert receipt.stage == "assembly" and f"mass[0, 0] is {mass:g}" in str(receipt)
    receipt.save(tmp_path)
    assert lcplab.receipts([tmp_path]).stages == {"assembly": 1}


def test_a_coefficient_of_friction_that_is_not_a_number_is_named_and_no_other_array():
    step = stop(
        mass=np.eye(3), jacobian=np.eye(3), bias=np.zeros(3), target=[-1.0, 2.0, 0.0], forces=[1.0, -0.5, 0.0],
        motion=[0.0, 1.5, 0.0], compliance=0.0, lo=[0.0, -np.inf, -np.inf], friction_index=[-1, 0, 0],
        mu=[0.0, np.nan, np.nan], model="coulomb-cone",
    )
    assert lcplab.receipt(step).rejected.what == "mu[1] is nan"


def test_arrays_are_copied():
    bias = np.zeros(1)
    step = stop(bias=bias)
    bias[0] = np.nan
    assert lcplab.receipt(step).ok


@pytest.mark.parametrize("name", ["mu", "friction_index", "lo"])
def test_a_problem_file_with_a_vector_of_another_length_is_invalid_with_its_name(name, tmp_path):
    lcplab.receipt(stop()).write(tmp_path / "a.json", tmp_path / "a.x.json")
    problem = json.loads((tmp_path / "a.json").read_text())
    (tmp_path / "a.json").write_text(json.dumps(problem | {name: [-1, -1, -1]}))
    with pytest.raises(lcplab.InputError, match=f"a.json: {name}: has 3 entries, must have 1"):
        lcplab.receipts([tmp_path])


def test_an_adapter_that_returns_no_step_is_an_error():
    class Adapter:
        def problem(self, model, data):
            return {"mass": [[1.0]]}

    with pytest.raises(TypeError, match="adapter: problem.. returned a dict, must return an EngineStep"):
        lcplab.receipt(None, adapter=Adapter())


def test_a_problem_file_without_a_vector_is_invalid_with_the_name_of_the_vector(tmp_path):
    lcplab.receipt(stop()).write(tmp_path / "a.json", tmp_path / "a.x.json")
    problem = json.loads((tmp_path / "a.json").read_text())
    del problem["motion"]["bias"]
    (tmp_path / "a.json").write_text(json.dumps(problem))
    with pytest.raises(lcplab.InputError, match="a.json: motion.bias: is missing"):
        lcplab.receipts([tmp_path])
