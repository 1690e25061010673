"""All solutions: those of games by their supports, transport plans, saddles, rays."""

import itertools
from fractions import Fraction

import numpy as np
import pytest

import lcplab
from lcplab import Problem, solutions


def solved(A, right):
    """The solution of a square system in fractions; None if it is singular."""
    rows = [[*map(Fraction, row), Fraction(r)] for row, r in zip(A, right)]
    for k in range(len(rows)):
        pivot = next((i for i in range(k, len(rows)) if rows[i][k] != 0), None)
        if pivot is None:
            return None
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [entry / rows[k][k] for entry in rows[k]]
        for i in range(len(rows)):
            if i != k:
                rows[i] = [a - rows[i][k] * c for a, c in zip(rows[i], rows[k])]
    return [row[-1] for row in rows]


def by_supports(A, b):
    """The solutions of an LCP without bounds above, one support after the other."""
    found = set()
    for size in range(len(b) + 1):
        for support in itertools.combinations(range(len(b)), size):
            part = solved([[A[i][j] for j in support] for i in support], [-b[i] for i in support])
            if part is None:
                continue
            x = [Fraction(0)] * len(b)
            for i, value in zip(support, part):
                x[i] = value
            w = [sum(Fraction(a) * v for a, v in zip(row, x)) + Fraction(r) for row, r in zip(A, b)]
            if all(v >= 0 for v in x) and all(v >= 0 for v in w):
                found.add(tuple(x))
    return found


def by_sides(A, b, lo, hi):
    """The solutions of a problem with two bounds in each row, one choice of sides after the other."""
    found, n = set(), len(b)
    A, b, lo, hi = ([[Fraction(v) for v in row] for row in A], *([Fraction(v) for v in own] for own in (b, lo, hi)))
    for sides in itertools.product("lfh", repeat=n):
        free = [i for i in range(n) if sides[i] == "f"]
        x = [{"l": lo[i], "h": hi[i], "f": Fraction(0)}[sides[i]] for i in range(n)]
        w = lambda i: sum(a * v for a, v in zip(A[i], x)) + b[i]
        part = solved([[A[i][j] for j in free] for i in free], [-w(i) for i in free])
        if part is None:
            continue
        for i, value in zip(free, part):
            x[i] = value
        fits = {"l": lambda i: w(i) >= 0, "h": lambda i: w(i) <= 0, "f": lambda i: lo[i] <= x[i] <= hi[i]}
        if all(fits[sides[i]](i) for i in range(n)):
            found.add(tuple(x))
    return found


def game(costs_of_one, costs_of_other):
    """The LCP of a bimatrix game with positive costs; x divided by its sums are the strategies."""
    one, other = np.array(costs_of_one, dtype=float), np.array(costs_of_other, dtype=float)
    m, n = one.shape
    A = np.block([[np.zeros((m, m)), one], [other.T, np.zeros((n, n))]])
    return A, -np.ones(m + n)


def test_a_game_of_two_by_two_has_the_equilibria_of_its_supports():
    A, b = game([[1, 3], [3, 2]], [[3, 1], [1, 2]])
    found = solutions(Problem(A, b))
    assert {tuple(x) for x in found.corners} == by_supports(A.tolist(), b.tolist())
    assert tuple(map(Fraction, ["1/5", "2/5", "1/7", "2/7"])) in {tuple(x) for x in found.corners}


@pytest.mark.parametrize("seed", range(6))
def test_all_equilibria_of_games_are_found(seed):
    rng = np.random.default_rng(seed)
    A, b = game(rng.integers(1, 10, (3, 3)), rng.integers(1, 10, (3, 3)))
    known = by_supports(A.tolist(), b.tolist())
    found = solutions(Problem(A, b))
    # Further corners can only be ends of faces, whose systems are singular.
    assert known <= {tuple(x) for x in found.corners}
    if found.is_finite:
        assert known == {tuple(x) for x in found.corners}
    assert len(known) % 2 == 1 or not found.is_finite


