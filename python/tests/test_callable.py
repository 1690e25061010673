"""A function is a solver wherever a solver is named."""

import numpy as np
import pytest

import lcplab
from lcplab.testing import assert_no_false_claims, assert_solves


def sweeps(A, b, lo, hi, tolerance, max_iterations, **settings):
    """Projected Gauss-Seidel that yields its iterates."""
    x = np.zeros(len(b))
    for _ in range(max_iterations):
        for i in range(len(b)):
            x[i] = np.clip(x[i] - (A[i] @ x + b[i]) / A[i, i], lo[i], hi[i])
        yield x.copy()
        w = A @ x + b
        terms = np.abs(A) @ np.abs(x) + np.abs(b)
        if (np.abs(x - np.clip(x - w / np.diag(A), lo, hi)) * np.diag(A) <= tolerance * terms).all():
            return


def clamps_late(A, b, lo, hi, **settings):
    return np.clip(np.linalg.lstsq(A, -b, rcond=None)[0], lo, hi)


def breaks(A, b, lo, hi, **settings):
    raise ZeroDivisionError("row 3 has no mass")


P = lcplab.Problem([[2, -1], [-1, 2]], [-1, 2])


def test_an_answer_and_iterates_are_heard():
    r = lcplab.solve(P, solver=clamps_late)
    assert r.status == "solved" and r.solver == "clamps_late" and r.iterations == 1
    r = lcplab.solve([[2, 1], [1, 2]], [-5, -6], solver=sweeps, trace=True)
    assert r and 1 < r.iterations == r.trace["iteration"][-1]


def test_a_wrong_answer_is_a_claim_that_the_judge_refutes():
    p = lcplab.Problem([[2, 1], [1, 2]], [-5, 1])
    r = lcplab.solve(p, solver=lambda A, b, lo, hi, **s: [1.0, 1.0])
    assert r.status == "solved" and not r


@pytest.mark.parametrize(
    "function, words",
    [
        (breaks, "ZeroDivisionError: row 3 has no mass"),
        (lambda A, b, lo, hi, **s: [1.0], "x has length 1, the problem has 2 rows"),
        (lambda A, b, lo, hi, **s: [np.nan, 0.0], "no finite number"),
        (lambda A, b, lo, hi, **s: "x", "TypeError"),
    ],
)
def test_an_exception_is_a_failure_with_its_message(function, words):
    r = lcplab.solve(P, solver=function)
    assert r.status == "failed" and words in r.message
    row = lcplab.compare(P, [function, "dantzig"]).rows[0]
    assert row["claimed"] == 0 and words in row["trouble"]


@pytest.mark.parametrize("end", [KeyboardInterrupt, SystemExit, GeneratorExit])
def test_what_ends_more_than_a_function_passes_through(end):
    called = []

    def ends(A, b, lo, hi, **settings):
        called.append(len(b))
        raise end(3)

    def ends_later(A, b, lo, hi, **settings):
        yield np.zeros(len(b))
        raise end(3)

    large = lcplab.Problem.generate("stack", n=300)
    for solve in (
        lambda f: lcplab.solve(P, solver=f),
        lambda f: lcplab.solve(P, solver=f, trace=True),
        lambda f: lcplab.solve(large, solver=f),
        lambda f: lcplab.compare([P, large], [f, "pgs"]),
        lambda f: lcplab.hunt(f, n=2, evaluations=10_000),
        lambda f: lcplab.Scene.load("fig7").step(f),
        lambda f: assert_solves(f, [P]),
    ):
        for function in (ends, ends_later):
            with pytest.raises(end):
                solve(function)
            assert lcplab.solve(P, solver="dantzig"), "nothing of it is left for the next call"
    # What was not under way yet is not begun any more, so that no more than one call a thread was
    # made.
    assert len(called) < 50


def test_an_answer_with_imaginary_parts_is_no_answer():
    for x in (np.array([0.5 + 1j, 0]), [np.complex128(0.5 + 1j), 0.0]):
        r = lcplab.solve(P, solver=lambda A, b, lo, hi, **s: x)
        assert r.status == "failed" and "x is complex, must be real" in r.message


