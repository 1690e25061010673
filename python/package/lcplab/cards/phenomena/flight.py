"""Bodies in the air: the adapters' own test, a bounce, a bullet, and a brick that turns over."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from lcplab.cards._elliptic import first_kind
from lcplab.cards._phenomenon import PART, Curve, Measurement, Phenomenon, Run, over_time
from lcplab.engines import Array, pose, turned


def _thrown(curve: Curve, run: Run) -> Array:
    time = curve.x
    return np.asarray(run.body("cube")["velocity"][2] * time - run.gravity * time**2 / 2)


def _free_fall(runs: Sequence[Run]) -> list[Measurement]:
    run = runs[0]
    time = float(run.t[-1])
    fall, rate = run.gravity * time**2 / 2, float(np.linalg.norm(run.body("cube")["angular_velocity"]))
    q = run.poses[-1, 0, 3:]
    angle = 2 * math.atan2(float(np.linalg.norm(q[1:])), float(q[0]))
    law = run.body("cube")["velocity"][2] * time - fall
    allowed = PART * fall + run.gravity * time * run.dt / 2
    degrees = math.degrees(rate * time)
    return [
        Measurement("rises by", float(run.place("cube")[-1, 2]), law, allowed, "m"),
        Measurement("turns by", math.degrees(angle), degrees, PART * degrees, "°"),
    ]


FREE_FALL = Phenomenon(
    name="free_fall",
    question="Does a thrown cube follow its parabola and turn at a constant rate?",
    matters="A test of the adapters: if an engine with accurate settings fails it, the scene was translated "
    "incorrectly, and the engine is not shown. Engines that fail it only as installed damp motion in empty space.",
    law=r"z = v t - \tfrac12 g t^2, \qquad \varphi = \omega t",
    allowed="1 % of the fall and of the angle, and $g t h/2$ for a first-order step $h$.",
    duration=1.0,
    x=("time", "s"),
    y=("height", "m"),
    measure=_free_fall,
    plot=over_time(lambda run: run.place("cube")[:, 2]),
    exact=_thrown,
)


def _bouncing(run: Run) -> tuple[float, float, float]:
    """The height of the drop (m), the speed of arrival (m/s), and e."""
    ball = run.body("ball")
    height = float(ball["position"][2] - ball["shape"]["sphere"])
    return height, math.sqrt(2 * run.gravity * height), float(ball["restitution"])


def _above(run: Run) -> Array:
    return np.asarray(run.place("ball")[:, 2] - run.body("ball")["shape"]["sphere"])


def _height(curve: Curve, run: Run) -> Array:
    (height, speed, e), g = _bouncing(run), run.gravity
    start = speed / g
    exact = np.where(curve.x < start, height - g * curve.x**2 / 2, 0.0)
    while e > 0 and start < curve.x[-1] and speed > 1e-3:
        speed *= e
        flight = curve.x - start
        exact = np.where((flight > 0) & (flight < 2 * speed / g), speed * flight - g * flight**2 / 2, exact)
        start += 2 * speed / g
    return exact


def _bounce(runs: Sequence[Run]) -> list[Measurement]:
    run = runs[0]
    (height, speed, e), above = _bouncing(run), _above(run)
    arrival = speed / run.gravity
    rebound = float(above[run.after(1.2 * arrival) :].max())
    low = PART * height
    after = float(run.t[np.nonzero(above > low)[0][-1]])
    fine = Curve(np.linspace(0, float(run.t[-1]), 100_001), np.empty(0))
    law = float(fine.x[np.nonzero(_height(fine, run) > low)[0][-1]])
    bounces = sum(e ** (2 * k) > PART for k in range(1, 20))
    return [
        Measurement("rebounds to", 1e3 * rebound, 1e3 * e**2 * height, 1e3 * (low + e**2 * speed * run.dt), "mm"),
        Measurement("lies after", after, law, PART * law + (bounces + 1) * run.dt, "s"),
    ]


BOUNCE = Phenomenon(
    name="bounce",
    question="Does a ball bounce to the right height and come to rest in time?",
    matters="Everything that is dropped, thrown or hit. Each bounce keeps the fraction $e^2$ of the height, and all "
    "bounces together take a finite time. An engine that loses or gains a bounce predicts throws wrongly.",
    law=r"h_k = e^{2k} h, \qquad t_\infty = \sqrt{\tfrac{2h}{g}}\,\frac{1 + e}{1 - e}",
    allowed=r"1 % of $h$, and $e^2 v\,\Delta t$ because a step detects an arrival late. For the last time at which "
    r"the ball is 1 % of $h$ above the ground, which the table lists and which is earlier than $t_\infty$: 1 %, and "
    "one step per bounce.",
    duration=2.0,
    x=("time", "s"),
    y=("height above the ground", "m"),
    measure=_bounce,
    plot=over_time(_above),
    exact=_height,
)


#: Ten places to start from, 17 mm apart: where a step happens to end must not decide.
PLACES = [-1 - 0.017 * k for k in range(10)]


def _beyond(runs: Sequence[Run]) -> list[float]:
    """How far the ball's middle comes beyond the wall's front in each run (mm); at most through the wall."""
    wall, ball = runs[0].body("wall"), runs[0].body("ball")
    thickness = float(wall["shape"]["box"][0])
    front, through = float(wall["position"][0]) - thickness / 2, thickness + ball["shape"]["sphere"]
    return [1e3 * min(max(0.0, float(run.place("ball")[:, 0].max()) - front), through) for run in runs]


def _bullet(runs: Sequence[Run]) -> list[Measurement]:
    thickness = float(runs[0].body("wall")["shape"]["box"][0])
    return [
        Measurement("lets the ball's middle pass the front by", max(_beyond(runs)), 0.0, 1e3 * PART * thickness, "mm")
    ]


BULLET = Phenomenon(
    name="bullet",
    question="Does a fast ball stay on its side of a thin wall?",
    matters="Shots, drops, a finger that hits a plate at speed. A ball that is in front of the wall at the end of "
    "one step and behind it at the end of the next never overlapped it: only an engine that checks the path between "
    "the steps detects the contact.",
    law=r"x(t) \le x_\text{wall}",
    allowed="the center of the ball may pass the front face by 1 % of the wall's thickness; half the ball then "
    "overlaps the wall, which soft contacts and the step may use. The distance of one step, $v h$, is not allowed "
    "in addition: a ball that flies through would pass the test. The worst of ten starts counts, 17 mm apart. At 15 "
    "mm the ball is through.",
    duration=0.05,
    x=("start distance from the wall", "m"),
    y=("distance past the front face", "mm"),
    measure=_bullet,
    plot=lambda runs: Curve(-np.array(PLACES), np.array(_beyond(runs))),
    exact=lambda curve, run: np.zeros_like(curve.x),
    variants=[{"bodies.ball.position": [place, 0, 0]} for place in PLACES],
    reported="Some engines can check the path between the steps, body by body (PyBullet with ccdSweptSphereRadius, "
    "Rapier with ccd_enabled): no column here uses that. lcplab's acceleration level finds the instant within the "
    "step at which bodies meet.",
)


def _moments(run: Run) -> Array:
    return np.array(run.body("brick")["inertia"], dtype=float)


def _rates(run: Run) -> Array:
    """The angular velocity in the brick's own axes, (steps + 1, 3)."""
    q, omega = run.poses[:, 0, 3:], run.velocities[:, 0, 3:]
    return np.array([turned(a * [1, -1, -1, -1], w) for a, w in zip(q, omega, strict=True)])


