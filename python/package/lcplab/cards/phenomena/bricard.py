"""Bricard's mechanism: it moves, though its hinges are counted to hold it.

Six links of one length, the first of them the world, each with hinges at its ends that are perpendicular to it and
to each other: the threefold-symmetric linkage of Bricard (1897). Hinges 1, 3, 5 stand at an angle θ and 2, 4, 6
at φ, and the loop is closed while (1 + cos θ)(1 + cos φ) = 1 (Chen, You and Tarnai 2005, with twists of 90 degrees),
which is cos(θ/2) cos(φ/2) = 1/2, a spherical triangle of hypotenuse 60 degrees. With the angle ψ at its corner,

    tan(θ/2) = √3 cos ψ,   sin(φ/2) = (√3/2) sin ψ,

so that all states are one circle of ψ. The energies are M(ψ) ψ'²/2 and V(ψ), and the mechanism released at ψ₀ swings
to π − ψ₀ and back, from a cube to its mirror image.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from lcplab.cards._phenomenon import PART, Curve, Measurement, Phenomenon, Run, over_time
from lcplab.cards.phenomena.joints import _swing, gap
from lcplab.engines import Array, turned

#: ψ at the cube, where θ = φ = 90 degrees.
CUBE = math.acos(1 / math.sqrt(3))
#: How finely the way from the cube to its mirror image is divided.
PARTS = 2000


def _energies(run: Run, psi: Array) -> tuple[Array, Array]:
    """M(ψ) (kg m²) and V(ψ) (J), both like ``psi``.

    Rod after rod from the first hinge: rod i lies along the axis i of its own frame and turns about the axis i + 1
    of that of the one before, with all axes those of the world in the cube.
    """
    rod, g = run.body("rod 1"), run.gravity
    length, mass, (along, across, _) = rod["shape"]["box"][0], rod["mass"], rod["inertia"]
    root = math.sqrt(3)
    theta = 2 * np.arctan(root * np.cos(psi)) - math.pi / 2
    phi = 2 * np.arcsin(root / 2 * np.sin(psi)) - math.pi / 2
    theta_rate = -2 * root * np.sin(psi) / (1 + 3 * np.cos(psi) ** 2)
    phi_rate = root * np.cos(psi) / np.sqrt(1 - 0.75 * np.sin(psi) ** 2)
    turns = [(-theta, -theta_rate), (phi, phi_rate), (theta, theta_rate), (-phi, -phi_rate), (theta, theta_rate)]
    frame = [np.tile(axis, (len(psi), 1)) for axis in np.eye(3)]
    end, end_rate, omega = np.zeros((3, len(psi), 3))
    inertia, potential = np.zeros((2, len(psi)))
    for i, (angle, rate) in enumerate(turns):
        axis, u, w = ((i + k) % 3 for k in (1, 2, 3))
        cos, sin = np.cos(angle)[:, None], np.sin(angle)[:, None]
        omega = omega + rate[:, None] * frame[axis]
        frame[u], frame[w] = cos * frame[u] + sin * frame[w], cos * frame[w] - sin * frame[u]
        half = (length / 2 if i < 3 else -length / 2) * frame[i % 3]
        middle_rate = end_rate + np.cross(omega, half)
        spin = (omega * frame[i % 3]).sum(axis=1) ** 2
        inertia += mass * (middle_rate**2).sum(axis=1) + across * ((omega**2).sum(axis=1) - spin) + along * spin
        potential += mass * g * (end + half)[:, 2]
        end, end_rate = end + 2 * half, middle_rate + np.cross(omega, half)
    return inertia, potential


def _way(run: Run) -> tuple[Array, Array]:
    """ψ and the time (s) at which it comes there, from the cube to its mirror image, (PARTS + 1,) each.

    dt = √(M/2(V₀ − V)) dψ, and ψ = π/2 − (π/2 − ψ₀) cos χ leaves nothing singular at the ends.
    """
    half = math.pi / 2 - CUBE
    edges = np.linspace(0, math.pi, PARTS + 1)
    middles = (edges[1:] + edges[:-1]) / 2
    inertia, potential = _energies(run, math.pi / 2 - half * np.cos(np.append(0.0, middles)))
    speed = np.sqrt(2 * (potential[0] - potential[1:]) / inertia[1:])
    times = half * np.sin(middles) / speed * (math.pi / PARTS)
    return math.pi / 2 - half * np.cos(edges), np.append(0.0, np.cumsum(times))


def _angle(run: Run) -> Array:
    """θ, the first rod's angle from hanging down (rad), (steps + 1,)."""
    along = np.array([turned(q, np.array([1.0, 0, 0])) for q in run.poses[:, run.number("rod 1"), 3:]])
    return np.unwrap(np.arctan2(along[:, 0], -along[:, 2]))


