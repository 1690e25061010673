"""Write-back of a whole step of MuJoCo: compares the velocity after it with the acceleration that was solved."""

from __future__ import annotations

from typing import Any

import numpy as np

from lcplab._receipt import mujoco as reader
from lcplab._receipt.findings import Finding, Report
from lcplab._receipt.limits import ROUNDING
from lcplab._receipt.step import Array, Step

EULER = 0


def check(model: Any, data: Any, step: Step, qvel: Array) -> Report:
    """v⁺ = v + h a of Euler's method; with damping B of joints, which is implicit, a = (M + h B)⁻¹ (M u* + Jᵀx)."""
    why = _why_not(model)
    if why:
        return Report(not_checked=[f"write-back: the velocity after the step, because {why}"])
    h, damping = float(model.opt.timestep), _damping(model)
    acceleration = step.motion
    if np.any(damping) and not reader.is_disabled(model, "EULERDAMP", "DAMPER"):
        # The solver's residual is no error of this stage, so the forces are used and not the solved acceleration.
        push = step.push(step.forces) if step.reported_push is None else step.reported_push
        forces = step.times_mass(step.target) + push
        acceleration = step.mass_blocks.plus_diagonal(h * damping).solve(forces)
    change, limit = h * acceleration, ROUNDING[step.bits]
    difference = np.asarray(data.qvel, dtype=float) - qvel - change
    error, worst = step.norm(difference), int(np.argmax(np.abs(difference))) if model.nv else 0
    bodies = tuple(step.dof_bodies[worst : worst + 1])
    scale = max(step.norm(change), limit * step.norm(qvel), h * step.gravity, 1e-300)
    what = "the velocity after the step does not follow from the acceleration and the implicit damping"
    return Report([Finding("write-back", what, error / scale, limit, None, bodies)])


def _why_not(model: Any) -> str:
    """Why the velocity cannot be computed; "" if it can."""
    if int(model.opt.integrator) != EULER:
        return "it is checked for the Euler integrator only"
    names = ("dof_dampingpoly", "actuator_damping", "actuator_dampingpoly")
    if np.ndim(model.dof_damping) > 1 and np.any(np.asarray(model.dof_damping)[:, 1:]):
        return "damping is not linear"
    if any(np.any(getattr(model, name, 0.0)) for name in names):
        return "damping is not linear, or that of actuators"
    if np.any(model.dof_damping) and reader.is_disabled(model, "PASSIVE"):
        return "releases differ in the implicit damping of disabled passive forces"
    return ""


def _damping(model: Any) -> Array:
    """The linear damping of each degree of freedom, (nv,)."""
    damping = np.asarray(model.dof_damping, dtype=float)
    return damping if damping.ndim == 1 else damping[:, 0]
