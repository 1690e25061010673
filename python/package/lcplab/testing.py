"""Assertions about solvers, for the tests of other projects.

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

#: Families of definite or semidefinite problems without friction that a contact solver should solve.
FAMILIES = ("pd", "fathi", "stack", "table", "near-duplicate", "manufactured", "deudeu", "trivial")


def problems() -> list[Problem]:
    """The default problems of :func:`assert_solves`."""
    from lcplab import Problem

    return [Problem.generate(family) for family in FAMILIES]


def assert_solves(
    solver: Solver,
    on: Iterable[Problem] | None = None,
    *,
    tolerance: float = 1e-8,
    max_iterations: int = 100_000,
) -> None:
    """Assert that a solver solves every problem; the AssertionError names the problems that it does not solve.

    Parameters
    ----------
    solver : str or callable
        A solver as in :func:`lcplab.solve`.
    on : iterable of Problem, optional
        The problems. The default is those of :func:`problems`.
    """
    from lcplab import solve

    failures = []
    for problem in problems() if on is None else on:
        result = solve(problem, solver=solver, tolerance=tolerance, max_iterations=max_iterations)
        if result.status != "solved" or not result:
            where = "" if result.row is None else f", scaled residual {result.amount:.1e} in row {result.row}"
            failures.append(f"{problem.name or 'problem'}: {result.message}; {result.verdict}{where}")
    if failures:
        raise AssertionError("\n".join(failures))


def assert_no_false_claims(
    solver: Solver,
    *,
    evaluations: int = 2000,
    seed: int = 1,
    tolerance: float = 1e-8,
    max_iterations: int = 2000,
    friction: bool = False,
    model: str | None = None,
) -> None:
    """Assert that :func:`lcplab.hunt` finds no false claim; the AssertionError shows the smallest problem with one.

    The assertion also fails if the solver solves none of the problems.

    Parameters
    ----------
    solver : str or callable
        A solver as in :func:`lcplab.solve`.
    evaluations : int
        The number of problems to try. The same seed and number try the same problems.
    tolerance : float
        The largest scaled residual of an accepted answer; use 1e-5 for single precision.
    friction : bool
        Whether to try the same number of problems with friction as well: contacts with a normal and two tangents each.
    model : str, optional
        The friction model, such as ``"coulomb-cone"``. If it is given, all problems have friction.

    Examples
    --------
    >>> from lcplab.testing import assert_no_false_claims
    >>> assert_no_false_claims("dantzig", evaluations=200, friction=True)
    >>> assert_no_false_claims("cone-pgs", evaluations=200, model="coulomb-cone")
    """
    from lcplab._hunt import Finding, search
    from lcplab._solve import settings

    kinds = ["only"] if model is not None else ["never", "only"] if friction else ["never"]
    for kind in kinds:
        reported = search(
            solver,
            "false-claim",
            (1, 6),
            evaluations=evaluations,
            seed=seed,
            within="definite",
            friction=kind,
            model=model,
            settings=settings(tolerance, max_iterations),
        )
        if "problem" in reported:
            raise AssertionError(str(Finding(reported)))
        if reported["useless"]:
            raise AssertionError(reported["useless"])
