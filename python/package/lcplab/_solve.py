"""Solve, judge and explain one problem."""

from __future__ import annotations

import inspect
import json
import operator
import os
from collections.abc import Callable, Iterable
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike

from lcplab import _lcplab
from lcplab._problem import Array, Problem, ProblemLike, answer, problem_of, read_only

#: A name that :func:`solvers` lists, or a function of ``A, b, lo, hi`` and keywords.
Solver = Union[str, Callable[..., Any]]


class Verdict:
    """The judge's decision about x; true if x is a solution. ``print`` shows what the command ``judge`` prints.

    Attributes
    ----------
    verdict : str
        ``"proved"``, ``"within_tolerance"`` or ``"not_a_solution"``.
    residual : float
        The largest scaled residual of a row.
    certificate : dict
        The object that ``lcplab judge --json`` prints: residuals, gaps and bounds of the error.
    row, amount : int and float, or None
        If x is rejected, the row with the largest scaled residual, and that residual.
    proof : dict or None
        Further statements proved in exact arithmetic, such as that no solution exists.
    contacts : list of dict or None
        For problems with a friction model: ``impulse``, ``velocity``, ``strength`` (``|x_t| / (mu x_n)``) and
        ``misalignment`` (degrees) of each contact.
    """

    def __init__(self, is_solution: bool, certificate: dict[str, Any], asked: tuple[Any, ...] | None = None) -> None:
        self._is_solution = is_solution
        self._asked = asked
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

    def __str__(self) -> str:
        return repr(self) if self._asked is None else _lcplab.judge_text(*self._asked).rstrip("\n")

    def __getstate__(self) -> dict[str, Any]:
        # A problem cannot be pickled.
        return {**self.__dict__, "_asked": None}

    def __repr__(self) -> str:
        where = "" if self.row is None else f", scaled residual {self.amount:.1e} in row {self.row}"
        return f"<lcplab.Verdict {self.verdict}{where}>"


class Result(Verdict):
    """A solver's answer and the judge's verdict on it, with all attributes of a `Verdict`; true if x is a solution.

    ``print`` shows the solver, its status and the verdict.

    Attributes
    ----------
    status : str
        The solver's own claim: ``"solved"``, ``"infeasible"``, ``"iteration_limit"`` or ``"failed"``.
    message : str
        The status as a sentence.
    solver : str
        The name of the solver that returned x.
    iterations : int
        The number of its iterations.
    trace : dict of arrays or None
        With ``trace=True``, the residuals and the objective after each iteration.
    """

    def __init__(self, reported: dict[str, Any], asked: tuple[Any, ...] | None = None) -> None:
        super().__init__(reported["is_solution"], json.loads(reported["certificate"]), asked)
        self._x, self._w = read_only(reported["x"]), read_only(reported["w"])
        self.status: str = reported["status"]
        self.message: str = reported["message"]
        self.solver: str = reported["solver"]
        self.iterations: int = reported["iterations"]
        trace: dict[str, Array] | None = reported.get("trace")
        self.trace = None if trace is None else {name: read_only(column) for name, column in trace.items()}

    @property
    def x(self) -> Array:
        """The answer; read-only, because the verdict is about it. Use ``x.copy()`` for an array that you can change."""
        return self._x

    @property
    def w(self) -> Array:
        """``A x + b``; read-only."""
        return self._w

    def __str__(self) -> str:
        if self._asked is None:
            return repr(self)
        title, _, verdict = super().__str__().partition("\n")
        iterations = f"{self.iterations} iteration{'s' if self.iterations != 1 else ''}"
        return f"{title}\nsolver     {self.solver}\nstatus     {self.message}, {iterations}\n{verdict}"

    def __repr__(self) -> str:
        if self.status == "failed":
            return f"<lcplab.Result failed by {self.solver}: {self.message}>"
        return (
            f"<lcplab.Result {self.status} by {self.solver}, iterations: {self.iterations}, "
            f"{self.verdict}: x = {np.array2string(self.x, precision=4, threshold=8)}>"
        )


