"""What the package offers; see ``help(lcplab)``."""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from fractions import Fraction
from html import escape
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lcplab import _lcplab

Array = NDArray[np.float64]
#: A name that :func:`solvers` lists, or a function of ``A, b, lo, hi`` and keywords.
Solver = Union[str, Callable[..., Any]]

PROVED_ROWS = 50
EXACT_ROWS = 150


class Problem:
    """A boxed linear complementarity problem.

    Parameters
    ----------
    A : (n, n) array_like or SciPy sparse array
        The matrix.
    b : (n,) array_like
        The offset of ``w = A x + b``.
    lo, hi : (n,) array_like or float, optional
        Bounds; 0 and infinity without them, and none for rows of friction.
    friction_index : (n,) array_like of int, optional
        Row ``i`` with ``k = friction_index[i] >= 0`` is bounded by ``±mu[i] * max(x[k], 0)``; -1 for the others.
    mu : (n,) array_like, optional
        Coefficients of friction.
    name : str, optional
        What it is called.

    Raises
    ------
    InputError
        With every defect.

    Examples
    --------
    >>> p = Problem([[2, -1], [-1, 2]], [-1, 2])
    >>> len(p), p.hi.tolist()
    (2, [inf, inf])
    """

    def __init__(
        self,
        A: ArrayLike,
        b: ArrayLike,
        lo: ArrayLike | None = None,
        hi: ArrayLike | None = None,
        *,
        friction_index: ArrayLike | None = None,
        mu: ArrayLike | None = None,
        model: str | None = None,
        scale: float | None = None,
        name: str = "",
    ) -> None:
        right = _vector(b)
        self._inner = _lcplab.Problem.of(
            _entries(A),
            {
                "b": right,
                "lo": _bound(lo, len(right)),
                "hi": _bound(hi, len(right)),
                "friction_index": None
                if friction_index is None
                else np.ascontiguousarray(friction_index, dtype=np.int64),
                "mu": None if mu is None else _vector(mu),
                "model": model,
                "scale": scale,
                "name": name,
            },
        )

    @classmethod
    def _of(cls, inner: _lcplab.Problem) -> Problem:
        problem = cls.__new__(cls)
        problem._inner = inner
        return problem

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Problem:
        """Read a file of any format that ``lcplab convert --list`` names."""
        return cls._of(_lcplab.Problem.read(path))

    @classmethod
    def generate(cls, family: str, **values: float) -> Problem:
        """Make a problem of the library.

        Examples
        --------
        >>> Problem.generate("murty", n=3).solutions
        [[Fraction(0, 1), Fraction(0, 1), Fraction(1, 1)]]
        """
        return cls._of(_lcplab.Problem.generate(family, [(k, float(v)) for k, v in values.items()]))

    def write(self, path: str | os.PathLike[str]) -> list[str]:
        """Write a file in the format of its ending; what its reader should know is returned."""
        return self._inner.write(path)

    def to_json(self) -> dict[str, Any]:
        """The problem as the object of a problem file."""
        told: dict[str, Any] = json.loads(self._inner.json())
        return told

    @property
    def A(self) -> Array:
        """The matrix, dense."""
        return self._inner.a

    def triplets(self) -> tuple[NDArray[np.int64], NDArray[np.int64], Array]:
        """Rows, columns and values of the stored entries of A."""
        return self._inner.triplets()

    @property
    def b(self) -> Array:
        """The offset."""
        return self._inner.b

    @property
    def lo(self) -> Array:
        """The lower bounds."""
        return self._inner.lo

    @property
    def hi(self) -> Array:
        """The upper bounds."""
        return self._inner.hi

    @property
    def friction_index(self) -> NDArray[np.int64] | None:
        """The row that bounds each row, -1 for none."""
        return self._inner.friction_index

    @property
    def mu(self) -> Array | None:
        """The coefficients of friction."""
        return self._inner.mu

    @property
    def name(self) -> str:
        """What it is called."""
        return self._inner.name

    @property
    def card(self) -> dict[str, Any]:
        """Size, class, rank and condition."""
        told: dict[str, Any] = json.loads(self._inner.card())
        return told

    @property
    def solutions(self) -> list[list[Fraction]] | None:
        """The exact solutions that are known, if any; an empty list says that there is none."""
        text = self._inner.expected()
        if text is None:
            return None
        known = json.loads(text)
        return [
            [Fraction(int(p), int(s["denominator"])) for p in s["numerators"]]
            for s in known["solutions"]
        ]

    def __len__(self) -> int:
        return len(self._inner)

    def __repr__(self) -> str:
        return f"<lcplab.Problem {self.name!r}: {len(self)} rows>"


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

    def __bool__(self) -> bool:
        return self._is_solution

    def __repr__(self) -> str:
        where = "" if self.row is None else f", row {self.row} misses by {self.amount:.1e} of its terms"
        return f"<lcplab.Verdict {self.verdict}{where}>"


