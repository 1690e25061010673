"""A step as an engine reports it, in the units of the engine."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lcplab._lcplab import InputError
from lcplab._receipt.blocks import Blocks
from lcplab._receipt.given import Given

Array = NDArray[np.float64]
Rows = NDArray[np.int64]
#: Rows, columns and values of stored entries.
Triplets = tuple[Rows, Rows, Array]


def stored(matrix: Array) -> Triplets:
    """The entries of a dense matrix that are not 0."""
    rows, columns = np.nonzero(matrix)
    return rows.astype(np.int64), columns.astype(np.int64), np.ascontiguousarray(matrix[rows, columns], dtype=float)


@dataclass(frozen=True)
class Row:
    """The names of a row for messages: its label, its kind and its bodies."""

    label: str
    kind: str = ""
    bodies: tuple[str, ...] = ()


@dataclass(frozen=True)
class Step:
    """The problem that an engine posed in one step, and its answer.

    ``w = J v + bias + compliance * x`` is the velocity (``level="velocity"``, m/s, x in N s) or the acceleration
    (``"acceleration"``, m/s², x in N) that remains in a row; ``v = target + inv(M) J.T x``. Contacts push with
    ``x >= 0``. ``n`` rows, ``k`` degrees of freedom.

    Further keywords of ``of``:

    - ``method``: ``"direct"`` (the default), ``"newton"``, ``"cg"`` or ``"pgs"``; with ``bits=32`` for single precision
      it determines the limit.
    - ``iterations``, and ``has_converged=False`` if the solver stopped at its iteration limit.
    - ``own_tolerance``: the solver's tolerance as an error of the motion in the norm √(vᵀM v), if it states one.
    - ``gravity``: the change of the motion by gravity in the step, in the same norm: a number.
    - ``model``: the friction model of rows with ``friction_index``: ``"associated-cone"`` (the default),
      ``"coulomb-cone"``, or None for the bounds ±mu x[k].
    - ``reported_push``: the generalized forces of the constraints that the engine reports, (k,).
    - ``expected_bias``, ``expected_target``: bias and target as the adapter computes them from the model, to check assembly.
    - ``rows``: an `EngineRow` for each row; ``dof_bodies``: the body of each velocity component; ``name``, ``time``,
      ``settings``, ``not_checked``: stated in the receipt and in files.
    """

    engine: str
    version: str
    level: str
    #: Entries of the upper triangle of M, (k, k), and of J, (n, k).
    mass: Triplets
    jacobian: Triplets
    bias: Array
    compliance: Array
    #: The motion without constraints u*, (k,), and the engine's motion v, (k,).
    target: Array
    motion: Array
    #: The engine's x, (n,), and its bounds.
    forces: Array
    lo: Array
    hi: Array
    #: The normal row of each row of friction of a cone, -1 for others, and its coefficient.
    friction_index: Rows
    mu: Array
    #: The friction model of these rows, as in a problem file: ``"associated-cone"``, ``"coulomb-cone"``, or None for the
    #: bounds ``±mu * x[k]``.
    model: str | None = "associated-cone"
    rows: Sequence[Row] = ()
    #: The change of the motion by gravity in the step, in the norm of M.
    gravity: float = 0.0
    #: The solver's kind: ``"direct"``, ``"newton"``, ``"cg"``, ``"pgs"``; and the bits of its numbers.
    method: str = "direct"
    bits: int = 64
    iterations: int = 0
    has_converged: bool = True
    #: The engine's own tolerance as an error in the norm of M; 0 if it states none.
    own_tolerance: float = 0.0
    #: The generalized forces of the constraints as reported, (k,), if they are.
    reported_push: Array | None = None
    #: Entries of J, (n, k), the bias, (n,), and the motion without constraints, (k,), where the adapter computes them from
    #: the model and the state on its own: assembly is compared with them.
    expected_jacobian: Triplets | None = None
    expected_bias: Array | None = None
    expected_target: Array | None = None
    settings: Mapping[str, Any] = field(default_factory=dict)
    name: str = ""
    time: float = 0.0
    #: The names of the degrees of freedom's bodies.
    dof_bodies: Sequence[str] = ()
    #: Stages and parts that the engine does not report.
    not_checked: Sequence[str] = ()

    #: Why the motion of this step has no bound, although its friction model allows one; "" if it has one.
    no_bound: str = ""
    #: Whether the motion is not the engine's, but computed from its forces.
    has_computed_motion: bool = False

    def __post_init__(self) -> None:
        if self.model not in (None, "associated-cone", "coulomb-cone"):
            raise InputError(f"model: {self.model!r} is neither associated-cone nor coulomb-cone nor None")

    @classmethod
    def of(
        cls,
        engine: str,
        mass: ArrayLike,
        jacobian: ArrayLike,
        bias: ArrayLike,
        target: ArrayLike,
        forces: ArrayLike,
        motion: ArrayLike | None = None,
        *,
        level: str = "velocity",
        compliance: ArrayLike = 0.0,
        lo: ArrayLike = 0.0,
        hi: ArrayLike = np.inf,
        friction_index: ArrayLike = -1,
        mu: ArrayLike = 0.0,
        version: str = "",
        expected_jacobian: ArrayLike | None = None,
        **more: Any,
    ) -> Step:
        """A step from dense arrays; a number instead of an array applies to all rows.

        Raises
        ------
        InputError
            If an array has another shape or kind than the step needs, or a compliance or coefficient of friction is
            negative; one line for each defect. Numbers that are not finite are no invalid input but a wrong step: its
            receipt is rejected.

        Examples
        --------
        >>> step = Step.of("mine", mass=[[2.0]], jacobian=[[1.0]], bias=[0.0], compliance=0.5, target=[-3.0],
        ...                forces=[3.0], motion=[-1.5])
        >>> len(step), step.norm(step.motion - step.target)
        (1, 2.1213203435596424)
        """
        given = Given()
        offsets, free = given.vector("bias", bias), given.vector("target", target)
        n, k = len(offsets), len(free)
        step = cls(
            engine=engine,
            version=version,
            level=level,
            mass=stored(np.triu(given.symmetric("mass", mass, k))),
            jacobian=stored(given.array("jacobian", jacobian, (n, k))),
            bias=offsets,
            compliance=given.rows("compliance", compliance, n),
            target=free,
            motion=free if motion is None else given.array("motion", motion, (k,)),
            forces=given.array("forces", forces, (n,)),
            lo=given.rows("lo", lo, n),
            hi=given.rows("hi", hi, n),
            friction_index=given.normal_rows(friction_index, n),
            mu=given.rows("mu", mu, n),
            expected_jacobian=None if expected_jacobian is None else stored(
                given.array("expected_jacobian", expected_jacobian, (n, k))
            ),
            **more,
        )
        given.check_settings(step)
        if motion is None and not step.is_definite():
            given.defects.append("mass: is not positive definite, so that the motion of the forces cannot be computed")
        given.end()
        return step.with_motion_of_forces() if motion is None else step

    def with_motion_of_forces(self, why: str = "which the engine does not report") -> Step:
        """The same step with the motion that its forces cause instead of the engine's, which is then not checked."""
        change = self.mass_blocks.solve(self.push(self.forces))
        not_checked = [*self.not_checked, f"write-back: the motion, {why}"]
        return replace(self, motion=self.target + change, not_checked=not_checked, has_computed_motion=True)

    def __len__(self) -> int:
        return len(self.bias)

    def dense_mass(self) -> Array:
        """M, (k, k)."""
        size = len(self.target)
        mass = np.zeros((size, size))
        mass[self.mass[0], self.mass[1]] = self.mass[2]
        return mass + np.triu(mass, 1).T

    @cached_property
    def mass_blocks(self) -> Blocks:
        """M by its independent diagonal blocks."""
        return Blocks.of(self.mass, len(self.target))

    def is_definite(self) -> bool:
        """Whether M is positive definite, up to rounding."""
        return self.mass_blocks.is_definite()

    def dense_jacobian(self) -> Array:
        """J, (n, k)."""
        jacobian = np.zeros((len(self), len(self.target)))
        jacobian[self.jacobian[0], self.jacobian[1]] = self.jacobian[2]
        return jacobian

    def along(self, motion: Array) -> Array:
        """J v, (n,)."""
        rows, columns, values = self.jacobian
        return np.asarray(np.bincount(rows, values * motion[columns], len(self)), dtype=float)

    def size_along(self, motion: Array) -> Array:
        """The sum of the absolute values of the terms of J v, (n,)."""
        rows, columns, values = self.jacobian
        return np.asarray(np.bincount(rows, np.abs(values * motion[columns]), len(self)), dtype=float)

    def push(self, forces: Array) -> Array:
        """Jᵀx, (k,)."""
        rows, columns, values = self.jacobian
        return np.asarray(np.bincount(columns, values * forces[rows], len(self.target)), dtype=float)

    def times_mass(self, motion: Array) -> Array:
        """M v, (k,)."""
        rows, columns, values = self.mass
        size = len(self.target)
        product = np.bincount(rows, values * motion[columns], size)
        lower = rows != columns
        return np.asarray(product + np.bincount(columns[lower], (values * motion[rows])[lower], size), dtype=float)

    def norm(self, motion: Array) -> float:
        """√(vᵀM v): the root of twice a kinetic energy, if v is a velocity. It is NaN where v or M is."""
        rows, columns, _ = self.mass
        square = float((self._energies * motion[rows]) @ motion[columns])
        return 0.0 if square < 0 else math.sqrt(square)

    @cached_property
    def _energies(self) -> Array:
        """The entries of the upper triangle of M, those off the diagonal doubled."""
        rows, columns, values = self.mass
        return np.asarray(np.where(rows == columns, values, 2 * values), dtype=float)

    @property
    def effect(self) -> float:
        """The divisor of motion errors: the largest of ``|v - u*|_M``, the change by gravity, and 1e-6 ``|u*|_M``."""
        return self._effect

    @cached_property
    def _effect(self) -> float:
        change, free = self.norm(self.motion - self.target), self.norm(self.target)
        return max(change, 1e-6 * free, float(self.gravity))

    def _for_rust(self) -> dict[str, Any]:
        """The arrays, and the rest as JSON."""
        names = ("bias", "compliance", "target", "lo", "hi", "mu", "forces", "motion")
        vectors: dict[str, Array | None] = {
            name: np.ascontiguousarray(getattr(self, name), dtype=float) for name in names
        }
        for name in ("reported_push", "expected_bias", "expected_target"):
            values = getattr(self, name)
            vectors[name] = None if values is None else np.ascontiguousarray(values, dtype=float)
        facts = {
            "source": self._source(), "level": self.level, "model": self.model,
            "dof_bodies": list(self.dof_bodies), "not_checked": list(self.not_checked), "no_bound": self.no_bound or None,
            "has_computed_motion": self.has_computed_motion,
        }
        triplets = {"mass": self.mass, "jacobian": self.jacobian, "expected_jacobian": self.expected_jacobian}
        text = f'{json.dumps(facts)[:-1]}, "rows": [{_all_written(self.rows)}]}}'
        return {**triplets, **vectors, "friction_index": self.friction_index, "facts": text}

    def _source(self) -> dict[str, Any]:
        """Where the step comes from, as in a problem file."""
        return {
            "engine": self.engine, "version": self.version, "method": self.method, "bits": int(self.bits),
            "iterations": int(self.iterations), "has_converged": bool(self.has_converged), "time": number(self.time),
            "own_tolerance": number(self.own_tolerance), "gravity": number(self.gravity), "name": self.name,
            "settings": {key: plain(value) for key, value in self.settings.items()},
        }

    @classmethod
    def _of_frame(cls, frame: Mapping[str, Any]) -> Step:
        """The step of a file, as Rust reads it."""
        arrays = dict(frame)
        facts = json.loads(arrays.pop("facts"))
        source = facts.pop("source")
        rows = [Row(row["label"], row["kind"], tuple(row["bodies"])) for row in facts.pop("rows")]
        for name in ("time", "own_tolerance", "gravity"):
            source[name] = float(source[name])
        facts["no_bound"] = facts["no_bound"] or ""
        source.setdefault("settings", {})
        return cls(**arrays, **source, **facts, rows=rows)


_last_written: tuple[Sequence[Row], str] | None = None


def _all_written(rows: Sequence[Row]) -> str:
    """Rows as JSON; those of the step before are kept, because a reader may return the same rows for the next step."""
    global _last_written
    if not isinstance(rows, tuple):  # a list may have been changed
        return ", ".join(map(_written, rows))
    kept = _last_written
    if kept is None or kept[0] is not rows:
        kept = _last_written = rows, ", ".join(map(_written, rows))
    return kept[1]


@lru_cache(4096)
def _written(row: Row) -> str:
    """The names of a row as JSON; the rows of a contact have the same ones, as have those of the next step."""
    return json.dumps({"label": row.label, "kind": row.kind, "bodies": row.bodies})


def plain(value: Any) -> Any:
    """A setting for JSON."""
    if hasattr(value, "item"):
        return value.item()
    return value if isinstance(value, (int, float, str, bool)) else str(value)


def number(value: float) -> float | str:
    """A number for JSON: ``"nan"``, ``"inf"`` or ``"-inf"`` if it is not finite."""
    return float(value) if math.isfinite(value) else str(float(value))
