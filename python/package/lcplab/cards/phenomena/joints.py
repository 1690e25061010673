"""Joints: a pendulum, a chain under load, bars that close a loop, a spring, and an order."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from lcplab.cards._elliptic import first_kind, sine
from lcplab.cards._phenomenon import PART, Curve, Measurement, Phenomenon, Run, over_time
from lcplab.engines import Array, joints, pose, relative, turned


def gap(run: Run) -> float:
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
        Measurement("joints open by", 1e3 * gap(run), 0.0, 1e3 * PART * length, "mm"),
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
    """φ(t) of φ'' = −ω² sin φ from rest."""
    k = math.sin(start / 2)
    return np.asarray(2 * np.arcsin(k * sine(first_kind(k) + math.sqrt(square) * t, k)))


PENDULUM = Phenomenon(
    name="pendulum",
    question="Does a hinged rod keep its period and its energy, and does its hinge stay closed?",
    matters="A robot's arm, a door, a leg. Hinges modeled as springs open under load, implicit steps damp the "
    "swing, and a swing of 90 degrees takes 18 % longer than a small one.",
    law=r"T = 4\,K\!\left(\sin\tfrac{\varphi_0}{2}\right) \sqrt{\frac{I}{m g\,l/2}}, \qquad \dot E = 0",
    allowed="1 % of the period, of the energy in ten seconds (computed from the height that the rod reaches in its "
    "last swing, which a first-order step preserves), and of the rod's length.",
    duration=10.0,
    x=("time", "s"),
    y=("angle from hanging", "°"),
    measure=_pendulum,
    plot=over_time(lambda run: np.degrees(_rod_angle(run))),
    exact=lambda curve, run: np.degrees(_swung(_rod(run)[1], float(_rod_angle(run)[0]), curve.x)),
)


#: The parts of the settings' own step with which an error is seen to shrink.
HALVED = (1.0, 0.5, 0.25)
#: What rounding leaves in the angle (rad): an error below it need not shrink.
ROUNDED = 1e-12


def _errors(runs: Sequence[Run]) -> Array:
    """The error of the rod's angle (rad) with each step, the mean square over the times of the longest, (runs,)."""
    found = []
    for run, part in zip(runs, HALVED, strict=True):
        off = _rod_angle(run) - _swung(_rod(run)[1], float(_rod_angle(run)[0]), run.t)
        found.append(math.sqrt(float(np.mean(off[:: round(1 / part)] ** 2))))
    return np.array(found)


def _order(runs: Sequence[Run]) -> list[Measurement]:
    errors, omega = np.maximum(_errors(runs), ROUNDED), math.sqrt(_rod(runs[0])[1])
    first, second = np.log2(errors[:-1] / errors[1:])
    lacks = 0.0 if errors[-1] == ROUNDED else max(0.0, 1 - float(2 * second - first))
    allowed = PART + 3 / (8 * math.log(2)) * (omega * runs[0].dt) ** 2
    return [Measurement("falls short of first order by", lacks, 0.0, allowed, "")]


ORDER = Phenomenon(
    name="order",
    question="Does half the step give at most half the error?",
    matters="Users who halve the step to see how far they can trust a result rely on this. Damping that the scene "
    "does not specify, joints modeled as springs, and solvers that stop early leave an error that no smaller step "
    "removes.",
    law=r"e(h/2) \le \tfrac12\,e(h), \qquad \varphi(t) = 2 \arcsin\!\left(k\,\mathrm{sn}(K(k) + \omega t)\right), "
    r"\quad k = \sin\tfrac{\varphi_0}{2}",
    allowed="$e$ is the root mean square of the rod's error over one swing, with the step $h$ of the settings, "
    r"$h/2$ and $h/4$. One halving gives the order $p(h) = \log_2(e(h)/e(h/2))$, and both together give the order "
    r"for small steps, $2\,p(h/2) - p(h)$, whatever the next term of the error is: error feedback, which takes "
    "several steps, makes that term large. Only an order below 1 counts as an error. It may be lower by 0.01, and "
    r"by $\tfrac{3}{8 \ln 2}\,(\omega h)^2$ for a third term $a h\,(\omega h)^2$.",
    duration=2.0,
    x=("step relative to the settings'", ""),
    y=("error relative to the full step", ""),
    measure=_order,
    plot=lambda runs: Curve(np.array(HALVED), _errors(runs) / _errors(runs)[0]),
    exact=lambda curve, run: curve.x,
    steps=HALVED,
    log=True,
    reported="PyBullet as installed damps motion by 0.04 (1 + speed) per second, at any step: an error of 0.11 rad "
    "remains. Without that damping it is of first order.",
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
        Measurement("joints open by", 1e3 * gap(run), 0.0, 1e3 * PART * link, "mm"),
    ]


