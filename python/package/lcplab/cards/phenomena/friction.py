"""Friction: what sticks, what slides, and where it stops."""

from __future__ import annotations

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
    question="Does a cube stay on a slope that is rough enough to hold it?",
    matters="What a gripper holds hangs on friction. Contacts whose friction is a damper or a spring that gives "
    "way let it slide, slowly and for ever, and no shorter step helps.",
    law=r"\mu > \tan\theta \;\Rightarrow\; v = 0",
    allowed="a hundredth of the edge in ten seconds: 1 mm of 100 mm, 100 µm/s. The exact law leaves nothing to "
    "the step: a cube at rest stays at rest in every step.",
    duration=SETTLED + 10.0,
    x=("time", "s"),
    y=("slid down", "mm"),
    measure=_creep,
    plot=over_time(lambda run: 1e3 * (run.place("cube")[:, 0] - run.place("cube")[0, 0])),
    exact=lambda curve, run: np.zeros_like(curve.x),
    instants=(0.0, 11.0),
    reported="Reported as mujoco#3328: what should stick creeps. MuJoCo's friction is compliant: an impedance $d < 1$ "
    "leaves the part $1 - d$ of the pull unopposed until the slip, damped at the rate $b$, makes up for it, so that "
    r"$v = \frac{1-d}{d}\,\frac{g \sin\theta}{b}$; with the defaults ($d = 0.95$, $b = 105$/s) that is 1.7 mm/s. With "
    "elliptic cones it falls as 1/impratio, which is why the documentation advises to raise that.",
)


def _rise(run: Run) -> Array:
    height = run.place("cube")[:, 2]
    return np.asarray(height - height[0])


def _lift(runs: Sequence[Run]) -> list[Measurement]:
    run = runs[0]
    return [Measurement("rises by", 1e3 * float(_rise(run).max()), 0.0, 1e3 * PART * _edge(run), "mm")]


LIFT = Phenomenon(
    name="lift",
    question="Does a cube that slides stay on the floor?",
    matters="Where normal force and friction minimise one cost together, friction pays for a gap: a fast body "
    r"is lifted by about $h \mu v$ and floats. It matters for whatever is pushed, thrown or driven.",
    law=r"z(t) = z(0) \quad\text{while } v = v_0 - \mu g t",
    allowed="a hundredth of the edge: 1 mm.",
    duration=1.5,
    x=("time", "s"),
    y=("height above rest", "mm"),
    measure=_lift,
    plot=over_time(lambda run: 1e3 * _rise(run)),
    exact=lambda curve, run: np.zeros_like(curve.x),
    instants=(0.0, 0.5, 0.3),
    reported="Reported as Genesis#3126, where a cube at 6 m/s rises by 318 mm. The minimum of one convex cost over normal "
    r"force and friction leaves the ground at $w_n = \mu |w_t|$: exactly solved it would throw the cube up by as much as "
    r"$(\mu v)^2/2g$, here 459 mm, and softened it does a part of that, which grows with $(\mu v)^2$ all the same. It is "
    "not the cube that tips: a plate of 2 mm, too flat to tilt, is lifted too.",
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
    question="Where does a sliding cube stop?",
    matters="The distance is friction's whole account: speed, weight and coefficient. A push ends where the "
    "simulation says only if this one is right.",
    law=r"d = \frac{v^2}{2 \mu g}",
    allowed=r"a hundredth of $d$, and $v h/2$ for a step $h$ of first order.",
    duration=1.0,
    x=("time", "s"),
    y=("distance", "m"),
    measure=_stopping,
    plot=over_time(_path),
    exact=_braked,
    instants=(0.0, 0.2, 1.0),
)