def test_none_is_no_claim():
    assert lcplab.solve(P, solver=lambda A, b, lo, hi, **s: None).status == "iteration_limit"


def test_functions_are_compared_with_solvers():
    table = lcplab.compare({"two": P, "one": ([[1]], [-1])}, [sweeps, "pgs"])
    assert [(row["family"], row["solver"], row["accepted"]) for row in table.rows] == [
        ("two", "sweeps", 1), ("two", "pgs", 1), ("one", "sweeps", 1), ("one", "pgs", 1),
    ]
    assert table.to_csv().count("\n") == 5 and "<table>" in table._repr_html_()
    assert set(table.profile()) == {"sweeps", "pgs"} and "sweeps" in str(table)


def test_the_hunt_finds_the_smallest_wrong_answer_and_finds_it_again():
    search = dict(n=2, evaluations=2000, within="definite")
    found = lcplab.hunt(clamps_late, **search)
    assert len(found.problem) == 2 and found.words.startswith("clamps_late says: solved")
    assert not lcplab.solve(found.problem, solver=clamps_late)
    [x] = found.problem.solutions
    assert lcplab.judge(found.problem, x=[float(x) for x in x])
    assert lcplab.hunt(clamps_late, **search).problem.to_json() == found.problem.to_json()
    assert lcplab.hunt("dantzig", n=2, evaluations=200) is None


def test_a_function_steps_a_scene():
    ours, theirs = lcplab.Scene.load("fig7"), lcplab.Scene.load("fig7")
    assert ours.step(sweeps) and theirs.step("dantzig")
    np.testing.assert_allclose(ours.poses, theirs.poses, atol=1e-7)


def test_other_projects_can_ask_whether_a_solver_solves():
    assert_solves("dantzig")
    assert_solves(sweeps, [P])
    with pytest.raises(AssertionError, match="row 3 has no mass"):
        assert_solves(breaks, [P])
    with pytest.raises(AssertionError, match="clamps_late says: solved"):
        assert_no_false_claims(clamps_late)


C = lcplab.Problem(
    np.eye(3), [-2, -3, -3], friction_index=[-1, 0, 0], mu=[0, 0.5, 0.5], model="coulomb-cone"
)


def slides(A, b, lo, hi, model=None, friction_index=None, mu=None, **settings):
    """The answer to one contact on a diagonal A that slides: x_n = -b_n / a_n, friction of mu x_n against the push."""
    if model != "coulomb-cone" or len(b) != 3:
        raise NotImplementedError
    x = np.zeros(3)
    x[0] = max(-b[0] / A[0, 0], 0)
    x[1:] = -b[1:] / np.linalg.norm(b[1:]) * mu[1] * x[0]
    return x


def test_a_function_that_names_the_model_gets_friction_cones():
    r = lcplab.solve(C, solver=slides)
    assert r and r.solver == "slides"
    np.testing.assert_allclose(r.x, [2, 0.5**0.5, 0.5**0.5])
    row = lcplab.compare(C, [slides]).rows[0]
    assert (row["model"], row["claimed"], row["accepted"]) == ("coulomb-cone", 1, 1)
    box = lcplab.compare(P, [slides]).rows[0]
    assert (box["outside"], box["claimed"]) == (1, 0)


def test_a_function_for_boxes_never_gets_a_cone_and_a_row_says_so():
    called = []

    def boxes(A, b, lo, hi, **settings):
        called.append(settings)
        return np.zeros(len(b))

    rows = lcplab.compare(C, [boxes, "cone-pgs"]).rows
    assert [row["solver"] for row in rows] == ["boxes", "cone-pgs"]
    assert rows[0]["trouble"] == "not run: it does not declare support for coulomb-cone" and rows[0]["outside"] == 1
    with pytest.raises(lcplab.InputError, match="a parameter named model"):
        lcplab.solve(C, solver=boxes)
    with pytest.raises(lcplab.InputError, match="a parameter named model"):
        lcplab.hunt(boxes, model="coulomb-cone", evaluations=10)
    assert called == []