CHAIN = Phenomenon(
    name="chain",
    question="Does a chain keep its length under a load of 100 times a link's mass?",
    matters="Cranes, cable robots, fingers that hold a heavy object. Each joint supports everything that hangs "
    "below it; a sweep passes the load on by one joint, and springs stretch under it.",
    law=r"z_\text{load}(t) = z_\text{load}(0)",
    allowed="1 % of a link for each of the thirteen joints: 13 mm at the load and 1 mm in any one joint, at all "
    "times of three seconds. Nothing moves, so the step size needs no allowance.",
    duration=3.0,
    x=("time", "s"),
    y=("descent of the load", "mm"),
    measure=_chain,
    plot=over_time(lambda run: 1e3 * _sunken(run)),
    exact=lambda curve, run: np.zeros_like(curve.x),
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
    question="Does a closed loop of four bars stay closed and swing with the right period?",
    matters="Excavators, suspensions, parallel grippers. The joint that closes a loop is an additional equation "
    "even in joint coordinates: it can drift, do work, or be soft.",
    law=r"T = 4\,K\!\left(\sin\tfrac{\varphi_0}{2}\right) \sqrt{\frac{2 I + M l^2}{g\,(m + M)\,l}}, "
    r"\qquad \dot E = 0",
    allowed="1 % of the period, of the energy in ten seconds, and of a crank's length.",
    duration=10.0,
    x=("time", "s"),
    y=("angle of the cranks from hanging", "°"),
    measure=_closed_loop,
    plot=over_time(lambda run: np.degrees(_crank_angle(run))),
    exact=lambda curve, run: np.degrees(_swung(_four_bars(run)[1], float(_crank_angle(run)[0]), curve.x)),
)


def _hung(run: Run) -> tuple[float, float]:
    """How far the weight hangs below its start where it rests (m), and ω (1/s)."""
    weight, spring = run.body("weight"), run.scene["constraints"][0]
    square = spring["stiffness"] / weight["mass"]
    return run.gravity / square, math.sqrt(square)


def _lowered(run: Run) -> Array:
    """How far the weight is below its start (m), (steps + 1,)."""
    return np.asarray(run.place("weight")[0, 2] - run.place("weight")[:, 2])


def _spring(runs: Sequence[Run]) -> list[Measurement]:
    run = runs[0]
    (rest, omega), lowered = _hung(run), _lowered(run)
    period = 2 * math.pi / omega
    lost = 1 - (_amplitude(lowered - rest, run.t, period) / rest) ** 2
    allowed = PART + (omega * run.dt) ** 2 / 4
    return [
        Measurement("swings in", _swing(lowered - rest, run.t), period, PART * period, "s"),
        Measurement("loses", 100 * lost, 0.0, 100 * allowed, "% of its energy"),
    ]


def _bounced(curve: Curve, run: Run) -> Array:
    rest, omega = _hung(run)
    return np.asarray(rest * (1 - np.cos(omega * curve.x)))


SPRING = Phenomenon(
    name="spring",
    question="Does a weight that is released on a spring keep its period and its amplitude?",
    matters="Suspensions, tendons, anything compliant. A spring whose force is evaluated at the end of a step is "
    r"stable at any stiffness, but it is damped: for small $\omega h$ its amplitude decays as $e^{-\omega^2 h t/2}$. "
    "A spring whose force is evaluated at the start of a step keeps its amplitude.",
    law=r"T = 2\pi \sqrt{\frac{m}{k}}, \qquad \dot E = 0",
    allowed="1 % of the period; and of the energy in ten seconds (computed from the largest distance of the weight "
    r"from its rest position in the last swing) 1 % and $(\omega h)^2/4$: symplectic Euler swings farther by that "
    "much, and that much of the swing can lie between two steps.",
    duration=10.0,
    x=("time", "s"),
    y=("displacement downward", "m"),
    measure=_spring,
    plot=over_time(_lowered),
    exact=_bounced,
    reported="Rapier and lcplab treat a spring as a soft row, implicitly. At the last turning point but one, after "
    r"$t = 10.5\,T$, the fraction $1 - e^{-\omega^2 h t}$ of the energy is lost: 86 % with the substeps of 1/240 s "
    "of Rapier as installed, 37 % with steps of 1 ms; all of these columns are off by that amount. The soft scheme "
    "solves its rows again after it has moved the bodies, so the force acts one substep later, and the scheme loses "
    "as much energy as with twice the substep.",
)
