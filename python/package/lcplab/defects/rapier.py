"""Scenes of Rapier, which Node runs: each has a script that prints its steps."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from lcplab._receipt.step import Array, Step

GRAVITY, RESTITUTION = -10.0, 0.8
UP = np.array([0.0, 1.0, 0.0])


def resting_cube() -> Iterator[Step]:
    """A cube at rest on four contacts without friction."""
    printed = _printed("resting_cube")
    for step in printed["steps"]:
        yield read(step, printed)


def bouncing_ball() -> Iterator[Step]:
    """A ball falls on the ground from four heights."""
    printed = _printed("bouncing_ball")
    for step in printed["steps"]:
        yield bounce(step, printed["version"])


def _printed(scene: str) -> dict[str, Any]:
    """What the script of a scene prints, with the Rapier of this environment."""
    script = Path(__file__).with_name(f"{scene}.mjs").read_text(encoding="utf-8")
    node = ("node", "--input-type=module", "-")
    done = subprocess.run(node, input=script, capture_output=True, text=True, check=True, cwd=sys.prefix)
    printed: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return printed


def read(step: dict[str, Any], printed: dict[str, Any]) -> Step:
    """A step of the cube, whose axes are those of the world to a millionth; Rapier counts impulses in N s."""
    mass: float = printed["mass"]
    rows = [_row(np.array(point)) for point in step["points"]]
    fall = np.array([*(printed["dt"] * GRAVITY * UP), 0.0, 0.0, 0.0])
    return Step.of(
        "Rapier",
        mass=np.diag([mass] * 3 + [mass / 6] * 3),
        jacobian=np.array(rows),
        bias=np.zeros(len(rows)),
        target=np.array(step["before"]) + fall,
        forces=np.array(step["impulses"]),
        motion=np.array(step["after"]),
        version=printed["version"],
        bits=32,
        not_checked=["assembly: the bias and the compliance of the contacts, which Rapier does not report; 0 at rest"],
    )


def bounce(step: dict[str, Any], version: str = "") -> Step:
    """The step of the ball that bounces: e times the speed before it is asked for, the speed after it is solved."""
    mass, before, after = step["mass"], step["before"], step["after"]
    target = before + step["dt"] * GRAVITY
    return Step.of(
        "Rapier",
        mass=[[mass]],
        jacobian=[[1.0]],
        bias=[-after],
        target=[target],
        forces=[mass * (after - target)],
        motion=[after],
        version=version,
        bits=32,
        expected_bias=np.array([RESTITUTION * before]),
        not_checked=["solver: the bias and the impulse, which Rapier does not report here; they are those of its motion"],
    )


def _row(point: Array) -> Array:
    return np.concatenate([UP, np.cross(point, UP)])
