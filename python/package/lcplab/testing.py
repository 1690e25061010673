"""For the tests of other projects: is this a solver?

>>> import lcplab
>>> from lcplab.testing import assert_solves
>>> assert_solves("dantzig")
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lcplab._problem import Problem
    from lcplab._solve import Solver

#: Families of definite or semidefinite problems that a solver of contacts should solve, without friction.
FAMILIES = ("pd", "fathi", "stack", "table", "near-duplicate", "manufactured", "deudeu", "trivial")


def problems() -> list[Problem]:
    """The problems that :func:`assert_solves` tries without others."""
    from lcplab import Problem

    return [Problem.generate(family) for family in FAMILIES]


def assert_solves(
    solver: Solver,
    on: Iterable[Problem] | None = None,
    *,
    tolerance: float = 1e-8,
    max_iterations: int = 100_000,
) -> None:
    """Raise an AssertionError that names every problem which a solver does not solve.

    Parameters
    ----------
    solver : str or callable
        As in :func:`lcplab.solve`.
    on : iterable of Problem, optional
        The problems; those of :func:`problems` without it.
    """
    from lcplab import solve

    failures = []
    for problem in problems() if on is None else on:
        result = solve(problem, solver=solver, tolerance=tolerance, max_iterations=max_iterations)
        if result.status != "solved" or not result:
            where = "" if result.row is None else f", row {result.row} misses by {result.amount:.1e} of its terms"
            failures.append(f"{problem.name or 'problem'}: {result.message}; {result.verdict}{where}")
    if failures:
        raise AssertionError("\n".join(failures))


def assert_honest(solver: Solver, *, evaluations: int = 2000, seed: int = 1) -> None:
    """Raise an AssertionError with the smallest problem on which a solver claims what is not true, if one is found."""
    from lcplab import hunt

    found = hunt(solver, "lie", evaluations=evaluations, seed=seed, within="definite")
    if found is not None:
        raise AssertionError(str(found))
