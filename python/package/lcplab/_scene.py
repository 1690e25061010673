"""Scenes and their simulation."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from functools import cached_property
from typing import Any

from lcplab import _lcplab
from lcplab._problem import Array, Problem, read_only
from lcplab._solve import Solver


class Step:
    """A simulated step; true if the judge accepts the answers to all problems of the step."""

    def __init__(self, taken: _lcplab.Taken) -> None:
        self._taken = taken
        self.number: int = taken.number
        self.solvers: list[str] = taken.solvers
        self.statuses: list[str] = taken.statuses
        self.x: Array | None = None if taken.x is None else read_only(taken.x)

    @cached_property
    def _judged(self) -> list[tuple[str, bool]]:
        return self._taken.judged()

    @property
    def verdicts(self) -> list[str]:
        """The verdict on each problem of the step. They are computed when first read, because proofs take time."""
        return [verdict for verdict, _ in self._judged]

    def __bool__(self) -> bool:
        return all(accepted for _, accepted in self._judged)

    def __repr__(self) -> str:
        return f"<lcplab.Step {self.number}: {', '.join(self.verdicts) or 'nothing to solve'}>"


class Scene:
    """A scene and its state at the current time.

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
        """Load a shipped scene or a scene file; ``set={"mu": 0.3}`` changes fields, like ``--set`` of the command line."""
        changes = [(key, json.dumps(value)) for key, value in (set or {}).items()]
        return cls(_lcplab.Scene.load(os.fspath(name), changes, scheme, solver))

    def step(self, solver: Solver | None = None) -> Step:
        """Simulate one step. A solver that is given here is used for this step and all later ones."""
        return Step(self._inner.step(solver))

    def problem(self) -> Problem | None:
        """The last problem of the last step, with the names of its rows."""
        inner = self._inner.problem()
        return None if inner is None else Problem._of(inner)

    @classmethod
    def of(cls, description: Mapping[str, Any]) -> Scene:
        """Make a scene from a dictionary with the fields of a scene file.

        >>> ball = {"name": "ball", "shape": {"sphere": 0.5}, "mass": 2.0}
        >>> Scene.of({"bodies": [ball]}).bodies
        ['ball']
        """
        return cls(_lcplab.Scene.of(json.dumps(dict(description))))

    @classmethod
    def from_mujoco(cls, model: Any, data: Any = None, skip: bool = False) -> Scene:
        """Make a scene from a model of MuJoCo, at the state of its data or at its initial state.

        Parts without a counterpart in a scene are an error, which lists them; with ``skip`` they are left out.

        Raises
        ------
        InputError
            With one line for each element that has no counterpart.
        """
        from lcplab import _import

        imported = _import.scene(model, data)
        if not skip:
            imported.check()
        return cls.of(imported.scene)

    @staticmethod
    def described(
        scene: str | os.PathLike[str] | Mapping[str, Any], *, set: Mapping[str, Any] | None = None
    ) -> dict[str, Any]:
        """Describe a scene completely, for another program.

        Structures are expanded into bodies, a tilt becomes a direction of gravity, and each body has its mass,
        moments of inertia, quaternion, coefficients and velocities. ``scene`` is a file, a shipped scene, or a dictionary
        with the fields of a scene file; ``set`` changes fields of the first two.

        >>> [body["name"] for body in Scene.described("stack")["bodies"]][:3]
        ['ground', 'box1', 'box2']
        >>> ball = {"name": "ball", "shape": {"sphere": 0.5}, "mass": 2.0}
        >>> Scene.described({"bodies": [ball]})["bodies"][0]["inertia"]
        [0.2, 0.2, 0.2]
        """
        changes = [(key, json.dumps(value)) for key, value in (set or {}).items()]
        if isinstance(scene, Mapping):
            if changes:
                raise TypeError("set changes files and shipped scenes; change the dictionary itself")
            text = _lcplab.describe_json(json.dumps(dict(scene)))
        else:
            text = _lcplab.describe(os.fspath(scene), changes)
        described: dict[str, Any] = json.loads(text)
        return described

    def forces(self) -> Array | None:
        """The mean force (N, world axes) of contacts and joints on each body in the last step.

        ``None`` before the first step, and for integrators with stages, which do not record it.
        """
        return self._inner.forces()

    def loads(self) -> dict[str, Any] | None:
        """The forces of the last step by pair of bodies, by body and by contact, and which of them are unique.

        The keys are those of ``lcplab simulate --loads --json``: ``pairs`` with ``by``, ``on``, ``wrench`` (force in N and
        moment about the center of mass in N m, world axes, on the body ``on``), ``carried`` (N, against gravity), its
        ``range`` and the ``contacts``, each with its ``wrench`` and its ``arm``, the contact's point from the center of
        mass (m); ``bodies`` with the sum of all forces and the weight. A ``range`` has the ``least``
        and the ``most`` value of all forces that cause the same motion and obey the friction limits, and the value in the
        answer with the smallest sum of squares, ``least_norm``; ``is_unique`` says whether least and most differ by at most a
        millionth of the largest force. Without ranges, ``unexamined`` has the reason.

        ``None`` before the first step, and under friction models that are not boxes.
        """
        text = self._inner.loads()
        if text is None:
            return None
        loads: dict[str, Any] = json.loads(text)
        return loads

    @property
    def poses(self) -> Array:
        """Position (m) and unit quaternion (w, x, y, z) of each body, shape (bodies, 7)."""
        return self._inner.poses

    @property
    def velocities(self) -> Array:
        """Velocity (m/s) and angular velocity (rad/s) of each body in world axes, shape (bodies, 6)."""
        return self._inner.velocities

    @property
    def bodies(self) -> list[str]:
        """The names of the bodies."""
        return self._inner.bodies

    @property
    def time(self) -> float:
        """The current time (s)."""
        return self._inner.time

    @property
    def energy(self) -> float:
        """The sum of kinetic and potential energy (J)."""
        return self._inner.energy

    @property
    def penetration(self) -> float:
        """The largest overlap of two bodies (m)."""
        return self._inner.penetration

    @property
    def drift(self) -> float:
        """The largest position error of a joint (m)."""
        return self._inner.drift

    @property
    def name(self) -> str:
        """The name of the scene."""
        return self._inner.name

    @property
    def title(self) -> str:
        """The title of the scene."""
        return self._inner.title

    def __repr__(self) -> str:
        return f"<lcplab.Scene {self.name}: {self.title}, at {self.time:g} s>"
