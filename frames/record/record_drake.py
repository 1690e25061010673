"""Frames from Drake: MultibodyPlant with SAP, contact by points or by hydroelastic surfaces.

Level velocity (x in N s, w in m/s). Told: mass matrix, forces, contact points, surfaces, Jacobians. SAP does not tell
its own compliance; it is derived here as its paper states it (Castro et al. 2022, beta = 1, sigma = 1e-3):

- M is the mass matrix plus dt times the damping of joints, u_star = v + dt inv(M) (forces - C(v));
- R_n = max(|W| / 4 pi^2, 1 / (k dt (dt + tau))), R_t = sigma |W|, |W| a third of the Frobenius norm of the contact's
  block of J inv(M) J'; the normal's bias is -depth / (dt + tau); tau is the sum of the two bodies' relaxation times;
- points: depth and the stiffnesses in series; a face of a surface: k = area g, depth = pressure / g, g the two
  pressure gradients along the normal in series; faces below 1e-9 m^2 are left out;
- limits of joints: rows with beta = 0.1 and tau = dt, where the limit is nearer than two steps.

    python record_drake.py FOLDER
"""

import importlib.metadata
import pathlib
import sys

import numpy as np
from pydrake.geometry import HydroelasticContactRepresentation, SceneGraphConfig
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, DiscreteContactApproximation
from pydrake.multibody.tree import BodyIndex, JacobianWrtVariable, MultibodyForces
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

import mjcf
from frames import Rows, tangents

STIFFNESS, RELAXATION, SIGMA = 1e6, 0.02, 1e-3  # N/m and s of each body; SAP's sigma
SMALLEST = 1e-9  # m^2: smaller faces carry nothing, their compliance is beyond 1e6 of the others
NEAR_RIGID = 1 / (4 * np.pi**2)


def world(xml, dt, modulus):
    """Diagram and plant of a scene; with a modulus (Pa) all shapes are compliant and touch by surfaces."""
    builder = DiagramBuilder()
    plant, scene = AddMultibodyPlantSceneGraph(builder, dt)
    config = SceneGraphConfig()
    config.default_proximity_properties.point_stiffness = STIFFNESS
    config.default_proximity_properties.relaxation_time = RELAXATION
    if modulus:
        config.default_proximity_properties.compliance_type = "compliant"
        config.default_proximity_properties.hydroelastic_modulus = modulus
        config.default_proximity_properties.resolution_hint = 0.05
    scene.set_config(config)
    Parser(plant).AddModelsFromString(xml, "xml")
    plant.set_discrete_contact_approximation(DiscreteContactApproximation.kSap)
    plant.Finalize()
    return builder.Build(), plant


