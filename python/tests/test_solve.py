"""Solving and judging: the answers of closed forms, the words of errors, the bits of the command line."""

import json
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

import lcplab

A, B = np.array([[2.0, -1.0], [-1.0, 2.0]]), np.array([-1.0, 2.0])
SEEDED = ["manufactured", "pd", "friction-pile", "contact-graph", "friction-blocks", "box-stack"]
SIZED = ["murty", "fathi", "stack", "csizmadia"]


@pytest.mark.parametrize("solver", [None, "dantzig", "lemke", "pgs", "newton", "interior-point"])
def test_two_contacts_have_their_closed_form(solver):
    r = lcplab.solve(A, B, solver=solver)
    assert r and r.status == "solved"
    assert_allclose(r.x, [0.5, 0.0], atol=1e-7)
    assert_allclose(r.w, A @ r.x + B, atol=1e-15)


def test_lists_bounds_and_sparse_arrays_are_taken():
    from scipy import sparse

    assert lcplab.solve([[2]], [-8], hi=3).x.tolist() == [3.0]
    assert lcplab.solve([[2, 0], [0, 2]], [-8, -2], hi=3).x.tolist() == [3.0, 1.0]
    assert lcplab.solve([[2]], [8], lo=-np.inf).x.tolist() == [-4.0]
    r = lcplab.solve(sparse.csr_array(A), B)
    assert r.x.tolist() == [0.5, 0.0]
    assert lcplab.solve(A.T[::1], B).x.tolist() == [0.5, 0.0]
    assert lcplab.solve(np.asfortranarray(A), B.astype(np.float32)).x.tolist() == [0.5, 0.0]


def test_friction_is_bounded_by_the_normal_force():
    # Pressed with 2, pushed with 3, mu = 1/2: friction is 1.
    r = lcplab.solve(np.eye(2), [-2, -3], friction_index=[-1, 0], mu=[0, 0.5])
    assert r.verdict == "proved" and r.x.tolist() == [2.0, 1.0]


def test_the_judge_names_the_row_and_the_amount():
    v = lcplab.judge(A, B, [0.5, 0.0])
    assert v and v.verdict == "proved"
    v = lcplab.judge(A, B, [0.5, 1.0])
    # w_1 = 3.5, so row 1 would go to 0: a step of 1 of weight 2, beside the terms 0.5 + 2 + 2.
    assert not v and v.row == 1 and v.amount == pytest.approx(4 / 9)


def test_what_has_no_solution_is_proved_to_have_none():
    r = lcplab.solve([[1, -1], [-1, 1]], [-1, -1], solver="lemke")
    assert r.status == "infeasible" and not r and r.proof


@pytest.mark.parametrize(
    "arguments, words",
    [
        (([[1, 2]], [1]), "A: is 1 × 2, b has 1 entries"),
        (([[np.nan]], [1]), "NaN"),
        (([[1]], [1], [2], [1]), "lo[0]: is 2, above hi[0] = 1"),
        (([[1.0, 0], [0, 1]], [np.inf, np.nan]), "b[1]"),
    ],
)
def test_defects_are_input_errors_with_the_words_of_the_command_line(arguments, words):
    with pytest.raises(lcplab.InputError, match=words.replace("[", r"\[").replace("]", r"\]")):
        lcplab.solve(*arguments)
    assert issubclass(lcplab.InputError, ValueError)


def test_the_arrays_of_a_result_stay_what_was_judged():
    r = lcplab.solve(A, B, solver="pgs", trace=True)
    step = lcplab.Scene.load("fig7").step()
    for array in (r.x, r.w, step.x, *r.trace.values()):
        with pytest.raises(ValueError, match="read-only"):
            array[:] = 5
    for name in ("x", "w"):
        with pytest.raises(AttributeError):
            setattr(r, name, np.zeros(2))
    own = r.x.copy()
    own[:] = 5
    assert r and r.x[0] != 5 and lcplab.judge(A, B, r.x)


@pytest.mark.parametrize("name", ["A", "b", "lo", "hi", "mu", "friction_index"])
def test_imaginary_parts_are_refused_and_not_dropped(name):
    given = {"A": A, "b": B, "lo": [0.0, -np.inf], "hi": [np.inf, np.inf], "friction_index": [-1, 0], "mu": [0.0, 0.5]}
    if name not in ("mu", "friction_index"):
        del given["friction_index"], given["mu"]
    given[name] = np.asarray(given[name]).astype(complex) + (1j if name != "hi" else 0)
    with pytest.raises(lcplab.InputError, match=f"{name}: is complex, must be real"):
        lcplab.Problem(**given)


def test_masked_entries_are_refused_and_not_used():
    masked = np.ma.masked_array(np.asarray(A, dtype=float), mask=[[0, 1], [0, 0]])
    with pytest.raises(lcplab.InputError, match="A: has masked entries"):
        lcplab.solve(masked, B)
    assert lcplab.solve(np.ma.masked_array(A), B)


