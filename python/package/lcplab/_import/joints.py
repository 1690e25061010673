"""Joints: the constraints of a scene that leave a body the motions of its joints in MuJoCo.

All joints of one body are translated together, because a scene has no bodies without mass between them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from lcplab._import.model import Array, Model
from lcplab._import.refused import Log

FREE, BALL, SLIDE, HINGE = range(4)
#: Axes, points and positions that differ by less than this (relative, m or rad) are the same.
SAME = 1e-9
#: A speed (m/s or rad/s) that no joint reaches: a motor that aims at it exerts its whole effort.
OUT_OF_REACH = 1e4
#: The arm (m) of a spring along a slide, added to the length of its range.
ARM = 10.0

#: Properties of joints; the first one has a counterpart for no joint.
FIELDS = ("armature", "stiffness", "damping", "frictionloss")

Constraint = dict[str, Any]


@dataclass(frozen=True)
class Joint:
    """A joint at the imported state: a point and an axis in world axes."""

    number: int
    name: str
    kind: int
    point: Array
    axis: Array
    position: float

    def refuse(self, reason: str, body: str, log: Log) -> None:
        """Add to the list of what has no counterpart."""
        log.refuse("joint", self.name, reason, body, ("joint", self.number))


def of_group(model: Model, root: int, log: Log) -> list[Constraint]:
    """The constraints between a moving group and its parent."""
    first, count = int(model.model.body_jntadr[root]), int(model.model.body_jntnum[root])
    joints = [_joint(model, number) for number in range(first, first + count)]
    if joints[0].kind == FREE:
        _check_free(model, root, joints[0], log)
        return []
    bodies = model.bodies_of(model.parent(root), root)
    found = _kinematics(joints, bodies)
    if isinstance(found, str):
        joints[0].refuse(f"{found}; if skipped, the body is welded", model.names[root], log)
        return [{"kind": "fixed", "bodies": bodies}]
    for joint in joints:
        found += _passive(model, root, joint, joints, bodies, log)
    return found


def _joint(model: Model, number: int) -> Joint:
    own = model.model
    kind = int(own.jnt_type[number])
    position = float(model.data.qpos[own.jnt_qposadr[number]]) if kind in (SLIDE, HINGE) else 0.0
    name = model.name("joint", number)
    return Joint(number, name, kind, model.data.xanchor[number].copy(), model.data.xaxis[number].copy(), position)


def _kinematics(joints: list[Joint], bodies: list[str]) -> list[Constraint] | str:
    """The constraints of the joints' motions, or the reason why there are none."""
    kinds = [joint.kind for joint in joints]
    if kinds == [BALL]:
        return [_ball(joints[0].point, bodies)]
    if BALL in kinds:
        return "a ball joint with other joints of the same body has no counterpart"
    if kinds != sorted(kinds):
        return "a slide after a hinge of the same body has no counterpart, because the slide turns with the hinge"
    slides = [joint for joint in joints if joint.kind == SLIDE]
    hinges = [joint for joint in joints if joint.kind == HINGE]
    for own in (slides, hinges):
        if own and np.linalg.matrix_rank(np.array([joint.axis for joint in own]), tol=1e-6) < len(own):
            return "the axes of the joints of this body depend on each other"
    if not slides:
        return _hinges(hinges, bodies)
    if not hinges:
        return _slides(slides, bodies)
    return _planar(slides, hinges, bodies)


def _ball(point: Array, bodies: list[str]) -> Constraint:
    return {"kind": "ball" if len(bodies) == 2 else "nail", "bodies": bodies, "point": point.tolist()}


def _hinges(hinges: list[Joint], bodies: list[str]) -> list[Constraint] | str:
    first = hinges[0]
    if len(hinges) == 1:
        return [{"kind": "hinge", "bodies": bodies, "axis": first.axis.tolist(), "point": first.point.tolist()}]
    point = _common_point(hinges)
    if point is None:
        return "hinges of one body whose axes do not meet in a point have no counterpart"
    if len(hinges) == 3:
        return [_ball(point, bodies)]
    axes = [joint.axis for joint in hinges]
    if abs(axes[0] @ axes[1]) > SAME:
        return "two hinges of one body whose axes are not perpendicular have no counterpart"
    return [{"kind": "universal", "bodies": bodies, "axes": [axis.tolist() for axis in axes], "point": point.tolist()}]