class Step:
    """The state that a plant is in, and its rows."""

    def __init__(self, plant, context, control):
        self.plant, self.context, self.dt = plant, context, plant.time_step()
        k = plant.num_velocities()
        damping = np.zeros(k)
        for index in plant.GetJointIndices():
            joint = plant.get_joint(index)
            if joint.num_velocities():
                first = joint.velocity_start()
                damping[first : first + joint.num_velocities()] = joint.default_damping_vector()
        self.M = plant.CalcMassMatrix(context) + self.dt * np.diag(damping)
        forces = MultibodyForces(plant)
        plant.CalcForceElementsContribution(context, forces)
        push = forces.generalized_forces() + plant.CalcGravityGeneralizedForces(context)
        if len(control):
            push = push + plant.MakeActuationMatrix() @ control
        push = push - plant.CalcBiasTerm(context)
        self.u_star = plant.GetVelocities(context) + self.dt * np.linalg.solve(self.M, push)
        self.rows = Rows(k)

    def delassus(self, J):
        """|W| of a contact or of one row."""
        return np.linalg.norm(J @ np.linalg.solve(self.M, J.T)) / len(J)

    def jacobian(self, frame, point):
        """3 x k: velocity of the point (m, world) of a body."""
        world = self.plant.world_frame()
        place = self.plant.CalcPointsPositions(self.context, world, point, frame)
        return self.plant.CalcJacobianTranslationalVelocity(
            self.context, JacobianWrtVariable.kV, frame, place, world, world
        )

    def contact(self, inspector, id_a, id_b, point, normal, stiffness, depth):
        """The rows of a contact; the normal points from b into a."""
        frames = [self.plant.GetBodyFromFrameId(inspector.GetFrameId(i)).body_frame() for i in (id_a, id_b)]
        relative = self.jacobian(frames[0], point) - self.jacobian(frames[1], point)
        J = np.array([normal, *tangents(normal)]) @ relative
        frictions = [
            inspector.GetProximityProperties(i).GetProperty("material", "coulomb_friction") for i in (id_a, id_b)
        ]
        a, b = (friction.dynamic_friction() for friction in frictions)
        size, tau = self.delassus(J), 2 * RELAXATION
        R_n = max(NEAR_RIGID * size, 1 / (stiffness * self.dt * (self.dt + tau)))
        self.rows.contact(J, 2 * a * b / (a + b), (-depth / (self.dt + tau), 0, 0), (R_n, SIGMA * size, SIGMA * size))

    def limits(self):
        """The rows of joints at their limits."""
        for index in self.plant.GetJointIndices():
            joint = self.plant.get_joint(index)
            if joint.num_velocities() != 1:
                continue
            row = np.zeros((1, self.rows.k))
            row[0, joint.velocity_start()] = 1
            q, v = joint.GetOnePosition(self.context), joint.GetOneVelocity(self.context)
            for side, gap in ((1, q - joint.position_lower_limit()), (-1, joint.position_upper_limit() - q)):
                if gap < 2 * self.dt * max(abs(v), abs(row[0] @ self.u_star)):
                    self.rows.add(side * row[0], gap / (2 * self.dt), 0.01 * NEAR_RIGID * self.delassus(row))

    def contacts(self, has_surfaces):
        """The rows of all contacts."""
        query = self.plant.get_geometry_query_input_port().Eval(self.context)
        inspector = query.inspector()
        if has_surfaces:
            for surface in query.ComputeContactSurfaces(HydroelasticContactRepresentation.kPolygon):
                self.surface(inspector, surface)
            return
        for pair in query.ComputePointPairPenetration():
            middle = (pair.p_WCa + pair.p_WCb) / 2
            self.contact(inspector, pair.id_A, pair.id_B, middle, pair.nhat_BA_W, STIFFNESS / 2, pair.depth)

    def surface(self, inspector, surface):
        """A contact for each face of a surface."""
        for face in range(surface.num_faces()):
            normal, middle = surface.face_normal(face), surface.centroid(face)
            pressure = surface.poly_e_MN().EvaluateCartesian(face, middle)
            slopes = [surface.EvaluateGradE_M_W(face) @ normal, -(surface.EvaluateGradE_N_W(face) @ normal)]
            if pressure <= 0 or min(slopes) <= 0 or surface.area(face) < SMALLEST:
                continue
            g = 1 / (1 / slopes[0] + 1 / slopes[1])
            stiffness = surface.area(face) * g
            self.contact(inspector, surface.id_M(), surface.id_N(), middle, normal, stiffness, pressure / g)


