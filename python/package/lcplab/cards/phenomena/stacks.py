"""What stands on each other, or hangs on each other's friction: forces, mass ratios, towers, a row at a wall."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lcplab.cards._phenomenon import PART, Curve, Measurement, Phenomenon, Run, over_time
from lcplab.engines import Array

#: For how long forces are averaged (s), at the end of the run.
WATCHED = 0.5


def _moving(run: Run) -> list[int]:
    return [k for k, body in enumerate(run.scene["bodies"]) if not body["fixed"]]


def _carried(run: Run) -> Array:
    """The part of its weight that contacts put on each body, (steps + 1, bodies)."""
    assert run.forces is not None
    moving = _moving(run)
    masses = np.array([run.scene["bodies"][k]["mass"] for k in moving])
    return np.asarray(run.forces[:, moving, 2] / (masses * run.gravity))


def _weight(runs: Sequence[Run]) -> list[Measurement]:
    carried = _carried(runs[0])[runs[0].after(runs[0].t[-1] - WATCHED) :].mean(axis=0)
    worst = float(carried[np.argmax(np.abs(carried - 1))])
    return [Measurement("reports", 100 * worst, 100.0, 100 * PART, "% of a body's weight")]


WEIGHT = Phenomenon(
    name="weight",
    question="Do the reported contact forces on each body add up to its weight?",
    matters="Tactile sensors, grasp planners and structural analysis use these forces. For a body at rest Newton's "
    "second law suffices: the forces from its neighbors add up to its weight.",
    law=r"\textstyle\sum_c f_c = -m\,\mathbf{g} \quad\text{for each body}",
    allowed="1 % of the body's weight, averaged over the last half second.",
    duration=2.0,
    x=("time", "s"),
    y=("reported part of the weight", "%"),
    measure=_weight,
    plot=over_time(
        lambda run: 100 * np.take_along_axis(
            _carried(run), np.abs(_carried(run) - 1).argmax(axis=1)[:, None], axis=1
        )[:, 0]
    ),
    exact=lambda curve, run: np.full_like(curve.x, 100.0),
    needs_forces=True,
    reported="An engine that puts bodies to sleep may report no force from then on: 0 % means that the body sleeps, "
    "not that it falls.",
)

RATIOS = (1, 10, 100, 1000)


def _sunk(run: Run) -> float:
    height = run.place("heavy")[:, 2]
    return float(height[0] - height[-1])


def _mass_ratio(runs: Sequence[Run]) -> list[Measurement]:
    edge = float(runs[0].body("heavy")["shape"]["box"][2])
    return [
        Measurement(f"sinks under {ratio} times its mass by", 1e3 * _sunk(run), 0.0, 1e3 * 2 * PART * edge, "mm")
        for ratio, run in zip(RATIOS, runs, strict=True)
    ]


MASS_RATIO = Phenomenon(
    name="mass_ratio",
    question="How heavy can a cube be that rests on a light one?",
    matters="Sweeps over the contacts pass a heavy load on slowly, and soft contacts are compressed by it: the "
    "upper cube sinks into the light one. Robots that lift loads and vehicles on wheels are such stacks.",
    law=r"z_\text{heavy}(t) = z_\text{heavy}(0), \quad\text{whatever the masses}",
    allowed="1 % of an edge for each of the two contacts: 2 mm after three seconds.",
    duration=3.0,
    x=("upper mass / lower mass", ""),
    y=("penetration", "mm"),
    measure=_mass_ratio,
    plot=lambda runs: Curve(np.array(RATIOS, dtype=float), np.array([1e3 * _sunk(run) for run in runs])),
    exact=lambda curve, run: np.zeros_like(curve.x),
    variants=[{"bodies.heavy.mass": ratio} for ratio in RATIOS],
    log=True,
)


def _aside(run: Run) -> Array:
    """How far the body that moved most sideways has gone (m), (steps + 1,)."""
    place = run.poses[:, _moving(run), :2]
    return np.asarray(np.linalg.norm(place - place[0], axis=2).max(axis=1))


def _tower(runs: Sequence[Run]) -> list[Measurement]:
    run = runs[0]
    edge = float(run.scene["bodies"][_moving(run)[0]]["shape"]["box"][2])
    top = run.poses[:, _moving(run)[-1], 2]
    layers = len(_moving(run))
    return [
        Measurement("moves sideways by", 1e3 * float(_aside(run).max()), 0.0, 1e3 * PART * edge, "mm"),
        Measurement("sinks by", 1e3 * float(top[0] - top[-1]), 0.0, 1e3 * PART * edge * layers, "mm"),
    ]


TOWER = Phenomenon(
    name="tower",
    question="Does a tower of ten cubes stand still for twenty seconds?",
    matters="Ten redundant contacts on top of each other: the impulse error of one step pushes the cubes in the "
    "next step. Sideways drift shows this error long before the tower falls.",
    law=r"\mathbf{x}(t) = \mathbf{x}(0)",
    allowed="sideways 1 % of an edge, 1 mm; down 1 % of an edge for each contact below, 10 mm.",
    duration=20.0,
    x=("time", "s"),
    y=("sideways displacement", "mm"),
    measure=_tower,
    plot=over_time(lambda run: 1e3 * _aside(run)),
    exact=lambda curve, run: np.zeros_like(curve.x),
)


#: From when on the row at the wall is watched (s): before, a compliant contact may settle. And the time (s) in which
#: it may creep by a hundredth of its height.
SETTLED, LONG = 1.0, 10.0


def _slipping(runs: Sequence[Run]) -> list[Measurement]:
    run = runs[0]
    moving, start = _moving(run), run.after(SETTLED)
    time = float(run.t[-1] - run.t[start])
    edge = float(run.scene["bodies"][moving[0]]["shape"]["box"][2])
    path = np.linalg.norm(run.poses[-1, moving, :3] - run.poses[start, moving, :3], axis=1)
    return [Measurement("lets the worst slab creep at", 1e6 * float(path.max()) / time, 0.0, 1e6 * PART * edge / LONG, "µm/s")]


def _down_the_wall(run: Run) -> Array:
    """How far the slab that slid most has gone (m), (steps + 1,)."""
    height = run.poses[:, _moving(run), 2]
    return np.asarray((height[0] - height).max(axis=1))


WALL = Phenomenon(
    name="wall",
    question="Does friction hold a row of slabs that is pressed against a wall?",
    matters="Books between two hands, a gripper that lifts a stack, the stones of an arch. The contact at the wall "
    "supports all slabs, and the weight of the outer slabs must pass through the inner ones within every step.",
    law=r"\mu g_x > g_z \;\Rightarrow\; \mathbf{x}(t) = \mathbf{x}(0)",
    allowed="100 µm/s, which is 1 % of a slab's height in ten seconds, measured for four seconds after the first "
    r"second. Here $\mu g_x = \tfrac32 g_z$. No slab tips: with moments about its inner face, the force on the outer "
    r"$k$ slabs of thickness $a$ acts $\tfrac{k a}{2}\,\tfrac{g_z}{g_x}$ below the center, at most 25 mm of the 50 "
    "mm to the edge.",
    duration=SETTLED + 4.0,
    x=("time", "s"),
    y=("sliding distance", "mm"),
    measure=_slipping,
    plot=over_time(lambda run: 1e3 * _down_the_wall(run)),
    exact=lambda curve, run: np.zeros_like(curve.x),
)


def _apart(runs: Sequence[Run]) -> Array:
    """How far any body is from where it was in the other run (m), (steps + 1,)."""
    one, other = runs
    return np.asarray(np.linalg.norm(one.poses[:, :, :3] - other.poses[:, :, :3], axis=2).max(axis=1))


def _repeat(runs: Sequence[Run]) -> list[Measurement]:
    differ = (runs[0].poses != runs[1].poses).any(axis=(1, 2))
    return [Measurement("differs in", float(differ.sum()), 0.0, 0.5, "steps")]


REPEAT = Phenomenon(
    name="repeat",
    question="Does the same scene give bitwise identical results twice?",
    matters="A bug that cannot be reproduced cannot be fixed, and a policy that was trained on one run is evaluated "
    "on another. Results differ if threads add in another order, or if a world inherits state from the one before.",
    law=r"\mathbf{x}_1(t) = \mathbf{x}_2(t) \quad\text{to the last bit}",
    allowed="no step may differ in any bit, in two worlds of one process, one after the other.",
    duration=2.0,
    x=("time", "s"),
    y=("distance between the two runs", "mm"),
    measure=_repeat,
    plot=lambda runs: Curve(runs[0].t, 1e3 * _apart(runs)),
    exact=lambda curve, run: np.zeros_like(curve.x),
    variants=({}, {}),
)
