"""Physics engines that can run a scene: one module an engine, each a translation and nothing else.

An adapter turns a scene, as :meth:`lcplab.Scene.described` writes it out, into the engine's own terms. What
the engine does with it is the engine's: an adapter repairs nothing, and what it cannot express it refuses
with :class:`Unsupported` instead of leaving it out. Each engine comes with its defaults and with the settings
that its documentation recommends where accuracy counts, both in words.
"""

from __future__ import annotations

import importlib
import importlib.metadata
import importlib.util
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from lcplab import EngineStep, Problem

Array = NDArray[np.float64]
Description = Mapping[str, Any]


class Unsupported(Exception):
    """The engine, or its adapter, has no such thing; the message says what."""


class World(Protocol):
    """A scene inside an engine. Bodies stand in the order of the scene, fixed ones included."""

    def step(self) -> None:
        """Go on by the settings' ``dt``."""

    def poses(self) -> Array:
        """Position (m) and quaternion (w, x, y, z) of each body's axes, (bodies, 7)."""

    def velocities(self) -> Array:
        """Velocity of the center of mass (m/s) and angular velocity (rad/s), world axes, (bodies, 6)."""

    def forces(self) -> Array | None:
        """What contacts put on each body in the last step (N, world axes), (bodies, 3), if it is reported."""


@dataclass(frozen=True)
class Posed:
    """A contact problem of an engine and the engine's own answer to it."""

    problem: Problem
    answer: Array
    #: What was posed and in which units, for people.
    words: str
    #: More keys of a problem file: what its rows are, what it was made from.
    more: Mapping[str, Any] = field(default_factory=dict)
    #: The bodies whose velocities are the degrees of freedom, by their numbers.
    free: Sequence[int] = ()


@runtime_checkable
class Posing(Protocol):
    """A world that tells the contact problem which its engine solves."""

    def problem(self) -> Posed:
        """The problem of this moment; where an engine tells it only afterwards, that of a step which this takes."""


@dataclass(frozen=True)
class Settings:
    """How an engine is run."""

    #: What the column is called: ``defaults``, ``accurate``, the name of a scheme.
    name: str
    #: All that is set, for people.
    words: str
    #: The length of a step (s).
    dt: float
    #: The same for the adapter.
    values: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Engine:
    """An engine and how to bring a scene into it."""

    #: The name in options and tables.
    name: str
    #: The package to install, as PyPI has it, and the module to import.
    package: str
    module: str
    settings: tuple[Settings, ...]
    build: Callable[[Description, Settings], World]
    #: How its contact solver answers a problem with Coulomb's cones, if it poses none itself, and the words for it.
    solve: tuple[Callable[[Problem], Array], str] | None = None

    @property
    def title(self) -> str:
        """The name for people."""
        return TITLES[self.name]

    @property
    def is_installed(self) -> bool:
        """Whether its package can be imported."""
        return importlib.util.find_spec(self.module) is not None

    @property
    def version(self) -> str:
        """The version of the package that holds its module."""
        try:
            return importlib.metadata.version(self.package)
        except importlib.metadata.PackageNotFoundError:  # MuJoCo 3 is in ``mujoco``, MuJoCo 4 in ``mujoco-core``
            return importlib.metadata.version(importlib.metadata.packages_distributions()[self.module][0])


@runtime_checkable
class Reported(Protocol):
    """A world whose engine reports, of a step that was taken, the problem and its answer."""

    def reported_step(self) -> EngineStep:
        """Take a step by the settings' ``dt`` and read it, as :func:`lcplab.receipt` takes it.

        Raises
        ------
        Unsupported, InputError
            If the engine does not report this step; it is taken all the same.
        """


def engine_step(world: World) -> EngineStep:
    """Take a step of a world and read it, for :func:`lcplab.receipt`.

    Raises
    ------
    Unsupported
        If the engine does not report its problem, or not that of this scene.
    """
    if isinstance(world, Reported):
        return world.reported_step()
    name = type(world).__module__.rsplit(".", 1)[-1]
    raise Unsupported(f"{TITLES.get(name, name)} does not report its problem")


