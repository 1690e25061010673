"""Quadratic programs, with the arguments of qpsolvers."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lcplab import _lcplab
from lcplab._problem import Array, Problem, numbers, read_only
from lcplab._solve import Result, Solver, Verdict, solve

#: Differences of this multiple of n times the largest entry or eigenvalue of P are rounding.
ROUNDING = 4 * float(np.finfo(np.float64).eps)


class Block(NamedTuple):
    """A matrix as the row indices, column indices and values of its entries."""

    rows: NDArray[np.int64]
    cols: NDArray[np.int64]
    values: Array


class QPSolution(Verdict):
    """A solution of the optimality conditions of a quadratic program, with the judge's verdict; true if x satisfies them.

    If the program is convex, such an x is a minimum. The signs are those of qpsolvers: ``P x + q + G.T z + A.T y + z_box = 0``.

    Attributes
    ----------
    x : (n,) ndarray
        The minimum, if the program is convex.
    z : (m,) ndarray
        The multipliers of ``G x <= h``, at least 0.
    y : (p,) ndarray
        The multipliers of ``A x = b``.
    z_box : (n,) ndarray
        The multipliers of the bounds: at most 0 at ``lb``, at least 0 at ``ub``, 0 between them.
    objective : float
        ``1/2 x.T P x + q.T x``.
    is_convex : bool
        Whether P has no negative eigenvalue. Otherwise x may be a maximum or a saddle.
    problem : Problem
        The optimality conditions as a linear complementarity problem in ``(x, z, y)``.
    result : Result
        The answer to this problem, with the name of the solver and its iterations.
    """

    def __init__(
        self, problem: Problem, result: Result, parts: tuple[Array, Array, Array, Array], objective: float, is_convex: bool
    ) -> None:
        super().__init__(bool(result), result.certificate)
        self.x, self.z, self.y, self.z_box = map(read_only, parts)
        self.objective = objective
        self.is_convex = is_convex
        self.problem = problem
        self.result = result

    def __repr__(self) -> str:
        kind = "" if self.is_convex else ", not convex"
        return f"<lcplab.QPSolution {self.verdict}{kind}: x = {np.array2string(self.x, precision=4, threshold=8)}>"


def solve_qp(
    P: ArrayLike,
    q: ArrayLike,
    G: ArrayLike | None = None,
    h: ArrayLike | None = None,
    A: ArrayLike | None = None,
    b: ArrayLike | None = None,
    lb: ArrayLike | None = None,
    ub: ArrayLike | None = None,
    *,
    solver: Solver | None = None,
    tolerance: float = 1e-8,
    max_iterations: int = 10_000,
    prove: bool | None = None,
    nonconvex: bool = False,
) -> QPSolution:
    """Minimize ``1/2 x.T P x + q.T x`` subject to ``G x <= h``, ``A x = b`` and ``lb <= x <= ub``.

    The arguments have the names, the order and the meaning of ``qpsolvers.solve_qp``. The optimality conditions are solved
    and judged as a linear complementarity problem: its unknowns are x, a multiplier ``z >= 0`` for each inequality and a
    multiplier y without bounds for each equation.

    Parameters
    ----------
    P : (n, n) array_like or SciPy sparse array
        The matrix of the objective, symmetric but for rounding.
    q : (n,) array_like
        The vector of the objective.
    G, h : (m, n) array_like or SciPy sparse array, and (m,) array_like, optional
        The inequalities. An infinite entry of h leaves its row out.
    A, b : (p, n) array_like or SciPy sparse array, and (p,) array_like, optional
        The equations.
    lb, ub : (n,) array_like or float, optional
        Bounds of x. By default there are none.
    solver, tolerance, max_iterations, prove
        As in :func:`solve`.
    nonconvex : bool
        Whether to accept a P with negative eigenvalues. The judge then decides only whether x satisfies the optimality
        conditions, which a maximum and a saddle satisfy too.

    Returns
    -------
    QPSolution

    Raises
    ------
    InputError
        If the shapes do not fit, a number is invalid, P is not symmetric, or P has a negative eigenvalue.

    Examples
    --------
    >>> s = solve_qp([[2, 0], [0, 2]], [-1, 0], G=[[-1, -1]], h=[-2])
    >>> s.x.tolist(), s.z.tolist(), s.verdict
    ([1.25, 0.75], [1.5], 'proved')
    """
    right = numbers(q, "q")
    if right.ndim != 1 or len(right) == 0:
        raise _invalid("q", "must be a list of at least one number")
    n = len(right)
    objective = _symmetric(_block(P, (n, n), "P"), n)
    is_convex = _is_convex(objective, n, nonconvex)
    inequalities, limits = _rows(G, h, n, "G", "h")
    inequalities, limits, infinite = _without_infinite(inequalities, limits)
    equations, values = _rows(A, b, n, "A", "b")
    _check_numbers(right, limits, values)
    m, total = len(limits), n + len(limits) + len(values)
    free = np.full(len(values), np.inf)
    lo = np.concatenate([_bound(lb, n, -np.inf, "lb"), np.zeros(m), -free])
    hi = np.concatenate([_bound(ub, n, np.inf, "ub"), np.full(m, np.inf), free])
    blocks = [objective, *_coupling(inequalities, n), *_coupling(equations, n + m)]
    rows, cols, entries = (np.concatenate(parts) for parts in zip(*blocks))
    given = {"b": np.concatenate([right, limits, values]), "lo": lo, "hi": hi, "name": "quadratic program"}
    absent = dict.fromkeys(["friction_index", "mu", "model", "scale"])
    problem = Problem._of(_lcplab.Problem.of((total, rows, cols, entries), given | absent))
    result = solve(problem, solver=solver, tolerance=tolerance, max_iterations=max_iterations, prove=prove)
    x, multipliers, y = np.split(result.x.copy(), [n, n + m])
    z = np.zeros(len(infinite))
    z[~infinite] = multipliers
    curvature = objective.values * x[objective.rows] @ x[objective.cols]
    return QPSolution(problem, result, (x, z, y, -result.w[:n]), float(0.5 * curvature + right @ x), is_convex)


def _invalid(name: str, reason: str) -> _lcplab.InputError:
    return _lcplab.InputError(f"quadratic program: {name}: {reason}")


def _block(matrix: Any, shape: tuple[int | None, int], name: str) -> Block:
    """The entries of a dense or sparse matrix, checked against its shape."""
    if hasattr(matrix, "tocoo"):
        sparse = matrix.tocoo()
        found, rows, cols, values = sparse.shape, sparse.row, sparse.col, numbers(sparse.data, name)
    else:
        dense = numbers(matrix, name)
        if shape[0] is None and dense.ndim == 1:
            dense = dense[np.newaxis, :]
        found, places = dense.shape, np.nonzero(dense)
        rows, cols, values = places[0], places[-1], dense[places]
    if len(found) != 2 or found[1] != shape[1] or shape[0] not in (None, found[0]):
        raise _invalid(name, f"has the shape {tuple(found)}, must be {shape[0] or 'm'} × {shape[1]}")
    if not np.all(np.isfinite(values)):
        raise _invalid(name, "has an entry that is infinite or NaN")
    return Block(np.asarray(rows, dtype=np.int64), np.asarray(cols, dtype=np.int64), np.ascontiguousarray(values))


def _rows(matrix: Any, right: Any, n: int, name: str, right_name: str) -> tuple[Block, Array]:
    """The rows of constraints and their right-hand sides."""
    if (matrix is None) != (right is None):
        raise _invalid(name if matrix is None else right_name, "is missing")
    if matrix is None:
        return Block(np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64), np.zeros(0)), np.zeros(0)
    values = np.atleast_1d(numbers(right, right_name))
    block = _block(matrix, (None, n), name)
    count = matrix.shape[0] if hasattr(matrix, "tocoo") else len(np.atleast_2d(np.asarray(matrix)))
    if values.shape != (count,):
        raise _invalid(right_name, f"has the shape {values.shape}, {name} has {count} rows")
    return block, values


def _check_numbers(q: Array, h: Array, b: Array) -> None:
    for name, values in (("q", q), ("b", b)):
        if not np.all(np.isfinite(values)):
            raise _invalid(name, "has an entry that is infinite or NaN")
    if not np.all(h > -np.inf):
        raise _invalid("h", "has an entry that is -inf or NaN")


def _bound(values: Any, n: int, default: float, name: str) -> Array:
    bound = np.asarray(default if values is None else numbers(values, name), dtype=np.float64)
    if bound.ndim == 0 or (bound.shape == (1,) and n > 1):
        return np.full(n, float(bound.ravel()[0]))
    if bound.shape != (n,):
        raise _invalid(name, f"has the shape {bound.shape}, must have {n} entries")
    return bound


def _without_infinite(block: Block, limits: Array) -> tuple[Block, Array, NDArray[np.bool_]]:
    """The inequalities without those that nothing can violate, and which these are."""
    infinite = limits == np.inf
    kept = ~infinite[block.rows]
    number = np.cumsum(~infinite) - 1
    return Block(number[block.rows[kept]], block.cols[kept], block.values[kept]), limits[~infinite], infinite


def _coupling(block: Block, first: int) -> tuple[Block, Block]:
    """The rows ``h - G x`` of their multipliers from row ``first`` on, and their forces ``G.T z`` on x."""
    multipliers = block.rows + first
    return Block(multipliers, block.cols, -block.values), Block(block.cols, multipliers, block.values)


def _symmetric(P: Block, n: int) -> Block:
    """The same matrix, exactly symmetric if it is symmetric but for rounding."""
    entries: dict[tuple[int, int], float] = {}
    for i, j, value in zip(P.rows.tolist(), P.cols.tolist(), P.values.tolist()):
        entries[i, j] = entries.get((i, j), 0.0) + value
    largest = max(map(abs, entries.values()), default=0.0)
    mean: dict[tuple[int, int], float] = {}
    for (i, j), value in entries.items():
        other = entries.get((j, i), 0.0)
        if abs(value - other) > ROUNDING * n * largest:
            reason = f"is not symmetric: P[{i}, {j}] is {value}, P[{j}, {i}] is {other}; {_advice(entries)}"
            raise _invalid("P", reason)
        mean[i, j] = mean[j, i] = 0.5 * (value + other)
    places = np.array(list(mean), dtype=np.int64).reshape(len(mean), 2)
    return Block(places[:, 0].copy(), places[:, 1].copy(), np.array(list(mean.values()), dtype=np.float64))


def _advice(entries: dict[tuple[int, int], float]) -> str:
    """What to give instead of a P that is not symmetric."""
    used = [place for place, value in entries.items() if value != 0.0]
    if all(i <= j for i, j in used) or all(i >= j for i, j in used):
        # Some programs read one triangle of a symmetric P.
        return "all of P is required, not one triangle: give P + P.T - diag(P)"
    return "give (P + P.T) / 2, which has the same objective"


def _is_convex(P: Block, n: int, nonconvex: bool) -> bool:
    # Columns without entries have the eigenvalue 0.
    used, place = np.unique(P.rows, return_inverse=True)
    dense = np.zeros((len(used), len(used)))
    np.add.at(dense, (place, np.searchsorted(used, P.cols)), P.values)
    eigenvalues = np.append(np.linalg.eigvalsh(dense), 0.0)
    least, largest = float(eigenvalues.min()), float(np.abs(eigenvalues).max())
    is_convex = least >= -ROUNDING * n * largest
    if not is_convex and not nonconvex:
        reason = (
            f"has the negative eigenvalue {least:.3g}, so the program is not convex and a solution of its optimality "
            "conditions may be a maximum or a saddle; nonconvex=True solves them nevertheless"
        )
        raise _invalid("P", reason)
    return is_convex