def test_the_hunt_shows_the_wrong_x_and_the_right_one_under_the_model():
    def box(A, b, lo, hi, model=None, friction_index=None, mu=None, max_iterations=0, **settings):
        x = np.zeros(len(b))
        for _ in range(200):
            for i, k in enumerate(friction_index):
                low, high = (lo[i], hi[i]) if k < 0 else (-mu[i] * x[k], mu[i] * x[k])
                x[i] = np.clip(x[i] - (A[i] @ x + b[i]) / A[i, i], low, high)
        return x

    found = lcplab.hunt(box, model="coulomb-cone", evaluations=2000)
    assert found.problem.model == "coulomb-cone" and not lcplab.judge(found.problem, x=found.x)
    assert lcplab.judge(found.problem, x=found.right_x)
    assert "x of box" in str(found)


def test_a_solver_that_solves_nothing_is_not_honest():
    for options in ({}, {"friction": True}, {"model": "coulomb-cone"}):
        def fails(A, b, lo, hi, model=None, **settings):
            raise ValueError("no licence")

        with pytest.raises(AssertionError, match="fails solves none of .*ValueError: no licence"):
            assert_no_false_claims(fails, evaluations=100, **options)


def test_single_precision_is_honest_within_its_own_tolerance():
    def single(A, b, lo, hi, friction_index=None, mu=None, **settings):
        A, b, lo, hi = (v.astype(np.float32) for v in (A, b, lo, hi))
        x = np.zeros(len(b), dtype=np.float32)
        for _ in range(2000):
            before = x.copy()
            for i in range(len(b)):
                k = -1 if friction_index is None else friction_index[i]
                low, high = (lo[i], hi[i]) if k < 0 else (-np.float32(mu[i]) * x[k], np.float32(mu[i]) * x[k])
                x[i] = np.clip(x[i] - (A[i] @ x + b[i]) / A[i, i], low, high)
            yield x.astype(float)
            if (x == before).all():
                return

    assert_no_false_claims(single, evaluations=300, tolerance=1e-5, friction=True)


def test_an_x_that_has_not_converged_is_no_lie():
    def ten(A, b, lo, hi, **settings):
        x = np.zeros(len(b))
        for _ in range(10):
            for i in range(len(b)):
                x[i] = np.clip(x[i] - (A[i] @ x + b[i]) / A[i, i], lo[i], hi[i])
        return x

    assert_no_false_claims(ten, evaluations=1000)


def test_ctrl_c_stops_a_hunt():
    import os, signal, subprocess, sys, textwrap, time

    script = textwrap.dedent(
        """
        import lcplab, signal
        signal.signal(signal.SIGINT, signal.default_int_handler)  # a parent may have ignored it
        print("begun", flush=True)
        try:
            lcplab.hunt("dantzig", n=(20, 30), evaluations=10**8)
        except KeyboardInterrupt:
            print("stopped", flush=True)
        """
    )
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "begun\n"
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=60)
    assert out == "stopped\n" and process.returncode == 0


@pytest.mark.parametrize(
    "function", [lambda: None, lambda A, b: b, lambda A, b, lo, hi: b, lambda A, b, lo, hi, *, sweeps, **settings: b]
)
def test_the_hunt_refuses_a_function_that_cannot_be_called_as_a_solver(function):
    for search in (lambda f: lcplab.hunt(f, evaluations=10), lambda f: lcplab.hunt("pgs", "ratio", baseline=f, evaluations=10)):
        with pytest.raises(TypeError, match=r"solver: .*\(A, b, lo, hi, tolerance=, max_iterations=.* is no valid call"):
            search(function)
    with pytest.raises(TypeError, match="is no valid call"):
        lcplab.testing.assert_no_false_claims(function, evaluations=10)