def test_a_transport_problem_has_two_plans_and_all_between_them():
    # From supplies 50 and 60 to demands 30 and 25: the rows of the plan, then the prices.
    plan = [[0, 0, 0, 0, 1, 0, -1, 0], [0, 0, 0, 0, 1, 0, 0, -1], [0, 0, 0, 0, 0, 1, -1, 0], [0, 0, 0, 0, 0, 1, 0, -1]]
    A = np.array(plan + [[-1, -1, 0, 0, 0, 0, 0, 0], [0, 0, -1, -1, 0, 0, 0, 0], [1, 0, 1, 0] + [0] * 4, [0, 1, 0, 1] + [0] * 4])
    found = solutions(Problem(A, [2, 3, 2, 4, 50, 60, -30, -25]))
    # The first supplier serves all of the second customer, and up to 25 of the first, who costs both the same.
    assert {tuple(x[:4]) for x in found.corners} == {(0, 25, 30, 0), (25, 25, 5, 0)}
    assert not found.is_unique and not found.is_finite
    assert lcplab.judge(Problem(A, [2, 3, 2, 4, 50, 60, -30, -25]), x=[25, 25, 5, 0, 0, 0, 2, 3])


def test_a_saddle_has_three_solutions():
    # The minima (1, -1) and (-1, 1) of x² / 2 + 3 x y + y² / 2 on a square, and the saddle between them.
    found = solutions(Problem([[1, 3], [3, 1]], [0, 0], lo=-1, hi=1))
    assert {tuple(x) for x in found.corners} == {(0, 0), (1, -1), (-1, 1)}
    assert len(found) == 3 and found.is_finite and not found.is_unique
    assert repr(found) == "<lcplab.Solutions: exactly 3>"


@pytest.mark.parametrize("seed", range(60))
def test_all_solutions_are_found_where_terms_of_rows_overflow_and_underflow(seed):
    rng, n = np.random.default_rng(seed), 3
    # x_j is of the size 2^units[j], and the terms A_ij x_j of row i are of the size 2^sizes[i].
    units, sizes = rng.integers(-400, 401, n), rng.choice([-1100, -1070, 0, 1020, 1100], n)
    exponents = sizes[:, None] - units
    whole = np.where(abs(exponents) <= 1000, rng.integers(-2, 3, (n, n)), 0)
    A = np.ldexp(whole.astype(float), np.where(whole, exponents, 0))
    b = np.where(abs(sizes) <= 1020, np.ldexp(rng.integers(-2, 3, n).astype(float), sizes.clip(-1020, 1020)), 0.0)
    lo, hi = -np.ldexp(np.ones(n), units), np.ldexp(rng.integers(1, 3, n).astype(float), units)
    known = by_sides(A.tolist(), b.tolist(), lo.tolist(), hi.tolist())
    found = solutions(Problem(A, b, lo=lo, hi=hi))
    assert known <= {tuple(x) for x in found.corners}
    if found.is_finite:
        assert known == {tuple(x) for x in found.corners}


def test_no_solution_one_solution_and_a_ray():
    none = solutions(Problem([[0.0]], [-1]))
    assert not none and not none.is_unique and none.x.shape == (0, 1)
    one = solutions(Problem([[2, -1], [-1, 2]], [-1, 2]))
    assert one.is_unique and one.corners == [[Fraction(1, 2), Fraction(0)]]
    # w = 0 for every x: all x >= 0.
    ray = solutions(Problem([[0.0]], [0]))
    assert ray.corners == [[0]] and ray.rays == [[1]]
    (face,) = ray
    assert face.rays == [[1]] and not face.is_isolated


def test_thirds_are_exact():
    found = solutions(Problem([[3.0]], [-1]))
    assert found.corners == [[Fraction(1, 3)]] and found.x[0, 0] == 1 / 3


def test_large_problems_and_cones_are_refused():
    with pytest.raises(lcplab.InputError, match="531,441"):
        solutions(Problem(np.eye(20), -np.ones(20)))
    with pytest.raises(lcplab.InputError, match="more than 1,024 solutions"):
        solutions(Problem(-np.eye(12), np.zeros(12), lo=-1, hi=1))
    cone = Problem(np.eye(3), [-2, -3, 0], friction_index=[-1, 0, 0], mu=[0, 0.5, 0.5], model="coulomb-cone")
    with pytest.raises(lcplab.InputError, match="all solutions can be listed about boxes only"):
        solutions(cone)
    assert solutions(cone, model="coupled-box").corners == [[2, 1, 0]]
