"""The last step of a Rapier world with free bodies, read and not changed.

Rapier reports contact points and impulses but not its problem. The arms, the tangents and the gap are those of its source code
(``geometry/narrow_phase/pair_update.rs`` and ``dynamics/solver/contact_constraint``, version 0.36).
"""

from __future__ import annotations

import importlib.metadata
from typing import Any

import numpy as np

from lcplab._lcplab import InputError
from lcplab._receipt.contact_rows import ContactRows
from lcplab._receipt.step import Array, Step

#: Settings with which the points of the solve are those that Rapier reports, and why.
NEEDED = (
    ("num_solver_iterations", 1, "with several substeps Rapier reports sums over them"),
    ("contact_recycling", False, "the arms of recycled contacts are not reported"),
    ("friction_model", "COULOMB", "the points of simplified friction are not reported"),
)
#: The rules by which two coefficients of friction are combined; of two rules the later one counts.
RULES = ("AVERAGE", "MIN", "MULTIPLY", "MAX", "CLAMPED_SUM", "GEOMETRIC_MEAN")
#: The bit of a contact's number that marks a new one.
NEW = 1 << 31
NOT_REPORTED = "assembly: arms, tangents and gaps, which Rapier does not report; they are those of its source code"


def state(world: Any) -> tuple[Array, Array]:
    """Copies of the poses of the centers of mass (m; w, x, y, z), (bodies, 7), and velocities, (bodies, 6).

    Raises
    ------
    InputError
        If a body has no mass yet: Rapier adds up the masses in the first step.
    """
    bodies = [world.rigid_bodies[handle] for handle in _dynamic(world)]
    if any(body.mass <= 0 for body in bodies):
        raise InputError("a body has no mass; Rapier computes masses in the first step, so read a later one")
    poses = [[*_center(body), *_quaternion(body.rotation)] for body in bodies]
    velocities = [[*body.linvel, *body.angvel] for body in bodies]
    return np.array(poses).reshape(-1, 7), np.array(velocities).reshape(-1, 6)


