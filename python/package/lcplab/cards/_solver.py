"""Which part of a violated law is the solver's: the receipts of steps that an engine reports."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from lcplab import EngineStep
from lcplab._receipt import Receipt
from lcplab._receipt.receipt import receipts_of
from lcplab.cards._phenomenon import Run

#: The number of steps of a run that are checked.
CHECKED = 25


@dataclass(frozen=True)
class SolverPart:
    """The error of an engine's solver on its own problems."""

    #: The checked steps, and those of them whose error is above the limit.
    steps: int = 0
    above: int = 0
    #: The largest error of a step: of the motion, relative to its change in the step (docs/ci.md); and the limit.
    error: float = 0.0
    limit: float = 0.0
    #: Whether all errors are proved bounds of the motion error; otherwise a residual, or a bound for the friction of the
    #: answer, is among them.
    is_bound: bool = True
    #: Why no step was checked.
    why: str = ""


def part(runs: Sequence[Run]) -> SolverPart:
    """The solver's part in the motion of these runs."""
    steps: list[EngineStep] = [step for run in runs for step in run.reported if len(step) or step.no_bound]
    if not steps:
        return SolverPart(why=next((run.unreported for run in runs if run.unreported), "no rows"))
    receipts = receipts_of([(step, None) for step in steps], None)
    checked = [(receipt, error) for receipt in receipts if (error := _error(receipt)) is not None]
    if not checked:
        return SolverPart(why=steps[0].no_bound.removeprefix("because "))
    worst, error = max(checked, key=lambda pair: pair[1])
    return SolverPart(
        steps=len(checked), above=sum(not error <= receipt.limit for receipt, error in checked), error=error,
        limit=worst.limit, is_bound=all(receipt.motion_error is not None and not receipt.frozen for receipt, _ in checked),
    )


def _error(receipt: Receipt) -> float | None:
    """The error of the solver, None if the engine does not report its whole problem."""
    if receipt.step.no_bound:
        return None
    return receipt.residual if receipt.motion_error is None else receipt.motion_error
