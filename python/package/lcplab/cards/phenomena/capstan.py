"""A chain over a post: friction lets a small load hold a large one."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from lcplab.cards._phenomenon import PART, Curve, Measurement, Phenomenon, Run, over_time
from lcplab.engines import Array

#: The masses of the heavy load (kg): 0.91 and 1.19 of what friction can hold.
HELD, SLIDES = 2.3, 3.0


def _pull(run: Run, acceleration: float) -> float:
    """How much the chain pulls the heavy load up (N) while it moves along itself and all contacts slide.

    Link after link from the light load, in the plane (x, z), with the forces and the moments about the link's middle
    p, which is its contact's too: it is pulled back at p by F, pressed outwards by N and rubbed by −μ N at the post,
    R = |p| − r from the axis, and pulled on at the next hinge q by G; its weight acts at p. A link that hangs has no N.
    """
    g, friction = run.gravity, run.body("post")["friction"]
    links = [body for body in run.scene["bodies"] if body["name"].startswith("link")]
    hinges = [np.array(joint["point"])[[0, 2]] for joint in run.scene["constraints"]]
    back = np.array([0.0, -run.body("light")["mass"] * (g + acceleration)])
    for link, after in zip(links, hinges[1:], strict=True):
        p, radius, mass = np.array(link["position"])[[0, 2]], link["shape"]["sphere"], link["mass"]
        out = p / np.linalg.norm(p) if p[1] > -1e-9 else np.array([-1.0, 0.0])
        ahead, arm = np.array([out[1], -out[0]]), after - p
        weight = np.array([0.0, -mass * g]) - mass * acceleration * ahead
        # Unknown are N and G; the rows are the forces and the moment.
        rows = np.eye(3, k=1)
        if p[1] > -1e-9:
            rows[:2, 0] = out - friction * ahead
            rows[2] = -friction * radius, -arm[1], arm[0]
        else:
            rows[:, 0], rows[2] = (1.0, 0.0, 0.0), (0.0, -arm[1], arm[0])
        back = -np.linalg.solve(rows, np.array([*(-back - weight), 0.0]))[1:]
    return float(back[1])


def _limits(run: Run) -> tuple[float, float]:
    """The mass that friction can hold (kg), and the acceleration (m/s²) with which the heavy load goes down.

    The pull is linear in the acceleration: m (g − a) = F(0) + (F(1) − F(0)) a.
    """
    mass, still = run.body("heavy")["mass"], _pull(run, 0.0)
    return still / run.gravity, (mass * run.gravity - still) / (mass + _pull(run, 1.0) - still)


def _lowered(run: Run) -> Array:
    """How far the heavy load is below its place (m), (steps + 1,)."""
    height = run.place("heavy")[:, 2]
    return np.asarray(height[0] - height)


def _turns(run: Run) -> tuple[float, float]:
    """T₂/T₁ at the limit of a thin rope and of a thin chain that lies as this one does."""
    friction = run.body("post")["friction"]
    on = [body for body in run.scene["bodies"] if body["name"].startswith("link") and body["position"][2] > -1e-9]
    count = len(on) - 1
    part = friction * math.tan(math.pi / (2 * count))
    return math.exp(friction * math.pi), ((1 + part) / (1 - part)) ** count


def _capstan(runs: Sequence[Run]) -> list[Measurement]:
    held, slides = runs
    (limit, acceleration), (rope, chain) = _limits(slides), _turns(slides)
    heavy, time = slides.body("heavy")["mass"], float(slides.t[-1])
    law = acceleration * time**2 / 2
    off = 2 * slides.gravity * heavy * limit / (heavy + limit) ** 2 * (chain / rope - 1)
    allowed = PART * law + off * time**2 / 2 + acceleration * time * slides.dt / 2
    radius = held.body("post")["shape"]["capsule"]["radius"]
    return [
        Measurement(f"lets {HELD:g} kg sink by", 1e3 * float(_lowered(held)[-1]), 0.0, 1e3 * PART * radius, "mm"),
        Measurement(f"lets {SLIDES:g} kg sink by", 1e3 * float(_lowered(slides)[-1]), 1e3 * law, 1e3 * allowed, "mm"),
    ]


CAPSTAN = Phenomenon(
    name="capstan",
    question="Does a chain around a post hold 2.3 times the mass at its other end, but not 3 times?",
    matters="Winches, belts, tendons over pulleys, cables. Each link can pull slightly more than the link before "
    "it, and these factors multiply. An engine that takes the normal forces from the last step, or from a problem "
    "without friction, instead of from the tension itself, gets a sum instead of a power.",
    law=r"\frac{T_2}{T_1} \le \left(\frac{1 + \mu \tan\frac{\delta}{2}}{1 - \mu \tan\frac{\delta}{2}}\right)^{n} "
    r"\approx e^{\mu\pi}",
    allowed=r"the formula holds for a thin chain without weight; with $n$ = 12, $\delta$ = 15° and $\mu$ = 0.3 it "
    "gives 2.58. Links of 10 g that touch the post 10 mm below their hinges change the ratio: the balances of force "
    "and moment of all links give 2.53. So 1 kg must hold 2.3 kg: to 1 % of the post's radius, 1 mm. And 3 kg must "
    "move down by $a t^2/2$. Allowed are 1 % of that distance, $a t h/2$ for the step, and, because moved links lie "
    r"differently on the post, the distance that corresponds to the difference between the formula and $e^{\mu\pi}$, "
    "0.6 %.",
    duration=0.4,
    x=("time", "s"),
    y=("descent of 2.3 kg", "mm"),
    measure=_capstan,
    plot=over_time(lambda run: 1e3 * _lowered(run)),
    exact=lambda curve, run: np.zeros_like(curve.x),
    variants=({"bodies.heavy.mass": HELD}, {"bodies.heavy.mass": SLIDES}),
    reported="DART applies the same friction of 1.2 N at each link, so the forces add up: its version of Dantzig's "
    "method, from ODE, bounds friction by the normal forces of the problem without friction. Rapier keeps the "
    "normal of a contact while a ball moves over a round body by some degrees (without friction a ball moves "
    "straight on, 11 mm off the surface that it should follow), and links that have moved jam: 3 kg come to rest; "
    "as installed its contacts are so soft for links of 10 g that the chain passes through the post. MuJoCo's "
    "accurate settings let 3 kg move down by 78 mm, and with one sixteenth of their step, which makes contacts "
    "stiffer, by 69 mm. Drake's chain as installed follows the law until the next link arrives, after 0.19 s; then "
    "1 ms is too long for links of 10 g at 1e6 N/m, and with 0.5 ms 3 kg move down by 67 mm. With its accurate "
    "settings, 1e7 Pa, links penetrate the post by 1.4 to 2 mm, so that the chain lies closer and is 5 mm too long, "
    "and 2.3 kg move down by 3.8 mm of that. A damping of 50 s/m, Drake's default, presses more in front of a "
    "sliding ball than behind it; with this drag 3 kg move down by only 13 mm, without damping by 85 mm. With 1e9 "
    "Pa, meshes two to four times as fine and 10 s/m both loads obey the law: 0.74 mm and 64.4 mm. PyBullet as "
    "installed starts the contacts of links from zero in every step, and 50 sweeps do not converge: 2.3 kg move "
    "down by 1.54 mm. With 100 sweeps they move down by 0.42 mm, and 3 kg by 68.0 mm, which obeys the law. Errors "
    "in the friction are amplified five times: of the 3 kg, friction leaves 0.47 kg to pull, and friction that is 2 "
    "% too small leaves 0.05 kg more, which adds a tenth to the distance.",
)
