"""Branching articulated trees: one in free flight, and one that stands on its legs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lcplab.cards._phenomenon import PART, Curve, Measurement, Phenomenon, Run, over_time
from lcplab.cards.phenomena.joints import gap
from lcplab.cards.phenomena.stacks import WATCHED
from lcplab.engines import Array


def _masses(run: Run) -> Array:
    return np.array([body["mass"] for body in run.scene["bodies"]])


def _center(run: Run) -> tuple[Array, Array]:
    """The center of mass and its velocity, each (steps + 1, 3)."""
    parts = _masses(run) / _masses(run).sum()
    return np.einsum("b,tbi->ti", parts, run.poses[:, :, :3]), np.einsum("b,tbi->ti", parts, run.velocities[:, :, :3])


def _invariants(run: Run) -> tuple[Array, Array]:
    """Angular momentum about the center of mass, (steps + 1, 3), and kinetic energy of the motion about it."""
    (center, velocity), masses = _center(run), _masses(run)
    momentum, energy = np.zeros_like(center), np.zeros(len(run.t))
    for k, body in enumerate(run.scene["bodies"]):
        axes = [run.carried(body["name"], axis) for axis in np.eye(3)]
        arm, speed = run.poses[:, k, :3] - center, run.velocities[:, k, :3] - velocity
        omega = run.velocities[:, k, 3:]
        spin = sum(
            moment * (omega * axis).sum(axis=1)[:, None] * axis for moment, axis in zip(body["inertia"], axes, strict=True)
        )
        momentum += masses[k] * np.cross(arm, speed) + spin
        energy += (masses[k] * (speed**2).sum(axis=1) + (omega * spin).sum(axis=1)) / 2
    return momentum, energy


def _gained(run: Run) -> Array:
    """The relative change of the energy about the center of mass, (steps + 1,)."""
    energy = _invariants(run)[1]
    return np.asarray(energy / energy[0] - 1)


def _flying(runs: Sequence[Run]) -> list[Measurement]:
    run = runs[0]
    (center, velocity), momentum = _center(run), _invariants(run)[0]
    lost = np.linalg.norm(momentum - momentum[0], axis=1).max() / np.linalg.norm(momentum[0])
    spin = float(np.linalg.norm(run.velocities[0, 0, 3:]))
    allowed = 100 * (PART + spin * run.dt / 2)
    time, gravity = run.t[:, None], np.array(run.scene["gravity"])
    off = np.linalg.norm(center - center[0] - velocity[0] * time - gravity * time**2 / 2, axis=1).max()
    fall = run.gravity * run.t[-1] ** 2 / 2
    length = float(np.linalg.norm(np.subtract(run.body("left front limb")["position"], run.scene["constraints"][0]["point"])))
    return [
        Measurement("angular momentum is off by", 100 * float(lost), 0.0, allowed, "%"),
        Measurement("energy is off by", 100 * float(np.abs(_gained(run)).max()), 0.0, allowed, "%"),
        Measurement("center of mass is off by", float(off), 0.0, PART * fall + run.gravity * run.t[-1] * run.dt / 2, "m"),
        Measurement("joints open by", 1e3 * gap(run), 0.0, 1e3 * PART * 2 * length, "mm"),
    ]


FLYING_TREE = Phenomenon(
    name="flying_tree",
    question="Does a branching tree of rods in free flight keep its angular momentum and its energy?",
    matters="Legged robots that jump, satellites with arms, ragdolls. A trunk with four limbs and eight twigs spins, and "
    "the centrifugal forces swing limbs and twigs to and fro. Nothing else acts, so hinges and balls may exchange momentum and "
    "energy between the rods, but not change the sums. Recursive dynamics that mixes up two branches changes them.",
    law=r"\mathbf{r}_c(t) = \mathbf{r}_c(0) + \mathbf{v}_c t + \tfrac12 \mathbf{g} t^2, \quad "
    r"\dot{\mathbf{L}}_c = 0, \quad \tfrac{d}{dt} \sum_i \tfrac12 \left(m_i |\mathbf{v}_i - \mathbf{v}_c|^2 + "
    r"\boldsymbol\omega_i \cdot \mathbf{I}_i \boldsymbol\omega_i\right) = 0",
    allowed=r"1 % of angular momentum and of energy in two seconds, and $\omega h/2$ with the spin $\omega$, because a "
    "first-order step combines positions and velocities that are half a step apart; 1 % of the fall and $g t h/2$ for the "
    "center of mass; 1 % of a limb's length for the joints.",
    duration=2.0,
    x=("time", "s"),
    y=("change of the energy about the center of mass", "%"),
    measure=_flying,
    plot=over_time(lambda run: 100 * _gained(run)),
    exact=lambda curve, run: np.zeros_like(curve.x),
)


def _supported(run: Run) -> Array:
    """The force on each of the three plates, downward, relative to the weight of what stands on them, (steps + 1, 3)."""
    assert run.forces is not None
    plates = [run.number(f"plate {k}") for k in (1, 2, 3)]
    weight = run.gravity * sum(body["mass"] for body in run.scene["bodies"] if not body["fixed"])
    return np.asarray(-run.forces[:, plates, 2] / weight)


def _standing(runs: Sequence[Run]) -> list[Measurement]:
    run = runs[0]
    supported = _supported(run)[run.after(run.t[-1] - WATCHED) :].mean(axis=0)
    uneven = float(3 * supported[np.argmax(np.abs(3 * supported - 1))])
    trunk = run.place("trunk")
    moved, height = float(np.linalg.norm(trunk - trunk[0], axis=1).max()), float(trunk[0, 2])
    return [
        Measurement("reports on all plates", 100 * float(supported.sum()), 100.0, 100 * PART, "% of the weight"),
        Measurement("reports on one plate", 100 * uneven, 100.0, 100 * PART, "% of a third of the weight"),
        Measurement("lets the trunk move by", 1e3 * moved, 0.0, 1e3 * PART * height, "mm"),
        Measurement("joints open by", 1e3 * gap(run), 0.0, 1e3 * PART * height, "mm"),
    ]


STANDING_TREE = Phenomenon(
    name="standing_tree",
    question="Does a branching tree stand on three legs, and does each of them bear a third of its weight?",
    matters="Legged robots, hands, tripods. A trunk stands on three hinged legs without motors. Friction holds the feet: "
    "they press outward with 28 % of their normal force, and the coefficient is 1. Two chains of three links hang from "
    "each leg. With 63 degrees of freedom, MuJoCo uses its sparse factorization (from 60 on).",
    law=r"\textstyle\sum_i f_{i,z} = \sum_b m_b\,g, \qquad f_{1,z} = f_{2,z} = f_{3,z}, "
    r"\qquad \mathbf{r}_\text{trunk}(t) = \mathbf{r}_\text{trunk}(0)",
    allowed="1 % of the weight and of its third, both averaged over the last half second; 1 % of the trunk's height for its "
    "motion and for the joints. Nothing moves, so the step size needs no allowance.",
    duration=2.0,
    x=("time", "s"),
    y=("support force relative to the weight", "%"),
    measure=_standing,
    plot=over_time(lambda run: 100 * _supported(run).sum(axis=1)),
    exact=lambda curve, run: np.full_like(curve.x, 100.0),
    needs_forces=True,
)
