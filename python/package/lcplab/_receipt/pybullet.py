"""The last step of a PyBullet client with free bodies, read and not changed.

PyBullet reports contact points with their impulses, masses and poses, but not its problem. The correction of penetrations and
the gap that it adds are those of its source code (``SharedMemory/PhysicsServerCommandProcessor.cpp``).
"""

from __future__ import annotations

import importlib.metadata
from typing import Any

import numpy as np

from lcplab._lcplab import InputError
from lcplab._receipt.contact_rows import ContactRows
from lcplab._receipt.step import Array, Step

#: The fraction of an overlap that a step corrects, what is added to each distance (m), the speed (m/s) above which bodies
#: bounce, and the damping (1/s) of a new body.
ERP, SLOP, BOUNCES_FROM, DAMPING = 0.08, 1e-5, 0.2, 0.04
NOT_REPORTED = (
    "assembly: damping, external forces, the correction of penetrations and the law of friction, which PyBullet does not "
    "report; damping is that of the caller, the rest from its source code"
)


def state(client: int = 0) -> tuple[Array, Array]:
    """Copies of the poses (m; x, y, z, w), (bodies, 7), and velocities (m/s, rad/s), (bodies, 6), of all bodies."""
    import pybullet

    at, bodies = {"physicsClientId": client}, _bodies(pybullet, client)
    poses = [np.concatenate(pybullet.getBasePositionAndOrientation(body, **at)) for body in bodies]
    velocities = [np.concatenate(pybullet.getBaseVelocity(body, **at)) for body in bodies]
    return np.array(poses).reshape(-1, 7), np.array(velocities).reshape(-1, 6)


def read(client: int, before: tuple[Array, Array], damping: float = DAMPING) -> Step:
    """The step that the client has taken from this state.

    Raises
    ------
    InputError
        If a body has joints, or the state is that of other bodies.
    """
    import pybullet

    at, bodies = {"physicsClientId": client}, _bodies(pybullet, client)
    for body in bodies:
        if pybullet.getNumJoints(body, **at):
            raise InputError(f"body {body}: has joints; only free bodies can be read")
    for name, part, size in zip(("poses", "velocities"), before, (7, 6)):
        if np.shape(part) != (len(bodies), size):
            raise InputError(f"before: {name} have the shape {np.shape(part)}, must have ({len(bodies)}, {size})")
    engine = pybullet.getPhysicsEngineParameters(**at)
    dt, dynamics = float(engine["fixedTimeStep"]), {body: pybullet.getDynamicsInfo(body, -1, **at) for body in bodies}
    gravity = np.array([engine[f"gravityAcceleration{axis}"] for axis in "XYZ"], dtype=float)
    free = [k for k, body in enumerate(bodies) if dynamics[body][0] > 0]
    mass, target, fall = np.zeros((6 * len(free),) * 2), np.zeros(6 * len(free)), np.zeros(6 * len(free))
    for number, k in enumerate(free):
        own, spin = slice(6 * number, 6 * number + 3), slice(6 * number + 3, 6 * number + 6)
        axes = np.reshape(pybullet.getMatrixFromQuaternion(before[0][k, 3:]), (3, 3))
        inertia = axes @ np.diag(dynamics[bodies[k]][2]) @ axes.T
        mass[own, own], mass[spin, spin] = dynamics[bodies[k]][0] * np.eye(3), inertia
        for place, velocity in ((own, before[1][k, :3]), (spin, before[1][k, 3:])):
            target[place] = velocity - dt * damping * (1 + np.linalg.norm(velocity)) * velocity
        fall[own] = dt * gravity
        omega = before[1][k, 3:]
        target[spin] -= dt * np.linalg.solve(inertia, np.cross(omega, inertia @ omega))
    target += fall
    rows = ContactRows(len(target))
    for contact in pybullet.getContactPoints(**at):
        _add(rows, contact, bodies, free, before[0], dynamics, target, dt)
    normal = np.repeat(3 * np.arange(len(rows) // 3), 3)
    normal[::3] = -1
    mu = np.repeat(rows.mu, 3)
    mu[::3] = 0.0
    return Step.of(
        "PyBullet", mass, rows.dense_jacobian(), rows.bias, target, rows.forces, state(client)[1][free].ravel(),
        lo=np.where(normal < 0, 0.0, -np.inf), friction_index=normal, mu=mu, model="coulomb-cone", rows=rows.rows,
        version=importlib.metadata.version("pybullet"), method="pgs", iterations=int(engine["numSolverIterations"]),
        has_converged=False,  # PyBullet does not report whether its iteration limit stopped it
        gravity=float(np.sqrt(fall @ mass @ fall)),
        dof_bodies=[_name(bodies[k]) for k in free for _ in range(6)], not_checked=[NOT_REPORTED],
    )


def _bodies(pybullet: Any, client: int) -> list[int]:
    at = {"physicsClientId": client}
    return [pybullet.getBodyUniqueId(number, **at) for number in range(pybullet.getNumBodies(**at))]


def _name(body: int) -> str:
    return f"body {body}"


def _add(
    rows: ContactRows, contact: Any, bodies: list[int], free: list[int], poses: Array, dynamics: Any, target: Array, dt: float
) -> None:
    """The rows of a contact, at the poses from before the step."""
    axes, lines = np.array([contact[7], contact[11], contact[13]]), np.zeros((3, rows.size))
    for body, place, sign in ((contact[1], contact[5], 1), (contact[2], contact[6], -1)):
        k = bodies.index(body)
        if k in free:
            first = 6 * free.index(k)
            lines[:, first : first + 6] += sign * np.hstack([axes, np.cross(np.array(place) - poses[k, :3], axes)])
    pair = [dynamics[body] for body in contact[1:3]]
    gap = contact[8] + SLOP
    bias = (1 if gap > 0 else ERP) * gap / dt
    approach = float(lines[0] @ target)
    if approach <= -BOUNCES_FROM:
        bias += pair[0][5] * pair[1][5] * approach
    forces = dt * np.array([contact[9], contact[10], contact[12]])
    rows.add((_name(contact[1]), _name(contact[2])), lines, forces, bias, np.zeros(3), pair[0][1] * pair[1][1])
