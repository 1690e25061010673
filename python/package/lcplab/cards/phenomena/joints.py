"""Joints: a pendulum, a chain under load, and bars that close a loop."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from lcplab.cards._elliptic import first_kind
from lcplab.cards._phenomenon import PART, Curve, Measurement, Phenomenon, Run, over_time
from lcplab.engines import Array, joints, pose, relative, turned


def _gap(run: Run) -> float:
    """How far the two ends of any joint come apart at most (m)."""
    worst = 0.0
    for joint in joints(run.scene):
        ends = []
        for body in (joint.parent, joint.child):
            if body is None:
                ends.append(np.broadcast_to(joint.point, (len(run.t), 3)))
                continue
            start = pose(run.scene["bodies"][body])
            at = relative(start, np.concatenate([joint.point, [1, 0, 0, 0]]))[:3]
            name = run.scene["bodies"][body]["name"]
            ends.append(np.asarray(run.place(name) + run.carried(name, at)))
        worst = max(worst, float(np.linalg.norm(ends[0] - ends[1], axis=1).max()))
    return worst


def _swing(angle: Array, t: Array) -> float:
    """The mean period (s), from the times at which the angle passes 0 upwards."""
    k = np.nonzero((angle[:-1] < 0) & (angle[1:] >= 0))[0]
    passes = t[k] - angle[k] * (t[k + 1] - t[k]) / (angle[k + 1] - angle[k])
    return float(np.diff(passes).mean()) if len(passes) > 1 else math.inf


def _amplitude(angle: Array, t: Array, period: float) -> float:
    """How far it still swings at the end (rad), the larger side."""
    return float(np.abs(angle[t > t[-1] - 1.1 * period]).max())


def _fallen(angle: float, start: float) -> float:
    """The part of the energy of the start that a swing of this amplitude lacks."""
    return (math.cos(angle) - math.cos(start)) / (1 - math.cos(start))


def _swinging(run: Run, angle: Array, period: float, length: float, loss: float) -> list[Measurement]:
    start, measured = abs(float(angle[0])), _swing(angle, run.t)
    lost = _fallen(_amplitude(angle, run.t, period), start)
    return [
        Measurement("swings in", measured, period, PART * period, "s"),
        Measurement("loses", 100 * lost, 0.0, 100 * loss, "% of its energy"),
        Measurement("joints open by", 1e3 * _gap(run), 0.0, 1e3 * PART * length, "mm"),
    ]


def _rod(run: Run) -> tuple[float, float, float]:
    """The length of the rod (m), ω² of its small swings (1/s²), and the period (s) from its start."""
    length, thick, _ = run.body("rod")["shape"]["box"]
    moment = (length**2 + thick**2) / 12 + length**2 / 4
    square = run.gravity * (length / 2) / moment
    start = abs(float(_rod_angle(run)[0]))
    return length, square, 4 * first_kind(math.sin(start / 2)) / math.sqrt(square)


def _rod_angle(run: Run) -> Array:
    """The rod's angle from hanging down (rad), (steps + 1,)."""
    along = np.array([turned(q, np.array([1.0, 0, 0])) for q in run.poses[:, 0, 3:]])
    return np.unwrap(np.arctan2(along[:, 0], -along[:, 2]))


def _pendulum(runs: Sequence[Run]) -> list[Measurement]:
    length, _, period = _rod(runs[0])
    return _swinging(runs[0], _rod_angle(runs[0]), period, length, PART)


def _swung(square: float, start: float, t: Array) -> Array:
    """φ(t) of φ'' = −ω² sin φ from rest, in steps of a thousandth of a radian of phase."""
    angle, rate, exact = start, 0.0, [start]
    for h in np.diff(t):
        count = max(1, math.ceil(h * math.sqrt(square) * 100))
        for _ in range(count):
            s = h / count  # Runge-Kutta of fourth order on (φ, φ')
            k1 = (rate, -square * math.sin(angle))
            k2 = (rate + s / 2 * k1[1], -square * math.sin(angle + s / 2 * k1[0]))
            k3 = (rate + s / 2 * k2[1], -square * math.sin(angle + s / 2 * k2[0]))
            k4 = (rate + s * k3[1], -square * math.sin(angle + s * k3[0]))
            angle += s / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0])
            rate += s / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1])
        exact.append(angle)
    return np.array(exact)


