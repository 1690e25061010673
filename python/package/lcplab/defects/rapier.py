"""A scene of Rapier, which Node runs: the script prints its steps."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from lcplab._receipt.step import Array, Step

GRAVITY = -10.0
UP = np.array([0.0, 1.0, 0.0])


def resting_cube() -> Iterator[Step]:
    """A cube at rest on four contacts without friction."""
    script = Path(__file__).with_name("rapier.mjs").read_text(encoding="utf-8")
    node = ("node", "--input-type=module", "-")
    done = subprocess.run(node, input=script, capture_output=True, text=True, check=True, cwd=sys.prefix)
    told = json.loads(done.stdout.splitlines()[-1])
    for step in told["steps"]:
        yield read(step, told)


def read(step: dict[str, Any], told: dict[str, Any]) -> Step:
    """A step of the cube, whose axes are those of the world to a millionth; Rapier counts impulses in N s."""
    mass: float = told["mass"]
    rows = [_row(np.array(point)) for point in step["points"]]
    fall = np.array([*(told["dt"] * GRAVITY * UP), 0.0, 0.0, 0.0])
    return Step.of(
        "Rapier",
        mass=np.diag([mass] * 3 + [mass / 6] * 3),
        jacobian=np.array(rows),
        bias=np.zeros(len(rows)),
        target=np.array(step["before"]) + fall,
        forces=np.array(step["impulses"]),
        motion=np.array(step["after"]),
        version=told["version"],
        bits=32,
        not_checked=["assembly: the bias and the compliance of the contacts, which Rapier does not report; 0 at rest"],
    )


def _row(point: Array) -> Array:
    return np.concatenate([UP, np.cross(point, UP)])
