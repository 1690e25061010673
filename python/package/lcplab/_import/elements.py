"""Elements of a model besides bodies and joints: equalities, options and applied forces."""

from __future__ import annotations

from typing import Any

import numpy as np

from lcplab._import.model import Model
from lcplab._import.refused import Log
from lcplab._receipt.mujoco import is_disabled

#: The largest violation (m, or the size of a rotation's quaternion) of an equality at the imported state.
SATISFIED = 1e-9
CONNECT, WELD = 0, 1
#: Flags that change what a model does and have no counterpart.
FLAGS = ("LIMIT", "FRICTIONLOSS", "EQUALITY", "SPRING", "DAMPER", "CONSTRAINT")


def equalities(model: Model, log: Log) -> list[dict[str, Any]]:
    """The active equalities: ``connect`` is a ball joint, ``weld`` is fixed."""
    own, found = model.model, []
    for number in range(own.neq):
        if not model.data.eq_active[number]:
            continue
        kind = model.mujoco.mjtEq(int(own.eq_type[number])).name.removeprefix("mjEQ_").lower()
        name = model.name("equality", number)
        constraint = _equality(model, number)
        if isinstance(constraint, str):
            log.refuse(kind, name, constraint, place=("equality", number))
        else:
            found.append(constraint)
    return found


def _equality(model: Model, number: int) -> dict[str, Any] | str:
    own, data = model.model, model.data
    kind = int(own.eq_type[number])
    if kind not in (CONNECT, WELD):
        return "an equality of this kind, such as a coupling of joints, has no counterpart"
    if int(own.eq_objtype[number]) != int(model.mujoco.mjtObj.mjOBJ_BODY):
        return "an equality of two sites is not read; join the bodies instead"
    one, other = int(own.eq_obj1id[number]), int(own.eq_obj2id[number])
    roots = [model.root(one), model.root(other)]
    bodies = model.bodies_of(*roots)
    if roots[0] == roots[1] or not bodies:
        return "joins bodies that do not move relative to each other"
    first, second = own.eq_data[number, :3], own.eq_data[number, 3:6]
    anchors = (first, second) if kind == CONNECT else (second, first)
    points = [
        data.xpos[body] + data.xmat[body].reshape(3, 3) @ anchor for body, anchor in zip((one, other), anchors)
    ]
    error = float(np.linalg.norm(points[0] - points[1]))
    if kind == WELD:
        error = max(error, _turned(model, number, one, other))
    if error > SATISFIED:
        return f"is violated by {error:.2g} at the imported state; a scene's joints are satisfied at the start"
    place = {"bodies": bodies, "point": points[0].tolist()}
    if kind == WELD:
        return {"kind": "fixed", **place}
    return {"kind": "ball" if len(bodies) == 2 else "nail", **place}


def _turned(model: Model, number: int, one: int, other: int) -> float:
    """The error of the relative orientation of a weld."""
    own, data, mujoco = model.model, model.data, model.mujoco
    wanted, inverse, error = np.zeros(4), np.zeros(4), np.zeros(4)
    mujoco.mju_mulQuat(wanted, data.xquat[one], own.eq_data[number, 6:10])
    mujoco.mju_negQuat(inverse, data.xquat[other])
    mujoco.mju_mulQuat(error, inverse, wanted)
    return float(np.linalg.norm(error[1:]))


def check_options(model: Model, log: Log) -> None:
    """Options, flags and applied forces that have no counterpart."""
    own, data = model.model, model.data
    for field, what in (("density", "a fluid"), ("viscosity", "a fluid"), ("wind", "wind")):
        if np.any(getattr(own.opt, field)):
            log.refuse("option", field, f"forces of {what} have no counterpart")
    for flag in FLAGS:
        if is_disabled(own, flag):
            log.refuse("flag", flag.lower(), "is disabled; a scene has no such flag")
    if own.opt.enableflags & int(model.mujoco.mjtEnableBit.mjENBL_OVERRIDE):
        log.refuse("flag", "override", "is enabled, and replaces margin and softness of all contacts")
    for tree in _sleeping(model):
        body = int(np.flatnonzero(own.body_treeid == tree)[0])
        log.refuse("body", model.names[body], "sleep = init: a body that is asleep at the start has no counterpart", place=("body", body))
    for field in ("qfrc_applied", "xfrc_applied"):
        if np.any(getattr(data, field)):
            log.refuse("data", field, "applied forces are not translated")
    if own.nflex:
        log.refuse("flex", f"{own.nflex} flexes", "deformable bodies have no counterpart")
    if own.nplugin:
        log.refuse("plugin", f"{own.nplugin} plugins", "plugins have no counterpart")
    log.note("contacts, limits and equalities are rigid: solref and solimp are not translated")


def _sleeping(model: Model) -> list[int]:
    """The trees that sleep from the start, so that they do not fall, as far as this version has them."""
    own, mujoco = model.model, model.mujoco
    is_enabled = own.opt.enableflags & int(getattr(mujoco.mjtEnableBit, "mjENBL_SLEEP", 0))
    if not is_enabled or not hasattr(own, "tree_sleep_policy"):
        return []
    return [int(tree) for tree in np.flatnonzero(own.tree_sleep_policy == int(mujoco.mjtSleepPolicy.mjSLEEP_INIT))]
