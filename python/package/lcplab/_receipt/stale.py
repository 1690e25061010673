"""Poses in MuJoCo's data that are not those of the state before the step: stale kinematics, or another step's state."""

from __future__ import annotations

from typing import Any

import numpy as np

from lcplab._receipt import closure, kinematics
from lcplab._receipt.findings import Finding, Report
from lcplab._receipt.step import Array, Step


def check(model: Any, data: Any, step: Step, qpos: Array, qvel: Array) -> Report:
    """The difference of the poses as an error of assembly, and the comparison of the velocity after the step."""
    import mujoco

    distances, turns = kinematics.differences(model, data, qpos)
    worst = int(np.argmax(np.maximum(distances, turns)))
    body = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_BODY, worst) or f"body {worst}"
    report = closure.check(model, data, step, qvel)
    follows = bool(report.findings) and not any(finding.is_rejected for finding in report.findings)
    what = (
        f"the poses in the data are not those of before: they differ by {distances[worst]:.2g} m and {turns[worst]:.2g} rad; "
        f"{_cause(model, data, qpos, follows)}"
    )
    finding = Finding("assembly", what, np.inf, 0.0, None, (body,))
    parts = ["assembly: everything else, because the poses are not those of before"]
    return Report([finding, *report.findings], parts + report.not_checked)


def _cause(model: Any, data: Any, qpos: Array, follows: bool) -> str:
    """Whose state it is, as far as the data show it."""
    if np.array_equal(qpos, data.qpos):
        return "before is the state after the step: copy qpos and qvel before the step"
    if kinematics.is_at(model, data, np.array(data.qpos)):
        return "they are those of data.qpos, as after mj_forward: leave before out"
    if follows:
        return "the velocity after the step follows from before, so that the engine used the poses of another step"
    return "either the engine used the poses of another step, or before is the state of another step"
