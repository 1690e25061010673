"""Whether each active equality of MuJoCo has its constraint rows."""

from __future__ import annotations

from typing import Any

import numpy as np

from lcplab._receipt import mujoco as reader
from lcplab._receipt.findings import Finding, Report
from lcplab._receipt.kinematics import Kinematics

CONNECT, WELD, JOINT = 0, 1, 2
#: The rows of an equality of each type; those of tendons and flexes are not checked.
ROWS = {CONNECT: 3, WELD: 6, JOINT: 1}
#: The engine drops rows whose J is 0; J (m or 1 per degree of freedom) below this may be 0.
SMALL = 1e-6


def check(model: Any, data: Any, motion: Kinematics) -> Report:
    """The first active equality with another number of rows than its type has."""
    if model.neq == 0 or reader.is_disabled(model, "EQUALITY", "CONSTRAINT") or reader.are_asleep(data):
        return Report()
    kinds = np.asarray(data.efc_type[: int(data.nefc)])
    numbers = np.asarray(data.efc_id[: int(data.nefc)])[kinds == reader.EQUALITY]
    counted = [
        number for number in range(model.neq)
        if data.eq_active[number] and int(model.eq_type[number]) in ROWS and _moves(model, data, motion, number)
    ]
    for number in counted:
        has, needs = int(np.sum(numbers == number)), ROWS[int(model.eq_type[number])]
        if has != needs:
            return Report([_missing(model, number, has, needs)])
    return Report([Finding("assembly", "an active equality has no constraint rows", 0.0, 0.0)] if counted else [])


def _missing(model: Any, number: int, has: int, needs: int) -> Finding:
    import mujoco

    name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_EQUALITY, number) or f"equality {number}"
    bodies = tuple(
        str(mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_BODY, body) or f"body {body}")
        for body in (_bodies(model, number) if int(model.eq_type[number]) != JOINT else ())
    )
    what = f"the active equality {name} has {has} constraint rows instead of {needs}"
    return Finding("assembly", what, np.inf, 0.0, None, bodies)


def _is_by_sites(model: Any, number: int) -> bool:
    """Whether the equality is given by sites, which old versions do not have."""
    import mujoco

    return hasattr(model, "eq_objtype") and int(model.eq_objtype[number]) == int(mujoco.mjtObj.mjOBJ_SITE)


def _bodies(model: Any, number: int) -> tuple[int, int]:
    """The two bodies of a connect or a weld, which may be given by sites."""
    objects = int(model.eq_obj1id[number]), int(model.eq_obj2id[number])
    if _is_by_sites(model, number):
        return int(model.site_bodyid[objects[0]]), int(model.site_bodyid[objects[1]])
    return objects


def _moves(model: Any, data: Any, motion: Kinematics, number: int) -> bool:
    """Whether J of the equality is clearly not 0."""
    if int(model.eq_type[number]) == JOINT:
        return True
    first, second = _bodies(model, number)
    if int(model.eq_type[number]) == WELD:
        return bool(np.abs(motion.angular[first] - motion.angular[second]).max(initial=0.0) > SMALL)
    if _is_by_sites(model, number):
        at = np.asarray(data.site_xpos[model.eq_obj1id[number]])
    else:
        at = data.xpos[first] + np.reshape(data.xmat[first], (3, 3)) @ model.eq_data[number][:3]
    return bool(np.abs(motion.point(first, at) - motion.point(second, at)).max(initial=0.0) > SMALL)
