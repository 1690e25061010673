"""Rapier, in single precision: bodies in world coordinates, soft contacts and joints solved in substeps.

The frictions and the restitutions of two colliders are averaged, so equal ones are translated as they are.
Mass and moments are those of the body; its collider weighs nothing. A plane is a half-space. Joints are
impulse joints. What Rapier calls solver iterations are substeps.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lcplab.engines import Array, Description, Engine, Joint, Settings, Unsupported
from lcplab.engines import conjugate, joints, one_value, pose, shape, springs, turned


class Model:
    """A scene in Rapier."""

    def __init__(self, scene: Description, settings: Settings) -> None:
        import rapier3d

        self.rapier: Any = rapier3d
        self.dt = settings.dt
        self.sleep: bool = settings.values.get("sleep", True)
        self.world: Any = rapier3d.PhysicsWorld(gravity=scene["gravity"])
        parameters = self.world.integration_parameters
        parameters.dt = settings.dt
        for key, value in settings.values.get("parameters", {}).items():
            setattr(parameters, key, value)
        if "softness" in settings.values:
            softness = rapier3d.SpringCoefficients(*settings.values["softness"])
            parameters.contact_softness = parameters.static_contact_softness = softness
        self.surface = (one_value(scene, "friction"), one_value(scene, "restitution"))
        self.bodies = [self._body(body) for body in scene["bodies"]]
        self.colliders = [body.colliders[0] for body in self._found()]
        self.ground = self.world.add_body(rapier3d.RigidBody.fixed())
        for joint in joints(scene, besides=("spring",)):
            self._join(scene["bodies"], joint)
        for spring in springs(scene):
            (one, first), (other, second) = spring.ends
            made = rapier3d.SpringJointBuilder(spring.length, spring.stiffness, 0.0)
            made = made.local_anchor1(tuple(first)).local_anchor2(tuple(second))
            parent, child = (self.ground if k is None else self.bodies[k] for k in (one, other))
            self.world.impulse_joints.insert(parent, child, made.build())

    def _body(self, body: Any) -> Any:
        rapier, placed = self.rapier, pose(body)
        made = rapier.RigidBody.fixed() if body["fixed"] else rapier.RigidBody.dynamic()
        made = made.position(rapier.Isometry3(tuple(placed[:3]), rapier.Rotation3(*placed[3:])))
        if not body["fixed"]:
            inertia = rapier.MassProperties((0, 0, 0), body["mass"], tuple(body["inertia"]))
            made = made.additional_mass_properties(inertia)
            made = made.linvel(tuple(body["velocity"])).angvel(tuple(body["angular_velocity"]))
            made = made.can_sleep(self.sleep)
        kind, size = shape(body)
        if kind == "plane":
            collider = rapier.Collider.halfspace(tuple(size))
        elif kind == "box":
            collider = rapier.Collider.cuboid(*(edge / 2 for edge in size))
        elif kind == "sphere":
            collider = rapier.Collider.ball(size)
        elif kind == "capsule":
            collider = rapier.Collider.capsule_z(size["length"] / 2, size["radius"])
        else:
            raise Unsupported(f"a body of shape {kind}")
        collider = collider.density(0.0).friction(self.surface[0]).restitution(self.surface[1])
        return self.world.add_body(made, colliders=[collider])

    def _join(self, bodies: Any, joint: Joint) -> None:
        """A joint by its point and axis in the axes of both bodies, which do not collide."""
        rapier = self.rapier
        ends = [None if joint.parent is None else bodies[joint.parent], bodies[joint.child]]
        axis = tuple(joint.axis)
        hinge = joint.kind == "hinge"
        made = rapier.RevoluteJointBuilder(axis) if hinge else rapier.SphericalJointBuilder()
        made = made.contacts_enabled(False)
        for number, body in enumerate(ends, 1):
            placed = np.array([0, 0, 0, 1.0, 0, 0, 0]) if body is None else pose(body)
            back = conjugate(placed[3:])
            made = getattr(made, f"local_anchor{number}")(tuple(turned(back, joint.point - placed[:3])))
            if hinge:
                made = getattr(made, f"local_axis{number}")(tuple(turned(back, joint.axis)))
        parent = self.ground if joint.parent is None else self.bodies[joint.parent]
        self.world.impulse_joints.insert(parent, self.bodies[joint.child], made.build())

    def step(self) -> None:
        self.world.step()

    def _found(self) -> list[Any]:
        return [self.world.rigid_bodies[body] for body in self.bodies]

    def poses(self) -> Array:
        turns = [(body.translation, body.rotation) for body in self._found()]
        return np.array([[at.x, at.y, at.z, turn.w, turn.i, turn.j, turn.k] for at, turn in turns])

    def velocities(self) -> Array:
        return np.array([[*body.linvel, *body.angvel] for body in self._found()], dtype=float)

    def forces(self) -> Array | None:
        """The forces along the normals of contacts; of simplified friction Rapier tells none."""
        numbers = {collider: k for k, collider in enumerate(self.colliders)}
        every = np.zeros((len(self.bodies), 3))
        for pair in self.world.narrow_phase.contact_pairs():
            force = np.array([*pair.total_impulse()]) / self.dt  # on the second collider
            every[numbers[pair.collider1]] -= force
            every[numbers[pair.collider2]] += force
        return every


ENGINE = Engine(
    name="rapier",
    package="rapier3d",
    module="rapier3d",
    settings=(
        Settings(
            "defaults",
            "as installed: 4 substeps, contacts of 30 Hz (60 Hz to fixed bodies), bodies at rest sleep, "
            "simplified friction, steps of 1/60 s",
            1 / 60,
        ),
        Settings(
            "accurate",
            "12 substeps, joints told to start from the last impulses (which moves no number here by more "
            "than a fiftieth of its tolerance), contacts of 480 Hz, nothing sleeps, simplified friction, steps of "
            "1/240 s; the best of some thirty that were tried on these scenes",
            1 / 240,
            {
                "parameters": {"num_solver_iterations": 12, "warmstart_joints": True},
                "softness": (480.0, 10.0),
                "sleep": False,
            },
        ),
    ),
    build=Model,
)
