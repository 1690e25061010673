"""The stages solver and write-back: is the answer that of the problem which the engine posed?

Two proved bounds distinguish the stages: one on the error of the engine's own motion v, one on that of the motion u(x) which
its forces x cause. If both are above the limit, the solver is wrong. If only one is, the engine wrote back something else than
it solved. There are two exceptions, in which the difference is the solver's residual: engines that solve for the motion and
compute the forces from it, and a motion that is exactly that of the forces.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from lcplab import _lcplab
from lcplab._receipt import files, finite, work
from lcplab._receipt.findings import Finding, Report
from lcplab._receipt.limits import ROUNDING, limit_of
from lcplab._receipt.step import Array, Step
from lcplab._receipt.work import Solution

#: Why steps of other friction models have no bound.
NOT_ASSOCIATED = "which exists only for boxes and for cones with the associated law"
#: The largest number of rows for which lcplab solves the problem itself.
MOST_ROWS = 600


@dataclass(frozen=True)
class Bounds:
    """Bounds in the norm of M: on the errors of v and of u(x), and on the difference of the two."""

    motion: float
    answer: float
    closure: float
    #: The row that contributes most to the bound on the motion.
    row: int | None


def bounds_of(steps: list[Step]) -> list[Bounds | str]:
    """The bounds of each step, or the reason why it has none; computed on all processors, with the GIL released."""
    reasons = [_no_bound(step) for step in steps]
    posed = [step.arrays() for step, reason in zip(steps, reasons) if not reason]
    computed = (Bounds(*bounds) if bounds else str(why) for bounds, why in _lcplab.motion_bounds(posed))
    return [reason or next(computed) for reason in reasons]


def _no_bound(step: Step) -> str:
    """Why the motion of this step has no bound; "" if lcplab tries to compute one."""
    if finite.of_step(step):
        return "because a number is not finite"
    return step.no_bound or ("" if step.is_associated else NOT_ASSOCIATED)


def difference(step: Step) -> float | None:
    """The distance of the motion from that of an answer of lcplab, relative to the effect; None if lcplab finds none.

    A measurement and no bound: the law of Coulomb can have several solutions.
    """
    own = own_answer(step)
    return None if own is None else step.relative(step.norm(step.motion - own.motion))


def own_answer(step: Step) -> Step | None:
    """The step with lcplab's answer and the motion that it causes; None if lcplab finds none."""
    from lcplab import Problem, solve

    if len(step) > MOST_ROWS or len(step) == 0 or step.no_bound or finite.of_step(step):
        return None
    is_friction = step.friction_index >= 0
    friction: dict[str, Any] = {}
    if is_friction.any():
        friction = {"friction_index": step.friction_index, "mu": step.mu, "model": step.model}
    lo, hi = np.where(is_friction, -np.inf, step.lo), np.where(is_friction, np.inf, step.hi)
    offset = step.along(step.target) + step.bias
    result = solve(Problem(files.matrix(step), offset, lo, hi, **friction), prove=False)
    if not result:
        return None
    motion = step.target + np.linalg.solve(step.dense_mass(), step.push(result.x))
    return replace(step, forces=result.x, motion=motion)


def sharpened(step: Step, bounds: Bounds, solution: Solution | None) -> Bounds:
    """Tighter bounds by way of an accurate motion w, if there is one: |v - û| <= |v - w| + a bound on |w - û|.

    A rigid row's motion has a bound only with forces that solve the problem: those of lcplab's own answer.
    """
    exact = own_answer(step) if solution is None else replace(step, motion=solution.motion)
    if exact is None:
        return bounds
    accurate, beside = bounds_of([exact, replace(exact, forces=step.forces)])
    if isinstance(accurate, str) or isinstance(beside, str):
        return bounds
    slack = (1 + 1e-12) * step.norm(step.motion - exact.motion)
    motion = min(bounds.motion, slack + accurate.motion)
    answer = min(bounds.answer, beside.closure + accurate.motion)
    return Bounds(motion, answer, bounds.closure, bounds.row)


def is_sharp(step: Step, bounds: Bounds, limit: float) -> bool:
    """Whether both bounds are below the limit, so that they need not be tightened."""
    return step.relative(max(bounds.motion, bounds.answer)) <= limit


