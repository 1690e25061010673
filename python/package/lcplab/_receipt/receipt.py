"""The receipt of a step: what was checked, what was found, and what was not checked."""

from __future__ import annotations

import json
import math
import os
from functools import cached_property
from pathlib import Path
from typing import Any

from lcplab._receipt import files, solver, work
from lcplab._receipt.files import number
from lcplab._receipt.findings import STAGES, Finding, Report
from lcplab._receipt.limits import NOTABLE
from lcplab._receipt.solver import Bounds
from lcplab._receipt.step import Step


class Receipt:
    """The verification report of one step of an engine.

    Attributes
    ----------
    verdict : str
        ``"ok"``, ``"no rows"`` (nothing to solve, and nothing else wrong), ``"not checked"`` (no bound on the motion),
        ``"unconverged"`` (above the limit at the engine's iteration cap) or ``"wrong"``.
    ok : bool
        Whether the step has rows, its motion was bounded, and nothing is above its limit.
    motion_error : float or None
        A proved bound on the error of the engine's motion v, relative to what the constraints change.
    bound, effect : float
        The same bound and the change by the constraints, in the norm ``√(vᵀM v)``; ``unit`` is their unit.
    stage : str or None
        The first rejected stage: ``"collision"``, ``"assembly"``, ``"solver"`` or ``"write-back"``.
    row, bodies : int or None, and tuple of str
        The row and the bodies with the largest error.
    findings : list of Finding
        All measured errors, each with its limit.
    not_checked : list of str
        What the engine does not report, or lcplab cannot check.
    """

    def __init__(self, step: Step, bounds: Bounds | str, report: Report, limit: float | None = None) -> None:
        self.step = step
        self.limit = solver.limit_for(step, limit)
        self.solution: work.Solution | None = None
        if isinstance(bounds, Bounds) and len(step) and not solver.is_sharp(step, bounds, self.limit):
            self.solution = work.solve(step)
            bounds = solver.sharpened(step, bounds, self.solution)
        own = solver.check(step, bounds, self.limit)
        own.add(report)
        self.findings = sorted(own.findings, key=lambda finding: STAGES.index(finding.stage))
        self.not_checked = [*step.not_checked, *own.not_checked]
        self.effect = step.effect
        self.unit = step.unit
        has_bound = isinstance(bounds, Bounds) and len(step) > 0
        self.bound: float | None = bounds.motion if isinstance(bounds, Bounds) and has_bound else None
        self.motion_error = None if self.bound is None else step.relative(self.bound)
        rejected = [finding for finding in self.findings if finding.is_rejected]
        self.work: work.Work | None = None
        is_excused = bool(rejected) and self._is_excused(rejected[0])
        # Errors of other stages are not excused by the iteration cap, and count first.
        wrong = [finding for finding in rejected if finding.stage != "solver"] if is_excused else rejected
        self.rejected: Finding | None = next(iter(wrong or rejected), None)
        self.stage = self.rejected.stage if self.rejected else None
        self.verdict = "wrong" if wrong else "unconverged" if is_excused else self._accepted()

    def _is_excused(self, finding: Finding) -> bool:
        """Whether the solver's error is one of an engine at its iteration cap, whose method needs that many iterations."""
        if finding.stage != "solver" or self.step.has_converged or not math.isfinite(finding.error):
            return False
        self.work = work.compare(self.step, self.solution)
        return not self.work.is_excessive

    def _accepted(self) -> str:
        """The verdict of a step without rejected findings."""
        if len(self.step) == 0:
            return "no rows"
        return "ok" if self.bound is not None else "not checked"

    @property
    def ok(self) -> bool:
        """Whether the step has rows, its motion was bounded, and nothing is above its limit."""
        return self.verdict == "ok"

    @cached_property
    def difference(self) -> float | None:
        """Where there is no bound on the motion: its measured distance from that of lcplab's own answer, relative to
        what the constraints change. It is no proof; None if lcplab finds no answer."""
        return solver.difference(self.step) if self.bound is None else None

    @property
    def is_rejected(self) -> bool:
        """Whether an error is above its limit and the engine did not report itself as unconverged."""
        return self.verdict == "wrong"

    @property
    def is_notable(self) -> bool:
        """Whether the motion error is above a tenth of its limit."""
        return self.motion_error is not None and self.motion_error > NOTABLE * self.limit

    @property
    def row(self) -> int | None:
        """The row with the largest error of the rejected stage."""
        return self.rejected.row if self.rejected else None

    @property
    def bodies(self) -> tuple[str, ...]:
        """The bodies of this row."""
        return self.rejected.bodies if self.rejected else ()

    def __bool__(self) -> bool:
        return self.ok

    def __repr__(self) -> str:
        where = f", {self.stage}" if self.stage else ""
        error = "" if self.motion_error is None else f", motion error {self.motion_error:.1e}"
        return f"<lcplab.Receipt {self.verdict}{where}{error}>"

    def __str__(self) -> str:
        step = self.step
        iterations = f", {step.iterations} iterations" if step.iterations else ""
        scene = f"{step.name} at {step.time:.4g} s, " if step.name else ""
        lines = [
            f"{step.engine} {step.version}".strip() + f": {scene}{len(step)} rows, {step.method}{iterations}",
            f"  verdict       {self.verdict}" + (f": {self.stage}" if self.stage else ""),
        ]
        if self.bound is not None:
            lines.append(
                f"  motion error  {self.motion_error:.2g} of what the constraints change (limit {self.limit:.1g}); "
                f"at most {self.bound:.2g} of {self.effect:.3g} {self.unit}"
            )
        if self.difference is not None:
            lines.append(f"  difference    {self.difference:.2g} of what the constraints change, from lcplab's own answer")
        if 0 < step.own_tolerance < self.effect:
            lines.append(f"  the engine's own tolerance is {step.own_tolerance / self.effect:.1g} of it")
        if self.work is not None:
            lines.append(f"  work          {self.work}")
        lines += [f"  {finding.stage:<12}  {_line(step, finding)}" for finding in self.findings if finding.is_rejected]
        lines += [f"  not checked   {part}" for part in self.not_checked]
        return "\n".join(lines)

    def to_json(self) -> dict[str, Any]:
        """The receipt as JSON."""
        step = self.step
        return {
            "engine": step.engine, "version": step.version, "name": step.name, "time": number(step.time),
            "rows": len(step), "method": step.method, "bits": step.bits, "iterations": step.iterations,
            "verdict": self.verdict, "stage": self.stage, "row": self.row, "bodies": list(self.bodies),
            "motion_error": number(self.motion_error), "limit": number(self.limit), "bound": number(self.bound),
            "effect": number(self.effect),
            "unit": self.unit, "not_checked": self.not_checked,
            "findings": [
                {"stage": f.stage, "what": f.what, "error": number(f.error), "limit": number(f.limit), "row": f.row,
                 "bodies": list(f.bodies)}
                for f in self.findings
            ],
        }

    def write(self, problem: str | os.PathLike[str], answer: str | os.PathLike[str]) -> None:
        """Write the engine's problem, with the key ``motion``, and the engine's answer to it.

        ``lcplab judge PROBLEM ANSWER`` and ``lcplab prove`` take them; ``lcplab receipts`` takes an answer that is
        named ``STEM.x.json`` beside ``STEM.json``.
        """
        files.write(self.step, Path(problem), Path(answer))

    def save(self, folder: str | os.PathLike[str]) -> Path:
        """Write a folder with the problem, the engine's answer, the receipt as text and as JSON; its path."""
        place = Path(folder)
        place.mkdir(parents=True, exist_ok=True)
        self.write(place / "frame.json", place / "frame.x.json")
        (place / "receipt.txt").write_text(f"{self}\n", encoding="utf-8")
        (place / "receipt.json").write_text(json.dumps(self.to_json(), indent=1) + "\n", encoding="utf-8")
        return place


def _line(step: Step, finding: Finding) -> str:
    where = ""
    if finding.row is not None and finding.row < len(step.rows):
        where = f"; row {finding.row}, {step.rows[finding.row].label}"
    elif finding.row is not None:
        where = f"; row {finding.row}"
    elif finding.bodies:
        where = f"; {', '.join(finding.bodies)}"
    if not math.isfinite(finding.error):
        return f"{finding.what}{where}"
    return f"{finding.what}: {finding.error:.2g}, limit {finding.limit:.1g}{where}"
