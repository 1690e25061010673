"""Derivatives of a solution with respect to the data of its problem."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from lcplab import _lcplab
from lcplab._problem import Array, Problem, ProblemLike, answer, one, read_only, vector


class Gradient:
    """The exact derivative of a solution.

    Attributes
    ----------
    status : str
        ``"differentiable"``; ``"kink"``: x has one-sided derivatives only; ``"not_unique"``: x has none, but the motion
        has one if `is_of_motion`; ``"not_examined"``.
    certificate : str
        The same as a sentence, with the rows and what proves it.
    kinks : list of int
        Rows at a bound with w = 0.
    near_kink : list of int
        Rows that are within rounding of a kink, but not at it.
    states : list of str
        ``"free"``, ``"lower"``, ``"upper"``, ``"kink"`` or ``"held"`` (a friction row that stays at 0), row by row.
    x, w : (n,) ndarray
        The exact solution, rounded.
    u : (k,) ndarray or None
        Its motion, if the problem has the key ``motion``.
    is_of_motion : bool
        Whether x is not unique and the motion has a derivative with respect to ``target`` and ``mass``.
    dx_db : (n, n) ndarray or None
        dx_i/db_j, for up to 50 rows; None at a kink and if x is not unique.
    dx_db_right, dx_db_left : (n, n) ndarray or None
        The same for a small increase and a small decrease of b_j.
    """

    def __init__(self, inner: _lcplab.Gradient) -> None:
        self._inner = inner
        found = json.loads(inner.json())
        self.status: str = found["status"]
        self.certificate: str = found["certificate"]
        self.kinks: list[int] = found["kinks"]
        self.near_kink: list[int] = found["near_kink"]
        self.states: list[str] = found["states"]
        self.is_of_motion: bool = found["of_motion"]
        self.x: Array = read_only(np.array(found["x"], dtype=np.float64))
        self.w: Array = read_only(np.array(found["w"], dtype=np.float64))
        self.u: Array | None = _array(found.get("u"))
        self.dx_db: Array | None = _array(found.get("dx_db"))
        self.dx_db_right: Array | None = _array(found.get("dx_db_right", found.get("dx_db")))
        self.dx_db_left: Array | None = _array(found.get("dx_db_left", found.get("dx_db")))

    def vjp(self, v: ArrayLike, u: ArrayLike | None = None) -> dict[str, Any]:
        """The gradient of ``v @ x``, plus ``u @ motion`` if given, with respect to ``b``, ``A``, ``mu``, ``lo``, ``hi`` and ``motion``.

        Entry (i, j) of ``A`` is for this entry alone: for a symmetric A add entry (j, i). An entry of ``mass`` off the
        diagonal stands for both. Raises InputError at a kink and if x is not unique, except for the motion alone.
        """
        given = None if u is None else vector(u, "u")
        found: dict[str, Any] = json.loads(self._inner.pullback(vector(v, "v"), given))
        motion = found.pop("motion")
        result: dict[str, Any] = {key: np.array(value, dtype=np.float64) for key, value in found.items()}
        result["motion"] = motion and {key: np.array(value, dtype=np.float64) for key, value in motion.items()}
        return result

    def jvp(self, *, left: bool = False, **changes: ArrayLike) -> tuple[Array | None, Array | None]:
        """The changes of x and of the motion for changes ``b=``, ``A=``, ``mu=``, ``lo=``, ``hi=``, ``target=``, ``bias=``, ``compliance=``, ``mass=`` or ``jacobian=``.

        ``left`` selects the left derivative at a kink. x is None if it is not unique, the motion is None without the key
        ``motion``. Matrices are dense; of ``mass`` the upper triangle counts.
        """
        direction: dict[str, Any] = {}
        for name, change in changes.items():
            array = np.asarray(change, dtype=np.float64)
            direction[name] = array.tolist()
            if name in ("A", "mass", "jacobian"):
                places = np.argwhere(array).tolist()
                direction[name] = [(i, j, float(array[i, j])) for i, j in places if name != "mass" or i <= j]
        found = json.loads(self._inner.directional(json.dumps(direction))[int(left)])
        return _array(found["dx"]), _array(found["du"])

    def compare(self, dx_db: ArrayLike, *, h: float | None = None, tolerance: float | None = None) -> Mapping[str, Any]:
        """Compare a matrix dx/db from another program, and name its mistake: keys ``right``, ``faults``, ``worst`` and ``text``.

        ``h`` is the step, if the matrix comes from finite differences.
        """
        matrix = np.ascontiguousarray(dx_db, dtype=np.float64)
        found, text = self._inner.compare(matrix, h, tolerance)
        result: dict[str, Any] = json.loads(found)
        result["text"] = text
        return result

    def __str__(self) -> str:
        return self._inner.text()

    def __repr__(self) -> str:
        return f"<lcplab.Gradient of {len(self.x)} rows: {self.status}>"


def gradient(problem: ProblemLike, x: ArrayLike | None = None) -> Gradient:
    """Differentiate a solution, in exact arithmetic.

    ``problem`` is a :class:`Problem`, the path of a problem file, or a tuple ``(A, b)`` or ``(A, b, lo, hi)``. The
    derivative is that of the exact solution next to ``x``, by default next to lcplab's own answer. A problem may have up to
    150 rows.

    Raises
    ------
    InputError
        If no exact solution is known next to x, the problem is too large, or has friction cones.

    Examples
    --------
    >>> found = gradient(Problem([[2, -1], [-1, 2]], [-1, 2]))
    >>> found.status, found.dx_db.tolist()
    ('differentiable', [[-0.5, 0.0], [0.0, 0.0]])
    >>> found.vjp([1, 0])["b"].tolist()
    [-0.5, 0.0]
    >>> lift_off = gradient(Problem([[2]], [0]))
    >>> lift_off.kinks, lift_off.jvp(b=[1])[0].tolist(), lift_off.jvp(b=[1], left=True)[0].tolist()
    ([0], [0.0], [-0.5])
    """
    of = one(problem)
    return Gradient(_lcplab.gradient(of._inner, None if x is None else answer(x, len(of))))


def _array(values: Any) -> Array | None:
    return None if values is None else read_only(np.array(values, dtype=np.float64))
