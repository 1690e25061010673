"""lcplab's own schemes, held to the same laws by the same code."""

from __future__ import annotations

from lcplab import Scene
from lcplab.engines import Array, Description, Engine, Settings


class Stepped:
    """A scene that lcplab steps."""

    def __init__(self, scene: Description, settings: Settings) -> None:
        step = {**scene["step"], "dt": settings.dt}
        for key, value in settings.values.items():
            step[key] = {**step[key], **value} if isinstance(value, dict) else value
        changed = {**scene, "step": step}
        self.scene = Scene.of(changed)

    def step(self) -> None:
        self.scene.step()

    def poses(self) -> Array:
        return self.scene.poses

    def velocities(self) -> Array:
        return self.scene.velocities

    def forces(self) -> Array | None:
        return self.scene.forces()


def _scheme(name: str, dt: float, words: str, **values: object) -> Settings:
    return Settings(name, f"{words}, steps of {1e3 * dt:g} ms", dt, {"scheme": name, **values})


ENGINE = Engine(
    name="lcplab",
    package="lcplab",
    module="lcplab",
    settings=(
        _scheme(
            "velocity", 0.001, "velocity level, Dantzig's method, coupled box, a fifth of an error fed back",
            baumgarte=0.2,
        ),
        _scheme("acceleration", 0.005, "acceleration level, Dantzig's method, RK4", integrator="rk4"),
        _scheme("xpbd", 0.005, "XPBD, 20 substeps", substeps=20),
        _scheme(
            "soft", 0.005, "soft constraints (joints 400 Hz, contacts 200 Hz), 8 substeps",
            soft={"joint_hertz": 400.0, "contact_hertz": 200.0},
        ),
    ),
    build=Stepped,
)
