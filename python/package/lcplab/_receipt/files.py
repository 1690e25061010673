"""Steps as problem files with the key ``motion``."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from lcplab import _lcplab
from lcplab._lcplab import InputError
from lcplab._receipt.step import Step

#: The end of the name of an answer's file.
ANSWER = ".x.json"


def problem(step: Step) -> dict[str, Any]:
    """The object of a problem file: A = J M⁻¹Jᵀ + compliance, b = J u* + bias, and the key ``motion``.

    Raises
    ------
    InputError
        If there are more than 5,000 rows, or a friction cone cannot be judged: it has more or fewer than two
        coefficients, or they differ.
    """
    return dict(json.loads(_texts(step)[0]))


def write(step: Step, problem_path: Path, answer_path: Path) -> None:
    """Write both files."""
    for path, text in zip((problem_path, answer_path), _texts(step)):
        path.write_text(f"{text}\n", encoding="utf-8")


def answer_of(path: Path) -> Path:
    """The file with the answer to a problem file: ``STEM.x.json`` for ``STEM.json``."""
    return path.with_name(f"{path.stem}{ANSWER}")


def _texts(step: Step) -> tuple[str, str]:
    if step.model is not None:
        _check_cones(step)
    return _lcplab.step_files(step._for_rust())


def _check_cones(step: Step) -> None:
    for normal in np.unique(step.friction_index[step.friction_index >= 0]):
        coefficients = step.mu[step.friction_index == normal]
        if len(coefficients) != 2 or coefficients[0] != coefficients[1]:
            raise InputError(
                f"row {normal}: a friction cone with the coefficients {coefficients.tolist()} cannot be written: "
                "cones in problem files have two equal coefficients"
            )
