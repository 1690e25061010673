"""Pinocchio: dynamics of trees in joint coordinates, loops at acceleration level; it steps no worlds.

The steps are this adapter's, as Pinocchio's examples write them: ask for accelerations, integrate. A joint
that closes a loop is one point that two bodies share, for a hinge two points of its axis, 5 cm to each side.
Pinocchio poses and solves contact problems, but what touches when, and when it lets go, is left to a
simulator. So scenes where bodies could touch are refused; those that joints connect pass through each other.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lcplab import EngineStep, Problem
from lcplab._receipt import pinocchio as receipt
from lcplab.engines import Array, Description, Engine, Joint, Settings, Unsupported
from lcplab.engines import conjugate, joints, pose, rates, relative, shape, turned


class Model:
    """A scene in Pinocchio: one model that holds all trees."""

    def __init__(self, scene: Description, settings: Settings) -> None:
        import pinocchio

        self.pin: Any = pinocchio
        self.dt = settings.dt
        self.rk4: bool = settings.values["rk4"]
        bodies, every = scene["bodies"], joints(scene)
        refuse_contacts(bodies, every)
        self.model: Any = pinocchio.Model()
        self.model.gravity.linear = np.array(scene["gravity"], dtype=float)
        #: Each body's joint and the place of that joint's axes at the start; the world is joint 0.
        self.places: dict[int | None, tuple[int, Array]] = {None: (0, np.array([0, 0, 0, 1.0, 0, 0, 0]))}
        self.frames: list[int] = [0] * len(bodies)
        hung = [joint for joint in every if not joint.closes]
        for k in sorted(set(range(len(bodies))) - {joint.child for joint in hung}):
            self._body(k, bodies[k], None)
            self._branches(bodies, hung, k)
        self._branches(bodies, hung, None)
        self.data: Any = self.model.createData()
        self.hung = {joint.child: joint for joint in hung}
        self.q, self.v = self._started(bodies)
        self.loops = [loop for joint in every if joint.closes for loop in self._close(joint, settings.values)]
        self.kept = [loop.createData() for loop in self.loops]
        self.proximal = pinocchio.ProximalSettings(1e-12, 1e-12, *settings.values["proximal"])
        if self.loops:
            pinocchio.initConstraintDynamics(self.model, self.data, self.loops, self.kept)
        self._update()

    def _branches(self, bodies: Any, hung: list[Joint], k: int | None) -> None:
        """What hangs on a body, depth first: Pinocchio numbers the joints of each branch in a row."""
        for joint in hung:
            if joint.parent == k:
                self._body(joint.child, bodies[joint.child], joint)
                self._branches(bodies, hung, joint.child)

    def _placement(self, placed: Array) -> Any:
        return self.pin.SE3(self.pin.Quaternion(*placed[3:]).matrix(), placed[:3])

    def _body(self, k: int, body: Any, joint: Joint | None) -> None:
        pin, placed = self.pin, pose(body)
        if body["fixed"]:
            self.places[k] = self.places[None]
        elif joint is None:
            made = self.model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), body["name"])
            self.places[k] = (made, placed)
        else:
            there = np.array([*joint.point, *placed[3:]])  # a joint has the axes of its child
            parent, base = self.places[joint.parent]
            axis = turned(conjugate(placed[3:]), joint.axis)
            hinge = joint.kind == "hinge"
            kind = pin.JointModelRevoluteUnaligned(axis) if hinge else pin.JointModelSpherical()
            made = self.model.addJoint(parent, kind, self._placement(relative(base, there)), body["name"])
            self.places[k] = (made, there)
        number, there = self.places[k]
        own = self._placement(relative(there, placed))
        if not body["fixed"]:
            inertia = np.diag(np.array(body["inertia"], dtype=float))
            self.model.appendBodyToJoint(number, pin.Inertia(float(body["mass"]), np.zeros(3), inertia), own)
        frame = pin.Frame(f"axes of {body['name']}", number, own, pin.FrameType.OP_FRAME)
        self.frames[k] = self.model.addFrame(frame)

    def _started(self, bodies: Any) -> tuple[Array, Array]:
        q, v = self.pin.neutral(self.model), np.zeros(self.model.nv)
        for k, body in enumerate(bodies):
            joint = self.model.joints[self.places[k][0]]
            velocity = np.array([body["velocity"], body["angular_velocity"]], dtype=float)
            if body["fixed"]:
                continue
            if joint.nv == 6:
                placed = pose(body)
                q[joint.idx_q : joint.idx_q + 7] = placed[[0, 1, 2, 4, 5, 6, 3]]
                own = [turned(conjugate(placed[3:]), part) for part in velocity]  # in the body's axes
                v[joint.idx_v : joint.idx_v + 6] = np.concatenate(own)
            elif np.any(velocity):
                v[joint.idx_v : joint.idx_v + joint.nv] = rates(self.hung.get(k), bodies, k)
        return q, v

    def _close(self, joint: Joint, values: Any) -> list[Any]:
        """Points that a loop's last joint keeps together, with errors fed back."""
        made = []
        ends = [self.places[joint.child], self.places[joint.parent]]
        for shift in [0.0] if joint.kind == "ball" else [-0.05, 0.05]:
            at = np.array([*(joint.point + shift * joint.axis), 1, 0, 0, 0])
            where = [part for number, place in ends for part in (number, self._at(place, at))]
            loop = self.pin.RigidConstraintModel(self.pin.ContactType.CONTACT_3D, self.model, *where)
            stiffness = values["stiffness"]
            loop.m_baumgarte_parameters = self.pin.BaumgarteCorrectorParameters(stiffness, 2 * stiffness**0.5)
            made.append(loop)
        return made

    def _at(self, place: Array, point: Array) -> Any:
        return self.pin.SE3(np.eye(3), relative(place, point)[:3])

    def _acceleration(self, q: Array, v: Array) -> Array:
        force = np.zeros(self.model.nv)
        if not self.loops:
            return np.array(self.pin.aba(self.model, self.data, q, v, force))
        arguments = (q, v, force, self.loops, self.kept, self.proximal)
        return np.array(self.pin.constraintDynamics(self.model, self.data, *arguments))

    def _rates(self, moved: Array, v: Array) -> tuple[Array, Array]:
        """How fast a motion away from ``q``, as ``integrate`` takes it, and the velocity change."""
        jacobian = self.pin.dIntegrate(self.model, self.q, moved)[1]
        acceleration = self._acceleration(self.pin.integrate(self.model, self.q, moved), v)
        return np.linalg.solve(jacobian, v), acceleration

    def step(self) -> None:
        dt, moved = self.dt, np.zeros(self.model.nv)
        if self.rk4:
            rates = [self._rates(moved, self.v)]
            for part in (dt / 2, dt / 2, dt):
                rates.append(self._rates(part * rates[-1][0], self.v + part * rates[-1][1]))
            weights = np.array([1, 2, 2, 1]) * dt / 6
            moved = weights @ np.array([rate[0] for rate in rates])
            self.v = self.v + weights @ np.array([rate[1] for rate in rates])
        else:
            self.v = self.v + dt * self._acceleration(self.q, self.v)
            moved = dt * self.v
        self.q = self.pin.integrate(self.model, self.q, moved)
        self._update()

    def reported_step(self) -> EngineStep:
        force = np.zeros(self.model.nv)
        at = (self.q.copy(), self.v.copy())
        self._acceleration(*at)
        step = receipt.read(self.model, self.data, *at, force, self.loops, self.kept) if self.loops else None
        self.step()
        if step is None:
            raise Unsupported("no rows: Pinocchio computes the accelerations of trees in one pass")
        return step

    def _update(self) -> None:
        self.pin.forwardKinematics(self.model, self.data, self.q, self.v)
        self.pin.updateFramePlacements(self.model, self.data)

    def poses(self) -> Array:
        placed = [self.pin.SE3ToXYZQUAT(self.data.oMf[frame]) for frame in self.frames]
        return np.array(placed)[:, [0, 1, 2, 6, 3, 4, 5]]

    def velocities(self) -> Array:
        axes = self.pin.LOCAL_WORLD_ALIGNED
        found = [self.pin.getFrameVelocity(self.model, self.data, frame, axes) for frame in self.frames]
        return np.array([velocity.vector for velocity in found])

    def forces(self) -> Array | None:
        return np.zeros((len(self.frames), 3))  # nothing touches


