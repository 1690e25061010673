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
    assert_allclose(engine.all_cases(np.ones((2, 2)), -np.ones(2)), np.eye(2))  # the ends of a line of answers
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


def cell_of(lesson, part):
    """The names that the cell of a lesson with this text in it defines."""
    code = next(code for code, _ in cells.cells(NOTEBOOKS / lesson) if part in code)
    names = {"np": np, **{name: getattr(engine, name) for name in ("softness", "step", "Box")}}
    exec(re.split(r"\n(?=for |print)", code)[0], names)
    return names


def soft_column_in_one_step(m, h, sweeps):
    """The matrix of one step of balls with soft rows (ζ = 1) that all push, of gaps, speeds times dt and impulses."""
    n, dt = len(m), 1.0
    J = np.eye(n) - np.eye(n, k=-1)
    A = J @ np.diag(1 / m) @ J.T
    sigma, beta = 1 / (h * (2 + h)), h / (2 + h)
    soft = A + sigma * np.diag(np.diag(A))
    lower = np.linalg.inv(np.tril(soft))
    columns = []
    for state in np.eye(3 * n):
        c, rates, x = state[:n], state[n : 2 * n], state[2 * n :]  # rates of the gaps, without new impulses
        for _ in range(sweeps):
            x = x - lower @ (soft @ x + rates + beta / dt * c)
        after = rates + A @ x
        columns.append(np.concatenate([c + dt * after, after, x]))
    return np.column_stack(columns)


def test_the_stiffest_soft_column_that_stands_needs_many_substeps_of_one_sweep_as_lesson_16_says():
    names = cell_of("16_soft_rows.md", "def soft_column")
    m = np.array([1.0, 1, 1, 1, 100])
    for sweeps, limit in (1, 1.4), (2, 2.1), (10, 5.2):
        grows = [abs(np.linalg.eigvals(soft_column_in_one_step(m, h, sweeps))).max() > 1 for h in (limit - 0.05, limit + 0.05)]
        assert grows == [False, True]
        dt = 0.001 * sweeps
        for h, is_right in (0.8 * limit, True), (1.2 * limit, False):  # well within, and well beyond
            hertz = h / (2 * np.pi * dt)
            risen = names["soft_column"](m, dt, sweeps, hertz)
            assert (abs(risen / names["formula"](m, hertz) - 1) < 0.05) == is_right


def test_five_equal_soft_balls_stand_at_any_frequency_with_ten_sweeps_and_ten_are_like_the_heavy_top_as_lesson_16_says():
    grows = lambda n, h, sweeps: abs(np.linalg.eigvals(soft_column_in_one_step(np.ones(n), h, sweeps))).max() > 1 + 1e-9
    assert [grows(5, h, 1) for h in (1.6, 1.7)] == [False, True]
    assert not any(grows(5, h, 10) for h in np.geomspace(0.1, 1e5, 100))
    for sweeps, limit in (1, 1.4), (2, 2.2), (10, 6.8):
        assert [grows(10, h, sweeps) for h in (limit, limit + 0.1)] == [False, True]


def test_the_swing_of_soft_boxes_decays_for_the_steps_that_lesson_16_names():
    stack, masses = cell_of("16_soft_rows.md", "def stack")["stack"], [1, 1, 1, 1, 100]
    for sweeps, h, decays in (1, 1.2, True), (1, 1.4, False), (2, 1.8, True), (10, 4.7, True), (10, 5.1, False):
        dt = 0.001 * sweeps
        top = stack(masses, dt, sweeps, (h / (2 * np.pi * dt), 1.0), seconds=3.0)
        first, *_, last = (np.ptp(second) for second in np.array_split(top, 3))
        assert (last < 0.85 * first) == decays
    for hertz, stands in (40, True), (24, False):
        assert (stack(masses, 0.01, 10, (hertz, 1.0), seconds=8.0)[-1] > -0.2) == stands


def test_a_point_of_a_body_that_tumbles_freely_has_no_acceleration_where_lesson_2_has_j_dot_u():
    inertia, omega, r, n = np.diag([1.0, 2, 3]), np.ones(3), np.array([1.0, 0, 0]), np.array([0, 0, 1.0])
    rate = np.linalg.solve(inertia, -np.cross(omega, inertia @ omega))  # no torque
    j_dot_u = n @ np.cross(omega, np.cross(omega, r))
    assert_allclose([j_dot_u, n @ np.cross(rate, r) + j_dot_u], [1, 0], atol=1e-15)


def test_the_zigzag_of_lesson_5_keeps_0_64_of_the_distance_to_the_crossing_and_then_arrives():
    A, b, zero, inf = np.array([[1, 0.8], [0.8, 1]]), np.array([-1.8, -1.2]), np.zeros(2), np.full(2, np.inf)
    crossing, x = np.linalg.solve(A, -b), np.array([1, 2.1])
    path = [engine.sor(A, b, zero, inf, 1.0, sweeps, x) for sweeps in range(1, 6)]
    distances = [crossing[0] - x[0] for x in path[:3]]
    assert_allclose(np.divide(distances[1:], distances[:-1]), 0.64)
    assert path[3][1] == 0 and path[3][0] < 1.8
    assert_allclose(path[4], [1.8, 0])


def test_a_sweep_lands_on_the_answer_from_special_starts_as_the_erratum_on_finite_convergence_says():
    A, b, zero, inf = np.array([[2.0, -1], [-1, 2]]), -np.ones(2), np.zeros(2), np.full(2, np.inf)
    assert (engine.sor(A, b, zero, inf, 1.0, 1, np.array([5.0, 1])) == 1).all()
    assert (engine.sor(A, b, zero, inf, 1.0, 20, np.array([5.0, 2])) != 1).any()