def _exact(curve: Curve, run: Run) -> Array:
    psi, times = _way(run)
    time = curve.x % (2 * times[-1])
    there = np.interp(np.minimum(time, 2 * times[-1] - time), times, psi)
    return np.asarray(np.degrees(2 * np.arctan(math.sqrt(3) * np.cos(there))))


def _bricard(runs: Sequence[Run]) -> list[Measurement]:
    run = runs[0]
    period, length = 2 * _way(run)[1][-1], float(run.body("rod 1")["shape"]["box"][0])
    potential = _energies(run, np.array([CUBE, math.pi / 2]))[1]
    masses = np.array([body["mass"] for body in run.scene["bodies"]])
    heights = run.poses[run.t > run.t[-1] - 1.1 * period, :, 2] @ masses
    lost = (potential[0] - run.gravity * float(heights.max())) / (potential[0] - potential[1])
    return [
        Measurement("swings in", _swing(_angle(run), run.t), period, PART * period, "s"),
        Measurement("loses", 100 * lost, 0.0, 100 * PART, "% of its energy"),
        Measurement("joints open by", 1e3 * gap(run), 0.0, 1e3 * PART * length, "mm"),
    ]


BRICARD = Phenomenon(
    name="bricard",
    question="Does an over-constrained mechanism (Bricard's) still move?",
    matters="Folding roofs, deployable booms, doors on three hinges: real mechanisms have more hinges than they "
    "need. Five rods have 30 degrees of freedom and six hinges remove 30; yet this mechanism moves, because the "
    "rows of the hinges are linearly dependent. An error of a micrometer makes them independent: then the mechanism "
    "locks, or its forces grow without bound.",
    law=r"T = 2 \int_{\psi_0}^{\pi - \psi_0} \sqrt{\frac{M(\psi)}{2\,(V(\psi_0) - V(\psi))}}\,\mathrm{d}\psi, \qquad "
    r"\dot E = 0, \qquad (1 + \cos\theta)(1 + \cos\varphi) = 1",
    allowed="1 % of the period, of the energy exchanged, in ten seconds (computed from the height that the rods "
    r"reach in the last swing), and of a rod's length. $\theta$ and $\varphi$ are the angles of neighboring hinges, "
    r"$\tan\tfrac{\theta}{2} = \sqrt3 \cos\psi$ and $\sin\tfrac{\varphi}{2} = \tfrac{\sqrt3}{2} \sin\psi$.",
    duration=10.0,
    x=("time", "s"),
    y=("angle of the first rod from hanging", "°"),
    measure=_bricard,
    plot=over_time(lambda run: np.degrees(_angle(run))),
    exact=_exact,
    reported="A semi-implicit step preserves the energy of a pendulum, whose inertia is constant. Here $M$ grows "
    "from 10.0 to 22.1 kg m² on the way down, and the energy drifts in proportion to the step: with 1 ms Drake, and "
    "PyBullet without its damping, gain 6.0 %, with 0.5 ms 2.9 %; Runge-Kutta steps gain nothing. Exact solutions "
    "at velocity level lose energy for another reason: once the rods have drifted off the exact motion, the rows "
    "that feed errors back damp the only motion that is possible. DART loses 68 % with steps of 1 ms, 34 % with 0.5 "
    "ms and 2 % with 0.25 ms; lcplab's velocity level loses nearly all with 1 ms and nothing with 0.5 ms; its "
    "acceleration level fails with 5 ms and loses nothing with 2.5 ms. Rapier as installed sweeps over the hinges "
    "once in each of its four substeps, and corrects their remaining error at the expense of the motion: 74 % of "
    "the energy is lost with one sweep, 36 % with 2, 11 % with 4, 5 % with 64. Eight substeps with 64 sweeps lose "
    "0.5 %, 16 substeps gain 2.5 %. Pinocchio as installed takes semi-implicit steps of 5 ms, which open the loop "
    "by 0.3 mm in 0.15 s: one row is redundant while the loop is closed (its eigenvalue of $J H^{-1} J^T$ is 0, "
    "with the loop's rows $J$ and the mass matrix $H$); then its eigenvalue is 3e-11, which ten iterations with mu "
    "1e-10 no longer treat as 0, and the row damps the only motion that is possible. Runge-Kutta steps of 5 ms open "
    "the loop by 9 nm and gain 6e-4 %. (The steps and numbers of sweeps that are not in the table were tried "
    "separately.)",
)
