"""Solve, judge and explain one problem."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike

from lcplab import _lcplab
from lcplab._problem import Array, Problem, problem_of, read_only, vector

#: A name that :func:`solvers` lists, or a function of ``A, b, lo, hi`` and keywords.
Solver = Union[str, Callable[..., Any]]


class Verdict:
    """The judge's word on an x; true if x is a solution.

    Attributes
    ----------
    verdict : str
        ``"proved"``, ``"within_tolerance"`` or ``"not_a_solution"``.
    row, amount : int and float, or None
        The worst row of an x that is refused, and by how much of its terms it misses.
    proof : dict or None
        What else was shown in exact arithmetic.
    contacts : list of dict or None
        Of a problem under a model of friction: ``impulse``, ``velocity``, ``strength`` (``|x_t| / (mu x_n)``) and
        ``misalignment`` (degrees) of each contact.
    """

    def __init__(self, is_solution: bool, certificate: dict[str, Any]) -> None:
        self._is_solution = is_solution
        self.certificate = certificate
        self.verdict: str = certificate["verdict"]
        self.row: int | None = certificate.get("row")
        amount = certificate.get("amount")
        self.amount: float | None = None if amount is None else float(amount)
        self.residual = float(certificate["scaled_residual"])
        self.proof: dict[str, Any] | None = certificate.get("certificate")
        self.contacts: list[dict[str, Any]] | None = certificate.get("contacts")

    def __bool__(self) -> bool:
        return self._is_solution

    def __repr__(self) -> str:
        where = "" if self.row is None else f", row {self.row} misses by {self.amount:.1e} of its terms"
        return f"<lcplab.Verdict {self.verdict}{where}>"


class Result(Verdict):
    """A solver's answer and the judge's word on it; true if x is a solution.

    Attributes
    ----------
    status : str
        What the solver says: ``"solved"``, ``"infeasible"``, ``"iteration_limit"`` or ``"failed"``.
    message : str
        The same in words.
    solver : str
    iterations : int
    trace : dict of arrays or None
        By iteration, the residuals and the objective, if they were asked for.
    """

    def __init__(self, told: dict[str, Any]) -> None:
        super().__init__(told["is_solution"], json.loads(told["certificate"]))
        self._x, self._w = read_only(told["x"]), read_only(told["w"])
        self.status: str = told["status"]
        self.message: str = told["message"]
        self.solver: str = told["solver"]
        self.iterations: int = told["iterations"]
        trace: dict[str, Array] | None = told.get("trace")
        self.trace = None if trace is None else {name: read_only(column) for name, column in trace.items()}

    @property
    def x(self) -> Array:
        """The answer, read-only, since the verdict is about it; ``x.copy()`` can be changed."""
        return self._x

    @property
    def w(self) -> Array:
        """``A x + b``, read-only."""
        return self._w

    def __repr__(self) -> str:
        return (
            f"<lcplab.Result {self.status} by {self.solver} in {self.iterations} iterations, "
            f"{self.verdict}: x = {np.array2string(self.x, precision=4, threshold=8)}>"
        )


def solve(
    A: ArrayLike | Problem,
    b: ArrayLike | None = None,
    lo: ArrayLike | None = None,
    hi: ArrayLike | None = None,
    *,
    friction_index: ArrayLike | None = None,
    mu: ArrayLike | None = None,
    solver: Solver | None = None,
    tolerance: float = 1e-8,
    max_iterations: int = 10_000,
    omega: float | None = None,
    model: str | None = None,
    prove: bool | None = None,
    trace: bool = False,
) -> Result:
    """Solve a problem and have the answer judged.

    Parameters
    ----------
    A, b, lo, hi, friction_index, mu
        The problem, as :class:`Problem` takes it; or ``A`` is a :class:`Problem`.
    solver : str or callable, optional
        A name that :func:`solvers` lists, or a function ``f(A, b, lo, hi, **settings)`` that returns x, yields
        iterates, or returns None; without it the methods of ``docs/solvers.md`` in turn, until one solves the problem.
        Under a friction cone the function needs a parameter named ``model``.
    tolerance : float
        The largest scaled residual that counts as solved.
    omega : float, optional
        The relaxation of ``"sor"`` and its kin.
    model : str, optional
        The model of friction: ``"coupled-box"``, ``"frozen-box"``, ``"polygon-4"``, ``"polygon-8"``, ``"polygon-16"``,
        ``"associated-cone"`` or ``"coulomb-cone"``; without it the problem's own, or bounds ``±mu * x[k]`` on each row.
    prove : bool, optional
        Whether the judge looks for a proof in exact arithmetic: of up to 150 rows if true, of none if false, of up to
        50 without it.
    trace : bool
        Keep the residuals of every iterate.

    Returns
    -------
    Result

    Raises
    ------
    InputError
        With every defect of the input.

    Examples
    --------
    >>> r = solve([[2, -1], [-1, 2]], [-1, 2], solver="lemke")
    >>> bool(r), r.status, r.x.tolist()
    (True, 'solved', [0.5, 0.0])
    """
    problem = problem_of(A, b, lo, hi, friction_index, mu)
    given = settings(tolerance, max_iterations, omega)
    return Result(_lcplab.solve(problem._inner, solver, given, model, prove, trace))


def judge(
    A: ArrayLike | Problem,
    b: ArrayLike | None = None,
    x: ArrayLike | None = None,
    *,
    lo: ArrayLike | None = None,
    hi: ArrayLike | None = None,
    friction_index: ArrayLike | None = None,
    mu: ArrayLike | None = None,
    model: str | None = None,
    tolerance: float = 1e-8,
) -> Verdict:
    """Whether x is a solution, whoever found it; of a problem with friction under a model, as :func:`solve` takes it.

    Examples
    --------
    >>> bool(judge([[2, -1], [-1, 2]], [-1, 2], [0.5, 0]))
    True
    >>> judge([[2, -1], [-1, 2]], [-1, 2], [0.4, 0])
    <lcplab.Verdict not_a_solution, row 0 misses by 1.1e-01 of its terms>
    """
    if x is None:
        raise TypeError("judge needs x")
    problem = problem_of(A, b, lo, hi, friction_index, mu)
    is_solution, told = _lcplab.judge(problem._inner, vector(x, "x"), tolerance, model)
    return Verdict(is_solution, json.loads(told))


class Document:
    """A derivation: text when it is printed, a page in a notebook.

    Attributes
    ----------
    text, markdown, html : str
    """

    def __init__(self, text: str, markdown: str, html: str) -> None:
        self.text = text
        self.markdown = markdown
        self.html = html

    def __str__(self) -> str:
        return self.text

    def _repr_markdown_(self) -> str:
        return self.markdown


def explain(
    A: ArrayLike | Problem,
    b: ArrayLike | None = None,
    lo: ArrayLike | None = None,
    hi: ArrayLike | None = None,
    *,
    friction_index: ArrayLike | None = None,
    mu: ArrayLike | None = None,
    solver: str | None = None,
    omega: float | None = None,
    model: str | None = None,
) -> Document:
    """The way from A and b to x, line by line, by ``"pgs"``, ``"sor"``, ``"dantzig"`` or ``"lemke"``.

    ``model`` is the friction model, as :func:`solve` takes it; of cones the answer is judged, and the solver followed on
    the coupled box beside them.

    Examples
    --------
    >>> "tableau" in str(explain([[2, 1], [1, 2]], [-5, -6], solver="lemke")).lower()
    True
    """
    problem = problem_of(A, b, lo, hi, friction_index, mu)
    return Document(*_lcplab.explain(problem._inner, solver, settings(1e-8, 10_000, omega), model))


def solvers() -> list[str]:
    """The names of the solvers.

    Examples
    --------
    >>> "dantzig" in solvers()
    True
    """
    return [name for name, _, _ in _lcplab.solvers()]


def settings(tolerance: float, max_iterations: int, omega: float | None) -> dict[str, Any]:
    return {"tolerance": tolerance, "max_iterations": max_iterations, "omega": omega}
