"""What a phenomenon is: a question, a scene, the law that answers, and how far off an answer may be."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib import resources
from typing import TYPE_CHECKING, Any

import numpy as np

from lcplab import EngineStep, Scene
from lcplab.engines import Array, Description

if TYPE_CHECKING:
    from importlib.abc import Traversable  # moved to importlib.resources.abc in Python 3.11

#: The part of what is measured by which a law may be missed.
PART = 0.01


@dataclass(frozen=True)
class Run:
    """A scene as an engine moved it, at the start and after every step."""

    scene: Description
    dt: float
    #: (steps + 1,), (steps + 1, bodies, 7), (steps + 1, bodies, 6).
    t: Array
    poses: Array
    velocities: Array
    #: What contacts put on each body (N), (steps + 1, bodies, 3), if the engine tells it.
    forces: Array | None
    #: How long the steps took (s).
    seconds: float = 0.0
    #: Steps of the run as the engine reports them, or why it does not.
    reported: Sequence[EngineStep] = ()
    unreported: str = ""

    @property
    def gravity(self) -> float:
        """g (m/s²)."""
        return float(np.linalg.norm(self.scene["gravity"]))

    def body(self, name: str) -> Mapping[str, Any]:
        """The body of this name as the scene describes it."""
        found: Mapping[str, Any] = self.scene["bodies"][self.number(name)]
        return found

    def number(self, name: str) -> int:
        """The place of the body of this name."""
        return [body["name"] for body in self.scene["bodies"]].index(name)

    def place(self, name: str) -> Array:
        """Where the body's center was, (steps + 1, 3)."""
        return np.asarray(self.poses[:, self.number(name), :3])

    def carried(self, name: str, vector: Sequence[float] | Array) -> Array:
        """A vector in a body's axes, seen in the world's, (steps + 1, 3)."""
        q, along = self.poses[:, self.number(name), 3:], np.asarray(vector, dtype=float)
        return np.asarray(along + 2 * np.cross(q[:, 1:], np.cross(q[:, 1:], along) + q[:, :1] * along))

    def after(self, time: float) -> int:
        """The first step at or after this time."""
        return int(np.searchsorted(self.t, time - 1e-9))


@dataclass(frozen=True)
class Measurement:
    """A number that an engine gave, beside the law's."""

    what: str
    value: float
    law: float
    tolerance: float
    unit: str

    @property
    def holds(self) -> bool:
        """Whether the law is met."""
        return bool(abs(self.value - self.law) <= self.tolerance)


@dataclass(frozen=True)
class Curve:
    """What a plot shows of a run."""

    x: Array
    y: Array


@dataclass(frozen=True)
class Phenomenon:
    """A benchmark."""

    #: The name in options; the scene is ``scenes/NAME.toml``.
    name: str
    #: What it asks, and why it matters; plain sentences.
    question: str
    matters: str
    #: The law, as TeX, and the tolerance, in words with TeX between dollars.
    law: str
    allowed: str
    #: How long it is simulated (s).
    duration: float
    #: Name and unit of the plot's axes.
    x: tuple[str, str]
    y: tuple[str, str]
    #: What the runs, one a variant and step, give.
    measure: Callable[[Sequence[Run]], list[Measurement]]
    #: What is plotted of them, and what the law has for it.
    plot: Callable[[Sequence[Run]], Curve]
    exact: Callable[[Curve, Run], Array]
    #: Fields of the scene that are set, one run each.
    variants: Sequence[Mapping[str, Any]] = ({},)
    #: What the settings' own step is multiplied by, one run each for each variant.
    steps: Sequence[float] = (1.0,)
    #: Whether the horizontal axis is logarithmic.
    log: bool = False
    #: Whether engines that tell no forces cannot be measured.
    needs_forces: bool = False
    #: What was reported of engines, and the formula that explains it.
    reported: str = ""

    @property
    def scene(self) -> str:
        """The text of its scene file."""
        return self._file.read_text(encoding="utf-8")

    def described(self, variant: Mapping[str, Any]) -> Description:
        """The scene with the fields of a variant set, and everything written out."""
        with resources.as_file(self._file) as path:
            return Scene.described(path, set=variant)

    @property
    def _file(self) -> Traversable:
        return resources.files("lcplab.cards") / "scenes" / f"{self.name}.toml"


def over_time(quantity: Callable[[Run], Array]) -> Callable[[Sequence[Run]], Curve]:
    """The plot of a quantity of the first run over its time."""
    return lambda runs: Curve(runs[0].t, quantity(runs[0]))