def _common_point(hinges: list[Joint]) -> Array | None:
    """The point that all axes pass through."""
    across = [np.eye(3) - np.outer(joint.axis, joint.axis) for joint in hinges]
    total = np.sum(across, axis=0)
    base = hinges[0].point
    point = base + np.linalg.solve(total, sum(p @ (joint.point - base) for p, joint in zip(across, hinges)))
    misses = [np.linalg.norm(p @ (point - joint.point)) for p, joint in zip(across, hinges)]
    return np.asarray(point) if max(misses) <= SAME else None


def _slides(slides: list[Joint], bodies: list[str]) -> list[Constraint]:
    axes = [joint.axis for joint in slides]
    if len(axes) == 1:
        return [{"kind": "slider", "bodies": bodies, "axis": axes[0].tolist()}]
    orientation: list[Constraint] = [{"kind": "orientation", "bodies": bodies}]
    if len(axes) == 3:
        return orientation
    normal = np.cross(axes[0], axes[1])
    return [{"kind": "lock_translation", "bodies": bodies, "axis": normal.tolist()}, *orientation]


def _planar(slides: list[Joint], hinges: list[Joint], bodies: list[str]) -> list[Constraint] | str:
    """Slides followed by hinges."""
    axis = hinges[0].axis
    if len(hinges) == 3 and len(slides) == 3:
        return []
    if len(hinges) == 1:
        if len(slides) == 1 and np.linalg.norm(np.cross(slides[0].axis, axis)) <= SAME:
            return [{"kind": "cylindrical", "bodies": bodies, "axis": axis.tolist(), "point": hinges[0].point.tolist()}]
        turn: list[Constraint] = [
            {"kind": "lock_rotation", "bodies": bodies, "axis": across.tolist()} for across in _perpendicular(axis)
        ]
        if len(slides) == 3:
            return turn
        if len(slides) == 2 and max(abs(joint.axis @ axis) for joint in slides) <= SAME:
            return [{"kind": "lock_translation", "bodies": bodies, "axis": axis.tolist()}, *turn]
    return f"{len(slides)} slides and {len(hinges)} hinges of one body in these directions have no counterpart"


def _perpendicular(axis: Array) -> list[Array]:
    first = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    first /= np.linalg.norm(first)
    return [first, np.cross(axis, first)]


def _check_free(model: Model, root: int, joint: Joint, log: Log) -> None:
    for field in ("armature", "stiffness", "damping", "frictionloss"):
        if any(np.any(values) for values in _values(model, joint, field)):
            joint.refuse(f"{field} of a free joint has no counterpart", model.names[root], log)


def _values(model: Model, joint: Joint, field: str) -> list[Array]:
    """The linear value of a property of a joint, and its terms of higher order, if it has any."""
    own, number = model.model, joint.number
    first = int(own.jnt_dofadr[number])
    dofs = slice(first, first + {FREE: 6, BALL: 3}.get(joint.kind, 1))
    prefix, at = ("jnt_", number) if field == "stiffness" else ("dof_", dofs)
    names = [name for name in (f"{prefix}{field}", f"{prefix}{field}poly") if hasattr(own, name)]
    return [np.ravel(getattr(own, name)[at]) for name in names]


def _passive(
    model: Model, root: int, joint: Joint, joints: list[Joint], bodies: list[str], log: Log
) -> list[Constraint]:
    """Range, spring, damper and friction of a joint; its armature has no counterpart."""
    own = model.model

    def refuse(reason: str) -> None:
        joint.refuse(reason, model.names[root], log)

    linear = {field: float(np.max(_values(model, joint, field)[0])) for field in FIELDS}
    if linear["armature"] > 0:
        refuse(f"armature = {linear['armature']:g}: a scene has no inertia of rotors")
    is_limited = bool(own.jnt_limited[joint.number])
    hinges = [other for other in joints if other.kind == HINGE]
    if joint.kind == BALL or (joint.kind == HINGE and len(hinges) > 1):
        is_of = "a ball joint" if joint.kind == BALL else "one of several hinges of a body"
        acts = {field: any(np.any(values) for values in _values(model, joint, field)) for field in FIELDS[1:]}
        for field, is_present in ({"range": is_limited} | acts).items():
            if is_present:
                refuse(f"{field} of {is_of} has no counterpart")
        return []
    found: list[Constraint] = []
    word = "translation" if joint.kind == SLIDE else "rotation"
    base: Constraint = {"bodies": bodies, "axis": joint.axis.tolist()}
    place = {"point": joint.point.tolist()} if joint.kind == SLIDE else {}
    if is_limited:
        # MuJoCo stops the joint at this distance from its range.
        margin = float(own.jnt_margin[joint.number])
        lower, upper = own.jnt_range[joint.number].astype(float) + (margin, -margin)
        if not lower <= joint.position <= upper:
            within = f"{lower:g} … {upper:g}" + (", the range less margin" if margin else "")
            refuse(f"range: the position {joint.position:g} is outside of {within}")
        elif lower == upper or (joint.kind == HINGE and upper - lower >= 2 * np.pi):
            refuse(f"range = {lower:g} {upper:g}: stops must differ, and be less than a turn apart")
        else:
            limits = [float(lower - joint.position), float(upper - joint.position)]
            found.append({"kind": f"limit_{word}", **base, **place, "limits": limits})
    if loss := linear["frictionloss"]:
        found.append({"kind": f"motor_{word}", **base, **place, "speed": 0.0, "effort": loss})
    terms = [_values(model, joint, field) for field in ("stiffness", "damping")]
    if any(np.any(higher) for _, *rest in terms for higher in rest):
        refuse("stiffness and damping with terms of higher order have no counterpart")
    elif linear["stiffness"] or linear["damping"]:
        spring = _spring(model, joint, joints, bodies, linear["stiffness"], linear["damping"])
        if isinstance(spring, str):
            refuse(spring)
        else:
            found += spring
    return found