def limit_for(step: Step, limit: float | None) -> float:
    """The given limit; without one that of the solver's kind, or the engine's own tolerance if that is looser."""
    if limit is None:
        usual = limit_of(step.method, step.bits)
        return max(usual, step.own_tolerance / step.effect) if step.effect > 0 else usual
    if not limit >= 0:
        raise ValueError(f"limit: is {limit}, must be 0 or larger")
    return limit


def check(step: Step, bounds: Bounds | str, limit: float) -> Report:
    """Compare the bounds with the limit, and the motion and the reported generalized forces with the forces."""
    broken = finite.of_step(step)
    if broken:
        return Report([broken], [finite.REST])
    report = Report()
    if len(step) == 0 and step.no_bound:
        return Report(not_checked=[f"solver and write-back, {step.no_bound}"])
    if len(step) == 0:
        report.add(_free(step))
    elif isinstance(bounds, str):
        report.not_checked.append(f"solver: no bound on the motion, {bounds}")
        if not np.any(step.compliance > 0):
            report.findings.append(_closure(step))
    else:
        report.findings.append(_motion(step, bounds, limit))
    if step.reported_push is None:
        report.not_checked.append("write-back: generalized forces, which the engine does not report")
    elif len(step):
        report.findings.append(_push(step, step.reported_push))
    else:
        report.findings.append(_no_push(step, step.reported_push))
    return report


def _free(step: Step) -> Report:
    """Without rows the motion must be the motion without constraints."""
    error = step.norm(step.motion - step.target) / max(step.norm(step.target), step.gravity, 1e-300)
    what = "there are no rows, but the motion is not the motion without constraints"
    return Report([Finding("write-back", what, error, ROUNDING[step.bits])])


def _motion(step: Step, bounds: Bounds, limit: float) -> Finding:
    is_wrong = [not step.relative(bound) <= limit for bound in (bounds.motion, bounds.answer)]
    if is_wrong[0] == is_wrong[1] or work.are_forces_of_motion(step):
        stage, what = "solver", "the motion does not solve the problem that the engine posed"
        error = bounds.motion
    elif is_wrong[1] and is_motion_of_forces(step):
        stage, what = "solver", "the forces do not solve the problem, although the motion is within the limit"
        error = bounds.answer
    elif is_wrong[0]:
        stage, what = "write-back", "the forces solve the problem, but the motion is not the one that they cause"
        error = bounds.motion
    else:
        stage, what = "write-back", "the motion solves the problem, but the forces do not cause it"
        error = bounds.answer
    row = bounds.row
    bodies = step.rows[row].bodies if row is not None and row < len(step.rows) else ()
    return Finding(stage, what, step.relative(error), limit, row, bodies)


def is_motion_of_forces(step: Step) -> bool:
    """Whether the motion is, to rounding, the one that the forces cause: then write-back is correct."""
    return not _closure(step).is_rejected


def _closure(step: Step) -> Finding:
    """Compare the motion with the one that the forces cause, ``u* + inv(M) J.T x``."""
    change = np.linalg.solve(step.dense_mass(), step.push(step.forces))
    error = step.relative(step.norm(step.motion - step.target - change))
    return Finding("write-back", "the motion is not the one that the forces cause", error, ROUNDING[step.bits])


def _push(step: Step, reported: Array) -> Finding:
    """Compare the reported generalized forces with Jᵀx, each relative to its terms."""
    rows, columns, values = step.jacobian
    terms = np.bincount(columns, np.abs(values * step.forces[rows]), len(step.target))
    scale = np.maximum(terms, 1e-6 * max(float(terms.max(initial=0.0)), 1e-300))
    error = np.abs(reported - step.push(step.forces)) / scale
    worst = int(np.argmax(error)) if len(error) else 0
    bodies = (step.dof_bodies[worst],) if worst < len(step.dof_bodies) else ()
    what = f"the reported generalized force of degree of freedom {worst} is not Jᵀx"
    return Finding("write-back", what, float(error[worst]) if len(error) else 0.0, ROUNDING[step.bits], None, bodies)


def _no_push(step: Step, reported: Array) -> Finding:
    """Without rows, constraints have no generalized forces: the motion that the reported ones cause, against gravity's."""
    change = np.asarray(np.linalg.solve(step.dense_mass(), reported), dtype=float)
    error = step.norm(change) / max(step.norm(step.target), step.gravity, 1e-300)
    what = "there are no rows, but the reported generalized forces of constraints are not 0"
    return Finding("write-back", what, error, ROUNDING[step.bits])