def refuse_contacts(bodies: Any, every: list[Joint]) -> None:
    """Refuse a scene with a body that moves and another with a shape that no joints connect with it."""
    group = list(range(len(bodies)))
    for joint in every:
        if joint.parent is not None:
            old, new = group[joint.child], group[joint.parent]
            group = [new if number == old else number for number in group]
    solid = [k for k, body in enumerate(bodies) if shape(body)[0] != "point"]
    if len({group[k] for k in solid}) > 1 and not all(bodies[k]["fixed"] for k in solid):
        raise Unsupported("contacts: what touches when is left to a simulator")


def solved(problem: Problem) -> Array:
    """The impulses (N s) that Pinocchio's ADMM gives, with its default settings, for rows n, t1, t2 of each contact.

    Its contacts have their normal last. As A and b are given, the joints that its contacts belong to are any.
    """
    import pinocchio

    assert problem.mu is not None
    model = pinocchio.Model()
    joint = model.addJoint(0, pinocchio.JointModelFreeFlyer(), pinocchio.SE3.Identity(), "any")
    cones, kept = pinocchio.StdVec_ConstraintModel(), pinocchio.StdVec_ConstraintData()
    for mu in problem.mu[1::3]:
        cone = pinocchio.PointContactConstraintModel(model, joint)
        cone.setFriction(mu)
        cones.append(pinocchio.ConstraintModel(cone))
        kept.append(cones[-1].createData())
    order = np.arange(len(problem)).reshape(-1, 3)[:, [1, 2, 0]].ravel()
    delassus = pinocchio.DelassusOperatorDense(problem.A[np.ix_(order, order)])
    result = pinocchio.ADMMSolverResult()
    settings = pinocchio.ADMMSolverSettings()
    pinocchio.ADMMConstraintSolver().solve(delassus, problem.b[order], cones, kept, settings, result)
    x = np.zeros(len(problem))
    x[order] = result.retrieveConstraintImpulses()
    return x


ENGINE = Engine(
    name="pinocchio",
    package="pin",
    module="pinocchio",
    settings=(
        Settings(
            "defaults",
            "as in its example of closed chains: semi-implicit Euler, errors of loops fed back with Kp 10 "
            "and critical Kd, up to 10 proximal iterations with mu 1e-10, steps of 5 ms",
            0.005,
            {"rk4": False, "stiffness": 10.0, "proximal": (1e-10, 10)},
        ),
        Settings(
            "accurate",
            "RK4, errors of loops fed back with Kp 10 and critical Kd, up to 10 proximal iterations with mu "
            "1e-10, steps of 1 ms",
            0.001,
            {"rk4": True, "stiffness": 10.0, "proximal": (1e-10, 10)},
        ),
    ),
    build=Model,
    solve=(solved, "its ADMM, impulses (N s), on the step that lcplab poses at velocity level with Coulomb's cones"),
)
