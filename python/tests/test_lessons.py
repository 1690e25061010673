"""The Python of the lessons runs from top to bottom with NumPy alone, and prints what the lessons say."""

import doctest
import re
import sys
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

NOTEBOOKS = Path(__file__).parent.parent.parent / "notebooks"
sys.path.insert(0, str(NOTEBOOKS))

import cells
import engine


@pytest.mark.parametrize("lesson", cells.lessons(), ids=lambda path: path.stem)
def test_every_cell_prints_what_the_lesson_says(lesson):
    said = [output for _, output in cells.cells(lesson)]
    assert len(said) >= 3, "Python carries each lesson"
    assert cells.printed(lesson) == said


@pytest.mark.parametrize("lesson", cells.lessons(), ids=lambda path: path.stem)
def test_cells_import_numpy_and_the_engine_alone(lesson):
    for code, _ in cells.cells(lesson):
        packages = re.findall(r"^\s*(?:from|import) (\w+)", code, re.M)
        assert set(packages) <= {"numpy", "engine", "fractions"}


def test_the_engine_stays_short_and_its_example_holds():
    lines = (NOTEBOOKS / "engine.py").read_text(encoding="utf-8").splitlines()
    assert len(lines) <= 300 and max(map(len, lines)) <= 110
    assert doctest.testmod(engine).failed == 0


def problems():
    generator = np.random.default_rng(1)
    for n in range(1, 7):
        J = generator.normal(size=(n, n + 2))
        yield J @ J.T, generator.normal(size=n)


@pytest.mark.parametrize("A, b", list(problems()))
def test_all_methods_of_the_engine_find_the_one_solution(A, b):
    (x,) = engine.all_cases(A, b)
    zero, inf = np.zeros(len(b)), np.full(len(b), np.inf)
    for own in engine.dantzig(A, b), engine.murty(A, b), engine.lemke(A, b):
        assert_allclose(own, x, atol=1e-9)
    assert_allclose(engine.gauss_seidel(A, b, zero, inf, 20000), x, atol=1e-6)
    assert engine.natural(A, b, x) < 1e-9 and engine.scaled(A, b, x) < 1e-9


def test_the_power_method_finds_the_largest_eigenvalue_also_of_complex_and_double_ones():
    generator = np.random.default_rng(3)
    turns = np.array([[0.6, -0.8], [0.8, 0.6]])
    double = np.array([[0.9, 1.0], [0.0, 0.9]])
    assert_allclose([engine.radius(turns), engine.radius(double), engine.radius(np.zeros((2, 2)))], [1, 0.9, 0])
    for n in range(1, 9):
        G = generator.normal(size=(n, n))
        assert_allclose(engine.radius(G), abs(np.linalg.eigvals(G)).max(), rtol=1e-9)


def test_a_box_slides_down_a_slope_as_coulomb_says():
    theta, mu, dt, g = 0.5, 0.3, 0.01, 9.81
    slope, box = engine.Box((0, -5, theta), 10, 0), engine.Box((0, 0, theta), 1, 2)
    box.p[:2] = slope.p[:2] + slope.turned([0, 5.5])
    kept = {}
    for _ in range(30):
        kept = engine.step([slope, box], dt, 200, mu, kept)
    speed = -slope.turned([1, 0]) @ box.u[:2]
    assert_allclose(speed, 0.3 * g * (np.sin(theta) - mu * np.cos(theta)), rtol=1e-2)


def test_the_contact_impulses_of_a_resting_stack_carry_the_weights_above():
    masses, dt, g = [3.0, 1.0, 2.0], 0.01, 9.81
    boxes = [engine.Box((0, -5, 0), 10, 0)]
    boxes += [engine.Box((0, k + 0.5, 0), 1, m) for k, m in enumerate(masses)]
    x = engine.step(boxes, dt, 2000, 0.5, {})
    for k in range(3):
        layer = sum(value for ((i, j, _), along), value in x.items() if j == k + 1 and along == "n")
        assert_allclose(layer, dt * g * sum(masses[k:]), rtol=1e-9)