def test_a_tolerance_or_limit_that_is_no_such_number_is_refused():
    for tolerance in (np.inf, np.nan, -1.0):
        for call in (
            lambda: lcplab.judge(A, B, [5.0, 5.0], tolerance=tolerance),
            lambda: lcplab.solve(A, B, tolerance=tolerance),
        ):
            with pytest.raises(lcplab.InputError, match="tolerance: must be at least 0"):
                call()
    with pytest.raises(lcplab.InputError, match="max_iterations: must be at least 0, is -1"):
        lcplab.solve(A, B, max_iterations=-1)


def test_a_relaxation_factor_that_no_solver_uses_is_refused():
    for solver in (None, "pgs", lambda A, b, lo, hi, **_: b):
        with pytest.raises(lcplab.InputError, match="omega: is used by no chosen solver"):
            lcplab.solve(A, B, solver=solver, omega=1.2)
    with pytest.raises(lcplab.InputError, match="omega: is used by no chosen solver"):
        lcplab.compare({"one": (A, B)}, ["pgs", "dantzig"], omega=1.2)
    assert lcplab.solve(A, B, solver="sor", omega=1.2)
    assert lcplab.compare({"one": (A, B)}, ["pgs", "ssor"], omega=1.2)


def test_an_x_and_a_sparse_matrix_with_imaginary_parts_are_refused():
    from scipy import sparse

    with pytest.raises(lcplab.InputError, match="x: is complex"):
        lcplab.judge(A, B, np.array([0.5 + 1j, 0]))
    with pytest.raises(lcplab.InputError, match="x: is complex"):
        lcplab.prove(lcplab.Problem(A, B), np.array([0.5 + 1j, 0]))
    with pytest.raises(lcplab.InputError, match="A: is complex"):
        lcplab.solve(sparse.csr_array(A * 1j), B)


@pytest.mark.parametrize(
    ("matrix", "b", "name"),
    [([["a"]], [1], "A"), ([[1, 2], [3]], [1, 2], "A"), (None, [1], "A"), ([[1]], ["b"], "b")],
)
def test_what_is_no_array_of_numbers_is_refused_by_name(matrix, b, name):
    with pytest.raises(lcplab.InputError, match=f"problem: {name}: "):
        lcplab.solve(matrix, b)


def test_a_problem_without_rows_is_solved():
    assert lcplab.solve([], []).verdict == "proved"


def test_a_row_that_is_no_whole_number_is_refused():
    for index in ([-1, 0.5], [-1, np.nan], [-1, np.inf]):
        with pytest.raises(lcplab.InputError, match=r"friction_index\[1\]: must be a row or -1"):
            lcplab.Problem(A, B, friction_index=index, mu=[0, 0.5])
    assert lcplab.Problem(A, B, friction_index=[-1.0, 0.0], mu=[0, 0.5]).friction_index.tolist() == [-1, 0]


def test_an_unknown_solver_is_answered_with_the_known_ones():
    with pytest.raises(lcplab.InputError, match="there is no solver named \"gauss\"; there are pgs"):
        lcplab.solve(A, B, solver="gauss")


def test_the_trace_ends_at_the_answer():
    r = lcplab.solve(A, B, solver="pgs", trace=True)
    assert r.trace["iteration"][0] == 0 and r.trace["iteration"][-1] == r.iterations
    assert r.trace["scaled_residual"][-1] <= 1e-8


def test_the_same_bits_as_the_command_line_on_300_problems(tmp_path):
    count = 0
    for family in SEEDED + SIZED:
        for k in range(1, 31):
            problem = lcplab.Problem.generate(family, **{"seed" if family in SEEDED else "n": k})
            problem.write(tmp_path / f"{count:03}.json")
            count += 1
    assert count == 300
    script = "import sys, glob, lcplab\nfrom lcplab._lcplab import run\nfor f in sorted(glob.glob(sys.argv[1] + '/*.json')): run(['lcplab', 'solve', f, '--json'])"
    out = subprocess.run([sys.executable, "-c", script, str(tmp_path)], capture_output=True, text=True, check=True).stdout
    reported = [json.loads(line) for line in out.splitlines()]
    assert len(reported) == 300
    for k, command in enumerate(reported):
        r = lcplab.solve(lcplab.Problem.read(tmp_path / f"{k:03}.json"))
        assert r.x.tolist() == [float(x) for x in command["x"]], k
        assert r.w.tolist() == [float(w) for w in command["w"]], k
        assert (r.status, r.verdict, r.solver) == (command["status"], command["verdict"], command["solver"])


def test_importing_takes_less_than_a_tenth_of_a_second_of_the_processor_beside_numpy():
    script = "import numpy, time; t = time.process_time(); import lcplab; print(time.process_time() - t)"
    seconds = min(
        float(subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout)
        for _ in range(3)
    )
    assert seconds < 0.1


def test_other_threads_run_while_rust_works():
    import threading

    ticks, done = [], threading.Event()

    def count():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    lcplab.solve(lcplab.Problem.generate("pd", n=600), solver="lemke")
    done.set()
    thread.join()
    assert len(ticks) > 3 and max(np.diff(ticks)) < 1.0


