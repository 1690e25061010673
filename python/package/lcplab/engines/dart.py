"""DART: joint coordinates, contacts and loops as a boxed LCP at velocity level.

Of two shapes the smaller friction counts, so equal ones are translated as they are. The restitutions of two
shapes are multiplied, so each gets the square root. Nothing that comes slower than 0.1 m/s bounces; that
threshold is built in. Bodies of one tree of joints collide as others do, except those that a joint joins.
A joint that closes a loop is one point that two bodies share, for a hinge two points of its axis, 5 cm to
each side: the error of the axis in DART's own hinge between two bodies (6.20) grows by a hundredth a step.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

import lcplab
from lcplab import EngineStep
from lcplab._receipt import dart as receipt
from lcplab.engines import Array, Description, Engine, Joint, Posed, Settings, Unsupported
from lcplab.engines import conjugate, joints, one_value, pose, rates, relative, shape, turned
from lcplab._receipt.contact_rows import axes_along
from lcplab._receipt.dart import BOUNCES_FROM, CFM, ERP, FASTEST, SMALL
from lcplab.engines._contacts import Contacts


class Model:
    """A scene in DART: one skeleton for each free or fixed body and for each tree of joints."""

    def __init__(self, scene: Description, settings: Settings) -> None:
        import dartpy

        self.dart: Any = dartpy
        self.scene, self.dt = scene, settings.dt
        self.world: Any = dartpy.simulation.World()
        self.world.setTimeStep(settings.dt)
        self.world.setGravity(scene["gravity"])
        self._set(settings)
        self.surface = (one_value(scene, "friction"), math.sqrt(one_value(scene, "restitution")))
        bodies = scene["bodies"]
        self.nodes: list[Any] = [None] * len(bodies)
        every = joints(scene)
        hung = [joint for joint in every if not joint.closes]  # parents before children
        for k in sorted(set(range(len(bodies))) - {joint.child for joint in hung}):
            self._body(bodies, k, None)
        for joint in hung:
            self._body(bodies, joint.child, joint)
        ignored = self.world.getConstraintSolver().getCollisionOption().collisionFilter
        for joint in every:
            if joint.parent is not None:
                ignored.addBodyNodePairToBlackList(self.nodes[joint.parent], self.nodes[joint.child])
            if joint.closes:
                self._close(joint)

    def _set(self, settings: Settings) -> None:
        if "detector" in settings.values:
            self.world.setCollisionDetector(getattr(self.dart.collision, settings.values["detector"])())
        if not settings.values.get("sleep", True):
            options = self.world.getDeactivationOptions()
            options.mEnabled = False
            self.world.setDeactivationOptions(options)

    def _body(self, bodies: Any, k: int, joint: Joint | None) -> None:
        body, placed = bodies[k], pose(bodies[k])
        parent = None if joint is None or joint.parent is None else self.nodes[joint.parent]
        if parent is None:
            skeleton = self.dart.dynamics.Skeleton(body["name"])
        else:
            skeleton = parent.getSkeleton()
        kind = "Free" if joint is None else {"hinge": "Revolute", "ball": "Ball"}[joint.kind]
        kind = "Weld" if body["fixed"] else kind
        make = getattr(skeleton, f"create{kind}JointAndBodyNodePair")
        made, node = make() if parent is None else make(parent)
        self.nodes[k] = node
        node.setName(body["name"])
        if joint is not None:
            base = np.array([0, 0, 0, 1.0, 0, 0, 0]) if joint.parent is None else pose(bodies[joint.parent])
            there = np.array([*joint.point, *placed[3:]])  # a joint has the axes of its child
            made.setTransformFromChildBodyNode(self._isometry(relative(placed, there)))
            made.setTransformFromParentBodyNode(self._isometry(relative(base, there)))
            if joint.kind == "hinge":
                made.setAxis(turned(conjugate(placed[3:]), joint.axis))
        elif body["fixed"]:
            made.setTransformFromParentBodyNode(self._isometry(placed))
        else:
            made.setRelativeTransform(self._isometry(placed))
        if not body["fixed"]:
            inertia = np.diag(np.array(body["inertia"], dtype=float))
            node.setInertia(self.dart.dynamics.Inertia(body["mass"], np.zeros(3), inertia))
        self._shape(node, body)
        if parent is None:
            skeleton.enableSelfCollisionCheck()
            self.world.addSkeleton(skeleton)
        self._set_going(bodies, k, made, joint)

    def _isometry(self, placed: Array) -> Any:
        return self.dart.math.Isometry3(self.dart.math.Quaternion(placed[3:]), placed[:3])

    def _shape(self, node: Any, body: Any) -> None:
        kind, size = shape(body)
        kinds = self.dart.dynamics
        if kind == "plane":
            made = kinds.PlaneShape(size, 0.0)
        elif kind == "box":
            made = kinds.BoxShape(size)
        elif kind == "sphere":
            made = kinds.SphereShape(size)
        elif kind == "capsule":
            if self.world.getConstraintSolver().getCollisionDetector().getType() == "fcl":
                raise Unsupported("capsules in FCL, as which DART takes spheres")
            made = kinds.CapsuleShape(size["radius"], size["length"])
        else:
            raise Unsupported(f"a body of shape {kind}")
        put = node.createShapeNode(made)
        put.createCollisionAspect()
        aspect = put.createDynamicsAspect()
        aspect.setFrictionCoeff(self.surface[0])
        aspect.setRestitutionCoeff(self.surface[1])

    def _set_going(self, bodies: Any, k: int, made: Any, joint: Joint | None) -> None:
        body = bodies[k]
        if body["fixed"] or not any([*body["velocity"], *body["angular_velocity"]]):
            return
        if joint is not None:
            made.setVelocities(rates(joint, bodies, k))
            return
        made.setLinearVelocity(body["velocity"])
        made.setAngularVelocity(body["angular_velocity"])

    def _close(self, joint: Joint) -> None:
        own = [self.nodes[joint.child]]
        both = own if joint.parent is None else [*own, self.nodes[joint.parent]]
        for shift in [0.0] if joint.kind == "ball" else [-0.05, 0.05]:
            point = joint.point + shift * joint.axis
            made = self.dart.constraint.BallJointConstraint(*both, point)
            self.world.getConstraintSolver().addConstraint(made)

    def step(self) -> None:
        self.world.step()

    def reported_step(self) -> EngineStep:
        before = receipt.state(self.world)
        self.step()
        return receipt.read(self.world, before)

    def poses(self) -> Array:
        found = []
        for node in self.nodes:
            placed = node.getWorldTransform()
            found.append([*placed.translation(), *placed.quaternion().wxyz()])
        return np.array(found)

    def velocities(self) -> Array:
        return np.array([[*node.getLinearVelocity(), *node.getAngularVelocity()] for node in self.nodes])

    def forces(self) -> Array | None:
        every = np.zeros((len(self.nodes), 3))
        numbers = {node.getName(): k for k, node in enumerate(self.nodes)}
        for contact in self.world.getLastCollisionResult().getContacts():
            for end, sign in ((contact.collisionObject1, 1), (contact.collisionObject2, -1)):
                node = end.getShapeFrame().asShapeNode().getBodyNodePtr()
                every[numbers[node.getName()]] += sign * contact.force
        return every

    def problem(self) -> Posed:
        """The contact problem of a step, which is taken here, as DART poses it, and DART's own impulses.

        DART tells no problem. Points, normals, depths and forces are those of the step's contacts, poses and
        velocities those before it, masses and moments those of the scene. Dantzig's method, which DART has
        from ODE, bounds the friction along each tangent by μ times the normal impulse that it finds
        before any friction, and keeps this bound: the problem is that of a box frozen there.
        """
        contacts = Contacts(self.scene, self.poses(), self.velocities(), self.dt)
        self.step()
        if not self.velocities().any():
            raise Unsupported("bodies that sleep")
        numbers = {node.getName(): k for k, node in enumerate(self.nodes)}
        for contact in self.world.getLastCollisionResult().getContacts():
            nodes = [end.getShapeFrame().asShapeNode().getBodyNodePtr()
                     for end in (contact.collisionObject1, contact.collisionObject2)]
            pair = numbers[nodes[0].getName()], numbers[nodes[1].getName()]
            vertical = np.cross([0, 0, 1], contact.normal)
            axes = axes_along(np.array(contact.normal), [0, 0, 1] if vertical @ vertical >= SMALL else [1, 0, 0])
            lines = contacts.lines(pair, (contact.point, contact.point), axes)
            speed = min(max(contact.penetrationDepth, 0.0) * ERP / self.dt, FASTEST)
            bounce = -self.surface[1] ** 2 * float(lines[0] @ contacts.target)
            if bounce > BOUNCES_FROM:
                speed = max(speed, bounce)
            mixed = CFM * np.diag(lines @ np.linalg.solve(contacts.mass, lines.T))
            contacts.add(pair, lines, self.dt * axes @ contact.force, -speed, mixed)
        most = np.tile([np.inf, 0.0, 0.0], (len(contacts.rows) // 3, 1))
        normal = lcplab.solve(contacts.posed("", most=most).problem).x[::3]
        most[:, 1:] = self.surface[0] * normal[:, None]
        return contacts.posed("impulses (N s), boxes of friction", most=most)


ENGINE = Engine(
    name="dart",
    package="dartpy",
    module="dartpy",
    settings=(
        Settings(
            "defaults",
            "as installed: Dantzig's method, friction in a box, collisions by FCL, bodies at rest sleep, "
            "semi-implicit Euler, steps of 1 ms",
            0.001,
        ),
        Settings(
            "accurate",
            "Dantzig's method, friction in a box, collisions by ODE (all corners of a face), nothing sleeps, "
            "semi-implicit Euler, steps of 0.5 ms; the detector is the one Gazebo runs DART with, and the "
            "best of four that were tried on these scenes",
            0.0005,
            {"detector": "OdeCollisionDetector", "sleep": False},
        ),
    ),
    build=Model,
)
