"""Scenes on their way through time."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import Any

from lcplab import _lcplab
from lcplab._problem import Array, Problem
from lcplab._solve import Solver


class Step:
    """A step that a scene has taken; true if the judge accepts all that was solved in it."""

    def __init__(self, told: dict[str, Any]) -> None:
        self.number: int = told["number"]
        self.solvers: list[str] = told["solvers"]
        self.statuses: list[str] = told["statuses"]
        self.verdicts: list[str] = told["verdicts"]
        self.x: Array | None = told.get("x")
        self._is_accepted: bool = told["is_accepted"]

    def __bool__(self) -> bool:
        return self._is_accepted

    def __repr__(self) -> str:
        return f"<lcplab.Step {self.number}: {', '.join(self.verdicts) or 'nothing to solve'}>"


class Scene:
    """A scene on its way through time.

    Examples
    --------
    >>> s = Scene.load("fig7")
    >>> s.step().x.tolist()
    [4.0, 3.0, 1.0]
    """

    def __init__(self, inner: _lcplab.Scene) -> None:
        self._inner = inner

    @classmethod
    def load(
        cls,
        name: str | os.PathLike[str],
        *,
        scheme: str | None = None,
        solver: str | None = None,
        set: Mapping[str, Any] | None = None,
    ) -> Scene:
        """Load a shipped scene or a file; ``set={"mu": 0.3}`` changes fields as ``--set`` does."""
        changes = [(key, json.dumps(value)) for key, value in (set or {}).items()]
        return cls(_lcplab.Scene.load(os.fspath(name), changes, scheme, solver))

    def step(self, solver: Solver | None = None) -> Step:
        """Take one step; with a solver, it and all that follow are solved by that."""
        return Step(self._inner.step(solver))

    def problem(self) -> Problem | None:
        """The last problem of the last step, with what its rows are."""
        inner = self._inner.problem()
        return None if inner is None else Problem._of(inner)

    @property
    def poses(self) -> Array:
        """Position (m) and unit quaternion (w, x, y, z) of each body, (bodies, 7)."""
        return self._inner.poses

    @property
    def velocities(self) -> Array:
        """Velocity (m/s) and angular velocity (rad/s) of each body, world axes, (bodies, 6)."""
        return self._inner.velocities

    @property
    def bodies(self) -> list[str]:
        """The names of the bodies."""
        return self._inner.bodies

    @property
    def time(self) -> float:
        """The time now (s)."""
        return self._inner.time

    @property
    def energy(self) -> float:
        """Kinetic and potential energy (J)."""
        return self._inner.energy

    @property
    def penetration(self) -> float:
        """The deepest overlap of two bodies (m)."""
        return self._inner.penetration

    @property
    def drift(self) -> float:
        """The largest error of a joint (m)."""
        return self._inner.drift

    @property
    def name(self) -> str:
        """What it is called."""
        return self._inner.name

    @property
    def title(self) -> str:
        """What it shows."""
        return self._inner.title

    def __repr__(self) -> str:
        return f"<lcplab.Scene {self.name}: {self.title}, at {self.time:g} s>"
