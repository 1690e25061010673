"""The last step of a discrete Drake plant, read and not changed.

Drake reports contact points, their forces and its matrices, but not its problem. With its default contact approximation, it
looks for velocities v_n, v_t of each point at which the impulses are dt k (depth - dt v_n)₊ (1 - d v_n)₊ along the normal and
-μ n₀ v_t / √(|v_t|² + ε²) along the surface, n₀ being the normal one at the velocity before the step. With the factor of d and
the root as they are at Drake's own velocity after the step, each row has a compliance, and a tangent the bounds ±μ n₀.
"""

from __future__ import annotations

import importlib.metadata
from collections.abc import Sequence
from typing import Any

import numpy as np

from lcplab._lcplab import InputError
from lcplab._receipt.contact_rows import ContactRows, axes_along
from lcplab._receipt.step import Array, Step

#: Drake's defaults: stiffness (N/m) and dissipation (s/m) of a shape, the speed (m/s) below which friction holds in Drake 1.51,
#: and its least compliance as a fraction of the contact's own J M⁻¹Jᵀ.
STIFFNESS, DISSIPATION, STICTION, SIGMA = 1e6, 50.0, 1e-4, 1e-3
NOT_REPORTED = (
    "assembly: compliance and bounds of friction, which Drake does not report; from its documentation, linearized at its own "
    "velocity"
)


def is_mine(model: Any) -> bool:
    """Whether this is a plant of Drake."""
    return type(model).__module__.startswith("pydrake") and hasattr(model, "get_contact_results_output_port")


def state(plant: Any, context: Any) -> tuple[Array, Array]:
    """Copies of the plant's positions and velocities."""
    return np.array(plant.GetPositions(context)), np.array(plant.GetVelocities(context))


def read(plant: Any, context: Any, before: Sequence[Array] | None, stiction: float | None = None) -> Step:
    """The step that the plant has taken from this state.

    Raises
    ------
    InputError
        Without the state before the step, or with that of another plant, or if the plant is not discrete.
    """
    if before is None:
        raise InputError("before: is missing: Drake keeps no state from before a step; pass lcplab.drake.state(plant, context)")
    for name, part, size in zip(("positions", "velocities"), before, (plant.num_positions(), plant.num_velocities())):
        if np.shape(part) != (size,):
            raise InputError(f"before: {name} have the shape {np.shape(part)}, must have ({size},)")
    dt = float(plant.time_step())
    if dt <= 0:
        raise InputError("plant: time_step: is 0: a continuous plant has no steps")
    twin = plant.CreateDefaultContext()
    plant.SetPositions(twin, before[0])
    plant.SetVelocities(twin, before[1])
    motion = np.array(plant.GetVelocities(context))
    gravity = np.array(plant.CalcGravityGeneralizedForces(twin))
    damping = _damping(plant)
    mass = np.array(plant.CalcMassMatrix(twin)) + dt * np.diag(damping)
    forces = gravity - np.array(plant.CalcBiasTerm(twin)) - damping * before[1]
    target = before[1] + dt * np.linalg.solve(mass, forces)
    rows, bounds = ContactRows(len(motion)), []
    stiction = _usual_stiction() if stiction is None else stiction
    results = plant.get_contact_results_output_port().Eval(context)
    for number in range(results.num_point_pair_contacts()):
        bounds.append(_add(rows, results.point_pair_contact_info(number), plant, (context, twin), mass, before[1], motion, dt, stiction))
    return rows.step(
        "Drake", np.array(bounds), mass, target, motion, version=importlib.metadata.version("drake"), method="newton",
        gravity=dt * float(np.sqrt(gravity @ np.linalg.solve(mass, gravity))) if len(motion) else 0.0,
        time=float(context.get_time()), no_bound=_no_bound(plant, context, results, before[0], before[1], dt),
        not_checked=[NOT_REPORTED],
    )


def _usual_stiction() -> float:
    """The speed (m/s) below which friction holds, unless a plant sets another one; Drake does not report that of a plant."""
    from pydrake.multibody.plant import MultibodyPlantConfig

    return float(MultibodyPlantConfig().stiction_tolerance)


def _damping(plant: Any) -> Array:
    """The damping of joints, which is implicit, (k,)."""
    damping = np.zeros(plant.num_velocities())
    for index in plant.GetJointIndices():
        joint = plant.get_joint(index)
        start, count = joint.velocity_start(), joint.num_velocities()
        damping[start : start + count] = joint.default_damping_vector()
    return damping


