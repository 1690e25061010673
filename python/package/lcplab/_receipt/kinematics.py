"""The velocities of MuJoCo's bodies along each degree of freedom, by differences of poses on separate data.

They are independent of the engine's Jacobians, mass matrix and bias forces: only its forward kinematics is used.
"""

from __future__ import annotations

import threading
from typing import Any

import numpy as np

from lcplab._receipt.kept import Kept
from lcplab._receipt.step import Array, Rows

#: The time step (s) of second differences, which are accurate to about nine digits.
SECOND = 1e-3
#: The relative rounding error of a position.
EPSILON = float(np.finfo(float).eps)
#: MuJoCo's kinds of joints that turn bodies.
FREE, BALL, HINGE = 0, 1, 3
#: Poses that differ by less than this (m, rad) are the same.
SAME = 1e-9

#: Each thread has data of its own to try positions in.
_scratch = threading.local()


class Kinematics:
    """The bodies of a state.

    Attributes
    ----------
    centers, axes : (bodies, 3) and (bodies, 3, 3)
        Centers of mass (m) and the principal axes of inertia, in columns, of the step.
    first : float
        The time step of first differences (s).
    linear, angular : (bodies, 3, k)
        Velocities of the centers (m/s) and angular velocities (rad/s) that each degree of freedom gives.
    """

    def __init__(self, model: Any, data: Any, qpos: Array) -> None:
        self.model, self.scratch = model, scratch(model, data)
        self.qpos = qpos
        self.centers, self.axes = self.poses(qpos)
        self.reach = max(1.0, float(np.abs(self.centers).max(initial=0.0)))
        # The truncation error, size² of a rotation, equals the rounding error, EPSILON * reach / size.
        self.first = size = float(np.cbrt(EPSILON * self.reach))
        linear, angular = np.zeros((2, model.nbody, 3, model.nv))
        rounds = trees_of(model).rounds
        centers, axes = np.empty((2, len(rounds), model.nbody, 3)), np.empty((2, len(rounds), model.nbody, 3, 3))
        velocity = np.zeros(model.nv)
        for number, (dofs, _, _) in enumerate(rounds):
            velocity[dofs] = 1.0
            for side, time in enumerate((-size, size)):
                centers[side, number], axes[side, number] = self.along(velocity, time)
            velocity[dofs] = 0.0
        moved, turned = (centers[1] - centers[0]) / (2 * size), turn(axes[1], axes[0]) / (2 * size)
        for number, (_, bodies, columns) in enumerate(rounds):
            linear[bodies, :, columns] = moved[number, bodies]
            angular[bodies, :, columns] = turned[number, bodies]
        self.linear, self.angular = linear, angular

    def along(self, velocity: Array, time: float) -> tuple[Array, Array]:
        """Poses after a motion with constant velocity."""
        import mujoco

        moved = self.qpos.copy()
        mujoco.mj_integratePos(self.model, moved, np.ascontiguousarray(velocity), time)
        return self.poses(moved)

    def poses(self, qpos: Array) -> tuple[Array, Array]:
        """Centers of mass and principal axes at a position."""
        import mujoco

        self.scratch.qpos[:] = qpos
        mujoco.mj_kinematics(self.model, self.scratch)
        return self.scratch.xipos.copy(), self.scratch.ximat.reshape(-1, 3, 3).copy()

    def accelerations(self, velocity: Array) -> tuple[Array, Array]:
        """J̇v: accelerations of centers (m/s²) and angular ones (rad/s²) of a motion with constant velocity."""
        size = interval(self.model, velocity)
        (p, after), (q, before) = self.along(velocity, size), self.along(velocity, -size)
        linear = (p - 2 * self.centers + q) / size**2
        angular = (turn(after, self.axes) - turn(self.axes, before)) / size**2
        return linear, angular

    def rounding(self, velocity: Array) -> float:
        """The error of these accelerations by rounding of the poses (m/s²)."""
        return 8 * EPSILON * self.reach / interval(self.model, velocity) ** 2

    @property
    def trees(self) -> list[tuple[Rows, Rows]]:
        """Bodies and degrees of freedom of trees that have as many, (trees, bodies) and (trees, dofs)."""
        return trees_of(self.model).groups

    def of_trees(self, bodies: Rows, dofs: Rows) -> tuple[Array, Array]:
        """Linear and angular velocities of trees, (trees, bodies, 3, dofs)."""
        part = bodies[:, :, None, None], np.arange(3)[:, None], dofs[:, None, None, :]
        return self.linear[part], self.angular[part]

    def flat(self) -> tuple[Array, Array]:
        """Linear and angular velocities as matrices, (3 bodies, k)."""
        return self.linear.reshape(-1, self.model.nv), self.angular.reshape(-1, self.model.nv)

    def point(self, body: int, at: Array) -> Array:
        """The velocity of a body's point that each degree of freedom gives, (3, k)."""
        return np.asarray(self.points(np.array([body]), at[None])[0])

    def points(self, bodies: Rows, at: Array) -> Array:
        """The velocities of a point of each of these bodies that each degree of freedom gives, (points, 3, k)."""
        x, y, z = (at - self.centers[bodies]).T
        zero = np.zeros(len(bodies))
        turning = np.array([[zero, z, -y], [-z, zero, x], [y, -x, zero]])  # turning @ w = w × arm
        return np.asarray(self.linear[bodies] + np.moveaxis(turning, 2, 0) @ self.angular[bodies])