def driven(model: Model, number: int, force: float, stiffness: float, damping: float) -> list[Constraint] | str:
    """The constraints of a force along a joint, ``force - stiffness * (q - q0) - damping * q'``, or why there are none."""
    root = model.root(int(model.model.jnt_bodyid[number]))
    first, count = int(model.model.body_jntadr[root]), int(model.model.body_jntnum[root])
    joints = [_joint(model, k) for k in range(first, first + count)]
    joint, bodies = joints[number - first], model.bodies_of(model.parent(root), root)
    if joint.kind not in (SLIDE, HINGE) or (joint.kind == HINGE and sum(each.kind == HINGE for each in joints) > 1):
        return "its force acts on a free or ball joint or on one of several hinges of a body, which has no counterpart"
    if isinstance(_kinematics(joints, bodies), str):
        return "its joint has no counterpart"
    if joint.kind == SLIDE and len(joints) > 1 and (stiffness or damping):
        return "its force depends on the position or speed of a slide of a body with other joints, which has no counterpart"
    found = [_constant(joint, bodies, force)] if force else []
    if joint.kind == HINGE and (stiffness or damping):
        law = {"stiffness": stiffness, "damping": damping}
        found.append({"kind": "spring_rotation", "bodies": bodies, "axis": joint.axis.tolist(), **law})
    elif stiffness or damping:
        found.append(_along_slide(model, joint, bodies, 0.0, stiffness, damping))
    return found


def _constant(joint: Joint, bodies: list[str], force: float) -> Constraint:
    """A constant force or torque along a joint."""
    word, place = ("translation", {"point": joint.point.tolist()}) if joint.kind == SLIDE else ("rotation", {})
    speed = float(np.copysign(OUT_OF_REACH, force))
    axis = {"bodies": bodies, "axis": joint.axis.tolist()}
    return {"kind": f"motor_{word}", **axis, **place, "speed": speed, "effort": abs(float(force))}


def _spring(
    model: Model, joint: Joint, joints: list[Joint], bodies: list[str], stiffness: float, damping: float
) -> list[Constraint] | str:
    """A spring and damper, or the reason why a scene has none."""
    own = model.model
    stretch = joint.position - float(own.qpos_spring[own.jnt_qposadr[joint.number]])
    if joint.kind == HINGE:
        law = {"bodies": bodies, "stiffness": stiffness, "damping": damping}
        spring: Constraint = {"kind": "spring_rotation", "axis": joint.axis.tolist(), **law}
        # A torsion spring of a scene starts at rest.
        wound = -stiffness * stretch if abs(stretch) > SAME else 0.0
        return [spring, _constant(joint, bodies, wound)] if wound else [spring]
    if len(joints) > 1:
        return "stiffness and damping of a slide with other joints of the same body have no counterpart"
    return [_along_slide(model, joint, bodies, stretch if stiffness else 0.0, stiffness, damping)]


def _along_slide(
    model: Model, joint: Joint, bodies: list[str], stretch: float, stiffness: float, damping: float
) -> Constraint:
    """A spring between two points on the axis of a slide."""
    # The distance of two points on the axis changes as the slide does, as long as they are on the same side.
    arm = ARM + abs(stretch) + float(np.ptp(model.model.jnt_range[joint.number]))
    points = [(joint.point - arm * joint.axis).tolist(), joint.point.tolist()]
    law = {"bodies": bodies, "stiffness": stiffness, "damping": damping}
    return {"kind": "spring", "points": points, "length": arm - stretch, **law}
