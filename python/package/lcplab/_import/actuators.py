"""Actuators of hinges and slides: motors, and servos, whose forces are linear in position and speed."""

from __future__ import annotations

from typing import Any

import numpy as np

from lcplab._import import joints
from lcplab._import.model import Model
from lcplab._import.refused import Log
from lcplab._receipt.mujoco import is_disabled

#: The largest difference of a joint's force from the sum over its actuators (relative).
SAME = 1e-9


def constraints(model: Model, log: Log) -> list[dict[str, Any]]:
    """The motors, springs and dampers that act as the actuators do at the imported control.

    A control that stays the same makes the force of an actuator a function of position and speed. An actuator without
    force is noted, and one that cannot be expressed refused.
    """
    own, found, idle = model.model, list[dict[str, Any]](), []
    for number in range(own.nu):
        name = model.name("actuator", number)
        reasons = _properties(model, number)
        if not reasons and not _is_idle(model, number):
            made = _drive(model, number)
            if isinstance(made, str):
                reasons = [made]
            else:
                found += made
        elif not reasons:
            idle.append(repr(name))
        for reason in reasons:
            log.refuse("actuator", name, reason, place=("actuator", number))
    if idle:
        log.note(f"actuators that exert no force at this control are left out: {', '.join(idle)}")
    if found:
        log.note("controls of actuators stay as they are at the imported state")
    return found


def _properties(model: Model, number: int) -> list[str]:
    """Why an actuator acts on a joint even without control: MuJoCo adds its rotor and its damping to the joint's."""
    reasons = []
    for field, reason in (
        ("armature", "a scene has no inertia of rotors"),
        ("damping", "a damper of an actuator has no counterpart; give it to the joint, times gear²"),
        ("dampingpoly", "damping with terms of higher order has no counterpart"),
    ):
        values = getattr(model.model, f"actuator_{field}", None)
        if values is not None and np.any(values[number]):
            reasons.append(f"{field} = {' '.join(f'{value:g}' for value in np.ravel(values[number]))}: {reason}")
    return reasons


def _is_idle(model: Model, number: int) -> bool:
    """Whether an actuator exerts no force at any position and speed, as long as its control stays."""
    own, data, group = model.model, model.data, int(model.model.actuator_group[number])
    if is_disabled(own, "ACTUATION") or (0 <= group < 31 and int(own.opt.disableactuator) >> group & 1):
        return True
    has_feedback = int(own.actuator_biastype[number]) != 0 or int(own.actuator_gaintype[number]) != 0
    return not has_feedback and not _changes(model, number) and data.actuator_force[number] == 0


def _changes(model: Model, number: int) -> bool:
    """Whether an activation changes or a control arrives later, so that the force changes while the control stays."""
    own, data = model.model, model.data
    if hasattr(own, "actuator_delay") and own.actuator_delay[number] > 0:
        return True
    if own.actuator_dyntype[number] == 0:
        return False
    first = int(own.actuator_actadr[number])
    return bool(np.any(data.act_dot[first : first + int(own.actuator_actnum[number])]))


def _drive(model: Model, number: int) -> list[dict[str, Any]] | str:
    """The constraints of one actuator, or why there are none."""
    own, data, mujoco = model.model, model.data, model.mujoco
    if _changes(model, number):
        return "its activation changes or its control is delayed, which has no counterpart"
    if int(own.actuator_gaintype[number]) != int(mujoco.mjtGain.mjGAIN_FIXED):
        return "its force is not linear in position and speed, which has no counterpart"
    bias = np.zeros(3)
    if (law := int(own.actuator_biastype[number])) == int(mujoco.mjtBias.mjBIAS_AFFINE):
        bias = np.array(own.actuator_biasprm[number, :3])
    elif law != int(mujoco.mjtBias.mjBIAS_NONE):
        return "its force is not linear in position and speed, which has no counterpart"
    if int(own.actuator_trntype[number]) not in (int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT)):
        return "its force acts on a tendon, a site or a body, which has no counterpart"
    joint = int(own.actuator_trnid[number, 0])
    if bias[1:].any() and (own.actuator_forcelimited[number] or own.jnt_actfrclimited[joint]):
        return "its force depends on position or speed and is limited, which has no counterpart"
    if (bias[1:] > 0).any():
        return "its force grows with position or speed, which has no counterpart"
    if not _is_sum(model, joint):
        return "the limit of its joint's actuator force is reached, which has no counterpart"
    gear = float(own.actuator_gear[number, 0])
    speed = gear * float(data.qvel[own.jnt_dofadr[joint]])
    constant = gear * float(data.actuator_force[number] - bias[2] * speed)
    return joints.driven(model, joint, constant, *(-gear**2 * bias[1:]))


def _is_sum(model: Model, joint: int) -> bool:
    """Whether the force on a joint is the sum over its actuators, and not limited."""
    own, data = model.model, model.data
    dof = int(own.jnt_dofadr[joint])
    total = float(sum(
        own.actuator_gear[k, 0] * data.actuator_force[k] for k in range(own.nu)
        if own.actuator_trnid[k, 0] == joint and int(own.actuator_trntype[k]) in (0, 1)
    ))
    return abs(total - data.qfrc_actuator[dof]) <= SAME * abs(total) or not own.jnt_actfrclimited[joint]
