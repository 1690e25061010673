"""A scene of Newton's penalty solver, which reports no impulses."""

from __future__ import annotations

import importlib.metadata
from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike

from lcplab._receipt.step import Array, Step

DT, GRAVITY, FRICTION = 1e-4, 9.81, 0.5
#: A cube of 1 kg, half its edge (m), and the stiffness of each of its four contacts (N/m).
MASS, HALF, STIFFNESS = 1.0, 0.05, 2e4


def sliding_block() -> Iterator[Step]:
    """A cube slides on the ground, pressed in by almost its weight."""
    for speed in (0.5, 0.2, 0.1, 0.05, 0.02):
        before = np.array([speed, 0.0, 0.0])
        yield slide(before, _after(before), importlib.metadata.version("newton"))


def slide(before: ArrayLike, after: ArrayLike, version: str = "") -> Step:
    """The step of the cube's center: rows along the normal and along both tangents, impulses in N s.

    A cube that still slides has friction of mu times the normal impulse, which is taken as the engine's own.
    """
    target = np.asarray(before) - [0.0, 0.0, GRAVITY * DT]
    motion = np.asarray(after, dtype=float)
    side, across, normal = MASS * (motion - target)
    most = FRICTION * normal
    return Step.of(
        "Newton",
        mass=MASS * np.eye(3),
        jacobian=[[0, 0, 1], [1, 0, 0], [0, 1, 0]],
        bias=np.zeros(3),
        target=target,
        forces=[normal, side, across],
        motion=motion,
        lo=[normal, -most, -most],
        hi=[normal, most, most],
        version=version,
        bits=32,
        not_checked=["solver: normal impulses, and that the impulses are those of the motion: Newton reports none"],
    )


def _after(before: Array) -> Array:
    """The velocity after a step of Newton's solver of the first order with explicit forces."""
    import newton
    import warp

    warp.set_device("cpu")
    shape = newton.ModelBuilder.ShapeConfig(
        mu=FRICTION, ke=STIFFNESS, kd=0.0, kf=1e3, density=MASS / (2 * HALF) ** 3
    )
    builder = newton.ModelBuilder()
    builder.add_ground_plane(cfg=shape)
    depth = 0.98 * MASS * GRAVITY / (4 * STIFFNESS)
    body = builder.add_body(xform=warp.transform((0.0, 0.0, HALF - depth), warp.quat_identity()))
    builder.add_shape_box(body, hx=HALF, hy=HALF, hz=HALF, cfg=shape)
    model = builder.finalize()
    solver = newton.solvers.SolverSemiImplicit(model, angular_damping=0.0)
    now, then = model.state(), model.state()
    now.body_qd = warp.array([[*before, 0.0, 0.0, 0.0]], dtype=warp.spatial_vector)
    contacts = model.contacts()
    model.collide(now, contacts)
    now.clear_forces()
    solver.step(now, then, model.control(), contacts, DT)
    return np.array(then.body_qd.numpy()[0][:3], dtype=float)
