"""MuJoCo's state around a step: the copies from before it, and numbers that are not finite."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from lcplab._receipt import finite
from lcplab._receipt.findings import Finding
from lcplab._receipt.step import Array

#: What each stage reads besides the arrays of the step.
INPUTS = {
    "collision": ("geom_xpos", "geom_xmat"),
    "assembly": ("qpos", "qvel", "act", "ctrl", "mocap_pos", "mocap_quat", "qfrc_applied", "xfrc_applied", "qfrc_bias",
                 "qfrc_passive", "qfrc_actuator", "actuator_force"),
}


def check_before(model: Any, data: Any, before: Any) -> None:
    """Reject a state before the step that is no copy, or belongs to another model.

    Raises
    ------
    ValueError
        If ``before`` is not (qpos, qvel) of this model, or shares memory with the data.
    """
    if before is None:
        return
    if len(before) != 2:
        raise ValueError(f"before: has {len(before)} parts, must be (qpos, qvel)")
    for name, values, size in zip(("qpos", "qvel"), before, (model.nq, model.nv)):
        if np.shape(values) != (size,):
            raise ValueError(f"before: {name} has the shape {np.shape(values)}, must have ({size},)")
        live = getattr(data, name)
        if isinstance(live, np.ndarray) and isinstance(values, np.ndarray) and np.shares_memory(live, values):
            raise ValueError(
                f"before: {name} is a view of data.{name}, which the step overwrites; pass data.{name}.copy(), taken "
                "before the step"
            )


def not_finite(data: Any, before: Sequence[Array] | None) -> Finding | None:
    """The first number of the state, poses and contacts that is not finite, as an error of the stage that reads it."""
    contacts = {f"contact.{name}": getattr(data.contact, name) for name in ("dist", "pos", "frame")}
    stages = {stage: {name: getattr(data, name) for name in names} for stage, names in INPUTS.items()}
    after = {}
    if before is not None:
        stages["assembly"] |= {"before: qpos": before[0], "before: qvel": before[1]}
        after = {name: stages["assembly"].pop(name) for name in ("qpos", "qvel")}
    return (
        finite.in_arrays("collision", stages["collision"] | contacts)
        or finite.in_arrays("assembly", stages["assembly"])
        or finite.in_arrays("write-back", after)
    )


def was_reset(model: Any, data: Any) -> bool:
    """Whether MuJoCo has found numbers that are not finite or huge in this step, and begun it at the state of the model."""
    import mujoco

    kinds = (mujoco.mjtWarning.mjWARN_BADQPOS, mujoco.mjtWarning.mjWARN_BADQVEL, mujoco.mjtWarning.mjWARN_BADQACC)
    is_first = 0 < float(data.time) < 1.5 * float(model.opt.timestep)
    return is_first and any(int(data.warning[int(kind)].number) for kind in kinds)


def at_reset(model: Any) -> tuple[Array, Array]:
    """The state at which such a step begins."""
    return np.array(model.qpos0, dtype=float), np.zeros(int(model.nv))
