"""The contact problems that engines solve themselves: their own answers judged, and the same problems solved here."""

from __future__ import annotations

from typing import Any

import numpy as np

import lcplab
from lcplab.cards._run import _named
from lcplab.cards.phenomena import PHENOMENA
from lcplab.engines import Array, Description, Engine, Posed, Posing, Unsupported, by_name

#: Phenomena and times (s) at which a problem is taken out.
MOMENTS = (("creep", 1.0), ("stopping", 0.2), ("weight", 1.0), ("mass_ratio", 1.0))
#: The scaled residual that an engine's answer may have: half the digits, as engines stop by gradients.
TOLERANCE = 1e-6


def frames(name: str) -> list[dict[str, Any]]:
    """The problems of an engine as it is installed; none if it does not tell them.

    Examples
    --------
    >>> frames("lcplab")
    []
    """
    engine = by_name(name)
    found = []
    for phenomenon, time in MOMENTS:
        of = _named(PHENOMENA, phenomenon)
        try:
            posed = _posed(engine, of.described(of.variants[-1]), time)
        except Unsupported:
            continue
        if posed is None:
            return []
        problem = {
            **posed.problem.to_json(),
            **posed.more,
            "name": f"{engine.title}: {phenomenon.replace('_', ' ')} after {time:g} s",
            "source": f"{engine.package} {engine.version} as installed; {posed.words}",
        }
        answer = posed.answer.tolist()
        frame = {"engine": name, "phenomenon": phenomenon, "time": time, "problem": problem, "answer": answer}
        found.append(frame | _judged(posed.problem, posed.answer))
    return found


def _posed(engine: Engine, scene: Description, time: float) -> Posed | None:
    """The problem after a time (s), if it is reported; lcplab's own, if the engine solves problems but poses none."""
    if engine.solve is None:
        world = engine.build(scene, engine.settings[0])
        if not isinstance(world, Posing):
            return None
        for _ in range(round(time / engine.settings[0].dt)):
            world.step()
        return world.problem()
    stepped = lcplab.Scene.of({**scene, "contact": {**scene["contact"], "model": "coulomb-cone"}})
    for _ in range(round(time / scene["step"]["dt"])):
        stepped.step()
    problem = stepped.problem()
    assert problem is not None
    solve, words = engine.solve
    return Posed(problem, solve(problem), words)


def _judged(problem: lcplab.Problem, answer: Array) -> dict[str, Any]:
    verdict = lcplab.judge(problem, x=answer, tolerance=TOLERANCE)
    rows = lcplab.compare(problem, [name for name in lcplab.solvers() if name != "enumeration"]).rows
    solvers = [
        {
            "solver": row["solver"],
            "accepted": row["accepted"] == 1,
            "iterations": row["iterations"],
            "multiplications": row["multiplications"],
        }
        for row in rows
    ]
    judged = {
        "rows": len(answer),
        "verdict": verdict.verdict,
        "residual": float(f"{verdict.residual:.3g}"),
        "row": verdict.row,
        "solvers": solvers,
    }
    if verdict.row is not None and verdict.amount is not None:
        judged["missed"] = float(f"{verdict.amount * _terms(problem, answer, verdict.row):.3g}")
    return judged


def _terms(problem: lcplab.Problem, x: Array, row: int) -> float:
    """What the judge measures a row's miss by, in the unit of w (m/s of impulses): its terms, or that of the scale."""
    line = problem.A[row]
    rest = problem.to_json().get("scale", 0.0) * abs(line[row])
    return float(max(np.abs(line) @ np.abs(x) + abs(problem.b[row]), rest))