def test_a_move_of_dantzigs_method_has_the_length_0_where_a_row_starts_with_w_0(monkeypatch):
    calls, point = [], engine.point
    monkeypatch.setattr(engine, "point", lambda *given: calls.append(0) or point(*given))
    A = np.array([[2.0, -1], [-1, 2]])
    assert_allclose(engine.dantzig(A, np.array([0.0, -1])), [1 / 3, 2 / 3])
    assert len(calls) == 2  # row 0 enters at once


def test_after_the_tie_of_lesson_6_a_move_has_the_length_0():
    A, b = np.array([[2.0, 1, 1], [1, 2, 0], [1, 0, 2]]), np.array([-1.0, -2, -3])
    x = np.array([0.0, 1, 0])
    assert_allclose(A @ x + b, [0, 0, -3])  # both rows at the corner of their L, row 1 free after the tie
    d = np.append(-np.linalg.solve(A[:2, :2], A[:2, 2]), 1)
    assert_allclose(d, [-2 / 3, 1 / 3, 1])  # x_0 = 0 would fall
    (exact,) = engine.all_cases(A, b)
    assert_allclose(engine.dantzig(A, b), exact)


def test_block_pivoting_takes_about_six_exchanges_on_columns_of_60_bodies_as_lesson_7_says():
    generator, counts = np.random.default_rng(11), []
    J = np.eye(60) - np.eye(60, k=-1)
    A = J @ J.T
    for k in range(300):
        speeds = [generator.normal, lambda size: generator.uniform(-1, 1, size), generator.standard_cauchy][k % 3]
        b, F, exchanges = J @ speeds(size=60), np.zeros(60, dtype=bool), 0
        while (wrong := np.where(F, (x := engine.point(A, b, F)) < 0, A @ x + b < -1e-9)).any():
            F, exchanges = F ^ wrong, exchanges + 1
        counts.append(exchanges)
    assert 5 <= np.median(counts) <= 7
    assert np.mean(np.array(counts) < 10) > 0.9


def test_the_bound_on_the_error_holds_for_lengths_and_not_for_largest_entries_as_lesson_8_says():
    A, b = np.array([[0.01, -0.02], [-0.02, 0.05]]), np.array([0.01, -0.03])
    x, least, greatest = np.array([1.7, 1.3]), *np.linalg.eigvalsh(A)
    residual, factor = np.minimum(x, A @ x + b), (1 + greatest) / least
    assert_allclose(engine.all_cases(A, b), [[1, 1]])
    assert np.linalg.norm(x - 1) <= factor * np.linalg.norm(residual)
    assert factor * abs(residual).max() < abs(x - 1).max() <= np.sqrt(2) * factor * abs(residual).max()


def test_the_gap_bounds_the_energy_of_the_error_as_lesson_8_derives():
    generator, attained = np.random.default_rng(8), 0.0
    for _ in range(2000):
        U = generator.normal(size=(3, 3))
        A, x = U @ U.T + 0.1 * np.eye(3), generator.exponential(size=3)
        w = generator.exponential(size=3) * (generator.random(3) < 0.5)
        (exact,) = engine.all_cases(A, w - A @ x)
        error = x - exact
        assert error @ A @ error <= x @ w * (1 + 1e-9) + 1e-12
        attained = max(attained, error @ A @ error / (x @ w) if x @ w else 0)
    assert attained > 0.99


def test_the_error_of_the_box_of_lesson_8_is_305_times_the_residual_at_most_where_three_rows_push():
    H = np.array([[1 / (i + j + 1) for j in range(6)] for i in range(6)])
    exact, w = np.array([1.0, 0, 1, 0, 1, 0]), np.array([0.0, 1, 0, 1, 0, 1])
    for rows, times in ([0, 2, 4], 305.3), (range(6), 9.235e6):
        assert_allclose(1 / np.linalg.eigvalsh(H[np.ix_(rows, rows)])[0], times, rtol=1e-3)
    x = exact.copy()
    x[[0, 2, 4]] += 1e-6 * np.linalg.eigh(H[np.ix_([0, 2, 4], [0, 2, 4])])[1][:, 0]
    residual = np.minimum(x, H @ (x - exact) + w)
    assert_allclose(np.linalg.norm(x - exact) / np.linalg.norm(residual), 305.3, rtol=1e-3)


def test_the_proof_of_lesson_8_finds_each_of_the_four_cases():
    proof = cell_of("08_is_it_solved.md", "def proof")["proof"]
    A = [[2.0, -1], [-1, 2]]
    for b in [-1.0, -1], [-1.0, 2], [2.0, -1], [1.0, 1], [-4.0, 1]:
        (exact,) = engine.all_cases(np.array(A), np.array(b))
        assert_allclose(np.array(proof(A, b, exact), dtype=float), exact)
    assert proof(A, [1.0, 1], [5.0, 10]) is None  # the impulse of this set is negative


def test_the_same_residual_means_other_errors_for_other_b_as_lesson_8_says():
    H, exact = np.array([[1 / (i + j + 1) for j in range(4)] for i in range(4)]), np.array([1.0, 0, 1, 0])
    errors = []
    for w in np.array([0, 1.0, 0, 1]), np.zeros(4):  # of the rows that are not free
        x, b = np.zeros(4), w - H @ exact
        while engine.scaled(H, b, x) > 1e-8:
            x = engine.sor(H, b, np.zeros(4), np.full(4, np.inf), 1.0, 1, x)
        errors.append(abs(x - exact).max())
    assert errors[0] < 1e-5 < 3e-5 < errors[1]


