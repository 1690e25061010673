"""Steps as problem files with the key ``motion``, and back."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np

from lcplab._lcplab import InputError
from lcplab._receipt.step import Array, Row, Rows, Step, Triplets

#: The largest number of rows for which A is written.
MOST_ROWS = 5_000
#: The end of the name of an answer's file.
ANSWER = ".x.json"


def problem(step: Step) -> dict[str, Any]:
    """The object of a problem file: A = J M⁻¹Jᵀ + compliance, b = J u* + bias, and the key ``motion``.

    Raises
    ------
    InputError
        If a friction cone cannot be written: it has more or fewer than two coefficients, or they differ.
    """
    if step.model is not None:
        _check_cones(step)
    is_friction = step.friction_index >= 0
    unit = "N s" if step.level == "velocity" else "N"
    file: dict[str, Any] = {
        "name": f"{step.name} at {step.time:.4g} s",
        "source": source(step),
        "A": {"dense": [numbers(row) for row in matrix(step)]},
        "b": numbers(step.along(step.target) + step.bias),
        "lo": ["-inf" if friction else number(lo) for lo, friction in zip(step.lo, is_friction)],
        "hi": [number(hi) for hi in step.hi],
        "rows": [
            {"label": row.label, "kind": row.kind, "unit": unit, "bodies": list(row.bodies)} for row in step.rows
        ],
        "motion": {
            "mass": _entries(step.mass),
            "jacobian": _entries(step.jacobian),
            "bias": numbers(step.bias),
            "compliance": numbers(step.compliance),
            "target": numbers(step.target),
            "level": step.level,
        },
    }
    if is_friction.any():
        file |= {"friction_index": step.friction_index.tolist(), "mu": numbers(step.mu)}
        file |= {"model": step.model} if step.model is not None else {}
    return file


def matrix(step: Step) -> Array:
    """A = J M⁻¹Jᵀ + compliance, (n, n)."""
    n = len(step)
    if n > MOST_ROWS:
        raise InputError(f"step: {n} rows are too many for a dense A; at most {MOST_ROWS} are allowed")
    jacobian = step.dense_jacobian()
    product = jacobian @ np.linalg.solve(step.dense_mass(), jacobian.T)
    return (product + product.T) / 2 + np.diag(step.compliance)


def source(step: Step) -> dict[str, Any]:
    """Where the step comes from."""
    return {
        "engine": step.engine, "version": step.version, "method": step.method, "bits": step.bits,
        "iterations": step.iterations, "has_converged": step.has_converged, "time": step.time,
        "own_tolerance": step.own_tolerance, "gravity": step.gravity, "name": step.name,
        "settings": {key: _plain(value) for key, value in step.settings.items()},
    }


def write(step: Step, problem_path: Path, answer_path: Path) -> None:
    """Write both files."""
    problem_path.write_text(json.dumps(problem(step)) + "\n", encoding="utf-8")
    answer = {"x": numbers(step.forces), "motion": numbers(step.motion), "solver": f"{step.engine} {step.version}"}
    if step.reported_push is not None:
        answer["reported_push"] = numbers(step.reported_push)
    answer_path.write_text(json.dumps(answer) + "\n", encoding="utf-8")


def answer_of(path: Path) -> Path:
    """The file with the answer to a problem file: ``STEM.x.json`` for ``STEM.json``."""
    return path.with_name(f"{path.stem}{ANSWER}")


def read(path: Path) -> Step:
    """The step of a problem file and of the answer ``STEM.x.json`` next to it.

    Raises
    ------
    InputError
        If a file cannot be read, or has no key ``motion``.
    """
    object_, answer = _load(path), _load(answer_of(path))
    motion = object_.get("motion")
    if not isinstance(motion, dict):
        raise InputError(f"{path}: motion: is missing; it states the masses and rows that the check needs")
    if "x" not in answer:
        raise InputError(f"{answer_of(path)}: x: is missing")
    try:
        step = _step(path, object_, motion, answer)
        _check_lengths(step)
        return step if "motion" in answer else step.with_motion_of_forces()
    except KeyError as error:
        raise InputError(f"{path}: {error.args[0]}: is missing") from error
    except (TypeError, ValueError) as error:
        raise InputError(f"{path}: {error}") from error


def _step(path: Path, object_: dict[str, Any], motion: dict[str, Any], answer: dict[str, Any]) -> Step:
    """The step of a problem, its key ``motion``, and an answer."""
    source_ = object_.get("source")
    words = source_ if isinstance(source_, dict) else {}
    n = len(object_["b"])
    index = np.array(object_.get("friction_index", [-1] * n), dtype=np.int64)
    mass, jacobian = _triplets(motion["mass"]), _triplets(motion["jacobian"])
    forces, target = np.array(answer["x"], dtype=float), np.array(motion["target"], dtype=float)
    return Step(
        engine=str(words.get("engine", "engine")),
        version=str(words.get("version", "")),
        level=str(motion.get("level", "velocity")),
        mass=mass,
        jacobian=jacobian,
        bias=np.array(motion["bias"], dtype=float),
        compliance=np.array(motion["compliance"], dtype=float),
        target=target,
        motion=np.array(answer["motion"], dtype=float) if "motion" in answer else target,
        forces=forces,
        lo=_bounds(object_.get("lo"), n, 0.0),
        hi=_bounds(object_.get("hi"), n, np.inf),
        friction_index=index,
        mu=np.array(object_.get("mu", [0.0] * n), dtype=float),
        model=object_.get("model"),
        rows=[
            Row(row.get("label", ""), row.get("kind", ""), tuple(row.get("bodies", ())))
            for row in object_.get("rows", ())
        ],
        gravity=float(words.get("gravity", 0.0)),
        method=str(words.get("method", "direct")),
        bits=int(words.get("bits", 64)),
        iterations=int(words.get("iterations", 0)),
        has_converged=bool(words.get("has_converged", True)),
        own_tolerance=float(words.get("own_tolerance", 0.0)),
        reported_push=np.array(answer["reported_push"], dtype=float) if "reported_push" in answer else None,
        settings=words.get("settings", {}),
        name=str(words.get("name", object_.get("name", path.stem))),
        time=float(words.get("time", 0.0)),
    )


def _check_lengths(step: Step) -> None:
    n, k = len(step), len(step.target)
    vectors = {"motion": k} | dict.fromkeys(("compliance", "lo", "hi", "mu", "forces", "friction_index"), n)
    vectors |= {} if step.reported_push is None else {"reported_push": k}
    for name, size in vectors.items():
        length = len(getattr(step, name))
        if length != size:
            raise ValueError(f"{'x' if name == 'forces' else name}: has {length} entries, must have {size}")


def _load(path: Path) -> dict[str, Any]:
    try:
        loaded = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: {error}") from error
    if not isinstance(loaded, dict):
        raise InputError(f"{path}: must hold an object")
    return loaded


def _check_cones(step: Step) -> None:
    for normal in np.unique(step.friction_index[step.friction_index >= 0]):
        coefficients = step.mu[step.friction_index == normal]
        if len(coefficients) != 2 or coefficients[0] != coefficients[1]:
            raise InputError(
                f"row {normal}: a friction cone with the coefficients {coefficients.tolist()} cannot be written: "
                "cones in problem files have two equal coefficients"
            )


def _entries(triplets: Triplets) -> list[list[Any]]:
    return [[int(row), int(column), number(value)] for row, column, value in zip(*triplets)]


def _triplets(entries: list[list[Any]]) -> Triplets:
    columns: list[Any] = [list(column) for column in zip(*entries)] or [[], [], []]
    rows: Rows = np.array(columns[0], dtype=np.int64)
    return rows, np.array(columns[1], dtype=np.int64), np.array(columns[2], dtype=float)


def _bounds(values: Any, n: int, otherwise: float) -> Array:
    return np.array([otherwise] * n if values is None else [float(value) for value in values])


def number(value: float | None) -> float | str | None:
    """A number for JSON: ``"nan"``, ``"inf"`` or ``"-inf"`` if it is not finite, None for None."""
    return value if value is None else float(value) if math.isfinite(value) else str(float(value))


def numbers(values: Array) -> list[float | str | None]:
    """A vector for JSON."""
    return values.tolist() if np.isfinite(values).all() else [number(value) for value in values]


def _plain(value: Any) -> Any:
    if hasattr(value, "item"):
        return value.item()
    return value if isinstance(value, (int, float, str, bool)) else str(value)
