"""Scenes of Drake, which reports neither the bias of its constraints nor the motion without them."""

from __future__ import annotations

import importlib.metadata
import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from lcplab._receipt.step import Array, Step

DT = 1e-3
#: SAP's near-rigid limit: a rigid row gets the compliance β²/(4π²) w, and -φ / (2 dt) as its velocity. For the coupler w
#: is the sum of inverses of diagonal entries of M: so measured, Drake 1.20 meets the row to 1e-16.
BETA = 0.1
#: A driven slider (kg, N/m, N s/m).
MASS, STIFFNESS, DAMPING = 2.0, 100.0, 10.0


def floating_gripper() -> Iterator[Step]:
    """A hand with two fingers on sliders, coupled by q₀ = -q₁, at different heights without gravity."""
    for height in (0.0, 0.1, 0.25, 0.5):
        yield _gripper(height)


def _gripper(height: float) -> Step:
    import pydrake.all as drake

    builder, plant = _plant(drake)
    hand = plant.AddRigidBody("hand", _inertia(drake, 1.0))
    sliders = []
    for mass in (0.1, 0.2):
        finger = plant.AddRigidBody(f"finger of {mass} kg", _inertia(drake, mass))
        axes = hand.body_frame(), finger.body_frame(), [1, 0, 0]
        sliders.append(plant.AddJoint(drake.PrismaticJoint(f"slider of {mass} kg", *axes)))
    plant.AddCouplerConstraint(*sliders, -1.0, 0.0)
    simulator, context = _started(drake, builder, plant)
    plant.SetFreeBodyPose(context, hand, drake.RigidTransform([0, 0, height]))
    for slider, place, rate in zip(sliders, (0.05, -0.04), (0.3, 0.1)):
        slider.set_translation(context, place)
        slider.set_translation_rate(context, rate)
    mass = plant.CalcMassMatrixViaInverseDynamics(context)
    target = plant.GetVelocities(context) - DT * np.linalg.solve(mass, plant.CalcBiasTerm(context))
    apart = sum(slider.get_translation(context) for slider in sliders)
    simulator.AdvanceTo(DT)
    columns = [slider.velocity_start() for slider in sliders]
    return coupled(mass, columns, target, np.array(plant.GetVelocities(context)), apart, _version())


def coupled(mass: Array, columns: list[int], target: Array, motion: Array, apart: float, version: str = "") -> Step:
    """The step with the bias that Drake's own motion solves: v + R x + bias = 0 in the only row."""
    jacobian = np.zeros((1, len(target)))
    jacobian[0, columns] = 1.0
    forces = np.linalg.lstsq(jacobian.T, mass @ (motion - target), rcond=None)[0]
    compliance = BETA**2 / (4 * math.pi**2) * np.sum(1 / np.diag(mass)[columns])
    return Step.of(
        "Drake",
        mass=mass,
        jacobian=jacobian,
        bias=-(jacobian @ motion + compliance * forces),
        compliance=compliance,
        target=target,
        forces=forces,
        motion=motion,
        lo=-np.inf,
        version=version,
        expected_bias=np.array([apart / (2 * DT)]),
        not_checked=["solver: Drake reports neither bias nor impulse of the coupler; they are those of its motion"],
    )


def driven_slider() -> Iterator[Step]:
    """A slider with a PD controller and a feed-forward force, and without constraints."""
    for force, place, rate in ((3.0, 0.0, 0.0), (3.0, 0.02, 0.5), (-2.0, 0.1, -0.3), (0.5, -0.05, 0.0)):
        yield _driven(force, place, rate)


def _driven(force: float, place: float, rate: float) -> Step:
    import pydrake.all as drake

    builder, plant = _plant(drake)
    body = plant.AddRigidBody("body", _inertia(drake, MASS))
    slider = plant.AddJoint(drake.PrismaticJoint("slider", plant.world_frame(), body.body_frame(), [1, 0, 0]))
    plant.AddJointActuator("motor", slider).set_controller_gains(drake.PdControllerGains(p=STIFFNESS, d=DAMPING))
    simulator, context = _started(drake, builder, plant)
    plant.get_actuation_input_port().FixValue(context, [force])
    plant.get_desired_state_input_port(drake.default_model_instance()).FixValue(context, [0.0, 0.0])
    slider.set_translation(context, place)
    slider.set_translation_rate(context, rate)
    simulator.AdvanceTo(DT)
    return free(force, place, rate, slider.get_translation_rate(context), _version())


def free(force: float, place: float, rate: float, after: float, version: str = "") -> Step:
    """The step of the slider, whose controller is implicit: m (v - v₀) = dt (u - k (q₀ + dt v) - d v)."""
    expected = (MASS * rate + DT * (force - STIFFNESS * place)) / (MASS + DT * DAMPING + DT**2 * STIFFNESS)
    return Step.of(
        "Drake",
        mass=[[MASS]],
        jacobian=np.zeros((0, 1)),
        bias=[],
        target=[after],
        forces=[],
        motion=[after],
        version=version,
        expected_target=np.array([expected]),
        not_checked=["write-back: without constraints Drake reports the motion alone, which is taken as u*"],
    )


def _version() -> str:
    return importlib.metadata.version("drake")


def _plant(drake: Any) -> tuple[Any, Any]:
    """A plant with Drake's solver SAP, without gravity."""
    builder = drake.DiagramBuilder()
    plant, _ = drake.AddMultibodyPlantSceneGraph(builder, DT)
    plant.set_discrete_contact_solver(drake.DiscreteContactSolver.kSap)
    plant.mutable_gravity_field().set_gravity_vector([0, 0, 0])
    return builder, plant


def _inertia(drake: Any, mass: float) -> Any:
    return drake.SpatialInertia(mass, np.zeros(3), drake.UnitInertia(0.01, 0.01, 0.01))


def _started(drake: Any, builder: Any, plant: Any) -> tuple[Any, Any]:
    plant.Finalize()
    diagram = builder.Build()
    context = diagram.CreateDefaultContext()
    return drake.Simulator(diagram, context), plant.GetMyMutableContextFromRoot(context)
