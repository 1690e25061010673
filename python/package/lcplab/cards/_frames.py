"""The contact problems that engines solve themselves: their own answers judged, and the same problems solved here."""

from __future__ import annotations

from typing import Any

import lcplab
from lcplab.cards._run import _named
from lcplab.cards.phenomena import PHENOMENA
from lcplab.engines import Posing, Unsupported, by_name

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
            world = engine.build(of.described(of.variants[-1]), engine.settings[0])
            if not isinstance(world, Posing):
                return []
            for _ in range(round(time / engine.settings[0].dt)):
                world.step()
            problem, answer = world.problem()
        except Unsupported:
            continue
        posed = {
            **problem.to_json(),
            "name": f"{engine.title}: {phenomenon.replace('_', ' ')} after {time:g} s",
            "source": f"{engine.package} {engine.version} as installed; forces (N), pyramids with a row an edge",
        }
        frame = {"engine": name, "phenomenon": phenomenon, "time": time, "problem": posed, "answer": list(answer)}
        found.append(frame | _judged(problem, answer))
    return found


def _judged(problem: lcplab.Problem, answer: Any) -> dict[str, Any]:
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
    return {
        "rows": len(answer),
        "verdict": verdict.verdict,
        "residual": float(f"{verdict.residual:.3g}"),
        "row": verdict.row,
        "solvers": solvers,
    }