def read(world: Any, before: tuple[Array, Array]) -> Step:
    """The step that the world has taken from this state.

    Raises
    ------
    InputError
        If the world has joints or settings with which its rows cannot be computed, or the state is that of other bodies.
    """
    handles = _dynamic(world)
    _check(world, handles, before)
    bodies = [world.rigid_bodies[handle] for handle in handles]
    parameters = world.integration_parameters
    dt = float(parameters.dt)
    mass, fall, push = np.zeros((6 * len(bodies),) * 2), np.zeros(6 * len(bodies)), np.zeros(6 * len(bodies))
    gravity = np.array([*world.gravity], dtype=float)
    for k, body in enumerate(bodies):
        own, spin = slice(6 * k, 6 * k + 3), slice(6 * k + 3, 6 * k + 6)
        axes = _matrix(before[0][k, 3:]) @ _matrix(np.array(_quaternion(body.mass_properties.principal_inertia_local_frame)))
        moments = np.array([*body.mass_properties.principal_inertia])
        mass[own, own], mass[spin, spin] = body.mass * np.eye(3), axes @ np.diag(moments) @ axes.T
        fall[own] = dt * body.gravity_scale * gravity
        push[own], push[spin] = [*body.user_force], [*body.user_torque]
    target = before[1].ravel() + fall + dt * np.linalg.solve(mass, push)
    for k, body in enumerate(bodies):
        if body.gyroscopic_forces_enabled:
            spin = slice(6 * k + 3, 6 * k + 6)
            target[spin] = _turned_by_itself(target[spin], mass[spin, spin], dt)
    moved = _Moved(handles, before[0], state(world)[0])
    rows = ContactRows(len(target))
    for pair in world.narrow_phase.contact_pairs():
        for manifold in pair.manifolds:
            for contact in manifold.data.solver_contacts:
                _add(rows, world, pair, manifold, contact, moved, dt)
    normal = np.repeat(3 * np.arange(len(rows) // 3), 3)
    normal[::3] = -1
    mu = np.repeat(rows.mu, 3)
    mu[::3] = 0.0
    return Step.of(
        "Rapier", mass, rows.dense_jacobian(), rows.bias, target, rows.forces, state(world)[1].ravel(),
        lo=np.where(normal < 0, 0.0, -np.inf), friction_index=normal, mu=mu, model="coulomb-cone", rows=rows.rows,
        version=importlib.metadata.version("rapier3d"), method="pgs", bits=32,
        iterations=int(parameters.num_internal_stabilization_iterations),
        has_converged=False,  # Rapier makes all its sweeps
        gravity=float(np.sqrt(fall @ mass @ fall)),
        dof_bodies=[moved.name(handle) for handle in handles for _ in range(6)], not_checked=[NOT_REPORTED],
    )


def _dynamic(world: Any) -> list[Any]:
    return [handle for handle in world.rigid_bodies.handles() if world.rigid_bodies[handle].is_dynamic]


def _check(world: Any, handles: list[Any], before: tuple[Array, Array]) -> None:
    parameters, defects = world.integration_parameters, []
    for name, needed, reason in NEEDED:
        value = getattr(parameters, name)
        if getattr(value, "name", value) != needed and str(value).rpartition(".")[2] != needed:
            defects.append(f"{name}: is {value}, must be {needed}: {reason}")
    if parameters.num_internal_stabilization_iterations < 1:
        defects.append("num_internal_stabilization_iterations: must be at least 1, or the velocities include the correction of overlaps")
    if len(world.impulse_joints) or any(world.multibody_joints.rigid_body_link(handle) is not None for handle in handles):
        defects.append("the world has joints; only free bodies can be read")
    for k, handle in enumerate(handles):
        body = world.rigid_bodies[handle]
        for name, is_wrong in (
            ("is asleep", body.is_sleeping),
            ("has damping", body.linear_damping or body.angular_damping),
            ("has a dominance group", body.dominance_group),
            ("has locked axes", not all((*body.enabled_translations, *body.enabled_rotations))),
        ):
            if is_wrong:
                defects.append(f"body {k}: {name}, which cannot be read")
    for name, part, size in zip(("poses", "velocities"), before, (7, 6)):
        if np.shape(part) != (len(handles), size):
            defects.append(f"before: {name} have the shape {np.shape(part)}, must have ({len(handles)}, {size})")
    if defects:
        raise InputError("\n".join(defects))


class _Moved:
    """The bodies before and after the step, by the handle."""

    def __init__(self, handles: list[Any], before: Array, after: Array) -> None:
        self._number = {str(handle): k for k, handle in enumerate(handles)}
        self._before, self._after = before, after

    def number(self, handle: Any) -> int | None:
        """The number of a dynamic body."""
        return self._number.get(str(handle))

    def name(self, handle: Any) -> str:
        """A name for messages."""
        number = self.number(handle)
        return "fixed" if number is None else f"body {number}"

    def back(self, handle: Any, point: Array) -> Array:
        """Where a point of a body was before the step."""
        return self._carried(handle, point, self._after, self._before)

    def ahead(self, handle: Any, point: Array) -> Array:
        """Where a point of a body is after the step."""
        return self._carried(handle, point, self._before, self._after)

    def arm(self, number: int, point: Array) -> Array:
        """From the center of mass before the step."""
        return np.asarray(point - self._before[number, :3])

    def _carried(self, handle: Any, point: Array, start: Array, end: Array) -> Array:
        k = self.number(handle)
        if k is None:
            return point
        turn = _matrix(end[k, 3:]) @ _matrix(start[k, 3:]).T
        return np.asarray(end[k, :3] + turn @ (point - start[k, :3]))


def _add(rows: ContactRows, world: Any, pair: Any, manifold: Any, contact: Any, moved: _Moved, dt: float) -> None:
    """The rows of a point: the second body leaves the first one along the normal."""
    colliders = [world.colliders[pair.collider1], world.colliders[pair.collider2]]
    if any(collider.restitution for collider in colliders) or any([*contact.tangent_velocity]):
        raise InputError("restitution and moving surfaces are not read")
    handles = [collider.parent for collider in colliders]
    ends = [np.array(_numbers(end)) for end in manifold.data.solver_contact_world_points(contact, world.rigid_bodies)]
    ends = [moved.back(handle, end) for handle, end in zip(handles, ends)]
    normal, point = np.array([*manifold.data.normal]), (ends[0] + ends[1]) / 2
    tangent = _tangent(-normal)
    axes = np.array([normal, -tangent, np.cross(normal, tangent)])
    lines = np.zeros((3, rows.size))
    for handle, sign in zip(handles, (-1, 1)):
        if (k := moved.number(handle)) is not None:
            lines[:, 6 * k : 6 * k + 6] += sign * np.hstack([axes, np.cross(moved.arm(k, point), axes)])
    # The last sweeps leave the gap that remains after the motion of the step.
    first, second = (moved.ahead(handle, point) for handle in handles)
    gap = (ends[1] - ends[0] + second - first) @ normal
    data = manifold.points[contact.contact_id & (NEW - 1)]
    forces = np.array([data.impulse, *data.tangent_impulse])
    names = moved.name(handles[1]), moved.name(handles[0])
    rows.add(names, lines, forces, max(float(gap), 0.0) / dt, np.zeros(3), _friction(*colliders))


def _turned_by_itself(spin: Array, inertia: Array, dt: float) -> Array:
    """ω after the gyroscopic torque of a step, which keeps the size of the angular momentum."""
    momentum = inertia @ spin
    turned = momentum - dt * np.cross(spin, momentum)
    size = np.linalg.norm(turned)
    return spin if size == 0 else np.asarray(np.linalg.solve(inertia, turned * np.linalg.norm(momentum) / size))


def _tangent(direction: Array) -> Array:
    """Rapier's first tangent of a contact, which depends on its direction alone (``orthonormal_vector``)."""
    x, y, z = direction
    sign = np.copysign(1.0, z)
    part = -1 / (sign + z)
    return np.array([x * y * part, sign + y * y * part, -y])


def _friction(one: Any, other: Any) -> float:
    rules = [str(collider.friction_combine_rule).rpartition(".")[2] for collider in (one, other)]
    first, second = float(one.friction), float(other.friction)
    combined = {
        "AVERAGE": (first + second) / 2, "MIN": min(first, second), "MULTIPLY": first * second,
        "MAX": max(first, second), "CLAMPED_SUM": min(max(first + second, 0.0), 1.0), "GEOMETRIC_MEAN": np.sqrt(first * second),
    }
    return float(combined[max(rules, key=RULES.index)])


def _center(body: Any) -> list[float]:
    turn, local = _matrix(np.array(_quaternion(body.rotation))), np.array(_numbers(body.local_center_of_mass))
    return [float(part) for part in np.array(_numbers(body.translation)) + turn @ local]


def _numbers(vector: Any) -> list[float]:
    return [vector.x, vector.y, vector.z]


def _quaternion(turn: Any) -> list[float]:
    return [turn.w, turn.i, turn.j, turn.k]


def _matrix(quaternion: Array) -> Array:
    """The rotation matrix of a unit quaternion (w, x, y, z)."""
    w, (x, y, z) = quaternion[0], quaternion[1:]
    across = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + 2 * w * across + 2 * across @ across)