class Result(Verdict):
    """A solver's answer and the judge's word on it; true if x is a solution.

    Attributes
    ----------
    x, w : (n,) ndarray
        The answer, and ``A x + b``.
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
        self.x: Array = told["x"]
        self.w: Array = told["w"]
        self.status: str = told["status"]
        self.message: str = told["message"]
        self.solver: str = told["solver"]
        self.iterations: int = told["iterations"]
        self.trace: dict[str, Array] | None = told.get("trace")

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
    exact: bool = False,
    trace: bool = False,
) -> Result:
    """Solve a problem and have the answer judged.

    Parameters
    ----------
    A, b, lo, hi, friction_index, mu
        The problem, as :class:`Problem` takes it; or ``A`` is a :class:`Problem`.
    solver : str or callable, optional
        A name that :func:`solvers` lists, or a function ``f(A, b, lo, hi, **settings)`` that returns x, yields
        iterates, or returns None; without it Dantzig's method, or Lemke's where A is not symmetric.
    tolerance : float
        The largest scaled residual that counts as solved.
    omega : float, optional
        The relaxation of ``"sor"`` and its kin.
    exact : bool
        Prove up to 150 rows in exact arithmetic, not only up to 50.
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
    problem = _problem(A, b, lo, hi, friction_index, mu)
    given = _given(tolerance, max_iterations, omega)
    rows = EXACT_ROWS if exact else PROVED_ROWS
    return Result(_lcplab.solve(problem._inner, solver, given, rows, trace))


def judge(
    A: ArrayLike | Problem,
    b: ArrayLike | None = None,
    x: ArrayLike | None = None,
    *,
    lo: ArrayLike | None = None,
    hi: ArrayLike | None = None,
    friction_index: ArrayLike | None = None,
    mu: ArrayLike | None = None,
    tolerance: float = 1e-8,
) -> Verdict:
    """Whether x is a solution, whoever found it.

    Examples
    --------
    >>> bool(judge([[2, -1], [-1, 2]], [-1, 2], [0.5, 0]))
    True
    >>> judge([[2, -1], [-1, 2]], [-1, 2], [0.4, 0])
    <lcplab.Verdict not_a_solution, row 0 misses by 1.1e-01 of its terms>
    """
    if x is None:
        raise TypeError("judge needs x")
    problem = _problem(A, b, lo, hi, friction_index, mu)
    is_solution, told = _lcplab.judge(problem._inner, _vector(x), tolerance, EXACT_ROWS)
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
) -> Document:
    """The way from A and b to x, line by line, by ``"pgs"``, ``"sor"``, ``"dantzig"`` or ``"lemke"``.

    Examples
    --------
    >>> "tableau" in str(explain([[2, 1], [1, 2]], [-5, -6], solver="lemke")).lower()
    True
    """
    problem = _problem(A, b, lo, hi, friction_index, mu)
    return Document(*_lcplab.explain(problem._inner, solver, _given(1e-8, 10_000, omega)))


