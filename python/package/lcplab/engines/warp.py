"""MuJoCo Warp: MuJoCo's models in single precision, many worlds at a time; here one, on the processor."""

from __future__ import annotations

from typing import Any

import numpy as np

from lcplab import EngineStep
from lcplab._receipt import warp as receipt
from lcplab.engines import Array, Description, Engine, Settings, Unsupported
from lcplab.engines import mujoco

#: The largest numbers of contacts and rows; Warp drops those beyond.
CONTACTS, ROWS = 200, 800
#: MuJoCo's number of the pyramidal cone.
PYRAMIDAL = 0


class Model(mujoco.Model):
    """A scene in MuJoCo Warp. Its poses and velocities are those of MuJoCo's kinematics at its state."""

    #: MuJoCo raises a coefficient of 0 to 1e-5; Warp does not, warns of NaN, and gives it.
    FRICTIONLESS = {"condim": 1}

    def __init__(self, scene: Description, settings: Settings) -> None:
        import mujoco_warp
        import warp

        warp.config.quiet = True
        warp.set_device("cpu")
        super().__init__(scene, settings)
        self.warp: Any = mujoco_warp
        self.own: Any = mujoco_warp.put_model(self.model)
        self.state: Any = mujoco_warp.put_data(self.model, self.data, nconmax=CONTACTS, njmax=ROWS)
        self.is_followed = True

    def step(self) -> None:
        self.warp.step(self.own, self.state)
        self.is_followed = False

    def reported_step(self) -> EngineStep:
        before = self.state.qpos.numpy()[0].astype(float)
        self.step()
        return receipt.read(self.model, self.state, 0, before)

    def _follow(self) -> None:
        """Poses and velocities of bodies at Warp's state, which leaves them at the step's start."""
        if self.is_followed:
            return
        self.data.qpos[:], self.data.qvel[:] = self.state.qpos.numpy()[0], self.state.qvel.numpy()[0]
        for follow in (self.mujoco.mj_kinematics, self.mujoco.mj_comPos, self.mujoco.mj_comVel):
            follow(self.model, self.data)
        self.is_followed = True

    def poses(self) -> Array:
        self._follow()
        return super().poses()

    def velocities(self) -> Array:
        self._follow()
        return super().velocities()

    def forces(self) -> Array | None:
        return contact_forces(self.model, self.state)[self.ids]

    def problem(self) -> Any:
        raise Unsupported("problems in single precision")


def contact_forces(model: Any, state: Any) -> Array:
    """What contacts put on each body of a MuJoCo model in the only world of Warp's data (N, world axes), (nbody, 3)."""
    every = np.zeros((model.nbody, 3))
    np.add.at(every, model.geom_bodyid, geom_forces(model, state))
    return every


def geom_forces(model: Any, state: Any) -> Array:
    """The same for each geom, (ngeom, 3)."""
    every = np.zeros((model.ngeom, 3))
    contact, rows = state.contact, state.efc.force.numpy()[0]
    count = int(np.ravel(state.nacon.numpy())[0])
    frames, geoms = contact.frame.numpy()[:count].reshape(-1, 3, 3), contact.geom.numpy()[:count]
    friction, places = contact.friction.numpy()[:count], contact.efc_address.numpy()[:count]
    sizes = contact.dim.numpy()[:count]
    is_pyramid = model.opt.cone == PYRAMIDAL
    for frame, pair, mu, place, size in zip(frames, geoms, friction, places, sizes):
        if place[0] < 0:
            continue
        own = rows[place[: 2 * (size - 1) if is_pyramid and size > 1 else size]]
        local = pyramid(own, mu) if is_pyramid and size > 1 else own[:3]
        force = frame[: len(local)].T @ local  # on the second geom
        every[pair[0]] -= force
        every[pair[1]] += force
    return every


def pyramid(edges: Array, mu: Array) -> Array:
    """The force along normal and tangents, (3,), of those along the edges normal ± mu tangent."""
    return np.array([edges.sum(), *(mu[k] * (edges[2 * k] - edges[2 * k + 1]) for k in range(2))], dtype=float)


ENGINE = Engine(
    name="warp",
    package="mujoco-warp",
    module="mujoco_warp",
    settings=(
        Settings(
            "defaults",
            "as installed, on the processor: single precision, Newton's method, pyramids for cones, Euler, steps of 2 ms",
            0.002,
        ),
        Settings(
            "accurate",
            "single precision, elliptic cones, impratio 100, tolerance 1e-6 (the smallest) in 100 iterations, implicitfast, "
            "contacts as stiff as the step allows (solref 2 dt), steps of 1 ms; with RK4, as for MuJoCo, the forces of a "
            "resting stack vibrate",
            0.001,
            {"cone": 1, "impratio": 100.0, "tolerance": 1e-6, "iterations": 100, "integrator": 3},
        ),
    ),
    build=Model,
)
