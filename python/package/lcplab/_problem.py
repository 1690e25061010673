"""Problems."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from fractions import Fraction
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lcplab import _lcplab

Array = NDArray[np.float64]


class Problem:
    """A linear complementarity problem with bounds: find x with ``lo <= x <= hi`` for ``w = A x + b``.

    At a solution ``w[i] > 0`` only if ``x[i] == lo[i]``, and ``w[i] < 0`` only if ``x[i] == hi[i]``.

    Parameters
    ----------
    A : (n, n) array_like or SciPy sparse array
        The matrix; inverse masses (1/kg) if x are impulses.
    b : (n,) array_like
        The value of w at ``x = 0``; relative velocities (m/s) if x are impulses (N s).
    lo, hi : (n,) array_like or float, optional
        Bounds of x. The defaults are 0 and infinity, and no bounds for friction rows.
    friction_index : (n,) array_like of int, optional
        Row ``i`` with ``k = friction_index[i] >= 0`` has the bounds ``±mu[i] * max(x[k], 0)``; -1 marks all other rows.
    mu : (n,) array_like or float, optional
        Coefficients of friction.
    model : str, optional
        The friction model, as in :func:`solve`.
    scale : float, optional
        The smallest significant `|x|`; the residual of a row with smaller terms is relative to this size.
    name : str, optional
        A name for tables and messages.

    Raises
    ------
    InputError
        If the input is invalid; the message lists every defect.

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
        right = vector(b, "b")
        self._inner = _lcplab.Problem.of(
            _entries(A),
            {
                "b": right,
                "lo": _bound(lo, len(right), "lo"),
                "hi": _bound(hi, len(right), "hi"),
                "friction_index": None if friction_index is None else _rows(friction_index),
                "mu": _bound(mu, len(right), "mu"),
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
        """Read a problem file in any format that ``lcplab convert --list`` names."""
        return cls._of(_lcplab.Problem.read(path))

    @classmethod
    def generate(cls, family: str, **values: float) -> Problem:
        """Generate a problem of the library.

        Examples
        --------
        >>> Problem.generate("murty", n=3).solutions
        [[Fraction(0, 1), Fraction(0, 1), Fraction(1, 1)]]
        """
        return cls._of(_lcplab.Problem.generate(family, [(k, float(v)) for k, v in values.items()]))

    def write(self, path: str | os.PathLike[str]) -> list[str]:
        """Write the problem to a file in the format of its extension; returns warnings for its readers."""
        return self._inner.write(path)

    def to_json(self) -> dict[str, Any]:
        """The contents of a problem file as a dictionary."""
        reported: dict[str, Any] = json.loads(self._inner.json())
        return reported

    @property
    def A(self) -> Array:
        """The matrix A as a dense array, (n, n); read-only, as all arrays of a problem: make a new `Problem` to change it."""
        return read_only(self._inner.a)

    def triplets(self) -> tuple[NDArray[np.int64], NDArray[np.int64], Array]:
        """Row indices, column indices and values of the stored entries of A."""
        return self._inner.triplets()

    @property
    def b(self) -> Array:
        """The value of w at ``x = 0``, (n,)."""
        return read_only(self._inner.b)

    @property
    def lo(self) -> Array:
        """The lower bounds, (n,)."""
        return read_only(self._inner.lo)

    @property
    def hi(self) -> Array:
        """The upper bounds, (n,)."""
        return read_only(self._inner.hi)

    @property
    def friction_index(self) -> NDArray[np.int64] | None:
        """For each row, the normal row that its friction bounds depend on, or -1."""
        index = self._inner.friction_index
        if index is not None:
            index.flags.writeable = False
        return index

    @property
    def mu(self) -> Array | None:
        """The coefficients of friction, (n,)."""
        mu = self._inner.mu
        return None if mu is None else read_only(mu)

    @property
    def model(self) -> str | None:
        """The friction model of the problem, such as ``"coulomb-cone"``, or None."""
        return self._inner.model

    @property
    def name(self) -> str:
        """The name of the problem."""
        return self._inner.name

    @property
    def card(self) -> dict[str, Any]:
        """Size, class of the matrix, rank and condition number."""
        reported: dict[str, Any] = json.loads(self._inner.card())
        return reported

    @property
    def solutions(self) -> list[list[Fraction]] | None:
        """The known exact solutions; None if unknown, an empty list if no solution exists."""
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


#: A problem, the path of its file, or the tuple of its arrays, (A, b) or (A, b, lo, hi).
ProblemLike = Union[Problem, str, "os.PathLike[str]", tuple[Any, ...]]


def problem_of(
    A: Any,
    b: ArrayLike | None,
    lo: ArrayLike | None,
    hi: ArrayLike | None,
    friction_index: ArrayLike | None,
    mu: ArrayLike | None,
) -> Problem:
    """The problem of the arguments of a function that takes A and b, or a whole problem as A."""
    if b is None or isinstance(A, (Problem, str, os.PathLike)):
        if any(value is not None for value in (b, lo, hi, friction_index, mu)):
            raise TypeError("A is a whole problem, so b, bounds and friction must not be given")
        return one(A)
    return Problem(A, b, lo, hi, friction_index=friction_index, mu=mu)


def one(problem: Any) -> Problem:
    """A problem that is given as a Problem, as the path of its file, or as the tuple of its arrays.

    Raises
    ------
    InputError
        If it is something else.
    """
    if isinstance(problem, Problem):
        return problem
    if isinstance(problem, (str, os.PathLike)):
        return Problem.read(problem)
    if isinstance(problem, tuple) and 2 <= len(problem) <= 4:
        return Problem(*problem)
    what = f"a {type(problem).__name__}"
    raise _lcplab.InputError(f"problem: is {what}; must be a Problem, the path of a file, or a tuple (A, b) or (A, b, lo, hi)")


def answer(x: Any, n: int, name: str = "x") -> Array:
    """The n numbers of an answer; of an object with an attribute x, such as a Result, that attribute."""
    array = vector(getattr(x, "x", x), name, "answer")
    if len(array) != n:
        raise _lcplab.InputError(f"answer: {name}: has length {len(array)}, the problem has {n} rows")
    return array


def named(problems: Any) -> list[tuple[str, Problem]]:
    if isinstance(problems, Mapping):
        return [(str(name), _single(problem)) for name, problem in problems.items()]
    if isinstance(problems, (Problem, str, os.PathLike, tuple)):
        problems = [problems]
    named = []
    for k, given in enumerate(problems):
        problem = _single(given)
        path = os.fspath(given) if isinstance(given, (str, os.PathLike)) else ""
        named.append((path or problem.name or f"problem {k}", problem))
    return named


def _single(given: Any) -> Problem:
    if isinstance(given, (tuple, list)) and 2 <= len(given) <= 4:
        return Problem(*given)
    return one(given)


def read_only(array: Array) -> Array:
    """The same array, made read-only: writing raises a ValueError."""
    array.flags.writeable = False
    return array


def vector(values: ArrayLike, name: str, of: str = "problem") -> Array:
    """Contiguous real numbers.

    Raises
    ------
    InputError
        If the values are not numbers, or not one-dimensional.
    """
    array = numbers(values, name, of)
    if array.ndim != 1:
        shape = " × ".join(map(str, array.shape)) or "that of a number"
        raise _lcplab.InputError(f"{of}: {name}: has the shape {shape}, must be one-dimensional")
    return np.ascontiguousarray(array)


def numbers(values: ArrayLike, name: str, of: str = "problem") -> Array:
    """Real numbers in any shape."""
    # NumPy would drop masks, and imaginary parts with a warning, and would take None for NaN.
    if np.ma.is_masked(values):
        raise _lcplab.InputError(f"{of}: {name}: has masked entries")
    if isinstance(values, (list, tuple)):
        for i, value in enumerate(values):
            if value is None:
                raise _lcplab.InputError(f"{of}: {name}[{i}]: is None, must be a number or ±inf")
    try:
        array = np.asarray(values)
        is_complex = np.iscomplexobj(array)
        real = array.real if is_complex else np.asarray(array, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise _lcplab.InputError(f"{of}: {name}: is no array of numbers: {error}") from None
    if is_complex:
        raise _lcplab.InputError(f"{of}: {name}: is complex, must be real; its real part is {name}.real")
    return real


def _rows(friction_index: ArrayLike) -> NDArray[np.int64]:
    # NumPy would cut 0.5 to row 0.
    index = numbers(friction_index, "friction_index")
    for i in np.flatnonzero(~np.isfinite(index) | (np.floor(index) != index)):
        raise _lcplab.InputError(f"problem: friction_index[{i}]: must be a row or -1, is {index.flat[i]}")
    return np.ascontiguousarray(index, dtype=np.int64)


def _bound(values: ArrayLike | None, n: int, name: str) -> Array | None:
    if values is None:
        return None
    bound = numbers(values, name)
    return np.full(n, bound) if bound.ndim == 0 else vector(bound, name)


def _entries(A: Any) -> _lcplab.Entries:
    if hasattr(A, "tocoo"):
        sparse = A.tocoo()
        rows, cols = sparse.shape
        if rows != cols:
            raise _lcplab.InputError(f"problem: A: is {rows} × {cols}, must be square")
        index = [np.ascontiguousarray(k, dtype=np.int64) for k in (sparse.row, sparse.col)]
        return rows, index[0], index[1], vector(sparse.data, "A")
    matrix = numbers(A, "A")
    if matrix.size == 0:
        return matrix.reshape(0, 0)
    if matrix.ndim != 2:
        raise _lcplab.InputError(f"problem: A: has {matrix.ndim} dimensions, must be a matrix")
    return matrix