PENDULUM = Phenomenon(
    name="pendulum",
    question="Does a rod on a hinge keep its period, its energy and its hinge?",
    matters="A robot's arm, a door, a leg. Hinges as springs open under load, implicit steps brake, and a swing of "
    "90 degrees is slower than a small one by 18 %.",
    law=r"T = 4\,K\!\left(\sin\tfrac{\varphi_0}{2}\right) \sqrt{\frac{I}{m g\,l/2}}, \qquad \dot E = 0",
    allowed="a hundredth of the period, of the energy in ten seconds (from the height that the rod reaches in its "
    "last swing, which a step of first order keeps), and of the rod's length.",
    duration=10.0,
    x=("time", "s"),
    y=("angle from hanging", "°"),
    measure=_pendulum,
    plot=over_time(lambda run: np.degrees(_rod_angle(run))),
    exact=lambda curve, run: np.degrees(_swung(_rod(run)[1], float(_rod_angle(run)[0]), curve.x)),
    instant=0.9,
)


def _sunken(run: Run) -> Array:
    """How far the load is below its place (m), (steps + 1,)."""
    height = run.place("load")[:, 2]
    return np.asarray(height[0] - height)


def _chain(runs: Sequence[Run]) -> list[Measurement]:
    run = runs[0]
    first, second = (joint["point"][2] for joint in run.scene["constraints"][:2])
    link, count = float(first - second), len(run.scene["constraints"])
    sunken = _sunken(run)
    worst = float(sunken[np.argmax(np.abs(sunken))])
    return [
        Measurement("load sinks by", 1e3 * worst, 0.0, 1e3 * PART * link * count, "mm"),
        Measurement("joints open by", 1e3 * _gap(run), 0.0, 1e3 * PART * link, "mm"),
    ]


CHAIN = Phenomenon(
    name="chain",
    question="Does a chain keep its length under a load of a hundred times a link's mass?",
    matters="Cranes, cable robots, fingers that hold something heavy. A joint passes on what hangs below it; sweeps "
    "pass it on by a joint at a time, and springs give way to it.",
    law=r"z_\text{load}(t) = z_\text{load}(0)",
    allowed="a hundredth of a link for each of the thirteen joints, 13 mm at the load and 1 mm in any one, at all "
    "times of three seconds. Nothing moves, so nothing is left to the step.",
    duration=3.0,
    x=("time", "s"),
    y=("load below its place", "mm"),
    measure=_chain,
    plot=over_time(lambda run: 1e3 * _sunken(run)),
    exact=lambda curve, run: np.zeros_like(curve.x),
    instant=3.0,
)


def _crank_angle(run: Run) -> Array:
    """The left crank's angle from hanging down (rad), (steps + 1,)."""
    down = np.array([turned(q, np.array([0.0, 0, -1])) for q in run.poses[:, run.number("left crank"), 3:]])
    return np.unwrap(np.arctan2(down[:, 0], -down[:, 2]))


def _four_bars(run: Run) -> tuple[float, float, float]:
    """The cranks' length (m), ω² of small swings (1/s²), and the period (s) from the start.

    The coupler stays level, so it moves as a point at a crank's end: I = 2 I_crank + M l², and the weight
    pulls with g (m l + M l) sin φ, each of the two cranks at half its length.
    """
    crank, coupler = run.body("left crank"), run.body("coupler")
    thick, _, length = crank["shape"]["box"]
    mass, load = crank["mass"], coupler["mass"]
    moment = 2 * mass * ((length**2 + thick**2) / 12 + length**2 / 4) + load * length**2
    square = run.gravity * (mass + load) * length / moment
    start = abs(float(_crank_angle(run)[0]))
    return length, square, 4 * first_kind(math.sin(start / 2)) / math.sqrt(square)


def _closed_loop(runs: Sequence[Run]) -> list[Measurement]:
    length, _, period = _four_bars(runs[0])
    return _swinging(runs[0], _crank_angle(runs[0]), period, length, PART)


CLOSED_LOOP = Phenomenon(
    name="closed_loop",
    question="Do four bars that close a loop stay closed, and swing as they must?",
    matters="Excavators, suspensions, parallel grippers. The joint that closes a loop is an equation beside the "
    "others even in joint coordinates: it drifts, it pulls, or it is soft.",
    law=r"T = 4\,K\!\left(\sin\tfrac{\varphi_0}{2}\right) \sqrt{\frac{2 I + M l^2}{g\,(m + M)\,l}}, "
    r"\qquad \dot E = 0",
    allowed="a hundredth of the period, of the energy in ten seconds, and of a crank's length.",
    duration=10.0,
    x=("time", "s"),
    y=("angle of the cranks from hanging", "°"),
    measure=_closed_loop,
    plot=over_time(lambda run: np.degrees(_crank_angle(run))),
    exact=lambda curve, run: np.degrees(_swung(_four_bars(run)[1], float(_crank_angle(run)[0]), curve.x)),
    instant=0.75,
)
