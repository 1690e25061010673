"""Selects the module that reads a step, by the type of the model, and runs the checks of the other stages."""

from __future__ import annotations

from typing import Any, Protocol, runtime_checkable

import numpy as np

from lcplab._receipt import closure, kinematics, mjx, mujoco, mujoco_assembly, mujoco_shapes, warp
from lcplab._receipt.findings import Report
from lcplab._receipt.step import Array, Step

State = tuple[Array, Array]


@runtime_checkable
class Adapter(Protocol):
    """Reads the steps of another engine; see ``docs/ci.md``."""

    def problem(self, model: Any, data: Any) -> Step:
        """The step that the engine has just solved."""


def read(model: Any, data: Any, adapter: Adapter | None, before: State | None) -> tuple[Step, Report]:
    """The step, and the findings of the stages that its engine allows to check.

    Raises
    ------
    TypeError
        If no adapter reads this kind of model.
    """
    if isinstance(model, Step):
        return model, Report(not_checked=["collision", "assembly"])
    if adapter is not None:
        return adapter.problem(model, data), Report(not_checked=["collision", "assembly"])
    if mujoco.is_mine(model):
        return _of_mujoco(model, data, before)
    raise TypeError(
        f"no adapter reads a {type(model).__module__}.{type(model).__name__}: pass adapter=, an object with "
        "problem(model, data), or an EngineStep"
    )


def _of_mujoco(model: Any, data: Any, before: State | None) -> tuple[Step, Report]:
    if mjx.is_mine(data):
        return _of_mjx(model, data, before)
    if warp.is_mine(data):
        if warp.worlds(data) > 1:
            raise TypeError("data has several worlds: use receipts([(model, data)]), which checks all of them")
        return of_world(model, data, 0)
    step = mujoco.read(model, data)
    report = mujoco_shapes.check(model, data)
    qpos, qvel = before or (np.array(data.qpos), np.array(data.qvel))
    if kinematics.is_at(model, data, qpos):
        report.add(mujoco_assembly.check(model, data, step, qpos, qvel))
    else:
        report.not_checked.append("assembly: the state is that after the step; pass before=(qpos, qvel)")
    if before is not None:
        report.add(closure.check(model, data, step, qvel))
    return step, report


def _of_mjx(model: Any, data: Any, before: State | None) -> tuple[Step, Report]:
    step = mjx.read(model, data, before[0] if before else np.array(data.qpos, dtype=float))
    report = Report(not_checked=["collision", "assembly"])
    if before is not None:
        report.add(closure.check(model, data, step, before[1]))
    return step, report


def worlds(data: Any) -> int:
    """The number of worlds of these data."""
    return warp.worlds(data) if warp.is_mine(data) else 1


def of_world(model: Any, data: Any, world: int) -> tuple[Step, Report]:
    """The step of one of several worlds."""
    return warp.read(model, data, world), Report(not_checked=["collision", "assembly"])