class Comparison:
    """Solvers beside each other on problems: a row for each pair.

    Attributes
    ----------
    rows : list of dict
        With the keys ``family`` (the problem), ``model``, ``solver``, ``claimed``, ``accepted``, ``proved``,
        ``refuted_claims``, ``iterations``, ``worst_residual``, ``seconds``, ``trouble`` and others.
    """

    _COLUMNS = ("family", "model", "solver", "claimed", "accepted", "proved", "iterations", "seconds", "trouble")

    def __init__(self, rows: list[dict[str, Any]], text: str) -> None:
        self.rows = rows
        self._text = text

    def __str__(self) -> str:
        return self._text

    __repr__ = __str__

    def to_csv(self, path: str | os.PathLike[str] | None = None) -> str:
        """All rows as CSV, written to a file if one is named."""
        out = io.StringIO()
        writer = csv.DictWriter(out, list(self.rows[0]) if self.rows else [], lineterminator="\n")
        writer.writeheader()
        writer.writerows(self.rows)
        if path is not None:
            with open(path, "w", encoding="utf-8", newline="") as file:
                file.write(out.getvalue())
        return out.getvalue()

    def profile(self) -> dict[str, tuple[Array, Array]]:
        """Dolan & Moré's performance profile of the times: by solver, (tau, share of the problems solved)."""
        problems: dict[tuple[Any, Any], dict[str, float]] = {}
        names: list[str] = []
        for row in self.rows:
            names += [row["solver"]] if row["solver"] not in names else []
            solved = row["accepted"] == row["claimed"] == row["problems"] and row["problems"] > 0
            cost = max(row["seconds"], 1e-9) if solved else np.inf
            problems.setdefault((row["family"], row["model"]), {})[row["solver"]] = cost
        best = {key: min(costs.values()) for key, costs in problems.items()}
        solvable = [key for key in problems if np.isfinite(best[key])]
        curves = {}
        for name in names:
            ratios = np.sort([problems[key].get(name, np.inf) / best[key] for key in solvable])
            ratios = ratios[np.isfinite(ratios)]
            share = np.arange(1, len(ratios) + 1) / max(len(solvable), 1)
            curves[name] = (ratios, share)
        return curves

    def plot(self, ax: Any = None) -> Any:
        """Draw the performance profile with matplotlib; returns the axes."""
        import matplotlib.pyplot as plt

        if ax is None:
            _, ax = plt.subplots()
        curves = self.profile()
        end = 2 * max((ratios[-1] for ratios, _ in curves.values() if len(ratios)), default=1.0)
        for name, (ratios, share) in curves.items():
            tau, rho = np.append(ratios, end), np.append(share, share[-1] if len(share) else 0.0)
            ax.step(tau, rho, where="post", label=name)
        ax.set(xscale="log", ylim=(0, 1.02), xlabel="τ: at most so many times the fastest", ylabel="share solved")
        ax.legend()
        return ax

    def _repr_html_(self) -> str:
        def cell(value: Any) -> str:
            shown = "" if value is None else f"{value:.3g}" if isinstance(value, float) else str(value)
            return f"<td>{escape(shown)}</td>"

        head = "".join(f"<th>{name}</th>" for name in self._COLUMNS)
        body = "".join(
            "<tr>" + "".join(cell(row.get(name)) for name in self._COLUMNS) + "</tr>" for row in self.rows
        )
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


#: One solver of each kind, for comparisons.
USUAL = ("pgs", "newton", "apgd", "interior-point", "dantzig", "lemke")


def compare(
    problems: Any,
    solvers: Iterable[Solver] = USUAL,
    *,
    models: Sequence[str] = (),
    tolerance: float = 1e-8,
    max_iterations: int = 10_000,
    omega: float | None = None,
) -> Comparison:
    """Solve every problem by every solver, each answer judged.

    Parameters
    ----------
    problems : Problem, str, tuple, or an iterable or mapping of them
        Problems, names of files, ``(A, b)`` or ``(A, b, lo, hi)``.
    solvers : iterable of str or callable
        As in :func:`solve`. An exception in a function is a row with its message.
    models : sequence of str
        Under which models of friction the problems with friction are solved; without it under their own.

    Examples
    --------
    >>> table = compare({"two": ([[2, -1], [-1, 2]], [-1, 2])}, ["pgs", "dantzig"])
    >>> [(row["solver"], row["proved"]) for row in table.rows]
    [('pgs', 1), ('dantzig', 1)]
    """
    named = [(name, [problem._inner]) for name, problem in _named(problems)]
    given = _given(tolerance, max_iterations, omega)
    rows, text = _lcplab.compare(named, list(solvers), list(models), given)
    return Comparison(json.loads(rows), text)


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
    given = [] if start is None else [problem._inner for _, problem in _named(start)]
    told = _lcplab.hunt(solver, rival, quarry, _given(tolerance, max_iterations, None), given)
    return Finding(told) if "problem" in told else None


class Step:
    """A step that a scene has taken; true if the judge accepts all that was solved in it."""

    def __init__(self, told: dict[str, Any]) -> None:
        self.number: int = told["number"]
        self.solvers: list[str] = told["solvers"]
        self.statuses: list[str] = told["statuses"]
        self.verdicts: list[str] = told["verdicts"]
        self.x: Array | None = told.get("x")
        self._is_accepted: bool = told["is_accepted"]

    def __bool__(self) -> bool:
        return self._is_accepted

    def __repr__(self) -> str:
        return f"<lcplab.Step {self.number}: {', '.join(self.verdicts) or 'nothing to solve'}>"


