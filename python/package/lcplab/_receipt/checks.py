"""Selects the module that reads a step, by the type of the model, and runs the checks of the other stages."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol, runtime_checkable

import numpy as np

from lcplab._receipt import (
    closure,
    dart,
    drake,
    finite,
    kinematics,
    mjx,
    mujoco,
    mujoco_assembly,
    mujoco_shapes,
    mujoco_state,
    stale,
    warp,
)
from lcplab._receipt.findings import Report
from lcplab._receipt.step import Array, Step

#: (qpos, qvel); DART has more.
State = Sequence[Array]
VELOCITY = "write-back: the velocity after the step; pass before=(qpos, qvel)"
POSITION = "write-back: the position after the step"
RESET = "assembly: the state before the step, because MuJoCo reset an unstable simulation in it"


@runtime_checkable
class Adapter(Protocol):
    """Reads the steps of another engine; see ``docs/ci.md``."""

    def problem(self, model: Any, data: Any) -> Step:
        """The step that the engine has just solved."""


def read(model: Any, data: Any, adapter: Adapter | None, before: State | None) -> tuple[Step, Report | None]:
    """The step, and the findings of the stages that its engine allows to check; None if it is described by an adapter.

    Raises
    ------
    TypeError
        If no adapter reads this kind of model, or the adapter returns something else than a step.
    """
    if isinstance(model, Step):
        return model, None
    if adapter is not None:
        step = adapter.problem(model, data)
        if not isinstance(step, Step):
            raise TypeError(f"adapter: problem() returned a {type(step).__name__}, must return an EngineStep")
        return step, None
    if mujoco.is_mine(model):
        return _of_mujoco(model, data, before)
    if type(model).__module__.startswith("lcplab.engines."):
        from lcplab.engines import engine_step

        return engine_step(model), None
    if dart.is_mine(model):
        return dart.read(model, before), None
    if drake.is_mine(model):
        return drake.read(model, data, before), None
    raise TypeError(
        f"no adapter reads a {type(model).__module__}.{type(model).__name__}: pass adapter=, an object with "
        "problem(model, data), or an EngineStep"
    )


def _of_mujoco(model: Any, data: Any, before: State | None) -> tuple[Step, Report]:
    mujoco_state.check_before(model, data, before)
    if mjx.is_mine(data):
        return _of_mjx(model, data, before)
    if warp.is_mine(data):
        if warp.worlds(data) > 1:
            raise TypeError("data has several worlds: use receipts([(model, data)]), which checks all of them")
        return of_world(model, data, 0)
    step = mujoco.read(model, data)
    if not (finite.is_finite(step) and step.is_definite()):
        return step, Report()
    broken = mujoco_state.not_finite(data, before)
    if broken:
        return step, Report([broken], [finite.REST])
    if int(model.opt.integrator) == mujoco.RK4 and not kinematics.is_at(model, data, np.array(data.qpos)):
        step = step.with_motion_of_forces("which is a mean of the stages of RK4")
    report = mujoco_shapes.check(model, data)
    if before is not None and mujoco_state.was_reset(model, data):
        before = mujoco_state.at_reset(model)
        report.not_checked.append(RESET)
    report.add(_at_state(model, data, step, before))
    report.not_checked += mujoco.never_checked(model, data)
    return step, report


def _at_state(model: Any, data: Any, step: Step, before: State | None) -> Report:
    """Assembly and write-back, which need the state at which the step was solved."""
    qpos, qvel = before or (np.array(data.qpos), np.array(data.qvel))
    if kinematics.is_at(model, data, qpos):
        report = mujoco_assembly.check(model, data, step, qpos, qvel)
        report.add(Report(not_checked=[VELOCITY]) if before is None else closure.check(model, data, step, qvel))
        return report
    if before is None:
        return Report(not_checked=["assembly: the state is that after the step; pass before=(qpos, qvel)", VELOCITY])
    if int(model.opt.integrator) == mujoco.RK4:
        why = "the poses in the data are those of the last stage of RK4"
        return Report(not_checked=[f"assembly: {why}", f"write-back: the velocity after the step, because {why}"])
    return stale.check(model, data, step, qpos, qvel)


def _of_mjx(model: Any, data: Any, before: State | None) -> tuple[Step, Report]:
    step = mjx.read(model, data, before[0] if before else np.array(data.qpos, dtype=float))
    if before is None:
        return step, Report(not_checked=["collision", "assembly", VELOCITY, POSITION])
    report = Report(not_checked=["collision", "assembly", POSITION])
    if finite.is_finite(step):
        report.add(closure.check(model, data, step, before[1]))
    return step, report


def worlds(data: Any) -> int:
    """The number of worlds of these data."""
    return warp.worlds(data) if warp.is_mine(data) else 1


def of_world(model: Any, data: Any, world: int) -> tuple[Step, Report]:
    """The step of one of several worlds."""
    return warp.read(model, data, world), Report(not_checked=["collision", "assembly", VELOCITY, POSITION])
