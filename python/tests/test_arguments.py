"""Every function takes a problem and an answer in the same forms, and says what is wrong with another form."""

import pickle

import numpy as np
import pytest

import lcplab
from lcplab import InputError

A, b = np.array([[2.0, -1.0], [-1.0, 2.0]]), np.array([-1.0, 2.0])
X = [0.5, 0.0]
P = lcplab.Problem(A, b)


@pytest.fixture
def path(tmp_path):
    P.write(tmp_path / "p.json")
    return tmp_path / "p.json"


def test_a_problem_is_a_problem_a_path_or_a_tuple(path):
    for problem in (P, path, str(path), (A, b), (A, b, 0, np.inf)):
        assert lcplab.solve(problem).x.tolist() == X
        assert lcplab.judge(problem, X) and lcplab.judge(problem, x=X)
        assert lcplab.gradient(problem).status == "differentiable"
        assert lcplab.solutions(problem).is_unique
        proof = lcplab.prove(problem)
        assert proof.kind == "unique" and lcplab.check(problem, proof) is None
        assert "tableau" in str(lcplab.explain(problem, solver="lemke")).lower()
    assert lcplab.judge(((2.0, -1.0), (-1.0, 2.0)), b, X)  # a tuple of rows, with b


@pytest.mark.parametrize("function", [lcplab.gradient, lcplab.prove, lcplab.solutions, lcplab.solve])
def test_a_matrix_alone_is_no_problem(function):
    with pytest.raises(InputError, match="^problem: is a ndarray; must be a Problem, the path of a file, or a tuple"):
        function(A)


@pytest.mark.parametrize("function", [lcplab.gradient, lcplab.prove])
def test_a_matrix_and_b_are_a_tuple(function):
    with pytest.raises(InputError, match="tuple"):
        function(A, b)


def test_an_answer_may_be_a_result():
    result = lcplab.solve(P)
    assert lcplab.judge(P, result)
    assert lcplab.gradient(P, result).x.tolist() == X
    assert lcplab.prove(P, result).kind == "unique"


@pytest.mark.parametrize(
    "call, words",
    [
        (lambda: lcplab.solve(A, b[:, None]), r"^problem: b: has the shape 2 × 1, must be one-dimensional"),
        (lambda: lcplab.solve(A, np.asmatrix(b)), r"^problem: b: has the shape 1 × 2, must be one-dimensional"),
        (lambda: lcplab.judge(P, np.ones((2, 1))), r"^answer: x: has the shape 2 × 1, must be one-dimensional"),
        (lambda: lcplab.judge(P, [1.0]), r"^answer: x: has length 1, the problem has 2 rows"),
        (lambda: lcplab.solve(P, max_iterations=1e4), r"^options: max_iterations: must be a whole number, is 10000.0"),
        (lambda: lcplab.solve(P, tolerance="1e-8"), r"^options: tolerance: must be a number, is '1e-8'"),
        (lambda: lcplab.judge(P, X, tolerance="1e-8"), r"^options: tolerance: must be a number, is '1e-8'"),
        (lambda: lcplab.solve(A, b, lo=[None, 0]), r"^problem: lo\[0\]: is None, must be a number or ±inf"),
        (lambda: lcplab.gradient(P, [0.5, np.nan]), r"^answer: x\[1\]: is NaN, must be a finite number"),
    ],
)
def test_a_wrong_form_is_named_with_its_field(call, words):
    with pytest.raises(InputError, match=words):
        call()


def test_a_number_that_is_not_finite_is_rejected_in_its_row():
    verdict = lcplab.judge(P, [0.5, np.nan])
    assert not verdict and verdict.row == 1
    assert "x[1] is not a finite number" in str(verdict)


def test_mu_may_be_one_number():
    one = lcplab.Problem(np.eye(3), [-2, -3, 0], friction_index=[-1, 0, 0], mu=0.5)
    assert one.mu.tolist() == [0.5, 0.5, 0.5] or one.mu.tolist() == [0.0, 0.5, 0.5]
    assert lcplab.solve(one).x.tolist() == [2.0, 1.0, 0.0]


def test_the_arrays_of_a_problem_are_read_only():
    for array in (P.A, P.b, P.lo, P.hi):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1


def test_a_verdict_prints_what_the_command_prints(path, tmp_path, capfd):
    from lcplab import _lcplab

    (tmp_path / "x.json").write_text('{"x": [0.4, 0]}')
    _lcplab.run(["lcplab", "judge", str(path), str(tmp_path / "x.json")])
    assert capfd.readouterr().out == str(lcplab.judge(str(path), [0.4, 0.0])) + "\n"
    result = lcplab.solve(str(path))
    _lcplab.run(["lcplab", "solve", str(path)])
    assert capfd.readouterr().out == str(result) + "\n"
    # What is pickled has no problem; it prints its short form.
    assert str(pickle.loads(pickle.dumps(result))) == repr(result)


def test_a_function_that_fails_says_why_in_its_result():
    def column(A, b, lo, hi, **settings):
        return np.ones((2, 1))

    def breaks(A, b, lo, hi, **settings):
        raise ZeroDivisionError("row 3 has no mass")

    assert "x has the shape (2, 1), must be one-dimensional" in repr(lcplab.solve(P, solver=column))
    assert "ZeroDivisionError: row 3 has no mass" in repr(lcplab.solve(P, solver=breaks))
    with pytest.raises(TypeError, match="is no valid call"):
        lcplab.solve(P, solver=lambda A, b: b)


def test_half_precision_is_read(tmp_path):
    np.savez(tmp_path / "h.npz", A=np.array(A, dtype=np.float16), b=np.array([-1.5, 2**-24], dtype=np.float16))
    half = lcplab.Problem.read(tmp_path / "h.npz")
    assert half.A.tolist() == A.tolist() and half.b.tolist() == [-1.5, 2**-24]


def test_receipts_take_one_path(tmp_path):
    step = lcplab.EngineStep.of(
        "mine", mass=[[2.0]], jacobian=[[1.0]], bias=[0.0], compliance=0.5, target=[-3.0], forces=[3.0], motion=[-1.5]
    )
    lcplab.receipt(step).write(tmp_path / "a.json", tmp_path / "a.x.json")
    for path in (tmp_path, str(tmp_path)):
        assert len(lcplab.receipts(path).receipts) == 1


def test_the_names_of_the_package_are_its_own():
    assert not {"Any", "TYPE_CHECKING"} & set(dir(lcplab))