def solve(
    A: ArrayLike | ProblemLike,
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
    """Solve a problem and judge the answer.

    Parameters
    ----------
    A, b, lo, hi, friction_index, mu
        The problem, with the arguments of :class:`Problem`; or ``A`` is a :class:`Problem`, the path of a problem file, or
        a tuple ``(A, b)`` or ``(A, b, lo, hi)``.
    solver : str or callable, optional
        A name that :func:`solvers` lists, or a function ``f(A, b, lo, hi, **settings)`` that returns x, yields
        iterates, or returns None. By default, lcplab tries the methods of ``docs/solvers.md`` in turn until one solves the
        problem. For friction cones the function needs a parameter named ``model``.
    tolerance : float
        The largest scaled residual of an accepted answer.
    max_iterations : int
        The largest number of sweeps, pivots or other iterations.
    omega : float, optional
        The relaxation factor of ``"sor"`` and ``"ssor"``.
    model : str, optional
        The friction model, such as ``"coupled-box"`` or ``"coulomb-cone"``; ``docs/solvers.md`` lists them. The default is
        the model of the problem, or else bounds ``±mu * x[k]`` on each friction row.
    prove : bool, optional
        Whether the judge searches for a proof in exact arithmetic. True: up to 150 rows; None: up to 50; False: never.
    trace : bool
        Whether to record the residuals of every iterate.

    Returns
    -------
    Result

    Raises
    ------
    InputError
        If the input is invalid; the message lists every defect.
    TypeError
        If the solver is a function that cannot be called with A, b, lo, hi and the keywords.

    Examples
    --------
    >>> r = solve([[2, -1], [-1, 2]], [-1, 2], solver="lemke")
    >>> bool(r), r.status, r.x.tolist()
    (True, 'solved', [0.5, 0.0])
    """
    problem = problem_of(A, b, lo, hi, friction_index, mu)
    given = settings(tolerance, max_iterations, omega, [solver])
    check_signature(solver, has_friction=problem.friction_index is not None)
    reported = _lcplab.solve(problem._inner, solver, given, model, prove, trace)
    return Result(reported, (problem._inner, reported["x"], given["tolerance"], model))


def judge(
    A: ArrayLike | ProblemLike,
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
    """Decide whether x is a solution, without knowing which program found it.

    Parameters
    ----------
    A, b, lo, hi, friction_index, mu
        The problem, as in :func:`solve`. With a whole problem as ``A``, x is the second argument: ``judge(problem, x)``.
    x : (n,) array_like or Result
        The answer.
    model : str, optional
        The friction model, as in :func:`solve`.
    tolerance : float
        The largest scaled residual of an accepted answer.

    Returns
    -------
    Verdict
        True if x is a solution.

    Raises
    ------
    InputError
        If the problem is invalid, or x is not a list of n numbers. Numbers that are not finite are a rejected answer.

    Examples
    --------
    >>> bool(judge([[2, -1], [-1, 2]], [-1, 2], [0.5, 0]))
    True
    >>> problem = Problem([[2, -1], [-1, 2]], [-1, 2])
    >>> judge(problem, [0.4, 0])
    <lcplab.Verdict not_a_solution, scaled residual 1.1e-01 in row 0>
    """
    is_whole = isinstance(A, (Problem, str, os.PathLike)) or (isinstance(A, tuple) and 2 <= len(A) <= 4)
    if x is None and b is not None and is_whole:
        b, x = None, b
    if x is None:
        raise TypeError("judge needs x: judge(problem, x) or judge(A, b, x)")
    problem = problem_of(A, b, lo, hi, friction_index, mu)
    asked = (problem._inner, answer(x, len(problem)), _number(tolerance, "tolerance"), model)
    is_solution, reported = _lcplab.judge(*asked)
    return Verdict(is_solution, json.loads(reported), asked)


class Document:
    """A derivation. ``print`` shows it as text, a notebook as a page.

    Attributes
    ----------
    text, markdown, html : str
        The same document in three formats.
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
    A: ArrayLike | ProblemLike,
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
    """Derive x from A and b line by line, by ``"pgs"``, ``"sor"``, ``"dantzig"`` or ``"lemke"``.

    ``model`` is the friction model, as in :func:`solve`. For friction cones, the document has the judged answer and the
    steps of the solver on the coupled box with the same coefficients.

    Examples
    --------
    >>> "tableau" in str(explain([[2, 1], [1, 2]], [-5, -6], solver="lemke")).lower()
    True
    """
    problem = problem_of(A, b, lo, hi, friction_index, mu)
    return Document(*_lcplab.explain(problem._inner, solver, settings(1e-8, 10_000, omega, [solver]), model))


def solvers() -> list[str]:
    """Return the names of the built-in solvers.

    Examples
    --------
    >>> "dantzig" in solvers()
    True
    """
    return [name for name, _, _ in _lcplab.solvers()]


def settings(
    tolerance: float, max_iterations: int, omega: float | None = None, solvers: Iterable[Any] = ()
) -> dict[str, Any]:
    """The settings of a solver; `omega` must be used by one of these solvers."""
    if omega is not None and not any(solver in ("sor", "ssor") for solver in solvers):
        raise _lcplab.InputError("options: omega: is used by no chosen solver; sor and ssor use it")
    try:
        most = operator.index(max_iterations)
    except TypeError:
        raise _lcplab.InputError(f"options: max_iterations: must be a whole number, is {max_iterations!r}") from None
    if most < 0:
        raise _lcplab.InputError(f"options: max_iterations: must be at least 0, is {most}")
    factor = None if omega is None else _number(omega, "omega")
    return {"tolerance": _number(tolerance, "tolerance"), "max_iterations": most, "omega": factor}


def _number(value: Any, name: str) -> float:
    if isinstance(value, (str, bytes)) or not hasattr(value, "__float__"):
        raise _lcplab.InputError(f"options: {name}: must be a number, is {value!r}")
    return float(value)


def check_signature(solver: Solver | None, *, has_friction: bool) -> None:
    """Reject a function that cannot be called with the arguments of a solver, which would fail on every problem.

    Raises
    ------
    TypeError
        If ``f(A, b, lo, hi, tolerance=, max_iterations=)`` is no valid call, with ``friction_index=`` and ``mu=`` for
        problems with friction.
    """
    if solver is None or not callable(solver):
        return
    try:
        signature = inspect.signature(solver)
    except ValueError:  # a function in C may have no signature
        return
    names = ["tolerance", "max_iterations", *(["friction_index", "mu"] if has_friction else [])]
    try:
        signature.bind(*[None] * 4, **dict.fromkeys(names))
    except TypeError as error:
        name = getattr(solver, "__name__", "the solver")
        call = f"{name}(A, b, lo, hi, {', '.join(f'{name}=' for name in names)})"
        raise TypeError(f"solver: {call} is no valid call: {error}; a parameter **settings takes all keywords") from error