@pytest.mark.parametrize("A, b", list(problems()))
def test_the_natural_residual_bounds_the_error_as_lesson_8_derives(A, b):
    (exact,) = engine.all_cases(A, b)
    factor = (1 + np.linalg.norm(A, 2)) / np.linalg.eigvalsh(A).min()
    for x in np.random.default_rng(2).normal(size=(100, len(b))):
        residual = np.minimum(x, A @ x + b)
        assert np.linalg.norm(x - exact) <= factor * np.linalg.norm(residual) * (1 + 1e-9)


@pytest.mark.parametrize("A, b", list(problems()))
def test_murtys_rule_moves_the_last_row_at_most_once_as_lesson_7_derives(A, b):
    F, moves = np.zeros(len(b), dtype=bool), []
    while True:
        x = engine.point(A, b, F)
        wrong = np.flatnonzero(np.where(F, x < 0, A @ x + b < 0))
        if len(wrong) == 0:
            break
        moves.append(wrong[0])
        F[wrong[0]] ^= True
    assert moves.count(len(b) - 1) <= 1
    assert_allclose(x, engine.murty(A, b))


def test_all_cases_lists_each_isolated_solution_once():
    identity, border = np.eye(2), np.array([[2.0, 3], [3, 2]])
    assert len(engine.all_cases(identity, np.zeros(2))) == 1  # -b on the border of four cones
    assert_allclose(sorted(map(tuple, engine.all_cases(border, np.array([-1.0, -1.5])))), [(0, 0.75), (0.5, 0)])
    singular = np.array([[1.0, -1], [-1, 1]])
    assert engine.all_cases(singular, np.array([-1.0, -1])) == []
    assert_allclose(engine.all_cases(singular, np.array([-1.0, 1])), [[1, 0]])


def fathi(n):
    """Fathi's matrix of lesson 7 in exact numbers: U Uᵀ with 1 on the diagonal of U and 2 above it."""
    U = [[Fraction(1 if i == j else 2 * (j > i)) for j in range(n)] for i in range(n)]
    return [[sum(a * b for a, b in zip(p, q)) for q in U] for p in U]


def eliminated(A, F, right):
    """The exact solution of A_FF y = right_F, by its rows."""
    M = {i: {j: A[i][j] for j in F} | {"right": right[i]} for i in F}
    for k in F:
        M[k] = {j: value / M[k][k] for j, value in M[k].items()}
        for i in F:
            if i != k:
                M[i] = {j: value - M[i][k] * M[k][j] for j, value in M[i].items()}
    return {i: M[i]["right"] for i in F}


def exact_moves_of_dantzig(A, b, first):
    """Moves of Dantzig's method without rounding; of tied events the one with the least first(event)."""
    n, F, moves = len(b), [], 0
    x, w, bound_since = [Fraction(0)] * n, list(b), [0] * n
    for k in range(n):
        while w[k] < 0:
            y = eliminated(A, F, [-A[i][k] for i in range(n)])
            d = [Fraction(i == k) + y.get(i, 0) for i in range(n)]
            v = [sum(a * e for a, e in zip(row, d)) for row in A]
            ends = [(-w[k] / v[k], "driven", 0, k)]
            ends += [(-x[i] / d[i], "leaves", 0, i) for i in F if d[i] < 0]
            ends += [(-w[i] / v[i], "enters", bound_since[i], i) for i in range(k) if i not in F and v[i] < 0]
            length = min(end[0] for end in ends)
            i = min((end for end in ends if end[0] == length), key=first)[3]
            x, w = ([a + length * e for a, e in zip(p, q)] for p, q in [(x, d), (w, v)])
            moves += 1
            if i in F:
                F.remove(i)
                bound_since[i] = moves
            else:
                F.append(i)
    assert x == [0] * (n - 1) + [1]
    return moves


def test_the_moves_of_dantzigs_method_on_fathis_matrix_depend_on_the_rule_for_ties():
    order = {"driven": 0, "enters": 1, "leaves": 2}
    for n in range(2, 8):
        A, b = fathi(n), [Fraction(-1)] * n
        assert exact_moves_of_dantzig(A, b, lambda end: (order[end[1]], end[2])) == n * n - n + 1
        assert exact_moves_of_dantzig(A, b, lambda end: end[3]) == 2**n - 1
        assert exact_moves_of_dantzig(A, b, lambda end: -end[3]) == 2 * n - 1