def test_a_ball_bounces_a_step_early_and_half_a_step_above_the_floor_as_lesson_12_says():
    g, dt, early, above = 9.81, 0.01, [], []
    for h in np.random.default_rng(3).uniform(0.5, 4, 1000):
        z, v, t = h, 0.0, 0.0
        while z + dt * (v - g * dt) > 0:
            v -= g * dt
            z += dt * v
            t += dt
        early.append((np.sqrt(2 * h / g) - t) / dt)
        above.append(z / (np.sqrt(2 * g * h) * dt))
    assert_allclose([np.mean(early), np.mean(above)], [1, 0.5], atol=0.05)
    assert 0.49 < min(early) and max(early) < 1.51


def test_more_sweeps_or_shorter_steps_depends_on_number_and_order_of_masses_as_lesson_15_says():
    sinks = cell_of("15_stack_of_boxes.md", "def sinks")["sinks"]
    sweeps = [[1, 1], [1, 2], [10, 1], [4, 2, 1], [9, 3, 1], [100, 10, 1], [1e4, 100, 1], [20, 10, 0.1]]
    short_steps = [[1] * 3, [1] * 5, [1, 3], [1, 10], [1, 1.5, 2], [1.1, 1.05, 1]]
    for masses, sweeps_win in [(masses, True) for masses in sweeps] + [(masses, False) for masses in short_steps]:
        one, ten, short = (sinks(masses, 10, *way, True) for way in [(0.01, 1), (0.01, 10), (0.001, 1)])
        assert_allclose(one / short, 100, rtol=0.01)
        assert (one / ten > 100) == sweeps_win


def test_for_three_equal_balls_sweeps_win_again_from_16_on_as_lesson_15_says():
    sinks = cell_of("15_stack_of_boxes.md", "def sinks")["sinks"]
    one = sinks([1] * 3, 10, 0.01, 1, True)
    wins = [one / sinks([1] * 3, 10, 0.01, k, True) > k**2 for k in range(10, 21)]  # k times shorter steps gain k²
    assert wins == [k >= 16 for k in range(10, 21)]


def test_a_rod_loses_two_energies_in_each_step_as_lesson_10_says():
    p, u, g, dt, lost = np.array([1.0, 0]), np.zeros(2), np.array([0, -9.81]), 1 / 60, 0.0
    for _ in range(600):
        n = p / np.linalg.norm(p)
        across = np.array([-n[1], n[0]])
        lost += 0.5 * (n @ u) ** 2 + 0.5 * (across @ g * dt) ** 2
        u = across * (across @ (u + dt * g))
        p = p + dt * u
    assert_allclose(0.5 * u @ u - g @ p, -lost, rtol=1e-12)
    assert_allclose(lost, 8.40, atol=0.005)


def block_pivoting(A, b, exchanges):
    """The set and the wrong rows before each exchange of all wrong rows."""
    F, seen = np.zeros(len(b), dtype=bool), []
    for _ in range(exchanges):
        x = engine.point(A, b, F)
        wrong = np.where(F, x < -1e-12, A @ x + b < -1e-12)
        seen.append((tuple(F), wrong.sum()))
        F = F ^ wrong
    return seen


def test_block_pivoting_of_the_three_rows_of_lesson_7_cycles_and_the_number_of_wrong_rows_does_not_fall():
    A = np.array([[9.0, -9, 11], [-9, 14, -12], [11, -12, 14]])
    assert np.linalg.eigvalsh(A).min() > 0.1
    seen = block_pivoting(A, np.array([-1.0, 4, -3]), 9)
    assert seen[:3] == seen[3:6] == seen[6:]
    assert [wrong for _, wrong in seen] == 9 * [2]


def test_block_pivoting_cycles_rarely_with_three_rows_and_was_not_seen_to_cycle_with_two():
    generator = np.random.default_rng(1)
    for n, least, most in (2, 0, 0), (3, 1, 10):
        cycles = 0
        for _ in range(10000):
            B, b = generator.normal(size=(n, n)), generator.normal(size=n)
            cycles += block_pivoting(B @ B.T, b, 2**n + 1)[-1][1] > 0  # more exchanges than sets
        assert least <= cycles <= most


def test_minimum_degree_leaves_the_factor_of_the_net_that_sags_12_000_entries_as_lesson_14_says():
    names = {}
    for code, _ in cells.cells(NOTEBOOKS / "14_sparsity.md"):
        if "def rods_of_net" in code:
            exec(code, names)
    rods = names["rods_of_net"](20)
    pairs = names["entries"](rods)
    joined = {i: {j for j in range(len(rods)) if (i, j) in pairs and j != i} for i in range(len(rods))}
    count = 0
    while joined:
        i = min(joined, key=lambda i: (len(joined[i]), i))
        later = joined.pop(i)
        count += 1 + len(later)
        for j in later:
            joined[j] = (joined[j] | later) - {i, j}
    assert 11500 < count < 12500