def _add(
    rows: ContactRows, point: Any, plant: Any, contexts: tuple[Any, Any], mass: Array, before: Array, after: Array, dt: float,
    stiction: float,
) -> float:
    """The rows of a point; returns the bound of its friction (N s)."""
    from pydrake.multibody.tree import JacobianWrtVariable

    (context, twin), pair = contexts, point.point_pair()
    axes = axes_along(np.array(pair.nhat_BA_W))
    place, world = point.contact_point(), plant.world_frame()
    lines, names = np.zeros((3, rows.size)), []
    for index, sign in ((point.bodyA_index(), 1), (point.bodyB_index(), -1)):
        body = plant.get_body(index)
        names.append(str(body.name()))
        local = plant.EvalBodyPoseInWorld(twin, body).inverse().multiply(place)
        jacobian = plant.CalcJacobianTranslationalVelocity(
            twin, JacobianWrtVariable.kV, body.body_frame(), local, world, world
        )
        lines += sign * axes @ np.array(jacobian)
    stiffness, dissipation, friction = _material(plant, context, pair)
    start, end = lines @ before, lines @ after
    factor = 1 - dissipation * end[0]
    most = friction * dt * stiffness * pair.depth * max(1 - dissipation * start[0], 0.0)
    mobility = np.linalg.norm(lines @ np.linalg.solve(mass, lines.T)) / 3
    root = np.hypot(np.linalg.norm(end[1:]), max(stiction, SIGMA * mobility * most))
    tangential = root / most if most > 0 else 0.0
    # A point that leaves faster than 1/d carries nothing: its row is far from closing.
    pressed = 1 / (dt * dt * stiffness * factor) if factor > 0 else 1 / (dt * dt * stiffness)
    bias = -pair.depth / dt if factor > 0 else max(-end[0], 0.0)
    compliance = np.array([pressed, tangential, tangential])
    rows.add((names[0], names[1]), lines, -dt * axes @ np.array(point.contact_force()), bias, compliance, friction)
    return float(most)


def _material(plant: Any, context: Any, pair: Any) -> tuple[float, float, float]:
    """Stiffness (N/m), dissipation (s/m) and coefficient of friction of a pair, as Drake combines them."""
    inspector, parts = plant.EvalSceneGraphInspector(context), []
    for geometry in (pair.id_A, pair.id_B):
        properties = inspector.GetProximityProperties(geometry)
        parts.append((
            float(properties.GetPropertyOrDefault("material", "point_contact_stiffness", STIFFNESS)),
            float(properties.GetPropertyOrDefault("material", "hunt_crossley_dissipation", DISSIPATION)),
            float(properties.GetProperty("material", "coulomb_friction").dynamic_friction()),
        ))
    (k1, d1, m1), (k2, d2, m2) = parts
    friction = 2 * m1 * m2 / (m1 + m2) if m1 + m2 > 0 else 0.0
    return k1 * k2 / (k1 + k2), (k2 * d1 + k1 * d2) / (k1 + k2), friction


def _no_bound(plant: Any, context: Any, results: Any, positions: Array, velocities: Array, dt: float) -> str:
    """Which rows or forces the step has that cannot be read; "" if there are none."""
    if plant.get_discrete_contact_approximation().name != "kLagged":
        return "because the law of friction is known for Drake's lagged approximation only"
    if results.num_hydroelastic_contacts():
        return "because the problem of contact surfaces is not known"
    if plant.num_constraints():
        return "because Drake does not report the impulses of constraints"
    if plant.num_actuators():
        return "because the actuation of the step is not known"
    ports = (plant.get_applied_generalized_force_input_port(), plant.get_applied_spatial_force_input_port())
    if any(port.HasValue(context) for port in ports):
        return "because external forces act on bodies"
    if plant.num_force_elements() > 1:
        return "because the forces of force elements are not known"
    margin = 4 * dt * float(np.abs(velocities).max(initial=0.0))
    low, high = np.array(plant.GetPositionLowerLimits()), np.array(plant.GetPositionUpperLimits())
    if np.any((positions < low + margin) | (positions > high - margin)):
        return "because Drake does not report the impulse of a joint's limit"
    return ""
