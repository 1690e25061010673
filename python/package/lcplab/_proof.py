"""Proofs as files."""

from __future__ import annotations

import json
import os
from typing import Any

from numpy.typing import ArrayLike

from lcplab import _lcplab
from lcplab._problem import Problem, ProblemLike, answer, one


class Proof:
    """A statement about a problem, proved in exact arithmetic; true if there is a proof.

    Attributes
    ----------
    kind : str or None
        ``"no-solution"``, ``"unique"``, ``"not-unique"``, ``"solution"``, ``"cone-solution"``,
        ``"body-solution"``, ``"motion"``, ``"within"`` or ``"frozen-motion"``.
    claim : str
        The statement as a sentence.
    missing : dict
        For each stronger kind, the reason why there is no proof of it.
    data : dict or None
        The contents of the proof file, as ``docs/proofs.md`` specifies them.
    """

    def __init__(self, text: str | None, claim: str, missing: dict[str, str]) -> None:
        self._text = text
        self.data: dict[str, Any] | None = None if text is None else json.loads(text)
        self.kind: str | None = None if self.data is None else self.data["kind"]
        self.claim = claim
        self.missing = missing

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write the proof to a file."""
        if self._text is None:
            raise ValueError("there is no proof")
        with open(path, "w", encoding="utf-8") as file:
            file.write(self._text + "\n")

    def __bool__(self) -> bool:
        return self._text is not None

    def __repr__(self) -> str:
        return f"<lcplab.Proof {self.kind}: {self.claim}>"


def prove(
    problem: ProblemLike,
    x: ArrayLike | None = None,
    second: ArrayLike | None = None,
    *,
    kind: str | None = None,
    model: str | None = None,
) -> Proof:
    """Prove the strongest possible statement about a problem, or the given ``kind``.

    ``problem`` is a :class:`Problem`, the path of a problem file, or a tuple ``(A, b)`` or ``(A, b, lo, hi)``. The search
    starts from the answer ``x``, if it is given; the proof is about the problem, also if ``x`` is no solution. With a ``second`` answer it proves that both are solutions,
    and different; ``kind`` is then ``None`` or ``"not-unique"``. ``model`` replaces the friction model of the problem. Most
    proofs are about boxes. For cones lcplab can prove that a solution exists near ``x``, or that no solution exists, and for
    polygons that no solution exists; otherwise it raises :class:`InputError`.

    Examples
    --------
    >>> prove(Problem([[2, -1], [-1, 2]], [-1, 2]))
    <lcplab.Proof unique: exactly one solution exists>
    >>> prove(Problem([[1, 1], [1, 1]], [-1, -1]), [1, 0], [0.25, 0.75])
    <lcplab.Proof not-unique: two different solutions exist>
    """
    if second is not None and (x is None or kind not in (None, "not-unique")):
        raise ValueError("a second answer needs a first one, and the kind not-unique")
    of = one(problem)
    first = None if x is None else answer(x, len(of))
    other = None if second is None else answer(second, len(of), "second")
    proof, missing = _lcplab.prove(of._inner, first, other, kind, model)
    text, claim = proof if proof is not None else (None, "nothing")
    return Proof(text, claim, dict(missing))


def check(problem: ProblemLike, proof: Proof | str | os.PathLike[str], *, model: str | None = None) -> str | None:
    """Check a proof or a proof file: None if it is valid for the problem, otherwise the reason why it is not.

    ``model`` replaces the friction model of the problem.

    Examples
    --------
    >>> one, other = Problem([[1]], [-1]), Problem([[1]], [-2])
    >>> check(one, prove(one)), check(other, prove(one))
    (None, 'the proof is about another problem')
    """
    if isinstance(proof, Proof):
        text = json.dumps(proof.data)
    else:
        with open(proof, encoding="utf-8") as file:
            text = file.read()
    return _lcplab.check(one(problem)._inner, text, model)