def ordinary(n, kind, generator):
    if kind == "column":
        A = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
        A[0, 0] = 1
        return A, generator.normal(size=n)
    J = generator.normal(size=(n, 4 * n if kind == "well conditioned" else n))
    A = J @ J.T + 0.1 * np.eye(n)
    if kind == "half free":
        is_free = generator.permutation(n) < n // 2
        return A, np.where(is_free, 0, generator.random(n)) - A @ np.where(is_free, generator.random(n), 0)
    return A, generator.normal(size=n)


@pytest.mark.parametrize("kind", ["Gram", "well conditioned", "half free", "column"])
def test_ordinary_problems_take_one_to_six_moves_for_each_free_row_and_few_blocks(kind, monkeypatch):
    calls, point = [], engine.point
    monkeypatch.setattr(engine, "point", lambda *given: calls.append(0) or point(*given))
    generator = np.random.default_rng(7)
    for _ in range(20):
        A, b = ordinary(60, kind, generator)
        calls.clear()
        x = engine.dantzig(A, b)
        assert engine.natural(A, b, x) < 1e-8
        free = (x > 0).sum()
        assert free <= len(calls) <= 6 * free
        assert kind != "column" or len(calls) == free
        F, exchanges = np.zeros(60, dtype=bool), 0
        while (wrong := np.where(F, (x := point(A, b, F)) < 0, A @ x + b < -1e-9)).any():
            F, exchanges = F ^ wrong, exchanges + 1
        assert 2 <= exchanges <= 16


def test_what_a_sweep_adds_to_x_tends_to_a_farkas_vector_of_the_ring():
    A = 2 * np.eye(4) - np.roll(np.eye(4), 1, axis=0) - np.roll(np.eye(4), -1, axis=0)
    b, zero, inf = -np.ones(4), np.zeros(4), np.full(4, np.inf)
    x, y = (engine.gauss_seidel(A, b, zero, inf, sweeps) for sweeps in (60, 61))
    assert_allclose(y - x, np.ones(4))
    assert_allclose(A @ np.ones(4), 0)


def test_the_stiffest_soft_column_that_stands_needs_many_substeps_of_one_sweep_as_lesson_16_says():
    code = next(code for code, _ in cells.cells(NOTEBOOKS / "16_soft_rows.md") if "def column" in code)
    names = {"np": np, "softness": engine.softness}
    exec(code.split("\nfor masses")[0], names)
    heavy = [1, 1, 1, 1, 100]
    for sweeps, stands, falls in (1, 1.2, 1.5), (2, 1.8, 2.5), (10, 4.0, 6.0):
        dt = 0.001 * sweeps
        for h, is_right in (stands, True), (falls, False):
            hertz = h / (2 * np.pi * dt)
            risen = names["column"](heavy, dt, sweeps, hertz)
            assert (abs(risen / names["formula"](heavy, hertz) - 1) < 0.05) == is_right


def test_a_block_that_slides_stops_half_a_step_early_as_lesson_11_says():
    mu_g, speed, dt = 0.5 * 9.81, 3.0, 0.01
    v, place = speed, 0.0
    while v > 0:
        v = max(0.0, v - mu_g * dt)
        place += dt * v
    assert_allclose(speed**2 / (2 * mu_g) - place, 0.5 * speed * dt, rtol=0.02)


def test_a_small_softness_selects_the_answer_of_least_norm_as_lesson_9_says():
    corners = np.array([[-0.5, -0.5], [-0.5, 0.5], [0.5, -0.5], [0.5, 0.5]])
    J = np.column_stack([np.ones(4), corners[:, 1], -corners[:, 0]])
    for u_star in [-0.0981, 0, 0], [-0.0981, 0.05, -0.03]:
        A, b = J @ np.diag([1, 9.6, 9.6]) @ J.T, J @ np.array(u_star)
        least = np.linalg.lstsq(A, -b, rcond=None)[0]  # of all x with A x = -b
        assert (least > 0).all()
        (x,) = engine.all_cases(A + 1e-7 * np.eye(4), b)
        assert_allclose(x, least, atol=1e-7)


