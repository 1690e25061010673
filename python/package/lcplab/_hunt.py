"""The smallest problem on which a solver is wrong."""

from __future__ import annotations

import warnings
from typing import Any

from lcplab import _lcplab
from lcplab._problem import Array, Problem, named
from lcplab._solve import Solver, settings


class Finding:
    """The smallest problem that was found.

    Attributes
    ----------
    problem : Problem
        Under its friction model, with its exact solutions where they can be found.
    words : str
        What happens on it.
    x : (n,) ndarray or None
        The solver's own answer; None where it gave none.
    right_x : (n,) ndarray or None
        A right answer, the exact one nearest to ``x`` where that can be found; None where no solution exists.
    value : float
        The measure.
    evaluation : int
        The number of the problem that showed it first.
    """

    def __init__(self, told: dict[str, Any]) -> None:
        self.problem = Problem._of(told["problem"])
        self.words: str = told["words"]
        self.x: Array | None = told["x"]
        self.right_x: Array | None = told["right_x"]
        self.value: float = told["value"]
        self.evaluation: int = told["evaluation"]
        self._equations: str = told["equations"]
        self._answers: str = told["answers"]

    def __str__(self) -> str:
        return f"{self.words}\n\n{self._equations}\n{self._answers}"

    __repr__ = __str__


def hunt(
    solver: Solver,
    measure: str = "lie",
    n: int | tuple[int, int] = (1, 6),
    *,
    rival: Solver | None = None,
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
    """Search for a problem on which a solver is wrong, and make it as small as it can be.

    Parameters
    ----------
    solver : str or callable
        As in :func:`solve`.
    measure : str
        ``"lie"``, ``"failure"``, ``"iterations"``, ``"error"`` or, with a rival, ``"ratio"``.
    n : int or (int, int)
        How many rows.
    evaluations : int
        How many problems are tried. The same seed and number find the same.
    seconds : float, optional
        Stop sooner, after so much time.
    within : str, optional
        The class of the matrices: ``"definite"``, ``"semidefinite"``, ``"p"``, ``"general"`` and others. Every problem
        that is found is in it, in exact arithmetic. Without it ``"definite"``, where each problem has a solution; with
        ``start`` the narrowest class that those problems are in.
    friction : bool
        Only problems with friction: contacts with a normal and two tangents each.
    model : str, optional
        The friction model under which problems are solved and answers judged, as :func:`solve` takes it; without it the one
        that the problems of ``start`` state.
    start : optional, as the problems of :func:`compare`
        Problems to begin with, of any size: what they show is made smaller. A matrix that is semidefinite only up to
        rounding is made exactly definite, with a warning.

    Returns
    -------
    Finding or None
        None also if the solver solved nothing: then a warning says so.

    Notes
    -----
    A function has no status. An x that the judge rejects counts as a false claim only if it is worse than what plain
    projected Gauss-Seidel leaves, in several orders of the rows, from half as many sweeps on: an x that merely did not
    converge is no lie. The number of sweeps is the number of iterates that the function yields; four if it only returns x.

    Examples
    --------
    >>> def clamps_late(A, b, lo, hi, **settings):
    ...     import numpy as np
    ...     return np.clip(np.linalg.lstsq(A, -b, rcond=None)[0], lo, hi)
    >>> found = hunt(clamps_late, n=2, evaluations=2000, within="definite")
    >>> len(found.problem)
    2
    """
    told = search(
        solver,
        measure,
        n,
        rival=rival,
        evaluations=evaluations,
        seconds=seconds,
        seed=seed,
        at_least=at_least,
        within=within,
        friction="only" if friction else "any",
        model=model,
        start=start,
        settings=settings(tolerance, max_iterations, None),
    )
    for note in told["notes"] + ([told["useless"]] if told["useless"] else []):
        warnings.warn(note, stacklevel=2)
    return Finding(told) if "problem" in told else None


def search(
    solver: Solver,
    measure: str,
    n: int | tuple[int, int],
    *,
    settings: dict[str, Any],
    rival: Solver | None = None,
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
    quarry = {
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
    given = [] if start is None else [problem._inner for _, problem in named(start)]
    return _lcplab.hunt(solver, rival, quarry, settings, given)
