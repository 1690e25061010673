"""PyBullet: Bullet's multibodies in joint coordinates, contacts by sequential impulses with friction cones.

PyBullet multiplies the coefficients of two bodies, so each body gets the square root of what the pair has.
Bodies with joints are links of a multibody whose base is the world or, of a tree that hangs on nothing, its first
body; its motors, which are on by default, get no force. A joint that closes a loop is one point that two bodies
share, for a hinge two points of its axis, 5 cm to each side. By its maintainer proper restitution takes rigid bodies,
not multibodies, so the accurate settings make such of free bodies in a scene that bounces.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from lcplab import EngineStep
from lcplab._receipt import pybullet as receipt
from lcplab.engines import Array, Description, Engine, Joint, Posed, Settings, Unsupported
from lcplab.engines import conjugate, joints, one_value, pose, rates, relative, shape, turned
from lcplab._receipt.pybullet import BOUNCES_FROM, DAMPING, ERP, SLOP
from lcplab.engines._contacts import Contacts

#: What the maintainer of Bullet sets for restitution (github.com/bulletphysics/bullet3/issues/3094), beside
#: rigid bodies and no contacts at a distance. The last entry is ours: it splits impulses not only of bodies
#: that overlap by more than 4 cm.
BOUNCING = {"restitutionVelocityThreshold": 0.0, "warmStartingFactor": 0.0, "useSplitImpulse": 1,
            "contactSlop": 0.0, "splitImpulsePenetrationThreshold": 0.0}


class Model:
    """A scene in PyBullet, in a server of its own."""

    def __init__(self, scene: Description, settings: Settings) -> None:
        import pybullet

        self.p: Any = pybullet
        self.scene, self.dt = scene, settings.dt
        self.client: int = pybullet.connect(pybullet.DIRECT)
        self.at: dict[str, int] = {"physicsClientId": self.client}
        pybullet.setGravity(*scene["gravity"], **self.at)
        pybullet.setTimeStep(settings.dt, **self.at)
        friction, restitution = one_value(scene, "friction"), one_value(scene, "restitution")
        engine, dynamics = dict(settings.values.get("engine", {})), dict(settings.values.get("dynamics", {}))
        #: Whether free bodies are rigid bodies of their own instead of multibodies without links.
        self.maximal = settings.name == "accurate" and restitution > 0
        if self.maximal:
            engine, dynamics = engine | BOUNCING, dynamics | {"contactProcessingThreshold": 0.0}
        if engine:
            pybullet.setPhysicsEngineParameter(**engine, **self.at)
        self.dynamics: dict[str, Any] = {
            "lateralFriction": math.sqrt(friction), "restitution": math.sqrt(restitution), **dynamics
        }
        #: Each body's multibody and link; the base is link -1.
        self.places: list[tuple[int, int]] = [(-1, -1)] * len(scene["bodies"])
        every = joints(scene)
        self.hung = {joint.child: joint for joint in every if not joint.closes}
        for root, tree in trees([joint for joint in every if not joint.closes]):
            self._linked(scene["bodies"], root, tree)
        for k in range(len(scene["bodies"])):
            self._body(scene["bodies"], k)
        for joint in every:
            if joint.parent is not None:
                (first, one), (second, other) = self.places[joint.parent], self.places[joint.child]
                pybullet.setCollisionFilterPair(first, second, one, other, 0, **self.at)
            if joint.closes:
                self._close(scene["bodies"], joint)

    def _body(self, bodies: Any, k: int) -> None:
        """What a body has beside its place: its mass, its coefficients and its velocity."""
        body = bodies[k]
        if any(body["force"]) or any(body["torque"]):
            raise Unsupported("forces on bodies")
        velocity = [*body["velocity"], *body["angular_velocity"]]
        if self.places[k][0] < 0:
            own = pose(body)
            mass = 0.0 if body["fixed"] else body["mass"]
            made = self.p.createMultiBody(mass, self._shape(body), -1, own[:3], xyzw(own[3:]),
                                          useMaximalCoordinates=self.maximal, **self.at)
            self.places[k] = (made, -1)
        dynamics = dict(self.dynamics)
        if not body["fixed"]:
            dynamics |= {"mass": body["mass"], "localInertiaDiagonal": body["inertia"]}
        self.p.changeDynamics(*self.places[k], **dynamics, **self.at)
        if self.places[k][1] >= 0 and any(velocity):
            turning = rates(self.hung.get(k), bodies, k)
            if turning.any():
                self.p.resetJointStateMultiDof(*self.places[k], [0, 0, 0, 1], list(turning), **self.at)
        elif any(velocity):
            self.p.resetBaseVelocity(self.places[k][0], velocity[:3], velocity[3:], **self.at)

    def _shape(self, body: Any, **place: Any) -> int:
        kind, size = shape(body)
        if kind == "plane":
            if size != [0, 0, 1]:
                raise Unsupported("planes across other axes than z")
            made = self.p.createCollisionShape(self.p.GEOM_PLANE, planeNormal=size, **place, **self.at)
        elif kind == "box":
            half = [edge / 2 for edge in size]
            made = self.p.createCollisionShape(self.p.GEOM_BOX, halfExtents=half, **place, **self.at)
        elif kind == "sphere":
            made = self.p.createCollisionShape(self.p.GEOM_SPHERE, radius=size, **place, **self.at)
        elif kind == "capsule":
            made = self.p.createCollisionShape(self.p.GEOM_CAPSULE, radius=size["radius"], height=size["length"],
                                               **place, **self.at)
        else:
            raise Unsupported(f"a body of shape {kind}")
        return int(made)

    def _linked(self, bodies: Any, root: int | None, tree: list[Joint]) -> None:
        """One multibody of a tree of joints, whose base is its free root or the world.

        A link's frame is at its joint and has the body's axes; mass and shape are where the body is in it.
        """
        links: dict[int | None, int] = {joint.child: k for k, joint in enumerate(tree)}
        frames: dict[int | None, Array] = {
            joint.child: np.concatenate([joint.point, pose(bodies[joint.child])[3:]]) for joint in tree
        }
        base = np.array([0, 0, 0, 1, 0, 0, 0], dtype=float) if root is None else pose(bodies[root])
        own = [frames[joint.child] for joint in tree]
        placed = [relative(base if joint.parent == root else frames[joint.parent], frame)
                  for joint, frame in zip(tree, own)]
        middles = [relative(frame, pose(bodies[joint.child]))[:3] for joint, frame in zip(tree, own)]
        kinds = {"hinge": self.p.JOINT_REVOLUTE, "ball": self.p.JOINT_SPHERICAL}
        heavy = (0, -1, -1) if root is None else (bodies[root]["mass"], self._shape(bodies[root]), -1)
        made = self.p.createMultiBody(
            *heavy, base[:3], xyzw(base[3:]),
            linkMasses=[bodies[joint.child]["mass"] for joint in tree],
            linkCollisionShapeIndices=[self._shape(bodies[joint.child], collisionFramePosition=middle)
                                       for joint, middle in zip(tree, middles)],
            linkVisualShapeIndices=[-1] * len(tree),
            linkPositions=[at[:3] for at in placed],
            linkOrientations=[xyzw(at[3:]) for at in placed],
            linkInertialFramePositions=middles,
            linkInertialFrameOrientations=[[0, 0, 0, 1]] * len(tree),
            linkParentIndices=[0 if joint.parent == root else links[joint.parent] + 1 for joint in tree],
            linkJointTypes=[kinds[joint.kind] for joint in tree],
            linkJointAxis=[turned(conjugate(frame[3:]), joint.axis) for joint, frame in zip(tree, own)],
            flags=self.p.URDF_USE_SELF_COLLISION,
            **self.at,
        )
        if root is not None:
            self.places[root] = (made, -1)
        numbers = {self.p.getJointInfo(made, k, **self.at)[12]: k for k in range(len(tree))}
        for wanted, joint in enumerate(tree):
            k = numbers[f"link{wanted + 1}".encode()]  # PyBullet sorts links depth first
            self.places[joint.child] = (made, k)
            if joint.kind == "hinge":
                self.p.setJointMotorControl2(made, k, self.p.VELOCITY_CONTROL, force=0, **self.at)
            else:
                gains = {"positionGain": 0, "velocityGain": 0, "force": [0, 0, 0]}
                self.p.setJointMotorControlMultiDof(made, k, self.p.POSITION_CONTROL, [0, 0, 0, 1],
                                                    **gains, **self.at)

    def _close(self, bodies: Any, joint: Joint) -> None:
        """A loop's last joint as points in common, in both bodies' axes; body -1 is the world."""
        spread = [0.0] if joint.kind == "ball" else [-0.05, 0.05]
        child = self.places[joint.child]
        parent = (-1, -1) if joint.parent is None else self.places[joint.parent]
        for far in spread:
            point = np.array([*(joint.point + far * joint.axis), 1, 0, 0, 0])
            on_child = relative(pose(bodies[joint.child]), point)[:3]
            on_parent = point[:3] if joint.parent is None else relative(pose(bodies[joint.parent]), point)[:3]
            kind = self.p.JOINT_POINT2POINT
            self.p.createConstraint(*child, *parent, kind, [0, 0, 0], on_child, on_parent, **self.at)

    def step(self) -> None:
        self.p.stepSimulation(**self.at)

    def reported_step(self) -> EngineStep:
        before = receipt.state(self.client)
        self.step()
        if self.maximal:
            raise Unsupported("split impulses, which PyBullet does not report")
        if any(link >= 0 for _, link in self.places):
            raise Unsupported("lcplab reads only free bodies of PyBullet")
        return receipt.read(self.client, before, self.dynamics.get("linearDamping", DAMPING))

    def _link(self, body: int, link: int) -> Any:
        return self.p.getLinkState(body, link, computeLinkVelocity=1, computeForwardKinematics=1, **self.at)

    def poses(self) -> Array:
        base = self.p.getBasePositionAndOrientation
        found = [base(body, **self.at) if link < 0 else self._link(body, link)[:2]
                 for body, link in self.places]
        return np.array([[*position, turn[3], *turn[:3]] for position, turn in found])

    def velocities(self) -> Array:
        found = [self.p.getBaseVelocity(body, **self.at) if link < 0 else self._link(body, link)[6:8]
                 for body, link in self.places]
        return np.array([[*linear, *angular] for linear, angular in found])

    def forces(self) -> Array | None:
        every = np.zeros((len(self.places), 3))
        for contact in self.p.getContactPoints(**self.at):
            parts = [(contact[9], contact[7]), (contact[10], contact[11]), (contact[12], contact[13])]
            force = sum(size * np.array(direction) for size, direction in parts)  # on the first body
            every[self.places.index((contact[1], contact[3]))] += force
            every[self.places.index((contact[2], contact[4]))] -= force
        return every

    def problem(self) -> Posed:
        """The contact problem of a step, which is taken here, as Bullet poses it, and Bullet's own impulses.

        Bullet tells no problem. Points, normals, tangents, distances and forces are those that it tells after the
        step, poses and velocities those before it, masses and moments those of the scene. Free bodies are
        multibodies without links: a step first adds gravity and the gyroscopic torque to u and takes the damping
        0.04 (1 + |u|) u per second away. A point that is apart may close its distance, one that overlaps is to
        correct a part of it, and one that comes fast enough bounces. Bullet moves the friction of a point
        along each tangent by the sliding over that row's own diagonal entry, and then onto its disk; where the
        entries differ, friction is not quite against the sliding. What is posed is Coulomb's law. Nothing else
        is left out: ``u* + M⁻¹Jᵀx`` is the velocity after the step.
        """
        if self.maximal:
            raise Unsupported("split impulses, which PyBullet does not report")
        velocities = self.velocities()
        contacts = Contacts(self.scene, self.poses(), velocities, self.dt)
        parts = velocities[list(contacts.first)].reshape(-1, 3)
        damping = self.dynamics.get("linearDamping", DAMPING) * (1 + np.linalg.norm(parts, axis=1, keepdims=True))
        contacts.target -= self.dt * (damping * parts).ravel()
        self.step()
        for contact in self.p.getContactPoints(**self.at):
            pair = self.places.index((contact[1], contact[3])), self.places.index((contact[2], contact[4]))
            axes = np.array([contact[7], contact[11], contact[13]])
            lines = contacts.lines(pair, (np.array(contact[5]), np.array(contact[6])), axes)
            distance = contact[8] + SLOP
            bias = (1 if distance > 0 else ERP) * distance / self.dt
            approach = float(lines[0] @ contacts.target)
            if approach <= -BOUNCES_FROM:
                bias += self.dynamics["restitution"] ** 2 * approach
            contacts.add(pair, lines, self.dt * np.array([contact[9], contact[10], contact[12]]), bias)
        return contacts.posed("impulses (N s), Coulomb's cones", mu=self.dynamics["lateralFriction"] ** 2)

    def __del__(self) -> None:
        client = getattr(self, "client", -1)
        if client >= 0 and self.p.isConnected(client):
            self.p.disconnect(client)


def trees(hung: list[Joint]) -> list[tuple[int | None, list[Joint]]]:
    """The trees of joints, each with the body at its root, which is free; the world is one, too."""
    roots: dict[int | None, int | None] = {}
    found: dict[int | None, list[Joint]] = {}
    for joint in hung:  # parents before children
        root = roots[joint.child] = roots.get(joint.parent, joint.parent)
        found.setdefault(root, []).append(joint)
    return list(found.items())


def xyzw(turn: Array) -> Array:
    """A quaternion with its real part last, as PyBullet has it."""
    return turn[[1, 2, 3, 0]]


ENGINE = Engine(
    name="pybullet",
    package="pybullet",
    module="pybullet",
    settings=(
        Settings(
            "defaults",
            "as installed: at most 50 iterations until the residual is 1e-7, friction cones, damping of "
            "0.04 (1 + speed) per second, contacts corrected by 0.08 a step, steps of 1/240 s",
            1 / 240,
        ),
        Settings(
            "accurate",
            "no damping, 1000 iterations whatever the residual, friction cones, contacts corrected by 0.08 a "
            "step, steps of 1 ms; where bodies bounce they are rigid bodies with split impulses, without "
            "warm start, slop, contacts at a distance or a least speed",
            0.001,
            {
                "engine": {"numSolverIterations": 1000, "solverResidualThreshold": 0.0},
                "dynamics": {"linearDamping": 0.0, "angularDamping": 0.0},
            },
        ),
    ),
    build=Model,
)
