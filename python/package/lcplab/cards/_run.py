"""Running a phenomenon on an engine."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from lcplab import EngineStep, InputError
from lcplab.cards._phenomenon import Curve, Measurement
from lcplab.cards._phenomenon import Run as Recorded
from lcplab.cards._solver import CHECKED, SolverPart, part
from lcplab.cards.phenomena import PHENOMENA
from lcplab.engines import Array, Description, Engine, Reported, Settings, Unsupported, World, by_name

#: A body that is farther away (m) than this has left: the run went wrong.
LEFT = 1e6


@dataclass(frozen=True)
class Column:
    """What an engine with its settings gave for a phenomenon."""

    engine: str
    settings: str
    #: Why there is nothing to measure, if so: the engine has no such thing, or its run went wrong.
    unsupported: str | None = None
    failed: str | None = None
    measured: list[Measurement] = field(default_factory=list)
    curve: Curve | None = None
    exact: Array | None = None
    #: How long a simulated second takes (s), on the machine that ran it.
    pace: float | None = None
    #: The solver's part in the motion, if something was measured.
    solver: SolverPart | None = None

    @property
    def holds(self) -> bool:
        """Whether the law is met in all that was measured."""
        return bool(self.measured) and all(measurement.holds for measurement in self.measured)


class Left(Exception):
    """A run went wrong."""


def simulate(engine: Engine, settings: Settings, scene: Description, duration: float) -> Recorded:
    """Move a scene by an engine and keep every step."""
    world = engine.build(scene, settings)
    steps = round(duration / settings.dt)
    poses, velocities = [world.poses().copy()], [world.velocities().copy()]
    forces: list[Array] = []
    seconds: list[float] = []
    taken: list[EngineStep] = []
    unreported = ""
    for step in range(steps):
        if unreported or step % max(1, steps // CHECKED):
            start = time.perf_counter()
            world.step()
            seconds.append(time.perf_counter() - start)
        else:
            unreported = _take(world, taken)
        poses.append(world.poses().copy())
        velocities.append(world.velocities().copy())
        if (reported := world.forces()) is not None:
            forces.append(reported.copy())
        if not np.abs(poses[-1]).max() < LEFT:
            raise Left(f"a body was gone after {(step + 1) * settings.dt:.3g} s")
    return Recorded(
        scene=scene,
        dt=settings.dt,
        t=np.array([step * settings.dt for step in range(steps + 1)]),
        poses=np.array(poses),
        velocities=np.array(velocities),
        forces=np.array([np.zeros_like(forces[0]), *forces]) if len(forces) == steps else None,
        seconds=steps * float(np.mean(seconds)) if seconds else 0.0,
        reported=taken,
        unreported=unreported,
    )


def _take(world: World, taken: list[EngineStep]) -> str:
    """Take a step and append it as the engine reports it; why it does not, if so."""
    if not isinstance(world, Reported):
        world.step()
        return "the engine does not report its problem"
    try:
        taken.append(world.reported_step())
    except (Unsupported, InputError) as why:
        return str(why)
    return ""


def run(engine: str, settings: str, phenomenon: str) -> Column:
    """Run a phenomenon on an engine by their names.

    >>> run("lcplab", "velocity", "free_fall").holds
    True
    """
    known, wanted = by_name(engine), _named(PHENOMENA, phenomenon)
    chosen = _named(known.settings, settings)
    try:
        runs = [
            simulate(known, replace(chosen, dt=fraction * chosen.dt), wanted.described(variant), wanted.duration)
            for variant in wanted.variants
            for fraction in wanted.steps
        ]
        if wanted.needs_forces and runs[0].forces is None:
            raise Unsupported("forces are not reported")
    except Unsupported as why:
        return Column(engine, settings, unsupported=str(why))
    except Exception as why:  # an engine may fail in any way of its own; the others go on
        return Column(engine, settings, failed=f"{why}" or type(why).__name__)
    curve = wanted.plot(runs)
    if wanted.x[0] == "time":
        curve = _thinned(curve, wanted.duration)
    return Column(
        engine,
        settings,
        measured=wanted.measure(runs),
        curve=curve,
        exact=wanted.exact(curve, runs[0]),
        pace=_pace([run for run in runs if run.dt == chosen.dt], wanted.duration),
        solver=None if engine == "lcplab" else part(runs),  # its own solvers are judged by its own reports
    )


def _pace(runs: Sequence[Recorded], duration: float) -> float:
    return sum(run.seconds for run in runs) / (duration * len(runs))


#: Number of points of a run in a plot, at the same times for all engines.
POINTS = 101


def _thinned(curve: Curve, duration: float) -> Curve:
    times = np.linspace(0.0, duration, POINTS)
    return Curve(times, np.interp(times, curve.x, curve.y))


def _named(things: Any, name: str) -> Any:
    for thing in things:
        if thing.name == name:
            return thing
    raise ValueError(f"there is no {name!r}; known are {', '.join(thing.name for thing in things)}")


def tasks(engines: list[str], phenomena: list[str]) -> Iterator[tuple[str, str, str]]:
    """Every engine with each of its settings on every phenomenon."""
    for phenomenon in phenomena:
        for engine in engines:
            for settings in by_name(engine).settings:
                yield engine, settings.name, phenomenon
