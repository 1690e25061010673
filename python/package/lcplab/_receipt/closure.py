"""Write-back of a whole step of MuJoCo: compares the velocity after it with the acceleration that was solved."""

from __future__ import annotations

from typing import Any

import numpy as np

from lcplab._receipt.findings import Finding, Report
from lcplab._receipt.limits import ROUNDING
from lcplab._receipt.step import Array, Step

EULER = 0


def check(model: Any, data: Any, step: Step, qvel: Array) -> Report:
    """v⁺ = v + h (M + h B)⁻¹ M a of Euler's method, with the damping B of joints taken implicitly."""
    import mujoco as engine

    if int(model.opt.integrator) != EULER:
        return Report(not_checked=["write-back: the velocity after the step, which is checked for the Euler integrator only"])
    h, damping = float(model.opt.timestep), np.asarray(model.dof_damping, dtype=float)
    if damping.ndim > 1:
        if np.any(damping[:, 1:]):
            return Report(not_checked=["write-back: the velocity after the step, because damping is nonlinear"])
        damping = damping[:, 0]
    change = h * step.motion
    flags = engine.mjtDisableBit
    off = int(flags.mjDSBL_EULERDAMP) | int(getattr(flags, "mjDSBL_DAMPER", 0)) | int(
        getattr(flags, "mjDSBL_PASSIVE", 0))
    if np.any(damping) and not model.opt.disableflags & off:
        mass = step.dense_mass()
        implicit = np.linalg.solve(mass + h * np.diag(damping), step.times_mass(step.motion))
        change = np.asarray(h * implicit, dtype=float)
    limit = ROUNDING[step.bits]
    error = step.norm(np.asarray(data.qvel, dtype=float) - qvel - change)
    scale = max(step.norm(change), limit * step.norm(qvel), h * step.gravity, 1e-300)
    what = "the velocity after the step does not follow from the acceleration and the implicit damping"
    return Report([Finding("write-back", what, error / scale, limit)])
