"""A heavy top: one point held, gravity, and spin."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from lcplab.cards._phenomenon import PART, Curve, Measurement, Phenomenon, Run, over_time
from lcplab.engines import Array


def _lean(run: Run) -> Array:
    """θ, the angle of the axis from the vertical (rad), (steps + 1,)."""
    axis = run.carried("top", [0, 0, 1])
    return np.asarray(np.arctan2(np.hypot(axis[:, 0], axis[:, 1]), axis[:, 2]))


def _azimuth(run: Run) -> Array:
    """How far the axis has gone round (rad), (steps + 1,)."""
    axis = run.carried("top", [0, 0, 1])
    angle = np.unwrap(np.arctan2(axis[:, 1], axis[:, 0]))
    return np.asarray(angle - angle[0])


def _precession(run: Run) -> float:
    """Ω (rad/s) of the regular precession with the lean and the spin of the start, the slow one.

    The axis e goes round with Ω, and the spin about it is ω₃. L = I₃ ω₃ e + I₁ Ω (ẑ − cos θ e) goes round with it,
    and Ω ẑ × L = Ω (I₃ ω₃ − I₁ Ω cos θ) ẑ × e is the torque m g l ẑ × e; I₁ is about the fixed point.
    """
    top = run.body("top")
    axis, place = run.carried("top", [0, 0, 1])[0], np.array(top["position"])
    spin, length = float(np.array(top["angular_velocity"]) @ axis), float(np.linalg.norm(place))
    across, along = top["inertia"][0] + top["mass"] * length**2, top["inertia"][2]
    lever, cos = top["mass"] * run.gravity * length, float(axis[2])
    momentum = along * spin
    return float((momentum - math.sqrt(momentum**2 - 4 * across * lever * cos)) / (2 * across * cos))


def _top(runs: Sequence[Run]) -> list[Measurement]:
    run = runs[0]
    lean, rate = _lean(run), _precession(run)
    start, law = float(lean[0]), math.degrees(rate * float(run.t[-1]))
    allowed = PART * start + rate * math.sin(start) * run.dt / 2
    nods = math.degrees(float(np.abs(lean - start).max()))
    return [
        Measurement("nods by", nods, 0.0, math.degrees(allowed), "°"),
        Measurement("goes round by", math.degrees(float(_azimuth(run)[-1])), law, PART * law, "°"),
    ]


TOP = Phenomenon(
    name="top",
    question="Does a heavy top precess at the right rate, without nutation?",
    matters="Wheels that lean, gyroscopes, rotors on arms. Gravity pulls the top down, and the spin turns this into "
    "precession. Without the gyroscopic torque the top falls; with damping it sinks.",
    law=r"\Omega\,(I_3 \omega_3 - I_1 \Omega \cos\theta) = m g l, \qquad \theta(t) = \theta(0), "
    r"\quad \varphi = \Omega t",
    allowed=r"1 % of $\theta$ and of $\Omega T$ in ten seconds. A first-order step $h$ has velocities half a step "
    r"apart from its poses, so the axis may also nod by its motion in half a step, $\Omega \sin\theta\, h/2$. $I_1$ "
    "is about the fixed point.",
    duration=10.0,
    x=("time", "s"),
    y=("lean", "°"),
    measure=_top,
    plot=over_time(lambda run: np.degrees(_lean(run))),
    exact=lambda curve, run: np.full_like(curve.x, math.degrees(float(_lean(run)[0]))),
)
