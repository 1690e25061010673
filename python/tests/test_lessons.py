"""The Python of the lessons runs from top to bottom with NumPy alone, and prints what the lessons say."""

import doctest
import re
import sys
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