class Scene:
    """A scene on its way through time.

    Examples
    --------
    >>> s = Scene.load("fig7")
    >>> s.step().x.tolist()
    [4.0, 3.0, 1.0]
    """

    def __init__(self, inner: _lcplab.Scene) -> None:
        self._inner = inner

    @classmethod
    def load(
        cls,
        name: str | os.PathLike[str],
        *,
        scheme: str | None = None,
        solver: str | None = None,
        set: Mapping[str, Any] | None = None,
    ) -> Scene:
        """Load a shipped scene or a file; ``set={"mu": 0.3}`` changes fields as ``--set`` does."""
        changes = [(key, json.dumps(value)) for key, value in (set or {}).items()]
        return cls(_lcplab.Scene.load(os.fspath(name), changes, scheme, solver))

    def step(self, solver: Solver | None = None) -> Step:
        """Take one step; with a solver, it and all that follow are solved by that."""
        return Step(self._inner.step(solver))

    def problem(self) -> Problem | None:
        """The last problem of the last step, with what its rows are."""
        inner = self._inner.problem()
        return None if inner is None else Problem._of(inner)

    @property
    def poses(self) -> Array:
        """Position (m) and unit quaternion (w, x, y, z) of each body, (bodies, 7)."""
        return self._inner.poses

    @property
    def velocities(self) -> Array:
        """Velocity (m/s) and angular velocity (rad/s) of each body, world axes, (bodies, 6)."""
        return self._inner.velocities

    @property
    def bodies(self) -> list[str]:
        """The names of the bodies."""
        return self._inner.bodies

    @property
    def time(self) -> float:
        """The time now (s)."""
        return self._inner.time

    @property
    def energy(self) -> float:
        """Kinetic and potential energy (J)."""
        return self._inner.energy

    @property
    def penetration(self) -> float:
        """The deepest overlap of two bodies (m)."""
        return self._inner.penetration

    @property
    def drift(self) -> float:
        """The largest error of a joint (m)."""
        return self._inner.drift

    @property
    def name(self) -> str:
        """What it is called."""
        return self._inner.name

    @property
    def title(self) -> str:
        """What it shows."""
        return self._inner.title

    def __repr__(self) -> str:
        return f"<lcplab.Scene {self.name}: {self.title}, at {self.time:g} s>"


def solvers() -> list[str]:
    """The names of the solvers.

    Examples
    --------
    >>> "dantzig" in solvers()
    True
    """
    return [name for name, _, _ in _lcplab.solvers()]


def _vector(values: ArrayLike) -> Array:
    return np.ascontiguousarray(values, dtype=np.float64)


def _bound(values: ArrayLike | None, n: int) -> Array | None:
    if values is None:
        return None
    bound = _vector(values)
    return np.full(n, bound) if bound.ndim == 0 else bound


def _entries(A: Any) -> _lcplab.Entries:
    if hasattr(A, "tocoo"):
        sparse = A.tocoo()
        rows, cols = sparse.shape
        if rows != cols:
            raise _lcplab.InputError(f"problem: A: is {rows} × {cols}, must be square")
        index = [np.ascontiguousarray(k, dtype=np.int64) for k in (sparse.row, sparse.col)]
        return rows, index[0], index[1], _vector(sparse.data)
    return np.asarray(A, dtype=np.float64)


def _problem(
    A: Any,
    b: ArrayLike | None,
    lo: ArrayLike | None,
    hi: ArrayLike | None,
    friction_index: ArrayLike | None,
    mu: ArrayLike | None,
) -> Problem:
    if isinstance(A, Problem):
        if any(value is not None for value in (b, lo, hi, friction_index, mu)):
            raise TypeError("a Problem has its b, bounds and friction")
        return A
    if b is None:
        raise TypeError("b is missing")
    return Problem(A, b, lo, hi, friction_index=friction_index, mu=mu)


def _named(problems: Any) -> list[tuple[str, Problem]]:
    if isinstance(problems, Mapping):
        return [(str(name), _one(problem)) for name, problem in problems.items()]
    if isinstance(problems, (Problem, str, os.PathLike, tuple)):
        problems = [problems]
    named = []
    for k, given in enumerate(problems):
        problem = _one(given)
        path = os.fspath(given) if isinstance(given, (str, os.PathLike)) else ""
        named.append((path or problem.name or f"problem {k}", problem))
    return named


def _one(given: Any) -> Problem:
    if isinstance(given, Problem):
        return given
    if isinstance(given, (str, os.PathLike)):
        return Problem.read(given)
    return Problem(*given)


def _given(tolerance: float, max_iterations: int, omega: float | None) -> dict[str, Any]:
    return {"tolerance": tolerance, "max_iterations": max_iterations, "omega": omega}
