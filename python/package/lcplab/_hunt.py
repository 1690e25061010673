"""Search for the smallest problem on which a solver is wrong."""

from __future__ import annotations

import warnings
from typing import Any

from lcplab import _lcplab
from lcplab._problem import Array, Problem, named
from lcplab._solve import Solver, check_signature, settings


class Finding:
    """The smallest problem that :func:`hunt` found.

    Attributes
    ----------
    problem : Problem
        The problem with its friction model, and its exact solutions if they could be found.
    words : str
        What the solver does on this problem.
    x : (n,) ndarray or None
        The solver's answer, or None if it gave none.
    right_x : (n,) ndarray or None
        A correct answer: the exact solution nearest to ``x`` if it could be found. None if no solution exists.
    value : float
        The value of the measure.
    evaluation : int
        The number of the first problem with which the search found the fault.
    """

    def __init__(self, reported: dict[str, Any]) -> None:
        self.problem = Problem._of(reported["problem"])
        self.words: str = reported["words"]
        self.x: Array | None = reported["x"]
        self.right_x: Array | None = reported["right_x"]
        self.value: float = reported["value"]
        self.evaluation: int = reported["evaluation"]
        self._equations: str = reported["equations"]
        self._answers: str = reported["answers"]

    def __str__(self) -> str:
        return f"{self.words}\n\n{self._equations}\n{self._answers}"

    __repr__ = __str__


def hunt(
    solver: Solver,
    measure: str = "false-claim",
    n: int | tuple[int, int] = (1, 6),
    *,
    baseline: Solver | None = None,
    evaluations: int = 20_000,
    seconds: float | None = None,
    seed: int = 1,
    at_least: float | None = None,
    within: str | None = None,
    friction: bool = False,
    model: str | None = None,
    start: Any = None,
    tolerance: float = 1e-8,
    max_iterations: int = 2000,
) -> Finding | None:
    """Search for a problem on which a solver is wrong, and shrink it as far as possible.

    Parameters
    ----------
    solver : str or callable
        A solver as in :func:`solve`.
    measure : str
        What to search for: ``"false-claim"``, ``"failure"``, ``"iterations"``, ``"error"`` or, with a baseline,
        ``"ratio"``. ``docs/hunt.md`` defines them.
    n : int or (int, int)
        The number of rows, or its smallest and largest value.
    baseline : str or callable, optional
        The solver to compare with, for the measure ``"ratio"``.
    evaluations : int
        The number of problems to try. The same seed and number find the same problem.
    seconds : float, optional
        A time limit; the search may end earlier.
    at_least : float, optional
        Keep searching until the measure reaches this value.
    within : str, optional
        The class of the matrices: ``"definite"``, ``"semidefinite"``, ``"p"``, ``"p-or-semidefinite"``, ``"p0"``,
        ``"copositive-plus"`` or ``"general"``. The problem that is found belongs to it exactly. The
        default is ``"definite"``, for which every problem has a solution; with ``start``, it is the narrowest class that
        contains those problems.
    friction : bool
        Whether to try only problems with friction: contacts with a normal and two tangents each.
    model : str, optional
        The friction model for solving and judging, as in :func:`solve`. The default is the model of the problems in
        ``start``.
    start : optional, as the problems of :func:`compare`
        Problems to start from, of any size; the search shrinks them. A matrix that is semidefinite only up to
        rounding is made exactly definite, with a warning.

    Raises
    ------
    TypeError
        If the solver is a function that cannot be called with A, b, lo, hi and the keywords of :func:`solve`.

    Returns
    -------
    Finding or None
        None if nothing was found. If this is because the solver solved no problem at all, a warning says so.

    Notes
    -----
    A function returns no status, so its x may be the last iterate of a solver that ran out of sweeps. Therefore an x that
    the judge rejects counts as a false claim only if its residual is more than twice that of plain projected Gauss-Seidel
    in each of seven orders of the rows, at all sweeps from k/2 to k. k is the number of iterates that the function
    yields, or four if it only returns x.

    Examples
    --------
    >>> def clamps_late(A, b, lo, hi, **settings):
    ...     import numpy as np
    ...     return np.clip(np.linalg.lstsq(A, -b, rcond=None)[0], lo, hi)
    >>> found = hunt(clamps_late, n=2, evaluations=2000, within="definite")
    >>> len(found.problem)
    2
    """
    reported = search(
        solver,
        measure,
        n,
        baseline=baseline,
        evaluations=evaluations,
        seconds=seconds,
        seed=seed,
        at_least=at_least,
        within=within,
        friction="only" if friction else "any",
        model=model,
        start=start,
        settings=settings(tolerance, max_iterations),
    )
    for note in reported["notes"] + ([reported["useless"]] if reported["useless"] else []):
        warnings.warn(note, stacklevel=2)
    return Finding(reported) if "problem" in reported else None


def search(
    solver: Solver,
    measure: str,
    n: int | tuple[int, int],
    *,
    settings: dict[str, Any],
    baseline: Solver | None = None,
    evaluations: int = 20_000,
    seconds: float | None = None,
    seed: int = 1,
    at_least: float | None = None,
    within: str | None = None,
    friction: str = "any",
    model: str | None = None,
    start: Any = None,
) -> dict[str, Any]:
    """What a search finds, with the number of problems that the solver solved. Friction: ``any``, ``only`` or ``never``."""
    search = {
        "measure": measure,
        "rows": (n, n) if isinstance(n, int) else tuple(n),
        "evaluations": evaluations,
        "seed": seed,
        "at_least": at_least,
        "within": within,
        "model": model,
        "seconds": seconds,
        "friction": friction,
    }
    for function in (solver, baseline):
        check_signature(function, has_friction=friction != "never")
    given = [] if start is None else [problem._inner for _, problem in named(start)]
    return _lcplab.hunt(solver, baseline, search, settings, given)
