"""lcplab's own schemes, held to the same laws by the same code."""

from __future__ import annotations

from lcplab import Scene
from lcplab.engines import Array, Description, Engine, Settings


class Stepped:
    """A scene that lcplab steps."""

    def __init__(self, scene: Description, settings: Settings) -> None:
        values = dict(settings.values)
        contact = {**scene["contact"], "model": values.pop("model", scene["contact"]["model"])}
        step = {**scene["step"], "dt": settings.dt}
        for key, value in values.items():
            step[key] = {**step[key], **value} if isinstance(value, dict) else value
        self.scene = Scene.of({**scene, "step": step, "contact": contact})

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
        _scheme(
            "velocity, cone", 0.002, "velocity level, Coulomb's cone by APGD, a fifth of an error fed back",
            scheme="velocity", model="coulomb-cone", baumgarte=0.2,
        ),
        _scheme("acceleration", 0.005, "acceleration level, Dantzig's method, RK4", integrator="rk4"),
        _scheme("xpbd", 0.005, "XPBD, 20 substeps", substeps=20),
        _scheme(
            "soft", 0.005, "soft constraints of 200 Hz, 8 substeps",
            soft={"joint_hertz": 200.0, "contact_hertz": 200.0},
        ),
    ),
    build=Stepped,
)
