"""Masses, inertias and states: one body of a scene for each group of welded bodies.

A body of a scene has its center of mass as origin and its principal axes as axes.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from lcplab._import.model import Array, Model
from lcplab._import.refused import Log

#: Products of inertia below this fraction of the largest moment are rounding errors.
DIAGONAL = 1e-13


@dataclass(frozen=True)
class Inertia:
    """Mass (kg), center of mass (m) and tensor about it (kg m²), in world axes."""

    mass: float
    center: Array
    tensor: Array
    #: The principal axes as columns, where MuJoCo states them, else None.
    axes: Array | None


def inertia(model: Model, root: int) -> Inertia:
    """The inertia of a group."""
    own, data = model.model, model.data
    parts = [body for body in model.groups[root] if own.body_mass[body] > 0]
    masses = own.body_mass[parts]
    mass = float(masses.sum())
    center = masses @ data.xipos[parts] / mass
    tensor = np.zeros((3, 3))
    for body in parts:
        axes = data.ximat[body].reshape(3, 3)
        arm = data.xipos[body] - center
        tensor += axes @ np.diag(own.body_inertia[body]) @ axes.T
        tensor += own.body_mass[body] * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    axes = data.ximat[parts[0]].reshape(3, 3) if len(parts) == 1 else None
    return Inertia(mass, center, (tensor + tensor.T) / 2, axes)


def principal_axes(own: Inertia, preferred: Array | None) -> Array:
    """Right-handed principal axes as columns: the preferred ones, if they are principal."""
    for axes in (preferred, own.axes):
        if axes is not None and is_principal(own, axes):
            return axes
    axes = np.linalg.eigh(own.tensor)[1]
    axes[:, 2] = np.cross(axes[:, 0], axes[:, 1])
    return np.asarray(axes)


def is_principal(own: Inertia, axes: Array) -> bool:
    """Whether the tensor has no products of inertia in these axes."""
    turned = axes.T @ own.tensor @ axes
    products = turned - np.diag(np.diag(turned))
    return bool(np.abs(products).max() <= DIAGONAL * np.abs(turned).max())


def state(model: Model, root: int, own: Inertia, axes: Array) -> dict[str, Any]:
    """Mass, moments, pose and velocities of a group, as fields of a body."""
    twist = np.zeros(6)
    kind = model.mujoco.mjtObj.mjOBJ_XBODY
    model.mujoco.mj_objectVelocity(model.model, model.data, kind, root, twist, 0)
    spin, arm = twist[:3], own.center - model.data.xpos[root]
    return {
        "mass": own.mass,
        "inertia": np.diag(axes.T @ own.tensor @ axes).tolist(),
        "position": own.center.tolist(),
        "rotation": {"quaternion": quaternion(axes)},
        "velocity": (twist[3:] + np.cross(spin, arm)).tolist(),
        "angular_velocity": spin.tolist(),
    }


def compensation(model: Model, root: int, log: Log) -> dict[str, Any]:
    """The constant force of ``gravcomp``, as fields of a body."""
    own = model.model
    lifted = [body for body in model.groups[root] if own.body_gravcomp[body] and own.body_mass[body] > 0]
    if not lifted or not gravity(model).any():
        return {}
    with_mass = [body for body in model.groups[root] if own.body_mass[body] > 0]
    shares = {float(own.body_gravcomp[body]) for body in lifted}
    if len(shares) > 1 or lifted != with_mass:
        log.refuse("body", model.names[root], "its welded bodies have different gravcomp", place=("body", root))
        return {}
    force = -shares.pop() * float(own.body_mass[with_mass].sum()) * gravity(model)
    return {"force": force.tolist()}


def gravity(model: Model) -> Array:
    """The acceleration of gravity (m/s²)."""
    from lcplab._receipt.mujoco import is_disabled

    return np.zeros(3) if is_disabled(model.model, "GRAVITY") else np.array(model.model.opt.gravity)


def quaternion(axes: Array) -> list[float]:
    """The quaternion (w, x, y, z) of a rotation matrix."""
    import mujoco

    found = np.zeros(4)
    mujoco.mju_mat2Quat(found, np.ascontiguousarray(axes).ravel())
    return [float(value) for value in found]
