"""Drake: joint coordinates in discrete steps, compliant contacts with regularized friction, solved by SAP.

Static and dynamic friction both get the scene's coefficient; of two equal ones Drake makes the same again. It
has no coefficient of restitution: dissipation d bounds the speed after a bounce by 1/d, 2 cm/s by default.
The defaults run a scene that bounces all the same, the accurate settings refuse it. A ball joint has three
angles about the axes x, y, z and is singular where the second is a right angle. A joint that closes a loop
is one point that two bodies share, for a hinge two points of its axis, 5 cm to each side.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lcplab import EngineStep
from lcplab._receipt import drake as receipt
from lcplab.engines import Array, Description, Engine, Joint, Posed, Settings, Unsupported
from lcplab.engines import conjugate, joints, one_value, pose, rates, relative, shape, springs, turned
from lcplab._receipt.contact_rows import axes_along
from lcplab._receipt.drake import DISSIPATION, SIGMA, STICTION, STIFFNESS
from lcplab.engines._contacts import Contacts

#: The hydroelastic modulus of bodies (Pa) in the accurate settings. Drake's guide calls 1e5 to 1e7 good
#: approximations of rigid contact and sees no reason for more.
MODULUS = 1e7
#: How finely round bodies are meshed (m), as Drake has it by default, and smaller ones in parts of their radius.
MESH, FINE = 0.02, 0.2


class Model:
    """A scene in Drake."""

    def __init__(self, scene: Description, settings: Settings) -> None:
        from pydrake import geometry, math
        from pydrake.common import eigen_geometry
        from pydrake.multibody import math as spatial, plant, tree
        from pydrake.systems import analysis, framework

        self.scene = scene
        self.geometry: Any = geometry
        self.math: Any = math
        self.quaternion: Any = eigen_geometry.Quaternion
        self.plants: Any = plant
        self.tree: Any = tree
        self.velocity: Any = spatial.SpatialVelocity
        self.accurate = settings.name == "accurate"
        self.stiction: float | None = settings.values.get("plant", {}).get("stiction_tolerance")
        if one_value(scene, "restitution") > 0 and self.accurate:
            raise Unsupported("a coefficient of restitution")
        builder = framework.DiagramBuilder()
        config = plant.MultibodyPlantConfig(time_step=settings.dt, **settings.values.get("plant", {}))
        self.plant: Any
        self.plant, graph = plant.AddMultibodyPlant(config, builder)
        self.plant.mutable_gravity_field().set_gravity_vector(scene["gravity"])
        self.friction = one_value(scene, "friction")
        self.bodies: list[Any] = [self.plant.AddRigidBody(body["name"], self._inertia(body))
                                  for body in scene["bodies"]]
        #: The body's number for each geometry.
        self.owners: dict[Any, int] = {}
        every = joints(scene, besides=("spring",))
        hangs = {joint.child: joint for joint in every if not joint.closes}
        for k, body in enumerate(scene["bodies"]):
            self._shape(k, body)
            if k in hangs:
                self._join(scene["bodies"], hangs[k])
            elif body["fixed"]:
                at = self._transform(pose(body))
                self.plant.WeldFrames(self.plant.world_frame(), self.bodies[k].body_frame(), at)
            else:
                self.plant.SetDefaultFloatingBaseBodyPose(self.bodies[k], self._transform(pose(body)))
        for joint in every:
            if joint.closes:
                self._close(scene["bodies"], joint, graph)
        for spring in springs(scene):
            ends: list[Any] = []
            for number, point in spring.ends:
                ends += [self.plant.world_body() if number is None else self.bodies[number], point]
            self.plant.AddForceElement(self.tree.LinearSpringDamper(*ends, spring.length, spring.stiffness, 0.0))
        self.plant.Finalize()
        self.simulator: Any = analysis.Simulator(builder.Build())
        self.context: Any = self.plant.GetMyMutableContextFromRoot(self.simulator.get_mutable_context())
        self.dt, self.steps = settings.dt, 0
        for k in range(len(scene["bodies"])):
            self._set_going(scene["bodies"], k, hangs.get(k))

    def _inertia(self, body: Any) -> Any:
        if any(body["force"]) or any(body["torque"]):
            raise Unsupported("forces on bodies")
        if body["fixed"]:
            return self.tree.SpatialInertia.Zero()
        moments = self.tree.RotationalInertia(*body["inertia"])
        return self.tree.SpatialInertia.MakeFromCentralInertia(body["mass"], [0, 0, 0], moments)

    def _transform(self, at: Array) -> Any:
        return self.math.RigidTransform(self.quaternion(wxyz=at[3:] / np.linalg.norm(at[3:])), at[:3])

    def _shape(self, k: int, body: Any) -> None:
        """A body's shape. Planes are rigid: a soft one and a soft box meet in one point, as by default.

        A fixed plane is a shape of the world: on a body, Drake 1.51 and 1.58 crash with more than about 15 other shapes.
        """
        kind, size = shape(body)
        owner, at = self.bodies[k], self.math.RigidTransform()
        if kind == "plane":
            if size != [0, 0, 1]:
                raise Unsupported("planes across other axes than z")
            made = self.geometry.HalfSpace()
            if body["fixed"]:
                owner, at = self.plant.world_body(), self._transform(pose(body))
        elif kind == "box":
            made = self.geometry.Box(*size)
        elif kind == "sphere":
            made = self.geometry.Sphere(size)
        elif kind == "capsule":
            made = self.geometry.Capsule(size["radius"], size["length"])
        else:
            raise Unsupported(f"a body of shape {kind}")
        properties = self.geometry.ProximityProperties()
        friction = self.plants.CoulombFriction(self.friction, self.friction)
        self.geometry.AddContactMaterial(properties=properties, friction=friction)
        if self.accurate and kind == "plane":
            self.geometry.AddRigidHydroelasticProperties(properties=properties)
        elif self.accurate:
            radius = size if kind == "sphere" else size["radius"] if kind == "capsule" else np.inf
            self.geometry.AddCompliantHydroelasticProperties(min(MESH, FINE * radius), MODULUS, properties)
        made = self.plant.RegisterCollisionGeometry(owner, at, made, body["name"], properties)
        self.owners[made] = k

    def _join(self, bodies: Any, joint: Joint) -> None:
        """A joint of the tree. Its frames have the child's axes, so that it stands at zero at the start."""
        own = pose(bodies[joint.child])
        frame = np.concatenate([joint.point, own[3:]])
        sides = [(self.bodies[joint.child], relative(own, frame))]
        if joint.parent is None:
            sides.insert(0, (self.plant.world_body(), frame))
        else:
            sides.insert(0, (self.bodies[joint.parent], relative(pose(bodies[joint.parent]), frame)))
        name = f"joint of {bodies[joint.child]['name']}"
        ends = [self.plant.AddFrame(self.tree.FixedOffsetFrame(f"{name}, {side.name()}", side.body_frame(),
                                                               self._transform(at))) for side, at in sides]
        if joint.kind == "hinge":
            made = self.tree.RevoluteJoint(name, *ends, turned(conjugate(own[3:]), joint.axis))
        else:
            made = self.tree.BallRpyJoint(name, *ends)
        self.plant.AddJoint(made)

    def _close(self, bodies: Any, joint: Joint, graph: Any) -> None:
        """A loop's last joint as constraints of points; its bodies do not collide.

        The world takes part as a body that is welded to it: on the world itself Drake 1.51 crashes.
        """
        spread = [0.0] if joint.kind == "ball" else [-0.05, 0.05]
        for far in spread:
            point = np.array([*(joint.point + far * joint.axis), 1, 0, 0, 0])
            on_child = relative(pose(bodies[joint.child]), point)[:3]
            if joint.parent is None:
                parent, on_parent = self._anchor(), point[:3]
            else:
                parent, on_parent = self.bodies[joint.parent], relative(pose(bodies[joint.parent]), point)[:3]
            self.plant.AddBallConstraint(self.bodies[joint.child], on_child, parent, on_parent)
        if joint.parent is not None:
            pair = [self.geometry.GeometrySet(self.plant.GetCollisionGeometriesForBody(self.bodies[k]))
                    for k in (joint.parent, joint.child)]
            apart = self.geometry.CollisionFilterDeclaration().ExcludeBetween(*pair)
            graph.collision_filter_manager().Apply(apart)

    def _anchor(self) -> Any:
        """The body that stands for the world in constraints."""
        if not self.plant.HasBodyNamed("world that closes"):
            made = self.plant.AddRigidBody("world that closes", self.tree.SpatialInertia.Zero())
            self.plant.WeldFrames(self.plant.world_frame(), made.body_frame())
        return self.plant.GetBodyByName("world that closes")

    def _set_going(self, bodies: Any, k: int, hung: Joint | None) -> None:
        body = bodies[k]
        velocity = [*body["angular_velocity"], *body["velocity"]]
        if body["fixed"] or not any(velocity):
            return
        if not self.bodies[k].is_floating_base_body():
            turning = rates(hung, bodies, k)
            if turning.any():
                self.plant.GetJointByName(f"joint of {body['name']}").set_angular_velocity(self.context, turning)
            return
        moving = self.velocity(w=np.array(velocity[:3]), v=np.array(velocity[3:]))
        self.plant.SetFreeBodySpatialVelocity(self.context, self.bodies[k], moving)

    def step(self) -> None:
        self.steps += 1
        self.simulator.AdvanceTo(self.steps * self.dt)

    def reported_step(self) -> EngineStep:
        before = receipt.state(self.plant, self.context)
        self.step()
        return receipt.read(self.plant, self.context, before, self.stiction)

    def poses(self) -> Array:
        found = [self.plant.EvalBodyPoseInWorld(self.context, body) for body in self.bodies]
        return np.array([[*at.translation(), *at.rotation().ToQuaternion().wxyz()] for at in found])

    def velocities(self) -> Array:
        found = [self.plant.EvalBodySpatialVelocityInWorld(self.context, body) for body in self.bodies]
        return np.array([[*moving.translational(), *moving.rotational()] for moving in found])

    def forces(self) -> Array | None:
        results = self.plant.get_contact_results_output_port().Eval(self.context)
        every = np.zeros((len(self.bodies), 3))
        for k in range(results.num_point_pair_contacts()):
            point = results.point_pair_contact_info(k)
            every[self.owners[point.point_pair().id_A]] -= point.contact_force()
            every[self.owners[point.point_pair().id_B]] += point.contact_force()
        for k in range(results.num_hydroelastic_contacts()):
            surface = results.hydroelastic_contact_info(k)
            force = surface.F_Ac_W().translational()  # on the body of the first geometry
            every[self.owners[surface.contact_surface().id_M()]] += force
            every[self.owners[surface.contact_surface().id_N()]] -= force
        return every

    def problem(self) -> Posed:
        """The contact problem of a step, which is taken here, as Drake poses it, and Drake's own impulses.

        Points, depths and forces are those of the contact results of the step, poses and velocities those before
        it, masses and moments those of the scene. Drake looks for velocities v_n, v_t of each point at which the
        impulses are dt k (depth − dt v_n)₊ (1 − d v_n)₊ along its normal and −μ n₀ v_t/√(|v_t|² + ε²) along its
        surface, n₀ being the normal one at the velocity before the step. That is no LCP. It becomes one with the
        factor of d and with the root as they are at Drake's own velocity after the step: each row then has a
        compliance, and a tangent the bounds ±μ n₀. Its only solution is Drake's answer if that solves Drake's
        own equations. A point that leaves faster than 1/d carries nothing, yet has the friction of n₀.
        """
        if self.accurate:
            raise Unsupported("surfaces of contact")
        before, dt = self.velocities(), self.dt
        contacts = Contacts(self.scene, self.poses(), before, dt)
        self.step()
        after = self.velocities()
        results = self.plant.get_contact_results_output_port().Eval(self.context)
        bounds = []
        for number in range(results.num_point_pair_contacts()):
            point = results.point_pair_contact_info(number)
            pair = self.owners[point.point_pair().id_A], self.owners[point.point_pair().id_B]
            normal, depth = np.array(point.point_pair().nhat_BA_W), point.point_pair().depth
            axes = axes_along(normal)
            place = point.contact_point()
            lines = contacts.lines(pair, (place, place), axes)
            start, end = (lines @ moving[list(contacts.first)].ravel() for moving in (before, after))
            factor = 1 - DISSIPATION * end[0]
            most = self.friction * dt * STIFFNESS / 2 * depth * max(1 - DISSIPATION * start[0], 0.0)
            mobility = np.linalg.norm(lines @ np.linalg.solve(contacts.mass, lines.T)) / 3
            root = np.hypot(np.linalg.norm(end[1:]), max(STICTION, SIGMA * mobility * most))
            tangential = root / most if most > 0 else 0.0
            pressed = 2 / (dt * dt * STIFFNESS * factor) if factor > 0 else 0.0
            compliance = np.array([pressed, tangential, tangential])
            contacts.add(pair, lines, -dt * axes @ point.contact_force(), -depth / dt, compliance)
            bounds.append([np.inf if factor > 0 else 0.0, most, most])
        return contacts.posed("impulses (N s), soft points with lagged friction", most=np.array(bounds))


ENGINE = Engine(
    name="drake",
    package="drake",
    module="pydrake",
    settings=(
        Settings(
            "defaults",
            "as installed: one point a pair of bodies (1e6 N/m and 50 s/m a body), lagged friction, stiction "
            "to 1e-4 m/s, steps of 1 ms",
            0.001,
        ),
        Settings(
            "accurate",
            "hydroelastic contact (rigid planes, bodies of 1e7 Pa and 50 s/m), lagged friction, stiction to "
            "1e-6 m/s, steps of 0.5 ms",
            0.0005,
            {"plant": {"stiction_tolerance": 1e-6}},
        ),
    ),
    build=Model,
)