def test_the_inverse_of_the_matrix_of_a_column_is_full_as_lesson_14_says():
    n = 6
    A, _ = ordinary(n, "column", np.random.default_rng(1))
    places = np.arange(n)
    assert_allclose(np.linalg.inv(A), n - np.maximum.outer(places, places))


@pytest.mark.parametrize("beta, is_stable", [(0.5, True), (1.5, True), (1.95, True), (2.05, False)])
def test_feedback_decays_below_two_with_alternating_sign_above_one_as_lesson_10_says(beta, is_stable):
    c, dt, errors = 1e-3, 0.01, []
    for _ in range(50):
        errors.append(c)
        c += dt * -(beta / dt * c)  # J u+ = -(β/dt) c
    errors = np.array(errors)
    assert (abs(errors[1:]) < abs(errors[:-1])).all() == is_stable
    assert (errors[1:] * errors[:-1] < 0).all() == (beta > 1)


def test_lemke_ends_on_a_ray_of_a_semidefinite_matrix_just_where_no_solution_exists_as_lesson_7_says():
    generator, rays = np.random.default_rng(4), 0
    for _ in range(200):
        j, b = np.array([1.0, 1, -1, -1]), generator.choice(np.arange(-16, 17), 4, replace=False) / 8
        b[:2] += 1 / 16  # no ties; and no rounding
        # w = j s + b with s = j·x, which takes any value: an interval of s, or none
        is_feasible = max(-b[:2]) <= min(b[2:])
        assert (engine.lemke(np.outer(j, j), b) is not None) == is_feasible
        rays += not is_feasible
        turn = np.array([[0.0, 1], [-1, 0]])  # not symmetric: w_1 = b_1 - x_0
        assert (engine.lemke(turn, b[:2]) is not None) == (b[1] >= 0)
    assert 50 < rays < 190


def test_sweeps_circle_on_a_definite_matrix_that_is_not_symmetric_as_lesson_4_says():
    A, b = np.array([[1.0, 3], [-3, 1]]), np.array([-4.0, -1])
    assert np.linalg.eigvalsh(A + A.T).min() > 0
    assert_allclose(engine.all_cases(A, b), [[0.1, 1.3]])
    zero, inf = np.zeros(2), np.full(2, np.inf)
    once = engine.sor(A, b, zero, inf, 1.0, 1, np.array([0.0, 1]))
    assert_allclose([once, engine.sor(A, b, zero, inf, 1.0, 2, np.array([0.0, 1]))], [[1, 4], [0, 1]])


def test_softness_divides_the_factor_of_every_column_by_its_square_as_lesson_16_says():
    for n in 2, 3, 5, 8:
        J, m = np.eye(n) - np.eye(n, k=-1), np.random.default_rng(n).uniform(0.1, 50, n)
        A = J @ np.diag(1 / m) @ J.T
        soft = A + 2.4 * np.diag(np.diag(A))
        assert_allclose(engine.rate(soft), engine.rate(A) / 3.4**2, rtol=1e-9)


def test_a_push_at_the_corner_of_a_box_moves_it_two_and_a_half_times_as_a_ball():
    m = 4.0
    boxes = [engine.Box((0, -5, 0), 10, 0), engine.Box((0, 0.5, 0), 1, m)]
    _, J = engine.row(boxes, 0, 1, np.array([0.5, 0]), np.array([0, 1.0]))
    assert_allclose(J @ (boxes[1].M_inverse * J), 2.5 / m)


def test_a_falling_line_cuts_three_segments_once_or_three_times_as_lesson_13_says():
    lo, hi, counts = 0.0, 2.0, set()
    for b in np.arange(-3.05, 5, 0.1):  # a = -1
        inside = [x for x in [b] if lo < x < hi]
        counts.add(len(inside) + (b - lo > 0) + (b - hi < 0))
    assert counts == {1, 3}


def test_each_prediction_that_the_guide_names_is_in_a_lesson():
    one_line = lambda path: " ".join(path.read_text(encoding="utf-8").split())
    boxes = [box for lesson in cells.lessons() for box in one_line(lesson).split("**Predict.** ")[1:]]
    named = re.findall(r'[Pp]redict,?\*\* "(.*?)"', one_line(NOTEBOOKS / "guide.md"))
    assert len(named) > 20
    assert [words for words in named if not any(box.startswith(words) for box in boxes)] == []