class Trees:
    """The trees of a compiled model, which do not change: the bodies that hang on one child of the world.

    Attributes
    ----------
    rounds : list of (dofs, bodies, columns)
        Degrees of freedom that move different bodies, which one pair of poses measures: at most one of each tree. With them,
        the bodies that can move with one of them, and which one that is.
    groups : list of (bodies, dofs)
        Trees of as many bodies and degrees of freedom: (trees, bodies) and (trees, dofs).
    """

    def __init__(self, model: Any) -> None:
        roots = np.asarray(model.body_rootid)
        of_dof = roots[np.asarray(model.dof_bodyid)]
        place = np.zeros(model.nv, dtype=np.int64)
        sizes: dict[tuple[int, int], list[tuple[Rows, Rows]]] = {}
        for root in np.unique(of_dof):
            bodies, dofs = np.flatnonzero(roots == root), np.flatnonzero(of_dof == root)
            place[dofs] = np.arange(len(dofs))
            sizes.setdefault((len(bodies), len(dofs)), []).append((bodies, dofs))
        self.groups = [(np.array([own for own, _ in group]), np.array([own for _, own in group])) for group in sizes.values()]
        self.rounds = []
        for number in range(int(place.max(initial=-1)) + 1):
            dofs = np.flatnonzero(place == number)
            moves = np.full(model.nbody, -1, dtype=np.int64)
            moves[of_dof[dofs]] = dofs
            columns = moves[roots]
            bodies = np.flatnonzero(columns >= 0)
            self.rounds.append((dofs, bodies, columns[bodies]))


_trees: tuple[Any, Trees] | None = None


def trees_of(model: Any) -> Trees:
    """The trees of the model that was read last are kept, together with it, because threads may read several."""
    global _trees
    kept = _trees
    if kept is None or kept[0] is not model:
        kept = _trees = model, Trees(model)
    return kept[1]


def _turning_of(model: Any) -> Rows:
    """The degrees of freedom that turn bodies."""
    first, kinds = np.asarray(model.jnt_dofadr), np.asarray(model.jnt_type)
    of_free = first[kinds == FREE, None] + np.arange(3, 6)
    of_ball = first[kinds == BALL, None] + np.arange(3)
    return np.concatenate([of_free.ravel(), of_ball.ravel(), first[kinds == HINGE]])


_turning = Kept(_turning_of, "jnt_type", "jnt_dofadr")


def interval(model: Any, velocity: Array) -> float:
    """The time step of second differences (s) along a velocity: bodies that only move in a line have none."""
    return SECOND / max(1.0, float(np.abs(velocity[_turning(model)]).max(initial=0.0)))


def scratch(model: Any, data: Any) -> Any:
    """Separate data for this model, with the mocap bodies of the given data."""
    import mujoco

    if getattr(_scratch, "model", None) is not model:
        _scratch.model, _scratch.data = model, mujoco.MjData(model)
    own = _scratch.data
    own.mocap_pos[:], own.mocap_quat[:] = data.mocap_pos, data.mocap_quat
    return own


def is_at(model: Any, data: Any, qpos: Array) -> bool:
    """Whether the poses in these data belong to this position; after ``mj_step`` they belong to the one before."""
    distances, turns = differences(model, data, qpos)
    return bool(max(distances.max(initial=0.0), turns.max(initial=0.0)) <= SAME)


def differences(model: Any, data: Any, qpos: Array) -> tuple[Array, Array]:
    """The largest differences of each body's center of mass (m) and axes (rad) from those of a position, (bodies,)."""
    import mujoco

    own = scratch(model, data)
    own.qpos[:] = qpos
    mujoco.mj_kinematics(model, own)
    return np.abs(own.xipos - data.xipos).max(axis=1), np.abs(own.ximat - data.ximat).max(axis=1)


def cross(one: Array, other: Array) -> Array:
    """Cross products of vectors in rows, (n, 3); ``np.cross`` takes several times as long for few of them."""
    (a, b, c), (x, y, z) = one.T, other.T
    return np.stack([b * z - c * y, c * x - a * z, a * y - b * x], axis=1)


def turn(after: Array, before: Array) -> Array:
    """The rotation vectors (rad) of small turns, world axes: (..., 3) of axes (..., 3, 3)."""
    change = after @ np.swapaxes(before, -1, -2)
    skew = (change - np.swapaxes(change, -1, -2)) / 2
    return np.stack([skew[..., 2, 1], skew[..., 0, 2], skew[..., 1, 0]], axis=-1)
