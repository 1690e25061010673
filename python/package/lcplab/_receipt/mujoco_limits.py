"""Rows of MuJoCo's joint limits and friction losses, and coefficients of contact friction, from the model and the position."""

from __future__ import annotations

from typing import Any

import numpy as np

from lcplab._receipt import mujoco as reader
from lcplab._receipt.findings import Finding, Report
from lcplab._receipt.step import Array, Rows, Step

#: The largest accepted error: of distances (m, rad) and of J, and relative to losses and coefficients.
LIMIT = 1e-6
#: A limit this close to its margin (m, rad) may have its row or not: rounding decides.
UNCERTAIN = 1e-9
BALL = 1
#: The engine raises coefficients of friction to this.
LEAST_FRICTION = 1e-5


def check(model: Any, data: Any, step: Step, qpos: Array) -> Report:
    """Each part that is wrong, or that all are right."""
    if reader.is_disabled(model, "CONSTRAINT") or reader.are_asleep(data):
        return Report()
    report = Report()
    kinds, numbers = np.array(data.efc_type[: len(step)]), np.array(data.efc_id[: len(step)])
    if np.any(model.jnt_limited) and not reader.is_disabled(model, "LIMIT"):
        report.findings.append(_limits(model, data, step, qpos, kinds, numbers))
    if np.any(model.dof_frictionloss) and not reader.is_disabled(model, "FRICTIONLOSS"):
        report.findings.append(_losses(model, step, np.flatnonzero(kinds == reader.FRICTION_DOF), numbers))
    if data.ncon:
        report.findings.append(_coefficients(model, data))
    return report


def _limits(model: Any, data: Any, step: Step, qpos: Array, kinds: Rows, numbers: Rows) -> Finding:
    """The rows of the limits of each joint against those that its position requires."""
    rows = np.flatnonzero(kinds == reader.LIMIT_JOINT)
    jacobian = step.dense_jacobian()[rows] if len(rows) else np.zeros((0, model.nv))
    positions = np.array(data.efc_pos)[rows]
    worst = Finding("assembly", "a row of a joint limit differs from that of its joint", 0.0, LIMIT)
    for joint in _active(model, qpos, numbers[rows]):
        sides = _sides(model, joint, qpos)
        own = np.flatnonzero(numbers[rows] == joint)
        name = _joint(model, joint)
        bodies = (reader.names_of(model).bodies[model.jnt_bodyid[joint]],)
        needed = [side for side in sides if side[0] < model.jnt_margin[joint] - UNCERTAIN]
        possible = [side for side in sides if side[0] < model.jnt_margin[joint] + UNCERTAIN]
        if not len(needed) <= len(own) <= len(possible):
            what = f"the limit of {name} has {len(own)} constraint rows instead of {len(needed)}"
            return Finding("assembly", what, np.inf, 0.0, None, bodies)
        for row in own.tolist():
            errors = [max(abs(positions[row] - distance), float(np.abs(jacobian[row] - line).max()))
                      for distance, line in possible]
            error = min(errors)
            if not error <= worst.error:
                what = f"the row of the limit of {name} is not that of its position and axis"
                worst = Finding("assembly", what, error, LIMIT, int(rows[row]), bodies)
    return worst


def _active(model: Any, qpos: Array, numbers: Rows) -> list[int]:
    """The joints that have rows, or may need them."""
    limited = np.flatnonzero(model.jnt_limited)
    low, high = np.array(model.jnt_range)[limited].T
    values = qpos[np.array(model.jnt_qposadr)[limited]]
    near = np.minimum(values - low, high - values) < np.array(model.jnt_margin)[limited] + UNCERTAIN
    near |= np.array(model.jnt_type)[limited] == BALL
    return sorted({*limited[near].tolist(), *numbers.tolist()})


