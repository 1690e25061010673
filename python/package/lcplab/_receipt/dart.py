"""The last step of a DART world, read and not changed.

DART reports contact points, their forces and its matrices, but not its problem. Error reduction, mixing and the bounds of
friction are those of its source code (``dart/constraint/ContactConstraint.cpp``, versions 6.17 to 6.20).
"""

from __future__ import annotations

import importlib.metadata
from typing import Any

import numpy as np

from lcplab._lcplab import InputError
from lcplab._receipt.contact_rows import ContactRows, axes_along
from lcplab._receipt.step import Array, Step

#: The fraction of an overlap that a step corrects, the largest speed (m/s) for it, the speed (m/s) above which bodies
#: bounce, and the fraction of the diagonal that is added to it.
ERP, FASTEST, BOUNCES_FROM, CFM = 0.01, 1e-3, 0.1, 1e-5
#: Squares of lengths below this are 0 in the choice of tangents.
SMALL = 1e-12
NOT_REPORTED = "assembly: error reduction, mixing and bounds of friction, which DART does not report; from its source code"


def is_mine(model: Any) -> bool:
    """Whether this is a world of DART."""
    return type(model).__module__.startswith("dartpy") and hasattr(model, "getNumSkeletons")


#: Positions, velocities, commands of joints, and generalized external forces, all (k,).
State = tuple[Array, Array, Array, Array]


def state(world: Any) -> State:
    """Copies of what a step starts from, of all skeletons one after the other.

    Positions, velocities, commands of joints, and generalized external forces; take it when all forces are set, immediately
    before the step, which resets them.
    """
    skeletons = _skeletons(world)
    return (
        _joined([skeleton.getPositions() for skeleton in skeletons]),
        _joined([skeleton.getVelocities() for skeleton in skeletons]),
        _joined([skeleton.getCommands() for skeleton in skeletons]),
        _joined([skeleton.getExternalForces() for skeleton in skeletons]),
    )


def _joined(parts: list[Any]) -> Array:
    return np.concatenate([np.zeros(0), *(np.array(part, dtype=float) for part in parts)])


def read(world: Any, before: Any) -> Step:
    """The step that the world has taken from this state.

    Raises
    ------
    InputError
        Without the state before the step, or with that of another world.
    """
    if before is None:
        raise InputError("before: is missing: DART keeps no velocities from before a step; pass lcplab.dart.state(world)")
    skeletons = _skeletons(world)
    first = np.concatenate([[0], np.cumsum([skeleton.getNumDofs() for skeleton in skeletons])]).astype(int)
    size = int(first[-1])
    if len(before) != 4 or any(np.shape(part) != (size,) for part in before):
        shapes = ", ".join(str(np.shape(part)) for part in before)
        raise InputError(f"before: has the shapes {shapes}, must be the lcplab.dart.state of this world: 4 times ({size},)")
    dt = float(world.getTimeStep())
    twin = world.clone()
    mass, target, gravity = np.zeros((size, size)), np.zeros(size), np.zeros(size)
    for number, own in enumerate(_skeletons(twin)):
        place = slice(first[number], first[number + 1])
        if place.start == place.stop:
            continue
        own.setPositions(before[0][place])
        own.setVelocities(before[1][place])
        own.setCommands(before[2][place])
        own.computeForwardDynamics()
        mass[place, place] = np.array(own.getMassMatrix())
        target[place] = before[1][place] + dt * np.array(own.getAccelerations())
        gravity[place] = np.array(own.getGravityForces())
    motion = _joined([skeleton.getVelocities() for skeleton in skeletons])
    rows = ContactRows(size)
    for contact in world.getLastCollisionResult().getContacts():
        _add(rows, contact, twin, first, mass, target, dt)
    bounds = np.array(rows.mu) * rows.normal(mass, target) if len(rows) else np.zeros(0)
    weight = np.sqrt(max(0.0, float(gravity @ np.linalg.solve(mass, gravity)))) if size else 0.0
    return rows.step(
        "DART", bounds, mass, target, motion, version=importlib.metadata.version("dartpy"),
        gravity=dt * weight, time=float(world.getTime()), name=str(world.getName()), dof_bodies=_dof_bodies(skeletons),
        no_bound=_no_bound(world, twin, motion, before[3]) or _deep_overlaps(world, dt), not_checked=[NOT_REPORTED],
    )


