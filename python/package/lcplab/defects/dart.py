"""Scenes of DART, which poses its problem in velocities."""

from __future__ import annotations

import importlib.metadata
from collections.abc import Iterator
from typing import Any

import numpy as np

from lcplab._receipt.step import Array, Step

DT = 1e-3
#: Equations with smaller entries are those across the plane of the chain, 0 = 0, which nothing can violate.
ROUNDING = 1e-12
LENGTHS = (1.0, 0.8, 1.1)
#: The axes and angles by which the chain is turned against those of the world.
TURNS = ((0.3, 0.5, 0.7), (0.7, -0.2, 0.4), (-0.4, 0.9, 0.1), (0.2, 0.3, -1.1), (1.0, 0.6, -0.5))


def welded_chain() -> Iterator[Step]:
    """A planar chain of three hinges, its tip welded to the world: six equations of rank three."""
    for turn in TURNS:
        yield _first_step(np.array(turn))


def _first_step(turn: Array) -> Step:
    """The first step from rest, in which the weld has no error that DART would correct."""
    import dartpy

    world: Any = dartpy.simulation.World()
    world.setGravity([0, 0, -9.81])
    world.setTimeStep(DT)
    chain = _chain(dartpy, turn)
    world.addSkeleton(chain)
    tip = chain.getBodyNode(len(LENGTHS) - 1)
    weld = dartpy.constraint.WeldJointConstraint(tip)
    world.getConstraintSolver().addConstraint(weld)
    jacobian = np.array(chain.getJacobian(tip))  # angular and linear, in the axes of the last link
    jacobian = jacobian[np.abs(jacobian).max(axis=1) > ROUNDING]
    mass = np.array(chain.getMassMatrix())
    target = -DT * np.linalg.solve(mass, chain.getCoriolisAndGravityForces())
    world.step()
    motion = np.array(chain.getVelocities())
    version = importlib.metadata.version("dartpy")
    return Step.of(
        "DART",
        mass=mass,
        jacobian=jacobian,
        bias=np.zeros(len(jacobian)),
        compliance=_compliance(np.diag(jacobian @ np.linalg.solve(mass, jacobian.T)), weld, version),
        target=target,
        forces=np.linalg.lstsq(jacobian.T, mass @ (motion - target), rcond=None)[0],
        motion=motion,
        lo=-np.inf,
        version=version,
        not_checked=["write-back: the impulses of the weld, which DART does not report; they are those of the motion"],
    )


def _compliance(diagonal: Array, weld: Any, version: str) -> Array:
    """What DART adds to the diagonal: a part of it, since 6.18 and the same number once more."""
    mixing = float(weld.getConstraintForceMixing())
    since = tuple(int(part) for part in version.split(".")[:2])
    return mixing * diagonal + (mixing if since >= (6, 18) else 0.0)


def _chain(dartpy: Any, turn: Array) -> Any:
    chain, parent = dartpy.dynamics.Skeleton("chain"), None
    for k, angle in enumerate((1.2, -1.0, -1.3)):
        hinge = dartpy.dynamics.RevoluteJointProperties()
        hinge.mName, hinge.mAxis = f"hinge {k}", [0, 1, 0]
        place = np.eye(4)
        if parent is None:
            place[:3, :3] = _rotation(turn)
        else:
            place[2, 3] = LENGTHS[k - 1]
        hinge.mT_ParentBodyToJoint = dartpy.math.Isometry3(place)
        joint, parent = chain.createRevoluteJointAndBodyNodePair(parent, hinge)
        inertia = dartpy.dynamics.Inertia()
        inertia.setMass(1 + k)
        inertia.setMoment(np.diag([0.1, 0.1, 0.02]))
        inertia.setLocalCOM([0, 0, LENGTHS[k] / 2])
        parent.setInertia(inertia)
        joint.setPosition(0, angle)
    return chain


def _rotation(turn: Array) -> Array:
    """The matrix of a rotation by ``|turn|`` about ``turn`` (Rodrigues)."""
    angle = float(np.linalg.norm(turn))
    x, y, z = turn / angle
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)
