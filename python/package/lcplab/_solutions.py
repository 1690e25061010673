"""All solutions of a small problem."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

import numpy as np

from lcplab import _lcplab
from lcplab._problem import Array, Problem, ProblemLike, one, read_only


class Face:
    """A polyhedron of solutions: all weighted means of its corners, plus any nonnegative multiples of its rays.

    Attributes
    ----------
    corners : list of list of Fraction
        Its corners, exactly. A single corner without rays is an isolated solution.
    rays : list of list of Fraction
        The directions in which it has no end.
    """

    def __init__(self, corners: list[list[Fraction]], rays: list[list[Fraction]]) -> None:
        self.corners = corners
        self.rays = rays

    @property
    def is_isolated(self) -> bool:
        """Whether it is a single solution."""
        return len(self.corners) == 1 and not self.rays

    def __repr__(self) -> str:
        parts = [f"{len(self.corners)} corner{'s' if len(self.corners) != 1 else ''}"]
        if self.rays:
            parts.append(f"{len(self.rays)} ray{'s' if len(self.rays) != 1 else ''}")
        return f"<lcplab.Face of {', '.join(parts)}>"


class Solutions:
    """All solutions of a problem; true if there is one. Iterating gives the faces, none of which is part of another.

    Attributes
    ----------
    faces : list of Face
        Every solution belongs to a face.
    corners : list of list of Fraction
        The isolated solutions and the corners of the faces, exactly.
    rays : list of list of Fraction
        The directions in which the set has no end, each scaled to 1 in one row.
    x : (corners, n) ndarray
        The corners as numbers, rounded.
    """

    def __init__(
        self, n: int, corners: list[list[str]], rays: list[list[str]], faces: list[tuple[list[int], list[int]]]
    ) -> None:
        self.corners = [[Fraction(entry) for entry in corner] for corner in corners]
        self.rays = [[Fraction(entry) for entry in ray] for ray in rays]
        self.faces = [Face([self.corners[k] for k in own], [self.rays[k] for k in out]) for own, out in faces]
        self.x: Array = read_only(np.array(self.corners, dtype=np.float64).reshape(len(corners), n))

    @property
    def is_unique(self) -> bool:
        """Whether there is exactly one solution."""
        return len(self.faces) == 1 and self.faces[0].is_isolated

    @property
    def is_finite(self) -> bool:
        """Whether every solution is isolated."""
        return all(face.is_isolated for face in self.faces)

    def __bool__(self) -> bool:
        return bool(self.faces)

    def __len__(self) -> int:
        return len(self.faces)

    def __iter__(self) -> Iterator[Face]:
        return iter(self.faces)

    def __repr__(self) -> str:
        if not self.faces:
            return "<lcplab.Solutions: none>"
        if self.is_finite:
            return f"<lcplab.Solutions: exactly {len(self.faces)}>"
        return f"<lcplab.Solutions: infinitely many, in {len(self.faces)} face{'s' if len(self.faces) != 1 else ''}>"


def solutions(problem: ProblemLike, *, model: str | None = None) -> Solutions:
    """List all solutions of a problem, in exact arithmetic.

    ``problem`` is a :class:`Problem`, the path of a problem file, or a tuple ``(A, b)`` or ``(A, b, lo, hi)``. It may have up to 531,441 active sets: 19 contacts without friction, or 12 rows with two bounds; rows without
    bounds do not count. It may have up to 1,024 corners. ``model`` replaces the friction model of the problem, which
    must be a box.

    Raises
    ------
    InputError
        If the problem is too large, has too many solutions, or has friction cones.

    Examples
    --------
    >>> one_load_on_two_supports = Problem([[1, 1], [1, 1]], [-1, -1])
    >>> found = solutions(one_load_on_two_supports)
    >>> found, found.is_unique, found.x.tolist()
    (<lcplab.Solutions: infinitely many, in 1 face>, False, [[0.0, 1.0], [1.0, 0.0]])
    """
    of = one(problem)
    return Solutions(len(of), *_lcplab.solutions(of._inner, model))
