"""Friction: what sticks, what slides, and where it stops."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from lcplab.cards._phenomenon import PART, Curve, Measurement, Phenomenon, Run, over_time
from lcplab.engines import Array

#: From when on the cube on the slope is watched (s): before, a compliant contact may settle.
SETTLED = 1.0


def _edge(run: Run) -> float:
    return float(run.body("cube")["shape"]["box"][0])


def _creep(runs: Sequence[Run]) -> list[Measurement]:
    run = runs[0]
    place, start = run.place("cube"), run.after(SETTLED)
    time = run.t[-1] - run.t[start]
    speed = float(np.linalg.norm(place[-1] - place[start]) / time)
    return [Measurement("creeps at", 1e6 * speed, 0.0, 1e6 * PART * _edge(run) / time, "µm/s")]


CREEP = Phenomenon(
    name="creep",
    question="Does a cube stay at rest on a slope that is rough enough to hold it?",
    matters="A gripper holds objects by friction. If an engine models friction as a damper or a compliant spring, "
    "the object slides slowly and never stops.",
    law=r"\mu > \tan\theta \;\Rightarrow\; v = 0",
    allowed="1 % of the edge in ten seconds: 1 mm of 100 mm, 100 µm/s. The step size needs no allowance: under the "
    "exact law a cube at rest stays at rest in every step.",
    duration=SETTLED + 10.0,
    x=("time", "s"),
    y=("sliding distance", "mm"),
    measure=_creep,
    plot=over_time(lambda run: 1e3 * (run.place("cube")[:, 0] - run.place("cube")[0, 0])),
    exact=lambda curve, run: np.zeros_like(curve.x),
    reported="Reported as mujoco#3328: objects that should stick creep. MuJoCo's friction is compliant: an "
    "impedance $d < 1$ leaves the fraction $1 - d$ of the pull unopposed until the slip, damped at the rate $b$, "
    r"balances it, so that $v = \frac{1-d}{d}\,\frac{g \sin\theta}{b}$; with the defaults ($d$ = 0.95, $b$ = 105 per "
    "second) that is 1.7 mm/s. With elliptic cones the speed falls as 1/impratio, so the documentation recommends a "
    "larger impratio; stiffer contacts increase $b$. The accurate settings use both, which makes the result of the "
    "lift test below worse.",
)


def _rise(run: Run) -> Array:
    height = run.place("cube")[:, 2]
    return np.asarray(height - height[0])


def _lift(runs: Sequence[Run]) -> list[Measurement]:
    run = runs[0]
    return [Measurement("rises by", 1e3 * float(_rise(run).max()), 0.0, 1e3 * PART * _edge(run), "mm")]


LIFT = Phenomenon(
    name="lift",
    question="Does a sliding cube stay on the floor?",
    matters="If an engine minimizes one cost over normal force and friction together, friction is traded for a gap: "
    r"a fast body is lifted by about $h \mu v$ and floats. This matters for everything that is pushed, thrown or "
    "driven.",
    law=r"z(t) = z(0) \quad\text{while } v = v_0 - \mu g t",
    allowed="1 % of the edge: 1 mm.",
    duration=1.5,
    x=("time", "s"),
    y=("height above rest", "mm"),
    measure=_lift,
    plot=over_time(lambda run: 1e3 * _rise(run)),
    exact=lambda curve, run: np.zeros_like(curve.x),
    reported="Reported as Genesis#3126, where a cube at 6 m/s rises by 318 mm. The minimum of one convex cost over "
    r"normal force and friction leaves the ground at $w_n = \mu |w_t|$: the exact solution would throw the cube up "
    r"by as much as $(\mu v)^2/2g$, here 459 mm, and softened contacts do a part of that, which also grows with "
    r"$(\mu v)^2$. Tipping is not the cause: a plate of 2 mm, too flat to tilt, is lifted too.",
)


def _path(run: Run) -> Array:
    return np.asarray(run.place("cube")[:, 0] - run.place("cube")[0, 0])


def _distance(run: Run) -> tuple[float, float]:
    """v²/(2 μ g), and v."""
    cube = run.body("cube")
    speed = float(cube["velocity"][0])
    return speed**2 / (2 * cube["friction"] * run.gravity), speed


def _stopping(runs: Sequence[Run]) -> list[Measurement]:
    run = runs[0]
    (law, speed), place = _distance(run), run.place("cube")
    tolerance = PART * law + speed * run.dt / 2
    sideways = float(np.abs(place[:, 1] - place[0, 1]).max())
    return [
        Measurement("stops after", 1e3 * float(_path(run)[-1]), 1e3 * law, 1e3 * tolerance, "mm"),
        Measurement("leaves its line by", 1e3 * sideways, 0.0, 1e3 * PART * law, "mm"),
    ]


def _braked(curve: Curve, run: Run) -> Array:
    (law, speed), time = _distance(run), curve.x
    end = 2 * law / speed
    return np.where(time < end, speed * time * (1 - time / (2 * end)), law)


STOPPING = Phenomenon(
    name="stopping",
    question="Does a sliding cube stop at the right distance?",
    matters="The stopping distance combines speed, gravity and the friction coefficient. A simulated push ends in "
    "the right place only if this distance is right.",
    law=r"d = \frac{v^2}{2 \mu g}",
    allowed="1 % of $d$, and $v h/2$ for a first-order step $h$.",
    duration=1.0,
    x=("time", "s"),
    y=("distance", "m"),
    measure=_stopping,
    plot=over_time(_path),
    exact=_braked,
)


#: By how much the second cube is faster (m/s): single precision still has three digits of what that changes.
FASTER = 1e-4


def _farther(runs: Sequence[Run]) -> Array:
    """How much farther the second cube is for each m/s (s), (steps + 1,)."""
    return np.asarray((_path(runs[1]) - _path(runs[0])) / FASTER)


def _predictability(runs: Sequence[Run]) -> list[Measurement]:
    law, speed = _distance(runs[0])
    slope = 2 * law / speed
    return [Measurement("goes farther by", float(_farther(runs)[-1]), slope, PART * slope + runs[0].dt, "mm per mm/s")]


PREDICTABILITY = Phenomenon(
    name="predictability",
    question="Does the stopping distance respond correctly to a change of the initial speed by 0.1 mm/s?",
    matters="Optimization, learning and identification by finite differences need the change of the final state "
    "with the initial state. If a solver stops early, or a contact jumps between corners at random, the result is "
    "noise.",
    law=r"\frac{\partial d}{\partial v} = \frac{v}{\mu g}",
    allowed=r"1 % of it, and one step $h$: a first-order step brakes in whole steps, and $\partial d/\partial v$ is "
    r"$h$ times their number, the integer below or above $v/(\mu g h)$.",
    duration=1.0,
    x=("time", "s"),
    y=("extra distance per m/s", "s"),
    measure=_predictability,
    plot=lambda runs: Curve(runs[0].t, _farther(runs)),
    exact=lambda curve, run: np.minimum(curve.x, 2 * _distance(run)[0] / _distance(run)[1]),
    variants=({}, {"bodies.cube.velocity": [2 + FASTER, 0, 0]}),
)


SLOPE = math.radians(25)
GRAVITY = 9.81
TURNS = [math.radians(45 * k) for k in range(8)]


def _pull(turn: float) -> list[float]:
    """Gravity of a slope that falls in this direction, seen in the slope's own axes."""
    along = GRAVITY * math.sin(SLOPE)
    return [along * math.cos(turn), along * math.sin(turn), -GRAVITY * math.cos(SLOPE)]