def _momentum(run: Run) -> Array:
    """I ω in world axes, (steps + 1, 3)."""
    inside = _rates(run) * _moments(run)
    return np.array([turned(q, l) for q, l in zip(run.poses[:, 0, 3:], inside, strict=True)])


def _half_turn(run: Run) -> float:
    """Half the period of the middle rate (s): from one turning over to the next.

    Jacobi: the middle rate is an elliptic sine of the period 4 K(k) √(I1 I2 I3/((I3 − I2)(L² − 2 E I1))).
    """
    one, two, three = moments = _moments(run)
    omega = turned(pose(run.body("brick"))[3:] * [1, -1, -1, -1], np.array(run.body("brick")["angular_velocity"]))
    square, double = float(((moments * omega) ** 2).sum()), float((moments * omega**2).sum())
    part = (two - one) * (double * three - square) / ((three - two) * (square - double * one))
    return 2 * first_kind(math.sqrt(part)) * math.sqrt(
        one * two * three / ((three - two) * (square - double * one))
    )


def _crossings(t: Array, y: Array) -> Array:
    """When a quantity passes 0, between samples by a straight line."""
    k = np.nonzero(y[:-1] * y[1:] < 0)[0]
    return np.asarray(t[k] + (t[k + 1] - t[k]) * y[k] / (y[k] - y[k + 1]))