def test_the_command_is_in_the_package():
    reported = subprocess.run([sys.executable, "-m", "lcplab", "--version"], capture_output=True, text=True)
    assert reported.returncode == 0 and reported.stdout.startswith("lcplab ")
    reported = subprocess.run([sys.executable, "-m", "lcplab", "solve", "nowhere.json"], capture_output=True, text=True)
    assert reported.returncode == 2 and "nowhere.json" in reported.stderr


def test_a_model_of_friction_is_solved_and_judged_as_its_own():
    # Pressed with 2, pushed with 3 along (3, 4) / 5, mu = 1/2: the cone gives 1 along the push, the box 1 along each axis.
    push = np.array([0.6, 0.8])
    p = lcplab.Problem(
        np.eye(3), [-2, *(-3 * push)], friction_index=[-1, 0, 0], mu=[0, 0.5, 0.5], lo=[0, -np.inf, -np.inf]
    )
    cone = lcplab.solve(p, model="coulomb-cone")
    assert cone and cone.solver == "apgd"
    assert_allclose(cone.x, [2, *push], atol=1e-7)
    [contact] = cone.contacts
    assert contact["strength"] == pytest.approx(1) and contact["misalignment"] == pytest.approx(0, abs=1e-5)
    assert lcplab.solve(p).x.tolist() == [2, 1, 1]
    assert lcplab.judge(p, x=[2, *push], model="coulomb-cone") and not lcplab.judge(p, x=[2, *push])
    assert lcplab.judge(p, x=[2, 1, 1]) and not lcplab.judge(p, x=[2, 1, 1], model="coulomb-cone")


def test_what_does_not_suit_a_model_is_refused_in_words():
    flat = dict(A=np.eye(2), b=[-2, -3], friction_index=[-1, 0], mu=[0, 0.5])
    # In the plane the cone is the interval |x_t| <= x_n / 2.
    assert lcplab.solve(**flat, model="coulomb-cone").x.tolist() == [2.0, 1.0]
    with pytest.raises(lcplab.InputError, match="associated-cone, which is not defined here for contacts in the plane"):
        lcplab.solve(**flat, model="associated-cone")
    spatial = dict(A=np.eye(3), b=[-2, -3, 0], friction_index=[-1, 0, 0], mu=[0, 0.5, 0.5])
    with pytest.raises(lcplab.InputError, match="a function that has a parameter named model gets friction cones"):
        lcplab.solve(**spatial, model="coulomb-cone", solver=lambda A, b, lo, hi, **settings: b)
    with pytest.raises(lcplab.InputError, match="trace"):
        lcplab.solve(**spatial, model="coulomb-cone", trace=True)


def test_a_proof_is_looked_for_as_far_as_it_is_asked_for():
    p = lcplab.Problem.generate("pd", n=60)
    assert [lcplab.solve(p, prove=prove).verdict for prove in (None, True, False)] == [
        "within_tolerance",
        "proved",
        "within_tolerance",
    ]


def test_a_proof_of_a_scene_is_that_of_the_command_line_and_convinces_both_checkers(tmp_path):
    scene = lcplab.Scene.load("incline")
    scene.step()
    problem = scene.problem()
    path, proved, again = tmp_path / "incline.json", tmp_path / "incline.proof.json", tmp_path / "again.json"
    problem.write(path)
    proof = lcplab.prove(problem)
    assert proof and proof.kind == "not-unique" and "unique" in proof.missing
    proof.write(proved)
    assert lcplab.check(problem, proof) is None and lcplab.check(problem, proved) is None
    subprocess.run([sys.executable, "-m", "lcplab", "prove", path, "--out", again], check=True, capture_output=True)
    assert again.read_text() == proved.read_text()
    checker = Path(__file__).parents[2] / "proofs" / "lcpcheck.py"
    subprocess.run([sys.executable, checker, path, proved], check=True, capture_output=True)
    with pytest.raises(lcplab.InputError, match="length 2, the problem has 12 rows"):
        lcplab.prove(problem, [0, 0])


def test_a_cone_is_proved_and_explained_as_what_it_is():
    cone = lcplab.Problem(
        np.eye(3), [-2, -3, -3], friction_index=[-1, 0, 0], mu=[0, 0.5, 0.5], model="coulomb-cone"
    )
    proof = lcplab.prove(cone)
    assert proof.kind == "cone-solution" and proof.data["states"] == ["slides"] * 3
    assert lcplab.check(cone, proof) is None
    with pytest.raises(lcplab.InputError, match='is coulomb-cone.*model="coupled-box"'):
        lcplab.prove(cone, kind="within")
    proof = lcplab.prove(cone, model="coupled-box")
    assert proof.data["model"] == "coupled-box" and "coupled-box" in proof.claim
    assert "model" in lcplab.check(cone, proof) and lcplab.check(cone, proof, model="coupled-box") is None
    assert "(0.707107, 0.707107)" in str(lcplab.explain(cone))
    assert "x = (2, 1, 1)" in str(lcplab.explain(cone, model="coupled-box"))
