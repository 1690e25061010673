"""Painlevé's rod: where forces have no answer and impulses have one."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np

from lcplab.cards._phenomenon import PART, Measurement, Phenomenon, Run, over_time
from lcplab.engines import Array


def _energy(run: Run) -> Array:
    """Kinetic and potential energy of the rod (J), (steps + 1,)."""
    rod, k = run.body("rod"), run.number("rod")
    axes = np.stack([run.carried("rod", axis) for axis in np.eye(3).tolist()], axis=1)
    speed, rates = run.velocities[:, k, :3], np.einsum("kij,kj->ki", axes, run.velocities[:, k, 3:])
    kinetic = rod["mass"] * (speed**2).sum(axis=1) + (rates**2) @ np.array(rod["inertia"], dtype=float)
    return np.asarray(kinetic / 2 - rod["mass"] * run.place("rod") @ np.array(run.scene["gravity"], dtype=float))


def _gained(run: Run) -> Array:
    """What the energy is above the least that it was (J), (steps + 1,)."""
    energy = _energy(run)
    return np.asarray(energy - np.minimum.accumulate(energy))


def _tip(run: Run) -> Array:
    """The height of the lowest corner of the end that is ahead (m), (steps + 1,)."""
    a, b, c = (edge / 2 for edge in run.body("rod")["shape"]["box"])
    corners = [run.carried("rod", [a, y, z])[:, 2] for y, z in product((-b, b), (-c, c))]
    return np.asarray(run.place("rod")[:, 2] + np.min(corners, axis=0))


def _painleve(runs: Sequence[Run]) -> list[Measurement]:
    run = runs[0]
    rod = run.body("rod")
    speed, mass = float(np.linalg.norm(rod["velocity"])), float(rod["mass"])
    allowed = PART * mass * speed**2 / 2 + mass * run.gravity * speed * run.dt / 2
    sinks = max(0.0, -float(_tip(run).min()))
    return [
        Measurement("gains", float(_gained(run).max()), 0.0, allowed, "J"),
        Measurement("tip sinks in by", 1e3 * sinks, 0.0, 1e3 * PART * rod["shape"]["box"][0], "mm"),
    ]


PAINLEVE = Phenomenon(
    name="painleve",
    question="Does a rod that jams on its tip gain no energy and stay above the ground?",
    matters="Chalk on a board, a stick pushed across a table, a walking robot's toe. Friction turns the rod so that "
    "its tip is driven into the ground, and a larger force drives it in faster: no finite force can hold it. The "
    "tip must stop instantly, by an impulse, although there is no impact (Painlevé 1895). Some engines gain energy "
    "here.",
    law=r"\dot E \le 0, \quad z_\text{tip} \ge 0, \qquad\text{where } "
    r"1 + \tfrac{m}{I}\, r_x (r_x + \mu r_z) < 0",
    allowed="1 % of the kinetic energy at the start, and $m g v h/2$ for a first-order step $h$; and 1 % of the "
    r"rod's length, 10 mm. With $\mu$ = 2 the left side is −0.77; it is 0 at $\mu$ = 1.34.",
    duration=0.3,
    x=("time", "s"),
    y=("energy above its minimum", "J"),
    measure=_painleve,
    plot=over_time(_gained),
    exact=lambda curve, run: np.zeros_like(curve.x),
)