def _angular_momentum(runs: Sequence[Run]) -> list[Measurement]:
    run = runs[0]
    momentum, rates = _momentum(run), _rates(run)
    size = float(np.linalg.norm(momentum[0]))
    lost = float(np.linalg.norm(momentum - momentum[0], axis=1).max()) / size
    energy = (rates**2 * _moments(run)).sum(axis=1)
    gained = float(np.abs(energy / energy[0] - 1).max())
    turns, law = np.diff(_crossings(run.t, rates[:, 1])), _half_turn(run)
    return [
        Measurement("angular momentum is off by", 100 * lost, 0.0, 100 * PART, "%"),
        Measurement("energy is off by", 100 * gained, 0.0, 100 * PART, "%"),
        Measurement("turns over every", float(turns.mean()) if len(turns) else math.inf, law, PART * law, "s"),
    ]


def _middle(curve: Curve, run: Run) -> Array:
    """The middle rate by the law, from Euler's equations in steps of a ten-thousandth of a turn."""
    one, two, three = moments = _moments(run)
    slope = np.array([(two - three) / one, (three - one) / two, (one - two) / three])
    omega = _rates(run)[0]

    def rate(w: Array) -> Array:
        return np.asarray(slope * np.array([w[1] * w[2], w[2] * w[0], w[0] * w[1]]))

    exact = [omega[1]]
    for start, end in zip(curve.x[:-1], curve.x[1:], strict=True):
        count = max(1, math.ceil((end - start) * float(np.linalg.norm(moments * omega) / moments.min()) * 100))
        h = (end - start) / count
        for _ in range(count):
            a = rate(omega)
            b = rate(omega + h / 2 * a)
            c = rate(omega + h / 2 * b)
            omega = omega + h / 6 * (a + 2 * b + 2 * c + rate(omega + h * c))
        exact.append(omega[1])
    return np.array(exact)


ANGULAR_MOMENTUM = Phenomenon(
    name="angular_momentum",
    question="Does a brick in free flight keep its angular momentum and energy, and turn over in time?",
    matters="Drones, satellites, a falling cat, anything thrown with a spin. Engines that leave out the gyroscopic "
    "torque, or damp it, never turn the brick over; explicit integrators gain energy.",
    law=r"\dot{\mathbf{L}} = 0, \quad \dot E = 0, \quad "
    r"\tfrac{T}{2} = 2 K(k) \sqrt{\frac{I_1 I_2 I_3}{(I_3 - I_2)(L^2 - 2 E I_1)}}",
    allowed="1 % of each in ten seconds. $T/2$ is the time from one turn-over to the next, $K$ the complete "
    r"elliptic integral, $k^2 = \frac{(I_2 - I_1)(2 E I_3 - L^2)}{(I_3 - I_2)(L^2 - 2 E I_1)}$, $I_1 < I_2 < I_3$.",
    duration=10.0,
    x=("time", "s"),
    y=("rate about the middle axis", "rad/s"),
    measure=_angular_momentum,
    plot=over_time(lambda run: _rates(run)[:, 1]),
    exact=_middle,
)
