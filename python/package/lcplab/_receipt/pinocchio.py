"""A solve of Pinocchio's constrained dynamics: accelerations, and the forces of loops and contacts without friction limits."""

from __future__ import annotations

import importlib.metadata
from collections.abc import Sequence
from typing import Any

import numpy as np

from lcplab._lcplab import InputError
from lcplab._receipt.step import Array, Row, Step

#: The time (s) over which J is differentiated.
TIME = 1e-6


def read(
    model: Any, data: Any, q: Array, v: Array, tau: Array, contacts: Sequence[Any], kept: Sequence[Any]
) -> Step:
    """The step of the last ``constraintDynamics`` with these arguments.

    The bias is the one that Pinocchio asked for. The expected bias is that of the contacts' own Baumgarte parameters and of
    J̇v by differences of Pinocchio's J.

    Raises
    ------
    InputError
        If a contact does not constrain the three coordinates of a point.
    """
    import pinocchio

    for number, contact in enumerate(contacts):
        if contact.type != pinocchio.ContactType.CONTACT_3D:
            raise InputError(f"contacts[{number}]: is {contact.type}, only CONTACT_3D can be read")
        if contact.reference_frame != pinocchio.ReferenceFrame.LOCAL:
            raise InputError(f"contacts[{number}]: its reference frame is {contact.reference_frame}, only LOCAL can be read")
    own = model.createData()
    mass = np.triu(pinocchio.crba(model, own, q))
    mass = mass + np.triu(mass, 1).T
    forces = np.array(tau) - pinocchio.nonLinearEffects(model, model.createData(), q, v)
    gravity = pinocchio.computeGeneralizedGravity(model, model.createData(), q)
    jacobian, asked, rows = [], [], []
    for number, (contact, values) in enumerate(zip(contacts, kept)):
        jacobian.append(_jacobian(pinocchio, model, contact, q)[0])
        drift = _drift(pinocchio, model, contact, np.array(q), np.array(v))
        correction = contact.m_baumgarte_parameters
        asked.append(drift + correction.Kp * np.array(values.contact_placement_error.linear)
                     + correction.Kd * np.array(values.contact_velocity_error.linear)
                     - np.array(values.contact_acceleration_desired.linear))
        rows += [Row(f"loop {number}: {axis}", "loop") for axis in "xyz"]
    lines = np.vstack(jacobian) if jacobian else np.zeros((0, model.nv))
    motion = np.array(data.ddq)
    return Step.of(
        "Pinocchio", mass, lines, -np.array(data.primal_rhs_contact)[: len(lines)], np.linalg.solve(mass, forces),
        np.array(data.lambda_c)[: len(lines)], motion, level="acceleration", lo=-np.inf, rows=rows,
        version=importlib.metadata.version("pin"), gravity=float(np.sqrt(gravity @ np.linalg.solve(mass, gravity))),
        expected_bias=np.concatenate(asked) if asked else np.zeros(0), name=str(model.name),
    )


def _jacobian(pinocchio: Any, model: Any, contact: Any, q: Array) -> tuple[Array, Array]:
    """J of a contact in its local axes, (3, nv), and these axes as columns, (3, 3)."""
    own, values = model.createData(), contact.createData()
    pinocchio.computeJointJacobians(model, own, q)
    pinocchio.updateGlobalPlacements(model, own)
    contact.calc(model, own, values)
    jacobian = np.array(pinocchio.getConstraintJacobian(model, own, contact, values))
    return jacobian, np.array(values.oMc1.rotation)


def _drift(pinocchio: Any, model: Any, contact: Any, q: Array, v: Array) -> Array:
    """The acceleration of a contact at constant v, in its local axes, by central differences, (3,)."""
    sides = []
    for time in (TIME, -TIME):
        jacobian, axes = _jacobian(pinocchio, model, contact, pinocchio.integrate(model, q, time * v))
        sides.append(axes @ jacobian @ v)
    axes = _jacobian(pinocchio, model, contact, q)[1]
    return np.asarray(axes.T @ (sides[0] - sides[1]) / (2 * TIME))