def _down(run: Run) -> tuple[Array, Array]:
    """How far the cube slid down the slope, and across it (m), (steps + 1,)."""
    gravity = np.array(run.scene["gravity"][:2])
    down, path = gravity / np.linalg.norm(gravity), run.place("cube")[:, :2] - run.place("cube")[0, :2]
    return path @ down, path @ np.array([-down[1], down[0]])


def _slid(run: Run) -> float:
    """g (sin θ − μ cos θ) T²/2 (m)."""
    friction = run.body("cube")["friction"]
    return float(GRAVITY * (math.sin(SLOPE) - friction * math.cos(SLOPE)) * run.t[-1] ** 2 / 2)


def _directions(runs: Sequence[Run]) -> list[Measurement]:
    law, time = _slid(runs[0]), float(runs[0].t[-1])
    paths = [float(_down(run)[0][-1]) for run in runs]
    worst = max(paths, key=lambda path: abs(path - law))
    across = max(float(np.abs(_down(run)[1]).max()) for run in runs)
    allowed = PART * law + law / time * runs[0].dt
    return [
        Measurement("slides down by", 1e3 * worst, 1e3 * law, 1e3 * allowed, "mm"),
        Measurement("leaves its line by", 1e3 * across, 0.0, 1e3 * PART * law, "mm"),
    ]