def test_freezing_the_bounds_of_one_contact_multiplies_the_error_by_the_factor_of_lesson_11():
    tan = 2.0  # Painlevé's rod of lesson 13, which slides: x_t = μ x_n
    cos, sin = 1 / np.hypot(1, tan), tan / np.hypot(1, tan)
    A_nn, A_nt, b = 1 + 3 * cos**2, -3 * sin * cos, -1.0
    for mu in 0.5, 1.0, 1.3, 1.4:
        exact, x = -b / (A_nn + mu * A_nt), [3.0]
        for _ in range(10):
            x.append(-(b + A_nt * mu * x[-1]) / A_nn)
        errors = abs(np.array(x) - exact)
        assert_allclose(errors[1:] / errors[:-1], mu * abs(A_nt) / A_nn, rtol=1e-3)
        assert (errors[-1] < errors[0]) == (mu < 4 / 3)


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
    assert_allclose(A @ engine.dantzig(A, b), -b, atol=1e-12)  # gets through, and divides by 0 on the ring
    ring = 2 * np.eye(4) - np.roll(np.eye(4), 1, axis=0) - np.roll(np.eye(4), -1, axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        assert not np.isfinite(engine.dantzig(ring, -np.ones(4))).any()


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
    for b in 0.0, 2.0:  # through a corner: of the two segments there the x is the same
        assert len({x for x, fits in [(b, True), (lo, b - lo >= 0), (hi, b - hi <= 0)] if fits}) == 2


def test_each_prediction_that_the_guide_names_is_in_a_lesson():
    one_line = lambda path: " ".join(path.read_text(encoding="utf-8").split())
    boxes = [box for lesson in cells.lessons() for box in one_line(lesson).split("**Predict.** ")[1:]]
    named = re.findall(r'[Pp]redict,?\*\* "(.*?)"', one_line(NOTEBOOKS / "guide.md"))
    assert len(named) > 20
    assert [words for words in named if not any(box.startswith(words) for box in boxes)] == []


def test_a_row_with_x_and_w_0_counts_for_some_starts_and_not_for_others_as_lesson_5_says():
    A, b, zero, inf = np.array([[2.0, -1], [-1, 2]]), np.array([-1, 0.5]), np.zeros(2), np.full(2, np.inf)
    exact = np.array([0.5, 0])
    assert_allclose(A @ exact + b, 0)
    errors = lambda start: [abs(engine.sor(A, b, zero, inf, 1.0, k, np.array(start)) - exact).max() for k in range(8)]
    above = errors([1.0, 1.0])
    assert_allclose(np.divide(above[2:], above[1:-1]), 0.25)  # both rows: the square of the cosine of 60 degrees
    assert errors([0.0, 0.0])[1:] == 7 * [0.0]  # row 0 alone


def test_a_row_whose_w_is_0_when_its_turn_comes_causes_a_move_of_length_0_as_lesson_6_says(monkeypatch):
    solved, point = [], engine.point
    monkeypatch.setattr(engine, "point", lambda *given: solved.append(given[2].sum()) or point(*given))
    A, b = np.array([[1.0, -1, 0], [-1, 2, -1], [0, -1, 2]]), np.array([-1.0, 1, -1])
    assert (b != 0).all()
    assert_allclose(engine.dantzig(A, b), [2, 1, 1])
    assert solved == [0, 1, 2]  # row 0; row 2 with row 0 free, which ends at once; row 2 with both free


def test_the_slop_of_lesson_10_stops_the_jitter_of_a_stack_and_no_ball_needs_it():
    source = (NOTEBOOKS / "engine.py").read_text(encoding="utf-8")
    changed = {}
    for slop in 0.0, 1e-3:
        names = {}
        with_slop = source.replace("beta / dt * gap if", f"beta / dt * min(gap + {slop}, 0) if")
        assert with_slop != source
        exec(with_slop, names)
        boxes = [names["Box"]((0, -5, 0), 10, 0)] + [names["Box"]((0, k + 0.5, 0), 1, 1) for k in range(5)]
        kept, changed[slop], fastest = {}, 0, 0.0
        for k in range(600):
            before, kept = kept, names["step"](boxes, 0.01, 10, 0.5, kept)
            if k >= 300:
                push = {name for name, value in kept.items() if value > 0 and name[1] == "n"}
                changed[slop] += len(push ^ {name for name, value in before.items() if value > 0 and name[1] == "n"})
                fastest = max(fastest, *(abs(box.u).max() for box in boxes))
        assert (fastest < 1e-3) == (slop > 0)
    assert changed[0.0] > 20 and changed[1e-3] == 0
    for beta in 0.2, 0.5:  # a single ball, solved exactly
        z, v, dt = -0.01, 0.0, 1 / 60
        for _ in range(400):
            v = max(v - 9.81 * dt, -beta / dt * z)
            assert z <= z + dt * v <= 0  # rises to the surface, and not beyond
            z += dt * v


def test_no_velocities_close_all_gaps_of_a_ring_as_lesson_9_says():
    J = np.roll(np.eye(4), 1, axis=1) - np.eye(4)
    assert_allclose(J @ J.T, 2 * np.eye(4) - np.roll(np.eye(4), 1, axis=0) - np.roll(np.eye(4), -1, axis=0))
    assert_allclose(np.ones(4) @ J, 0)  # so the rates add up to 0
    u = np.linalg.lstsq(J, -np.ones(4), rcond=None)[0]
    assert_allclose(J @ u, 0, atol=1e-12)  # the best fit is not to move


def test_a_corner_carries_anything_up_to_half_of_the_weight_as_lesson_9_says():
    corners = np.array([[-0.5, -0.5], [-0.5, 0.5], [0.5, -0.5], [0.5, 0.5]])
    J = np.column_stack([np.ones(4), corners[:, 1], -corners[:, 0]])
    quarter, z = 0.25 * np.ones(4), np.array([1, -1, -1, 1])
    assert np.linalg.matrix_rank(J) == 3
    for t in -0.25, -0.1, 0.0, 0.25:
        assert_allclose(J.T @ (quarter + t * z), [1, 0, 0], atol=1e-12)
        assert (quarter + t * z).min() >= 0
    for t in -0.26, 0.26:
        assert_allclose(J.T @ (quarter + t * z), [1, 0, 0], atol=1e-12)  # supports the weight too, but two corners pull
        assert (quarter + t * z).min() < 0


def test_a_falling_line_through_the_corner_has_one_answer_as_lesson_13_says():
    a = -0.8
    for b, answers in (1.0, [0.0, 1.25]), (0.0, [0.0]), (-0.5, []):
        assert sorted({abs(x) for x in (0.0, -b / a) if x >= 0 and a * x + b >= 0}) == answers


def test_one_velocity_does_not_show_every_wrong_entry_of_a_row_as_lesson_17_says():
    v, right = np.array([2.0, 0, 0.5]), np.array([np.sin(0.7), 0, 1])
    for wrong in (np.array([np.sin(0.7), 7, 1]), np.array([np.sin(0.7) + 0.1, 0, 0.6])):
        assert_allclose(wrong @ v, right @ v)
        assert abs(wrong - right).max() > 0.3


def test_the_best_step_of_a_two_sided_quotient_is_near_1e_5_and_larger_for_large_numbers_as_lesson_17_says():
    def errors(add, sides):  # the largest over some places, for each h
        c = lambda x: add + np.sin(x)
        places = np.random.default_rng(5).uniform(0.3, 1.2, 200)
        steps = 10.0 ** np.arange(-12, -1)
        quotient = lambda h: (c(places + h) - c(places - (sides - 1) * h)) / (sides * h)
        return dict(zip(range(-12, -1), (abs(quotient(h) - np.cos(places)).max() for h in steps)))

    best = lambda found: min(found, key=found.get)
    one, two, large = errors(0.0, 1), errors(0.0, 2), errors(1e6, 2)
    assert best(one) == -8 and best(two) in (-6, -5) and best(large) > -5
    assert two[best(two)] < 0.1 * one[best(one)]


def test_j_dot_u_of_the_rod_is_the_second_derivative_and_not_the_curvature_as_lesson_2_says():
    p, v, h = np.array([3.0, 4, 0]), np.array([2.0, -1, 0]), 1e-4
    c = lambda t: np.linalg.norm(p + t * v) - 5
    second, slope = (c(h) - 2 * c(0) + c(-h)) / h**2, (c(h) - c(-h)) / (2 * h)
    assert_allclose(engine.rod(p, v, 5)[2], second, rtol=1e-5)
    assert second / (1 + slope**2) ** 1.5 < 0.85 * second


def test_a_row_that_is_an_angle_has_the_inverse_inertia_for_a_as_lesson_3_says():
    m, radius = 2.0, 0.3
    inertia = 0.4 * m * radius**2  # of a ball
    A, _ = engine.assemble(np.array([[0, 0, 0, 0, 1.0, 0]]), np.diag([1 / m] * 3 + [1 / inertia] * 3), np.zeros(6))
    assert_allclose(A, 1 / inertia)


def test_the_row_of_the_corner_of_a_box_of_lesson_2():
    boxes = [engine.Box((0, -5, 0), 10, 0), engine.Box((0, 0.5, 0), 1, 1)]
    _, J = engine.row(boxes, 0, 1, np.array([-0.5, 0]), np.array([0, 1.0]))
    assert_allclose(J, [0, 1, -0.5])
    turned = engine.Box((0, 0.5, 1e-6), 1, 1)  # counterclockwise
    assert turned.p[1] + turned.turned([-0.5, -0.5])[1] < 0


def test_jacobis_method_goes_in_circles_where_sweeps_converge_as_lesson_4_says():
    A, b, x = 0.2 * np.eye(3) + 0.8 * np.ones((3, 3)), -np.ones(3), np.zeros(3)
    assert np.linalg.eigvalsh(A).min() > 0
    steps = []
    for _ in range(4):
        x = np.maximum(x - (A @ x + b) / np.diag(A), 0)
        steps.append(x)
    assert_allclose(steps, [np.ones(3), np.zeros(3), np.ones(3), np.zeros(3)], atol=1e-12)
    assert_allclose(engine.gauss_seidel(A, b, np.zeros(3), np.full(3, np.inf), 100), 5 / 13)


def test_the_models_of_friction_take_the_most_work_of_their_figure_as_lesson_11_says():
    b_t, generator = -3 * np.array([np.cos(np.pi / 6), 0.5]), np.random.default_rng(6)
    disc = [np.cos(np.pi / 6), 0.5]
    for order, x_t in (np.inf, [1, 1]), (2, disc), (1, [1, 0]):  # the norms whose unit balls are square, disc, diamond
        y = generator.normal(size=(2000, 2))
        y /= np.linalg.norm(y, order, axis=1)[:, None]  # on the edge
        w_t = b_t + x_t
        assert (y @ w_t >= np.dot(x_t, w_t) - 1e-9).all()
        assert (np.linalg.norm(y + b_t, axis=1) >= np.linalg.norm(x_t + b_t) - 1e-9).all()


def test_newtons_restitution_with_friction_gains_energy_and_poissons_loses_some_as_lesson_12_says():
    # By hand, at 45° A = [5/2, -3/2; -3/2, 5/2] with det 4, and the end comes with (-1, 0.6) m/s.
    A, before, start = np.array([[2.5, -1.5], [-1.5, 2.5]]), np.array([-1, 0.6]), 0.5 * (0.6**2 + 1)
    newton = np.array([2.5 * 2 - 1.5 * 0.6, 1.5 * 2 - 2.5 * 0.6]) / 4  # A x = (2, -0.6)
    stops = np.array([2.5 * 1 - 1.5 * 0.6, 1.5 * 1 - 2.5 * 0.6]) / 4  # A x = (1, -0.6)
    poisson = np.array([2 * stops[0], (1.5 * 2 * stops[0] - 0.6) / 2.5])
    assert_allclose(A @ newton + before, [1, 0], atol=1e-12)
    assert_allclose([(A @ stops + before), (A @ poisson + before) * [0, 1]], np.zeros((2, 2)), atol=1e-12)
    for x in newton, stops, poisson - stops:  # sticks with μ = 1 in each phase
        assert abs(x[1]) <= x[0]
    energies = [start + x @ (before + 0.5 * A @ x) for x in (newton, poisson)]  # the work of the impulses
    said = cells.printed(NOTEBOOKS / "12_impacts.md")[-1]
    assert re.findall(r"([\d.]+) J", said) == [f"{energy:.2f}" for energy in (start, *energies)]
    assert energies[1] < start < energies[0]


def test_a_motor_takes_the_time_of_its_torque_and_then_pushes_against_the_stop_as_lesson_17_says():
    found = cells.results(NOTEBOOKS / "17_your_own_constraint.md")[1]
    assert_allclose([found["phi"], found["omega"]], [1.5, 0], atol=1e-9)
    assert_allclose(found["x"], [0.05, 0.05])  # 5 N m each
    said = cells.printed(NOTEBOOKS / "17_your_own_constraint.md")[-1].splitlines()
    assert "0.025 rad/s" in said[0]  # 5 N m on 2 kg m² in 0.01 s
    assert "1.000 rad/s, motor 0.0 N m" in said[1]  # 1 rad/s after 0.4 s


def test_a_sweep_leaves_a_little_more_of_the_error_of_soft_boxes_than_of_balls_as_lesson_16_says():
    boxes = [engine.Box((0, -5, 0), 10, 0)] + [engine.Box((0, k + 0.5, 0), 1, m) for k, m in enumerate([1, 100])]
    rows = []
    for i, j, _, q, n, _ in engine.contacts(boxes, 0.02):
        J = np.zeros(9)
        J[3 * i : 3 * i + 3], J[3 * j : 3 * j + 3] = engine.row(boxes, i, j, q, n)
        rows.append(J)
    A = np.array(rows) @ np.diag(np.concatenate([box.M_inverse for box in boxes])) @ np.array(rows).T
    for sigma in 0.48, 2.42:
        of_boxes, of_balls = engine.rate(A + sigma * np.diag(np.diag(A))), 100 / 101 / (1 + sigma) ** 2
        assert of_balls < of_boxes < 1.25 * of_balls


def test_feedback_without_dt_takes_416_steps_for_half_of_an_error_as_lesson_10_says():
    dt, beta, c, steps = 1 / 60, 0.1, 1.0, 0
    while c > 0.5:
        c, steps = c - dt * beta * c, steps + 1
    assert steps == 416 and 0.9**6 > 0.5 > 0.9**7


def test_the_stops_of_lemkes_path_in_the_drawing_of_lesson_7():
    A, start = np.array([[2.0, 1], [1, 2]]), np.array([-5.0, -6])
    for x, z0, w in ([0, 0], 6, [1, 0]), ([0, 1], 4, [0, 0]), ([4 / 3, 7 / 3], 0, [0, 0]):
        assert_allclose(A @ np.array(x) + z0 + start, w, atol=1e-12)


def test_lemkes_path_circles_after_ties_on_a_p_matrix_and_not_without_ties_as_lesson_7_says():
    A = [[1, 2, 0], [0, 1, 2], [2, 0, 1]]
    minors = [np.linalg.det(np.array(A)[np.ix_(F, F)]) for F in ([0], [1], [2], [0, 1], [0, 2], [1, 2], [0, 1, 2])]
    assert min(minors) > 0.9
    basis, stops = ["w0", "w1", "w2"], []
    T = [[Fraction(i == j) for j in range(3)] + [Fraction(-a) for a in A[i]] + [Fraction(-1)] * 2 for i in range(3)]
    names = ["w0", "w1", "w2", "x0", "x1", "x2", "z0"]  # the columns; the last one is b
    partner = {**dict(zip(names[:3], names[3:6])), **dict(zip(names[3:6], names[:3]))}
    row, entering = 0, "z0"
    while (stop := (set(basis), entering)) not in stops:
        stops.append(stop)
        k = names.index(entering)
        T[row] = [value / T[row][k] for value in T[row]]
        T = [T[i] if i == row else [p - T[i][k] * q for p, q in zip(T[i], T[row])] for i in range(3)]
        leaving, basis[row] = basis[row], entering
        assert leaving != "z0"  # it never arrives
        entering = partner[leaving]
        k = names.index(entering)
        row = min((i for i in range(3) if T[i][k] > 0), key=lambda i: T[i][-1] / T[i][k])  # of equal ones the first
    assert len(stops) - stops.index(stop) == 6
    for b in -np.ones(3), np.array([-1, -1.01, -1.02]):
        (x,) = engine.all_cases(np.array(A, dtype=float), b)
        assert_allclose(engine.murty(np.array(A, dtype=float), b), x)
    assert_allclose(engine.lemke(np.array(A, dtype=float), b), x)  # without ties


def test_several_contacts_gain_energy_just_where_a_pushed_one_was_opening_as_lesson_12_says():
    J = np.array([[-1.0, 1, 0], [0, -1, 1]])  # three touching balls of 1 kg
    A = J @ J.T

    def after(u):
        before = J @ u
        (first,) = engine.all_cases(A, before)
        (x,) = engine.all_cases(A, np.where((first > 0) & (before < 0), 2 * before, before))  # e = 1
        return u + J.T @ x, ((x > 1e-9) & (before > 0)).any()

    u, opened = after(np.array([1, 0, 0.2]))
    assert opened
    assert_allclose(u, np.array([-4, 11, 11]) / 15)
    assert_allclose(u @ u / (1 + 0.2**2), 1.1, atol=0.01)
    gains = []
    for start in np.random.default_rng(8).normal(size=(500, 3)):
        u, opened = after(start)
        gains.append(opened)
        assert (u @ u > start @ start + 1e-12) == opened
        assert u @ u > start @ start - 1e-12
    assert 0 < sum(gains) < 500
    for speed in -2.0, -0.3, 0.0, 0.4:  # a single contact: a ball and the ground
        (x,) = engine.all_cases(np.eye(1), np.array([2 * min(speed, 0) + max(speed, 0)]))
        assert_allclose(abs(speed + x[0]), abs(speed))


def test_the_rod_of_lesson_12_stops_sliding_at_0_15_newton_seconds_and_still_approaches():
    A, w, x, d = np.array([[2.5, -1.5], [-1.5, 2.5]]), np.array([-1, 0.6]), np.zeros(2), 1e-6
    while w[1] > 0:  # it slides: of each small impulse d, Coulomb's friction takes d against the slip
        x, w = x + [d, -d], w + A @ [d, -d]
    assert_allclose(x, [0.15, -0.15], atol=2e-6)
    assert_allclose(w, [-0.4, 0], atol=1e-5)
    stuck = A[0, 1] / A[1, 1]  # the friction that keeps the end from sliding, for each 1 N s along the normal
    assert abs(stuck) < 1


def test_ten_substeps_compute_all_rows_ten_times_for_the_same_number_of_sweeps_as_lesson_16_says(monkeypatch):
    rows, row = [], engine.row
    monkeypatch.setattr(engine, "row", lambda *given: rows.append(0) or row(*given))
    counts = []
    for substeps in 1, 10:
        boxes = [engine.Box((0, -5, 0), 10, 0)] + [engine.Box((0, k + 0.5, 0), 1, 1) for k in range(3)]
        rows.clear()
        kept = {}
        for _ in range(substeps):
            kept = engine.step(boxes, 0.01 / substeps, 10 // substeps, 0.5, kept, soft=(60, 1.0))
        counts.append(len(rows))
    assert counts == [12, 120]  # three layers, two points, a normal and a tangent


def test_one_stiffness_gives_each_row_another_h_and_one_frequency_the_same_as_lesson_16_says():
    dt, a = 0.001, np.array([1, 1.01, 0.01])  # 1 kg on the ground, 100 kg on 1 kg, 100 kg on the ground
    weight = 9.81 * np.array([1, 100, 100])
    h = lambda k: dt * np.sqrt(k * a)  # the frequency of a mass 1/a on a spring k
    assert_allclose(h(1e5) / h(1e5)[0], [1, np.sqrt(1.01), 0.1])
    stiffness = (2 * np.pi * 120) ** 2 / a
    assert_allclose(h(stiffness), 2 * np.pi * 120 * dt)
    assert_allclose(engine.softness(a, 120, 1.0, dt)[1], engine.softness(1.0, 120, 1.0, dt)[1])  # one β
    assert_allclose(weight / stiffness / (weight / stiffness)[0], [1, 101, 1])  # 100 kg on 1 kg sinks deep


def test_the_natural_residual_bounds_the_distance_to_the_nearest_answer_of_four_corners_as_lesson_9_says():
    corners = np.array([[-0.5, -0.5], [-0.5, 0.5], [0.5, -0.5], [0.5, 0.5]])
    J = np.column_stack([np.ones(4), corners[:, 1], -corners[:, 0]])
    A, b = J @ np.diag([1.0, 6, 6]) @ J.T, -np.ones(4)
    quarter, z = 0.25 * np.ones(4), np.array([1, -1, -1, 1])
    one = np.array([0.5, 0, 0, 0.5])
    assert np.abs(np.minimum(one, A @ one + b)).max() < 1e-12 and np.linalg.norm(one - quarter) == 0.5
    generator = np.random.default_rng(9)
    for size in 1.0, 0.1, 0.001:
        for _ in range(2000):
            x = quarter + generator.uniform(-0.25, 0.25) * z + size * generator.normal(size=4)
            nearest = quarter + np.clip(z @ (x - quarter) / 4, -0.25, 0.25) * z
            assert np.linalg.norm(x - nearest) < 2 * np.linalg.norm(np.minimum(x, A @ x + b))


def test_a_small_scaled_residual_does_not_show_that_a_solution_exists_as_lesson_9_says():
    ring = 2 * np.eye(4) - np.roll(np.eye(4), 1, axis=0) - np.roll(np.eye(4), -1, axis=0)
    assert_allclose(engine.scaled(ring, -np.ones(4), 1e8 * np.ones(4)), 1 / (4e8 + 1))


def test_the_best_relaxation_does_the_work_of_10_sweeps_to_six_digits_and_of_13_in_the_long_run_as_lesson_5_says():
    n = 10
    A, b, exact = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1), np.zeros(n), np.arange(n, 0, -1)
    A[0, 0], b[0] = 1, -1
    rho = np.cos(np.pi / 20) ** 2
    best = 2 / (1 + np.sqrt(1 - rho))

    def sweeps(omega, part):
        x, k = np.zeros(n), 0
        while abs(x - exact).max() > part * n:
            x, k = engine.sor(A, b, np.zeros(n), np.full(n, np.inf), omega, 1, x), k + 1
        return k

    assert round(np.log(best - 1) / np.log(rho)) == 13
    assert round(sweeps(1.0, 1e-6) / sweeps(best, 1e-6)) == 10


def test_a_row_that_moves_lowers_the_objective_from_within_its_bounds_and_may_raise_it_from_outside():
    f = lambda A, b, x: 0.5 * x @ A @ x + b @ x
    one = np.ones(1)
    moved = engine.sor(np.eye(1), one, 0 * one, np.inf * one, 1.0, 1, -one)
    assert f(np.eye(1), one, -one) == -0.5 and f(np.eye(1), one, moved) == 0
    for A, b in problems():
        zero, inf = np.zeros(len(b)), np.full(len(b), np.inf)
        for omega in 0.5, 1.0, 1.9:
            x = np.abs(b)  # within the bounds
            for _ in range(30):
                y = engine.sor(A, b, zero, inf, omega, 1, x)
                assert f(A, b, y) <= f(A, b, x) + 1e-12
                x = y


def test_a_scaled_residual_is_a_part_of_the_terms_on_either_leg_as_lesson_8_says():
    one = np.ones(1)
    open_contact, pushing = np.array([1e-8]), np.array([1 + 2e-8])
    assert_allclose(engine.scaled(np.eye(1), one, open_contact), 1e-8, rtol=1e-6)  # w = 1: nothing cancels
    assert_allclose(engine.scaled(np.eye(1), -one, pushing), 1e-8, rtol=1e-6)  # 1 - 1 leaves 2e-8 of 2


def test_the_friction_of_an_impact_in_one_impulse_adds_the_energy_that_lesson_11_mentions():
    x, before, after = np.array([1.025, 0.375]), np.array([-1, 0.6]), np.array([1, 0])
    A = np.array([[2.5, -1.5], [-1.5, 2.5]])
    assert_allclose(before + A @ x, after, atol=1e-12)
    assert_allclose(x * (before + after) / 2, [0, 0.1125], atol=1e-12)  # J, of the normal and of friction


def test_damped_jacobi_converges_below_two_over_the_largest_eigenvalue_as_lesson_4_says():
    A, b = 0.2 * np.eye(3) + 0.8 * np.ones((3, 3)), -np.ones(3)
    limit = 2 / 2.6  # the eigenvalues are 0.2, 0.2 and 2.6
    for damping, is_right in (0.98 * limit, True), (1.02 * limit, False):
        x = np.array([0.3, 0.4, 0.5])
        for _ in range(2000):
            x = np.maximum(x - damping * (A @ x + b) / np.diag(A), 0)
        assert (abs(x - 5 / 13).max() < 1e-9) == is_right


def test_the_five_rows_of_a_hinge_as_lesson_2_has_them():
    generator, h = np.random.default_rng(10), 1e-3
    a, ts = np.array([0, 0.6, 0.8]), ([1.0, 0, 0], [0, 0.8, -0.6])  # the axis and two directions across it
    omega = np.array([[0.5, -1, 0.8], [1.2, 0.3, -0.7]])

    def turned(r, spin, time):  # Rodrigues
        size, r = np.linalg.norm(spin), np.array(r)
        e = spin / size
        across = np.cross(e, r)
        return r + np.sin(size * time) * across + (1 - np.cos(size * time)) * np.cross(e, across)

    def c(t, omega, time):  # the axis belongs to body 1, the direction to body 0, and both spin on
        return turned(a, omega[1], time) @ turned(t, omega[0], time)

    allowed = np.array([omega[0], omega[0] + 0.7 * a])  # a turn about the axis
    for t in ts:
        s = np.cross(a, t)
        assert_allclose((c(t, omega, h) - c(t, omega, -h)) / (2 * h), s @ (omega[1] - omega[0]), atol=1e-5)
        assert_allclose(s @ (allowed[1] - allowed[0]), 0, atol=1e-12)
        product = (allowed[1] - allowed[0]) @ np.cross(allowed[0], s)
        assert abs(product) > 0.1
        assert_allclose((c(t, allowed, h) - 2 * c(t, allowed, 0) + c(t, allowed, -h)) / h**2, product, atol=1e-5)
    zero, I, r = np.zeros(3), np.eye(3), generator.normal(size=(2, 3))
    point = np.hstack([-I, engine.skew(r[0]), I, -engine.skew(r[1])])
    J = np.vstack([point] + [np.concatenate([zero, -np.cross(a, t), zero, np.cross(a, t)]) for t in ts])
    assert np.linalg.matrix_rank(J) == 5


def test_the_inertia_seen_from_outside_turns_with_the_body_as_lesson_3_says():
    places, masses = np.random.default_rng(12).normal(size=(6, 3)), np.arange(1.0, 7)
    inertia = lambda rs: sum(m * ((r @ r) * np.eye(3) - np.outer(r, r)) for m, r in zip(masses, rs))
    R = np.linalg.qr(np.random.default_rng(13).normal(size=(3, 3)))[0]
    assert_allclose(inertia(places @ R.T), R @ inertia(places) @ R.T)


def test_sweeps_on_singular_matrices_with_a_solution_converge_to_one_that_the_start_decides_as_lesson_9_says():
    rng = np.random.default_rng(9)
    zero, free, different = np.zeros(5), np.full(5, np.inf), 0
    for _ in range(20):
        J = rng.standard_normal((5, 3))
        A = J @ J.T
        x = np.maximum(rng.standard_normal(5), 0)
        b = np.where(x > 0, 0, rng.random(5)) - A @ x  # w is 0 where x pushes
        ends = []
        for start in zero, 2 * rng.random(5):
            swept = engine.sor(A, b, zero, free, 1.0, 3000, start)
            w = A @ swept + b
            assert abs(np.minimum(swept, w)).max() < 1e-6
            ends.append(swept)
        assert_allclose(A @ ends[0], A @ ends[1], atol=1e-5)
        different += abs(ends[0] - ends[1]).max() > 1e-3
    assert different > 5