#: The engines by the names of their modules, in the order of tables.
TITLES = {
    "mujoco": "MuJoCo",
    "warp": "MuJoCo Warp",
    "newton": "Newton",
    "drake": "Drake",
    "pybullet": "PyBullet",
    "dart": "DART",
    "rapier": "Rapier",
    "pinocchio": "Pinocchio",
    "lcplab": "lcplab",
}

NAMES = tuple(TITLES)


def by_name(name: str) -> Engine:
    """The engine of this name, installed or not."""
    if name not in NAMES:
        raise ValueError(f"there is no engine {name!r}; known are {', '.join(NAMES)}")
    module = "own" if name == "lcplab" else name
    engine: Engine = importlib.import_module(f"lcplab.engines.{module}").ENGINE
    return engine


def one_value(scene: Description, key: str) -> float:
    """The coefficient that all bodies share: rules for pairs of unequal ones differ from engine to engine."""
    values = {float(body[key]) for body in scene["bodies"]}
    if len(values) != 1:
        raise Unsupported(f"bodies of unequal {key}")
    return values.pop()


def shape(body: Mapping[str, Any]) -> tuple[str, Any]:
    """The kind of a body's shape and its measure, as ``("box", [1, 1, 0.5])``; ``("point", None)``."""
    written = body["shape"]
    return (written, None) if isinstance(written, str) else next(iter(written.items()))


def pose(body: Mapping[str, Any]) -> Array:
    """Position and quaternion (w, x, y, z) of a body at the start, (7,)."""
    turn = (body.get("rotation") or {"quaternion": [1, 0, 0, 0]})["quaternion"]
    return np.array([*body["position"], *turn], dtype=float)


@dataclass(frozen=True)
class Joint:
    """A joint of a scene."""

    #: ``hinge`` or ``ball``.
    kind: str
    #: The bodies by their numbers; no parent is the world.
    parent: int | None
    child: int
    #: Its place and its axis at the start (m, world).
    point: Array
    axis: Array
    #: Whether it closes a loop: its child hangs on another joint already.
    closes: bool


@dataclass(frozen=True)
class Spring:
    """A spring of a scene, without a damper."""

    #: The body by its number, and the point in its axes (m), of both ends; no body is the world.
    ends: list[tuple[int | None, Array]]
    #: At which it pulls nothing (m), and how much it pulls for each further meter (N/m).
    length: float
    stiffness: float


def springs(scene: Description) -> list[Spring]:
    """The springs of a scene."""
    numbers = {body["name"]: k for k, body in enumerate(scene["bodies"])}
    found = []
    for written in scene["constraints"]:
        if written["kind"] != "spring":
            continue
        if written["damping"] or not written["points"]:
            raise Unsupported("a spring with a damper, or without its points")
        bodies = [numbers[name] for name in written["bodies"]]
        points = np.array(written["points"], dtype=float)
        length = written["length"]
        length = float(np.linalg.norm(points[1] - points[0])) if length is None else float(length)
        ends: list[tuple[int | None, Array]] = [(None, points[0])] * (2 - len(bodies))
        for k, point in zip(bodies, points[-len(bodies) :]):
            at = np.array([*point, 1, 0, 0, 0])
            ends.append((k, relative(pose(scene["bodies"][k]), at)[:3]))
        found.append(Spring(ends, length, float(written["stiffness"])))
    return found


#: Fields of bodies and joints that no adapter translates.
_REFUSED = {
    "bodies": (
        *("force", "force_at", "torque", "static_friction"),
        *("force_over_time", "displacement_over_time", "without_contact"),
    ),
    "constraints": ("length", "angle", "limits", "speed", "effort", "stiffness", "damping"),
}


