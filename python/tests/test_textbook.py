"""The textbook in NumPy gives what the solvers give."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import lcplab
from lcplab import textbook


def problems():
    generator = np.random.default_rng(1)
    for n in range(1, 9):
        J = generator.normal(size=(n, n + 2))
        yield J @ J.T, generator.normal(size=n)


@pytest.mark.parametrize("A, b", list(problems()))
def test_each_method_finds_the_solution_that_the_judge_proves(A, b):
    n = len(b)
    exact = lcplab.solve(A, b, solver="dantzig")
    assert exact.verdict == "proved"
    zero, inf = np.zeros(n), np.full(n, np.inf)
    assert_allclose(textbook.murty(A, b), exact.x, atol=1e-9)
    assert_allclose(textbook.lemke(A, b), exact.x, atol=1e-9)
    assert_allclose(textbook.dantzig(A, b, zero, inf), exact.x, atol=1e-9)
    assert_allclose(textbook.interior_point(A, b, 60), exact.x, atol=1e-6)
    lo, hi = np.full(n, -0.2), np.full(n, 0.3)
    boxed = lcplab.solve(A, b, lo, hi, solver="dantzig")
    assert_allclose(textbook.dantzig(A, b, lo, hi), boxed.x, atol=1e-9)


@pytest.mark.parametrize("A, b", list(problems()))
def test_sweeps_are_those_of_the_solver(A, b):
    zero, inf = np.zeros(len(b)), np.full(len(b), np.inf)
    for k in (1, 2, 5):
        own = lcplab.solve(A, b, solver="pgs", max_iterations=k, tolerance=0.0)
        assert_allclose(textbook.gauss_seidel(A, b, zero, inf, k), own.x, atol=1e-13)
    many = textbook.jacobi(A, b, zero, inf, 1 / len(b), 5)
    assert (many >= 0).all()


def test_a_ray_is_none():
    assert textbook.lemke(np.array([[-1.0]]), np.array([-1.0])) is None