def _sides(model: Any, joint: int, qpos: Array) -> list[tuple[float, Array]]:
    """The distance from each limit (m, rad), negative beyond it, with its row of J."""
    low, high = model.jnt_range[joint].tolist()
    place, first = int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
    line = np.zeros(model.nv)
    if int(model.jnt_type[joint]) == BALL:
        quaternion = qpos[place : place + 4]
        length = float(np.linalg.norm(quaternion[1:]))
        angle = 2 * np.arctan2(length, quaternion[0])
        turn = angle - 2 * np.pi if angle > np.pi else angle
        line[first : first + 3] = -np.sign(turn) * quaternion[1:] / max(length, 1e-300)
        return [(max(low, high) - abs(turn), line)]
    line[first] = 1.0
    value = float(qpos[place])
    return [(value - low, line), (high - value, -line)]


def _joint(model: Any, joint: int) -> str:
    import mujoco

    return str(mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_JOINT, joint) or f"joint {joint}")


def _losses(model: Any, step: Step, rows: Rows, numbers: Rows) -> Finding:
    """A row with the bounds of its loss for each degree of freedom that has one."""
    losses = np.array(model.dof_frictionloss)
    dofs = numbers[rows]
    has, needs = sorted(dofs.tolist()), np.flatnonzero(losses).tolist()
    if has != needs:
        lost = sorted(set(needs) ^ set(has)) or has
        what = f"{len(has)} degrees of freedom have rows of friction loss instead of {len(needs)}"
        return Finding("assembly", what, np.inf, 0.0, None, (reader.names_of(model).dofs[lost[0]],))
    unit = np.zeros((len(rows), model.nv))
    unit[np.arange(len(rows)), dofs] = 1.0
    of_bounds = np.abs(np.array([-step.lo[rows], step.hi[rows]]) / losses[dofs] - 1).max(axis=0)
    errors = np.maximum(np.abs(step.dense_jacobian()[rows] - unit).max(axis=1), of_bounds)
    worst = int(np.argmax(errors))
    what = "a row of friction loss is not that of its degree of freedom"
    bodies = (reader.names_of(model).dofs[dofs[worst]],)
    return Finding("assembly", what, float(errors[worst]), LIMIT, int(rows[worst]), bodies)


def _coefficients(model: Any, data: Any) -> Finding:
    """The number of axes and the coefficients of friction of contacts, by MuJoCo's rule for two shapes or for a pair."""
    import mujoco

    what = "the coefficients of friction of a contact, or their number, are not those of its shapes"
    shapes = reader.shapes_of(data)
    rigid = np.flatnonzero((shapes >= 0).all(axis=1))
    if len(rigid) == 0:
        return Finding("assembly", what, 0.0, LIMIT)
    own = shapes[rigid]
    expected, sizes = _mixed(model, own)
    for pair in range(model.npair):
        ends = {int(model.pair_geom1[pair]), int(model.pair_geom2[pair])}
        same = [set(geoms) == ends for geoms in own.tolist()]
        expected[same], sizes[same] = model.pair_friction[pair], model.pair_dim[pair]
    if model.opt.enableflags & int(mujoco.mjtEnableBit.mjENBL_OVERRIDE):
        expected[:] = model.opt.o_friction
    expected = np.maximum(expected, LEAST_FRICTION)
    reported, dims = np.array(data.contact.friction)[rigid], np.array(data.contact.dim)[rigid]
    errors = np.abs(reported / expected - 1)
    errors[np.arange(1, 6) >= dims[:, None]] = 0.0
    errors[dims != sizes] = np.inf
    worst = int(np.argmax(errors)) // 5
    bodies = tuple(reader.names_of(model).geoms[geom] for geom in own[worst].tolist())
    return Finding("assembly", what, float(errors[worst].max()), LIMIT, None, bodies)


def _mixed(model: Any, shapes: Rows) -> tuple[Array, Rows]:
    """The five coefficients and the number of axes for pairs of shapes: of the one with priority, or else the larger."""
    friction, sizes = np.array(model.geom_friction)[shapes], np.array(model.geom_condim)[shapes]
    priority = np.array(model.geom_priority)[shapes]
    for one, other in ((0, 1), (1, 0)) if priority.any() else ():
        leads = priority[:, one] > priority[:, other]
        friction[leads, other], sizes[leads, other] = friction[leads, one], sizes[leads, one]
    return friction.max(axis=1)[:, [0, 0, 1, 2, 2]], sizes.max(axis=1)