def record(folder, name, xml, *, steps, push={}, control=(), modulus=0, dt=0.005, scene="mjcf.py"):
    """Steps, then pushes (m/s) of free bodies, and the frame of the state that they leave."""
    diagram, plant = world(xml, dt, modulus)
    simulator = Simulator(diagram)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    control = np.array(control, float)
    if plant.num_actuators():
        plant.get_actuation_input_port().FixValue(context, control)
    simulator.AdvanceTo(steps * dt)
    velocity = plant.GetVelocities(context).copy()
    for body, speed in push.items():
        first = plant.GetBodyByName(body).floating_velocities_start_in_v()
        velocity[first + 3 : first + 6] += speed
    plant.SetVelocities(context, velocity)
    step = Step(plant, context, control)
    step.limits()
    step.contacts(modulus > 0)
    bodies = [plant.get_body(BodyIndex(i)) for i in range(plant.num_bodies())]
    moving = [body for body in bodies if body.default_mass() > 0 and body is not plant.world_body()]
    step.rows.save(
        pathlib.Path(folder) / f"drake_{name}.npz",
        step.M,
        step.u_star,
        cone="associated-cone",
        level="velocity",
        dt=dt,
        lightest=min(body.default_mass() for body in moving),
        source={
            "engine": "Drake",
            "version": importlib.metadata.version("drake"),
            "scene": scene,
            "step": steps + 1,
            "push": {body: list(speed) for body, speed in push.items()},
            "bodies": len(moving),
            "settings": f"SAP, {f'hydroelastic, modulus {modulus:g} Pa' if modulus else 'points, 1e6 N/m'}, relaxation 0.02 s",
            "derived": "R, bias, mu of pairs; M with the damping of joints",
        },
    )


def main(folder):
    put = lambda name, xml, **settings: record(folder, name, xml, **settings)
    box = {"floor": "box"}
    put(
        "stack_surfaces",
        mjcf.stack([1] * 2, shift=0.02, turn=10, **box),
        steps=60,
        push={"box1": (1, 0.4, 0)},
        modulus=1e7,
    )
    put(
        "stack_surfaces_heavy_top",
        mjcf.stack([0.5, 100], half=(0.1, 0.1, 0.1), friction=0.3, **box),
        steps=60,
        push={"box1": (0.4, -0.8, 0)},
        modulus=1e8,
    )
    put(
        "grasp_two_surfaces",
        mjcf.grasp(2, **box),
        steps=60,
        control=(15, 5) * 2,
        push={"object": (0, 0.3, 0)},
        modulus=1e6,
    )
    put(
        "grasp_three_surfaces",
        mjcf.grasp(3, mass=3, round=True, **box),
        steps=60,
        control=(40, 6) * 3,
        push={"object": (0, 0.1, -0.2)},
        modulus=1e7,
    )
    put("humanoid_surfaces", mjcf.humanoid(**box), steps=40, push={"pelvis": (0.7, 0.2, 0)}, modulus=1e7)
    put("humanoid_lying_points", mjcf.humanoid(height=0.25, lean=-90, **box), steps=120, push={"pelvis": (0.5, 0.5, 0)})
    put("walker_four_surfaces", mjcf.walker(4, load=6, **box), steps=60, push={"trunk": (0.8, -0.4, 0)}, modulus=1e7)
    put("walker_six_points", mjcf.walker(6, load=2, friction=0.4, **box), steps=40, push={"trunk": (0, 1, 0)})
    put("vehicle_surfaces", mjcf.vehicle(steps=0, **box), steps=60, push={"car": (1, 0.5, 0)}, modulus=1e7)
    put(
        "dominoes_surfaces",
        mjcf.dominoes(3, spacing=0.07, friction=0.3, **box),
        steps=45,
        push={"domino1": (0.2, 0.1, 0)},
        modulus=1e7,
    )
    put(
        "arm_surfaces",
        mjcf.arm(boxes=2, mass=3, **box),
        steps=60,
        control=(15, 8, 0),
        push={"box1": (0, 0.3, 0)},
        modulus=1e7,
    )
    put("pile_spheres_points", mjcf.pile(24, ["sphere"], 11, **box), steps=300, push={"body1": (0, 1, 1)})
    put(
        "pile_capsules_points",
        mjcf.pile(20, ["capsule", "sphere"], 12, width=0.2, **box),
        steps=300,
        push={"body4": (1, 0, -1)},
    )
    put(
        "pile_mixed_points",
        mjcf.pile(18, ["box", "cylinder", "capsule"], 13, width=0.2, friction=0.4, **box),
        steps=250,
        push={"body2": (0, 0, -1)},
    )
    put("chain_points", mjcf.chain(24, length=0.07, posts=3, **box), steps=60, push={"link0": (0, 0.6, 0)})


if __name__ == "__main__":
    main(sys.argv[1])
