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


def assert_honest(
    solver: Solver,
    *,
    evaluations: int = 2000,
    seed: int = 1,
    tolerance: float = 1e-8,
    max_iterations: int = 2000,
    friction: bool = False,
    model: str | None = None,
) -> None:
    """Raise an AssertionError with the smallest problem on which a solver claims what is not true, if one is found.

    A solver that solves none of the problems fails too: one that always raises makes no false claim either.

    Parameters
    ----------
    solver : str or callable
        As in :func:`lcplab.solve`.
    evaluations : int
        How many problems are tried. The same seed and number try the same.
    tolerance : float
        The largest scaled residual that counts as solved; 1e-5 suits single precision.
    friction : bool
        Problems with friction as well, as many again: contacts with a normal and two tangents each.
    model : str, optional
        The friction model of those problems, such as ``"coulomb-cone"``; then all of them have friction.

    Examples
    --------
    >>> from lcplab.testing import assert_honest
    >>> assert_honest("dantzig", evaluations=200, friction=True)
    >>> assert_honest("cone-pgs", evaluations=200, model="coulomb-cone")
    """
    from lcplab._hunt import Finding, search
    from lcplab._solve import settings

    kinds = ["only"] if model is not None else ["never", "only"] if friction else ["never"]
    for kind in kinds:
        told = search(
            solver,
            "lie",
            (1, 6),
            evaluations=evaluations,
            seed=seed,
            within="definite",
            friction=kind,
            model=model,
            settings=settings(tolerance, max_iterations, None),
        )
        if "problem" in told:
            raise AssertionError(str(Finding(told)))
        if told["useless"]:
            raise AssertionError(told["useless"])
