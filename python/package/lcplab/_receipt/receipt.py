"""The receipt of a step: what was checked, what was found, and what was not checked."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from lcplab import _lcplab
from lcplab._receipt import files
from lcplab._receipt.findings import Finding, Report
from lcplab._receipt.step import Step

#: An error above this fraction of its limit is worth a look.
NOTABLE = 0.1


@dataclass(frozen=True)
class Work:
    """Iterations of the engine and of Newton's method with the exact Hessian, None if it does not converge."""

    engine: int
    newton: int | None


class Receipt:
    """The verification report of one step of an engine.

    Attributes
    ----------
    verdict : str
        ``"ok"``, ``"no rows"`` (nothing to solve, and nothing else wrong), ``"not checked"`` (the engine does not report
        its whole problem), ``"unconverged"`` (above the limit, but ``stopped_by`` says why the engine stopped early) or
        ``"wrong"``.
    ok : bool
        Whether the step has rows, its solver was checked, and nothing is above its limit.
    motion_error : float or None
        A proved bound on the error of the engine's motion v, relative to ``effect``; None if there is none. See ``frozen``.
    residual : float or None
        If there is no bound: the largest violation of a row's law, as the change of the motion by the impulse that
        corrects this row alone, relative to ``effect``. It is 0 exactly if all laws are satisfied, but many small
        violations can add up to a large error.
    stopped_by : str or None
        What stopped the solver early: its iteration limit (``"iterations"``) or its own loose tolerance (``"tolerance"``);
        otherwise None.
    frozen : bool
        Whether the bound is that of the problem with the friction limits (coupled boxes) or the slip (Coulomb's law)
        of this answer. Such a bound is near 0 only if the answer satisfies the law; otherwise it is not the distance
        from a motion that does.
    bound, effect : float
        The same bound and its divisor, in the norm ``√(vᵀM v)``; ``unit`` is their unit. The divisor is the change by the
        constraints, or that by gravity, or a millionth of the motion without constraints, whichever is largest;
        ``effect_of`` says which.
    stage : str or None
        The first stage with an error above its limit: ``"collision"``, ``"assembly"``, ``"solver"`` or ``"write-back"``.
    limit : float
        The largest accepted motion error, or residual.
    findings : list
        All measured errors: objects with ``stage``, ``what``, ``error``, ``limit``, ``row`` and ``bodies``.
    rejected : object or None
        The finding that decides, if one is above its limit.
    not_checked : list of str
        What the engine does not report, or lcplab cannot check.
    """

    # The receipts of a run are many, and few of them are read: what they say is taken from Rust when it is asked for.
    def __init__(self, step: Step, own: _lcplab.StepReceipt) -> None:
        self.step = step
        self._own = own

    @cached_property
    def _json(self) -> dict[str, Any]:
        written: dict[str, Any] = json.loads(self._own.json())
        return written

    @cached_property
    def verdict(self) -> str:
        return str(self._json["verdict"])

    @cached_property
    def stage(self) -> str | None:
        return None if self._json["stage"] is None else str(self._json["stage"])

    @cached_property
    def limit(self) -> float:
        return float(self._json["limit"])

    @cached_property
    def effect(self) -> float:
        return float(self._json["effect"])

    @cached_property
    def effect_of(self) -> str:
        return str(self._json["effect_of"])

    @cached_property
    def unit(self) -> str:
        return str(self._json["unit"])

    @cached_property
    def frozen(self) -> bool:
        return bool(self._json["frozen"])

    @cached_property
    def bound(self) -> float | None:
        return _optional(self._json["bound"])

    @cached_property
    def motion_error(self) -> float | None:
        return _optional(self._json["motion_error"])

    @cached_property
    def residual(self) -> float | None:
        return _optional(self._json["residual"])

    @cached_property
    def stopped_by(self) -> str | None:
        return None if self._json["stopped_by"] is None else str(self._json["stopped_by"])

    @cached_property
    def findings(self) -> list[Finding]:
        return [Finding.of(finding) for finding in self._json["findings"]]

    @cached_property
    def rejected(self) -> Finding | None:
        place = self._json["rejected"]
        return None if place is None else self.findings[place]

    @cached_property
    def not_checked(self) -> list[str]:
        return list(self._json["not_checked"])

    @cached_property
    def work(self) -> Work | None:
        work = self._json["work"]
        return None if work is None else Work(work["engine"], work["newton"])

    @property
    def ok(self) -> bool:
        """Whether the step has rows, its solver was checked, and nothing is above its limit."""
        return self.verdict == "ok"

    @cached_property
    def difference(self) -> float | None:
        """For coupled boxes and Coulomb's law, and where there is no bound: the measured distance of the motion from
        that of lcplab's own answer, relative to ``effect``. It is no proof; None if lcplab finds no answer."""
        return self._own.difference()

    @property
    def is_rejected(self) -> bool:
        """Whether an error is above its limit, and no iteration limit or loose tolerance explains it."""
        return self.verdict == "wrong"

    @property
    def is_notable(self) -> bool:
        """Whether the motion error, or else the residual, is above a tenth of its limit."""
        error = self.residual if self.motion_error is None else self.motion_error
        return error is not None and error > NOTABLE * self.limit

    @property
    def row(self) -> int | None:
        """The row with the largest error of this stage, or None."""
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
        error += "" if self.residual is None else f", residual {self.residual:.1e}"
        return f"<lcplab.Receipt {self.verdict}{where}{error}>"

    def __str__(self) -> str:
        return self._own.text()

    def to_json(self) -> dict[str, Any]:
        """The receipt as JSON."""
        return dict(self._json)

    def write(self, problem: str | os.PathLike[str], answer: str | os.PathLike[str]) -> None:
        """Write the engine's problem, with the key ``motion``, and the engine's answer to it.

        ``lcplab judge PROBLEM ANSWER`` and ``lcplab prove`` take them; ``lcplab receipts`` takes an answer that is
        named ``STEM.x.json`` beside ``STEM.json``.
        """
        files.write(self.step, Path(problem), Path(answer))

    def shrunk(self) -> Step | None:
        """A step with fewer rows and at least half of the error, which is rejected at the same stage; None if there is none.

        The forces of the removed rows become a part of the motion without constraints. Errors of collision, and of
        assembly unless an adapter's expected values show them, are those of the model and the state: their steps are
        not shrunk.
        """
        fields = self._own.shrunk()
        return None if fields is None else Step._of_frame(fields)

    def save(self, folder: str | os.PathLike[str]) -> Path:
        """Write a folder for a report of a defect; its path.

        It contains the problem and the engine's answer (frame.json, frame.x.json), the receipt as text, as JSON and as a page
        with a picture (receipt.html), and if the step can be shrunk, fewer rows that show the same error (shrunk.json,
        shrunk.x.json).
        """
        place = Path(folder)
        place.mkdir(parents=True, exist_ok=True)
        for name, text in self._own.folder():
            (place / name).write_text(text, encoding="utf-8")
        return place


def receipts_of(steps: Sequence[tuple[Step, Report | None]], limit: float | None) -> list[Receipt]:
    """The receipts of steps, computed on all processors, with the GIL released."""
    posed = [(step._for_rust(), None if report is None else json.dumps(report.to_json())) for step, report in steps]
    return [Receipt(step, own) for (step, _), own in zip(steps, _lcplab.step_receipts(posed, limit))]


def _optional(written: Any) -> float | None:
    return None if written is None else float(written)
