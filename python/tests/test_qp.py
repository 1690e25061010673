"""Quadratic programs: closed forms, SciPy's minima, and the signs of qpsolvers."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import lcplab
from lcplab import solve_qp


def assert_optimal(s, P, q, G, h, A, b, lb, ub):
    """The conditions of a minimum of a convex program, from their definition."""
    n = len(q)
    z_box, z = s.z_box, s.z
    assert_allclose(P @ s.x + q + G.T @ z + A.T @ s.y + z_box, np.zeros(n), atol=1e-9)
    assert_allclose(A @ s.x, b, atol=1e-9)
    assert (G @ s.x <= h + 1e-9).all() and (s.x >= lb - 1e-9).all() and (s.x <= ub + 1e-9).all()
    assert (z >= -1e-12).all()
    assert_allclose(z * (h - G @ s.x), 0, atol=1e-8)
    at_lb, at_ub = np.isclose(s.x, lb, atol=1e-8), np.isclose(s.x, ub, atol=1e-8)
    assert (z_box[~at_ub] <= 1e-8).all() and (z_box[~at_lb] >= -1e-8).all()


def test_the_example_of_qpsolvers():
    # The conditions of its minimum in fractions give x = (4, -9, 18) / 13.
    M = np.array([[1.0, 2.0, 0.0], [-8.0, 3.0, 2.0], [0.0, 1.0, 1.0]])
    P, q = M.T @ M, np.array([3.0, 2.0, 3.0]) @ M
    G, h = np.array([[1.0, 2.0, 1.0], [2.0, 0.0, 1.0], [-1.0, 2.0, -1.0]]), np.array([3.0, 2.0, -2.0])
    A, b = np.array([1.0, 1.0, 1.0]), np.array([1.0])
    s = solve_qp(P, q, G, h, A, b)
    assert s and s.is_convex
    assert_allclose(s.x, np.array([4, -9, 18]) / 13, atol=1e-12)
    assert_optimal(s, P, q, G, h, A[None, :], b, np.full(3, -np.inf), np.full(3, np.inf))
    assert s.objective == pytest.approx(0.5 * s.x @ P @ s.x + q @ s.x)


def test_the_multipliers_of_bounds_have_the_signs_of_qpsolvers():
    # (x - 2)^2 on [0, 1] and (x + 1)^2 on [0, 1]: the forces of the bounds are 2 and -2.
    assert solve_qp([[2.0]], [-4.0], lb=[0], ub=[1]).z_box.tolist() == [2.0]
    assert solve_qp([[2.0]], [2.0], lb=[0], ub=[1]).z_box.tolist() == [-2.0]
    assert solve_qp([[2.0]], [-1.0], lb=0, ub=1).z_box.tolist() == [0.0]


@pytest.mark.parametrize("seed", range(8))
def test_minima_are_those_of_scipy(seed):
    from scipy.optimize import minimize

    rng = np.random.default_rng(seed)
    n, m, p = 6, 5, 2
    F = rng.normal(size=(4, n))
    P, q = F.T @ F, rng.normal(size=n)  # rank 4
    inside = rng.uniform(-0.5, 0.5, n)
    G, A = rng.normal(size=(m, n)), rng.normal(size=(p, n))
    h, b = G @ inside + rng.uniform(0, 1, m), A @ inside
    lb, ub = np.full(n, -1.0), np.full(n, 1.0)
    s = solve_qp(P, q, G, h, A, b, lb, ub)
    assert s, s
    assert_optimal(s, P, q, G, h, A, b, lb, ub)
    limits = [
        {"type": "ineq", "fun": lambda x: h - G @ x, "jac": lambda x: -G},
        {"type": "eq", "fun": lambda x: A @ x - b, "jac": lambda x: A},
    ]
    known = minimize(
        lambda x: 0.5 * x @ P @ x + q @ x, inside, jac=lambda x: P @ x + q, bounds=list(zip(lb, ub)),
        constraints=limits, method="SLSQP", options={"ftol": 1e-14, "maxiter": 1000},
    )
    assert s.objective == pytest.approx(known.fun, abs=1e-6)
    assert s.objective <= known.fun + 1e-8


def test_sparse_matrices_give_the_same_as_dense_ones():
    from scipy import sparse

    P, q = np.diag([2.0, 2.0, 0.0]), np.array([-1.0, 0.0, 1.0])
    G, h, A, b = np.array([[-1.0, -1, 0]]), np.array([-2.0]), np.array([[0.0, 1, 1]]), np.array([3.0])
    dense = solve_qp(P, q, G, h, A, b, lb=0)
    other = solve_qp(sparse.csc_matrix(P), q, sparse.coo_array(G), h, sparse.csr_matrix(A), b, lb=0)
    assert dense and (dense.x == other.x).all() and (dense.z == other.z).all() and (dense.y == other.y).all()


def test_an_infinite_inequality_is_left_out_and_has_the_multiplier_0():
    # Without its first row the program is that of the docstring.
    s = solve_qp([[2, 0], [0, 2]], [-1, 0], G=[[5, 7], [-1, -1], [1, 1]], h=[np.inf, -2, np.inf])
    assert s.x.tolist() == [1.25, 0.75] and s.z.tolist() == [0.0, 1.5, 0.0]
    assert len(s.problem) == 3


def test_a_linear_program_is_a_quadratic_program_without_curvature():
    # min x + 2 y, x + y >= 1, x <= 0.75: (0.75, 0.25), with the forces 2 of the row and 1 of the bound.
    s = solve_qp(np.zeros((2, 2)), [1, 2], G=[[-1, -1]], h=[-1], lb=0, ub=[0.75, np.inf])
    assert s.verdict == "proved"
    assert s.x.tolist() == [0.75, 0.25] and s.z.tolist() == [2.0] and s.z_box.tolist() == [1.0, 0.0]


def test_a_program_without_a_feasible_point_is_proved_to_have_none():
    s = solve_qp(np.eye(2), [0, 0], G=[[1, 1], [-1, -1]], h=[-1, -1])
    assert not s and s.result.status == "infeasible" and s.proof


def test_a_program_that_is_not_convex_is_refused_with_its_eigenvalue():
    P = [[1.0, 3.0], [3.0, 1.0]]  # 4 and -2
    with pytest.raises(lcplab.InputError, match="P: has the negative eigenvalue -2, so the program is not convex"):
        solve_qp(P, [0, 0], lb=-1, ub=1)
    s = solve_qp(P, [0, 0], lb=-1, ub=1, nonconvex=True)
    assert not s.is_convex and "not convex" in repr(s)


def test_a_singular_matrix_of_the_objective_counts_as_convex():
    # Rounding makes one of its eigenvalues -1e-16.
    F = np.array([[1.0, 2, 3], [4, 5, 6], [5, 7, 9]])
    assert solve_qp(F.T @ F, [0, 0, 0], lb=-1, ub=1).is_convex
    with pytest.raises(lcplab.InputError, match="negative eigenvalue -1e-06"):
        solve_qp(np.diag([1.0, -1e-6]), [0, 0], lb=-1, ub=1)


def test_rounding_in_a_symmetric_matrix_is_averaged():
    P = np.array([[2.0, 0.1], [np.nextafter(0.1, 1), 2.0]])
    s = solve_qp(P, [-1, -1])
    assert s and (s.problem.A == s.problem.A.T).all()


@pytest.mark.parametrize(
    "arguments, words",
    [
        (dict(P=[[1, 2], [0, 1]]), "P: is not symmetric: P[0, 1] is 2.0, P[1, 0] is 0.0"),
        (dict(P=[[1, 2], [0, 1]]), "all of P is required, not one triangle: give P + P.T - diag(P)"),
        (dict(P=[[1, 0], [2, 1]]), "all of P is required, not one triangle: give P + P.T - diag(P)"),
        (dict(P=[[1, 2], [1, 1]]), "give (P + P.T) / 2, which has the same objective"),
        (dict(P=[[1, 2]]), "P: has the shape (1, 2), must be 2 × 2"),
        (dict(G=[[1, 0, 0]], h=[1]), "G: has the shape (1, 3), must be m × 2"),
        (dict(G=[[1, 0]], h=[1, 2]), "h: has the shape (2,), G has 1 rows"),
        (dict(G=[[1, 0]]), "h: is missing"),
        (dict(b=[1]), "A: is missing"),
        (dict(A=[[1, np.nan]], b=[1]), "A: has an entry that is infinite or NaN"),
        (dict(A=[[1, 1]], b=[np.inf]), "b: has an entry that is infinite or NaN"),
        (dict(q=[np.nan, 0]), "q: has an entry that is infinite or NaN"),
        (dict(G=[[1, 1]], h=[-np.inf]), "h: has an entry that is -inf or NaN"),
        (dict(lb=[0, 1, 2]), "lb: has the shape (3,), must have 2 entries"),
        (dict(lb=[2, 0], ub=[1, 1]), "lo[0]: is 2, above hi[0] = 1"),
    ],
)
def test_defects_name_the_argument(arguments, words):
    with pytest.raises(lcplab.InputError) as error:
        solve_qp(**{"P": np.eye(2), "q": [0, 0], **arguments})
    assert words in str(error.value)