DIRECTIONS = Phenomenon(
    name="directions",
    question="Does a cube slide down a slope equally far in eight directions, and straight?",
    matters="If friction is a box or a pyramid over two tangents, it acts with up to 1.41 times, or 0.71 times, its "
    "coefficient between the tangents, and pulls sideways. Vehicles and robots that steer on wheels, feet or skids "
    "drift off course.",
    law=r"\ddot x = g\,(\sin\theta - \mu \cos\theta)",
    allowed="1 % of the distance in the worst direction, and the distance of one step at the mean speed; sideways 1 "
    "% of the distance.",
    duration=1.0,
    x=("direction", "°"),
    y=("path", "mm"),
    measure=_directions,
    plot=lambda runs: Curve(
        np.degrees(TURNS), np.array([1e3 * float(_down(run)[0][-1]) for run in runs])
    ),
    exact=lambda curve, run: np.full_like(curve.x, 1e3 * _slid(run)),
    variants=[{"gravity": _pull(turn)} for turn in TURNS],
)


def _rolling(runs: Sequence[Run]) -> list[Measurement]:
    run = runs[0]
    ball, start = run.number("ball"), float(run.body("ball")["velocity"][0])
    radius, friction = run.body("ball")["shape"]["sphere"], run.body("ball")["friction"]
    speed, spin = float(run.velocities[-1, ball, 0]), float(run.velocities[-1, ball, 4])
    allowed = PART * 5 / 7 * start + friction * run.gravity * run.dt
    return [
        Measurement("rolls at", speed, 5 / 7 * start, allowed, "m/s"),
        Measurement("slips by", speed - radius * spin, 0.0, allowed, "m/s"),
    ]


def _rolls(curve: Curve, run: Run) -> Array:
    start, friction = float(run.body("ball")["velocity"][0]), run.body("ball")["friction"]
    return np.asarray(np.maximum(start - friction * run.gravity * curve.x, 5 / 7 * start))


ROLLING = Phenomenon(
    name="rolling",
    question="Does a sliding ball start to roll, at 5/7 of its initial speed?",
    matters="Wheels, bearings, bowling balls. Angular momentum about the line of contact determines the speed, for "
    "any friction coefficient. If a rolling ball slows down, or rolling never begins, the contact does not hold a "
    "point at rest.",
    law=r"v = \tfrac57 v_0 \quad\text{after}\quad t = \frac{2 v_0}{7 \mu g}",
    allowed=r"1 % of the speed, and $\mu g h$ for the step in which the slip ends.",
    duration=1.0,
    x=("time", "s"),
    y=("speed", "m/s"),
    measure=_rolling,
    plot=over_time(lambda run: run.velocities[:, run.number("ball"), 0]),
    exact=_rolls,
    reported="A dissipative contact patch brakes a rolling ball: its front is compressed, its rear separates, and "
    r"where pressure grows with $1 + d\,v_n$ and $d\,|v_n| > 1$ the rear supports nothing, so that the contact force "
    "acts ahead of the center. That is Drake with accurate settings ($d$ = 50 s/m): with $d$ = 10, 1 and 0 s/m the "
    "ball rolls at 1.25, 1.38 and 1.39 m/s; we cannot explain the remaining error at 0.",
)
