"""Steps as problem files with the key ``motion``."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from lcplab._lcplab import InputError
from lcplab._receipt.step import Array, Step, Triplets, number

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
        "name": f"{step.name or step.engine} at {step.time:.4g} s",
        "source": {**step._source(), "settings": {key: _plain(value) for key, value in step.settings.items()}},
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
    """A = J M⁻¹Jᵀ + compliance, (n, n); NaN if M is singular."""
    n = len(step)
    if n > MOST_ROWS:
        raise InputError(f"step: {n} rows are too many for a dense A; at most {MOST_ROWS} are allowed")
    jacobian = step.dense_jacobian()
    try:
        product = jacobian @ np.linalg.solve(step.dense_mass(), jacobian.T)
    except np.linalg.LinAlgError:  # a singular M has no A
        product = np.full((n, n), np.nan)
    return (product + product.T) / 2 + np.diag(step.compliance)


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


def numbers(values: Array) -> list[float | str | None]:
    """A vector for JSON."""
    return values.tolist() if np.isfinite(values).all() else [number(value) for value in values]


def _plain(value: Any) -> Any:
    if hasattr(value, "item"):
        return value.item()
    return value if isinstance(value, (int, float, str, bool)) else str(value)
