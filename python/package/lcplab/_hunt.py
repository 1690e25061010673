"""The smallest problem on which a solver is wrong."""

from __future__ import annotations

from typing import Any

from lcplab import _lcplab
from lcplab._problem import Problem, named
from lcplab._solve import Solver, settings


class Finding:
    """The smallest problem that was found.

    Attributes
    ----------
    problem : Problem
        With its exact solutions.
    words : str
        What happens on it.
    value : float
        The measure.
    evaluation : int
        The number of the problem that showed it first.
    """

    def __init__(self, told: dict[str, Any]) -> None:
        self.problem = Problem._of(told["problem"])
        self.words: str = told["words"]
        self.value: float = told["value"]
        self.evaluation: int = told["evaluation"]
        self._equations: str = told["equations"]

    def __str__(self) -> str:
        return f"{self.words}\n\n{self._equations}"

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
    within: str = "general",
    friction: bool = False,
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
    within : str
        The class of the matrices: ``"definite"``, ``"semidefinite"``, ``"p"``, ``"general"`` and others.
    friction : bool
        Only problems with friction.
    start : optional, as the problems of :func:`compare`
        Problems to begin with, of any size: what they show is made smaller.

    Returns
    -------
    Finding or None

    Examples
    --------
    >>> def clamps_late(A, b, lo, hi, **settings):
    ...     import numpy as np
    ...     return np.clip(np.linalg.lstsq(A, -b, rcond=None)[0], lo, hi)
    >>> found = hunt(clamps_late, n=2, evaluations=2000, within="definite")
    >>> len(found.problem)
    2
    """
    rows = (n, n) if isinstance(n, int) else tuple(n)
    quarry = {
        "measure": measure,
        "rows": rows,
        "evaluations": evaluations,
        "seed": seed,
        "at_least": at_least,
        "within": within,
        "seconds": seconds,
        "with_friction": friction,
    }
    given = [] if start is None else [problem._inner for _, problem in named(start)]
    told = _lcplab.hunt(solver, rival, quarry, settings(tolerance, max_iterations, None), given)
    return Finding(told) if "problem" in told else None