def _skeletons(world: Any) -> list[Any]:
    return [world.getSkeleton(number) for number in range(world.getNumSkeletons())]


def _dof_bodies(skeletons: list[Any]) -> list[str]:
    joints = [skeleton.getJoint(number) for skeleton in skeletons for number in range(skeleton.getNumJoints())]
    return [str(joint.getChildBodyNode().getName()) for joint in joints for _ in range(joint.getNumDofs())]


def _add(rows: ContactRows, contact: Any, twin: Any, first: Array, mass: Array, target: Array, dt: float) -> None:
    """The rows of a contact, at the poses from before the step."""
    vertical = np.cross([0, 0, 1], contact.normal)
    axes = axes_along(np.array(contact.normal), [0, 0, 1] if vertical @ vertical >= SMALL else [1, 0, 0])
    lines, names, friction, restitution = np.zeros((3, rows.size)), [], [], 1.0
    for end, sign in ((contact.collisionObject1, 1), (contact.collisionObject2, -1)):
        frame = end.getShapeFrame().asShapeNode()
        node = frame.getBodyNodePtr()
        names.append(str(node.getName()))
        aspect = frame.getDynamicsAspect()
        friction.append(float(aspect.getFrictionCoeff()))
        restitution *= float(aspect.getRestitutionCoeff())
        number = next(k for k, own in enumerate(_skeletons(twin)) if own.getName() == node.getSkeleton().getName())
        skeleton = twin.getSkeleton(number)
        if skeleton.getNumDofs() == 0:
            continue
        own = skeleton.getBodyNode(node.getName())
        placed = own.getWorldTransform()
        local = np.array(placed.rotation()).T @ (np.array(contact.point) - np.array(placed.translation()))
        columns = slice(first[number], first[number + 1])
        lines[:, columns] += sign * axes @ np.array(skeleton.getLinearJacobian(own, local))
    speed = min(max(float(contact.penetrationDepth), 0.0) * ERP / dt, FASTEST)
    bounce = -restitution * float(lines[0] @ target)
    if bounce > BOUNCES_FROM:
        speed = max(speed, bounce)
    mixed = CFM * np.einsum("ij,ij->i", lines, np.linalg.solve(mass, lines.T).T)
    rows.add((names[0], names[1]), lines, dt * axes @ np.array(contact.force), -speed, mixed, min(friction))


def _no_bound(world: Any, twin: Any, motion: Array, external: Array) -> str:
    """Which rows or forces the step has that cannot be read; "" if there are none."""
    if world.getConstraintSolver().getNumConstraints():
        return "because DART does not report the impulses of constraints"
    if external.any():
        return "because external forces act on bodies"
    if len(motion) and not motion.any():
        return "because DART does not step bodies that sleep"
    for own in _skeletons(twin):
        for number in range(own.getNumJoints()):
            joint = own.getJoint(number)
            places = [joint.getPosition(k) for k in range(joint.getNumDofs())]
            limits = [(joint.getPositionLowerLimit(k), joint.getPositionUpperLimit(k)) for k in range(joint.getNumDofs())]
            if joint.areLimitsEnforced() and any(not low < at < high for at, (low, high) in zip(places, limits)):
                return f"because DART does not report the impulse of the limit of {joint.getName()}"
            if any(joint.getCoulombFriction(k) for k in range(joint.getNumDofs())):
                return f"because DART does not report the friction of {joint.getName()}"
            if joint.getNumDofs() and joint.getActuatorType().name not in ("FORCE", "PASSIVE"):
                return f"because DART does not report the impulse that drives {joint.getName()}"
    return ""


def _deep_overlaps(world: Any, dt: float) -> str:
    """Where three bodies or more touch each other, DART 6.20 corrects overlaps faster than its limit, but not in each step."""
    pairs, is_deep = set(), False
    for contact in world.getLastCollisionResult().getContacts():
        nodes = [end.getShapeFrame().asShapeNode().getBodyNodePtr() for end in (contact.collisionObject1, contact.collisionObject2)]
        moving = [node for node in nodes if node.getSkeleton().getNumDofs()]
        pairs.add(frozenset((str(node.getSkeleton().getName()), str(node.getName())) for node in moving))
        is_deep |= float(contact.penetrationDepth) * ERP > dt * FASTEST
    if is_deep and sum(len(pair) == 2 for pair in pairs) > 1:
        return "because DART does not report how fast it corrects the deep overlaps of several bodies"
    return ""