def joints(scene: Description, besides: Sequence[str] = ()) -> list[Joint]:
    """The joints of a scene: those of spanning trees, then those that close loops.

    A tree begins at the world or, where nothing joins its bodies to that, at the first of them, which is free.

    Engines in joint coordinates take the first as they are and need an equation for each of the others.
    What no adapter translates is refused here. Constraints of the kinds ``besides`` are left to the adapter.
    """
    constraints = [written for written in scene["constraints"] if written["kind"] not in besides]
    if any(written["kind"] == "spring" for written in constraints):
        raise Unsupported("a spring between two points")
    for key, fields in _REFUSED.items():
        every = constraints if key == "constraints" else scene[key]
        for written, field_ in ((written, field_) for written in every for field_ in fields):
            if written.get(field_) not in (None, [0, 0, 0]):
                raise Unsupported(f"the field {field_} of {key}")
    if scene.get("pairs"):
        raise Unsupported("friction and restitution of a pair")
    if scene["start"]:
        raise Unsupported("a start elsewhere")
    numbers = {body["name"]: k for k, body in enumerate(scene["bodies"])}
    fixed = {k for k, body in enumerate(scene["bodies"]) if body["fixed"]}
    waiting = []
    for written in constraints:
        kind = "ball" if written["kind"] == "nail" else written["kind"]  # a nail is a ball joint to the world
        if kind not in ("hinge", "ball"):
            raise Unsupported(f"a joint of kind {kind}")
        bodies = [numbers[name] for name in written["bodies"]]
        if fixed.intersection(bodies):
            raise Unsupported("a joint to a fixed body, which it would touch; join to the world")
        ends = [None] * (2 - len(bodies)) + bodies
        point = np.array(written["point"] or scene["bodies"][bodies[-1]]["position"], dtype=float)
        axis = np.array(written["axis"] or [0, 0, 1], dtype=float)
        waiting.append((kind, ends, point, axis / np.linalg.norm(axis)))
    tree: list[Joint] = []
    reached: set[int | None] = {None}
    while waiting:
        ready = [w for w in waiting if (w[1][0] in reached) != (w[1][1] in reached)]
        if not ready:
            loose = [w[1][0] for w in waiting if w[1][0] not in reached]
            if not loose:
                break
            reached.add(loose[0])
            continue
        kind, ends, point, axis = ready[0]
        parent, child = ends if ends[0] in reached else ends[::-1]
        assert child is not None
        tree.append(Joint(kind, parent, child, point, axis, closes=False))
        reached.add(child)
        waiting.remove(ready[0])
    for kind, ends, point, axis in waiting:
        parent, child = ends if ends[1] is not None else ends[::-1]
        assert child is not None
        tree.append(Joint(kind, parent, child, point, axis, closes=True))
    return tree


def rates(joint: Joint | None, bodies: Sequence[Mapping[str, Any]], k: int) -> Array:
    """The rates of the joint on which body ``k`` hangs, which moves at the start: 1 of a hinge, 3 of a ball.

    Either the body moves as if it were fixed to its parent: then they are 0. Or it turns about a ball at the world: then
    they are its angular velocity in its own axes.
    """
    own, body = pose(bodies[k]), bodies[k]
    omega = np.array(body["angular_velocity"], dtype=float)
    if joint is not None and joint.parent is not None:
        parent = bodies[joint.parent]
        turning = np.array(parent["angular_velocity"], dtype=float)
        velocity = np.array(parent["velocity"]) + np.cross(turning, own[:3] - pose(parent)[:3])
        if np.allclose(omega, turning, atol=1e-9) and np.allclose(velocity, body["velocity"], atol=1e-6):
            return np.zeros(1 if joint.kind == "hinge" else 3)
    if joint is None or joint.parent is not None or joint.kind != "ball":
        raise Unsupported("a body that moves at the start relative to the parent of its joint, except on a ball at the world")
    if not np.allclose(np.cross(omega, own[:3] - joint.point), body["velocity"], atol=1e-9):
        raise Unsupported("a start that opens a joint")
    return turned(conjugate(own[3:]), omega)


def times(p: Array, q: Array) -> Array:
    """The product of two quaternions (w, x, y, z)."""
    vector = p[0] * q[1:] + q[0] * p[1:] + np.cross(p[1:], q[1:])
    return np.array([p[0] * q[0] - p[1:] @ q[1:], *vector])


def conjugate(q: Array) -> Array:
    """The turn back."""
    return np.asarray(q * np.array([1.0, -1.0, -1.0, -1.0]))


def turned(q: Array, v: Array) -> Array:
    """The vector turned by a unit quaternion."""
    return np.asarray(v + 2 * np.cross(q[1:], np.cross(q[1:], v) + q[0] * v))


def relative(parent: Array, child: Array) -> Array:
    """The pose of a child in the axes of its parent, both (7,) in the world's."""
    back = conjugate(parent[3:])
    return np.concatenate([turned(back, child[:3] - parent[:3]), times(back, child[3:])])
