"""The scene of each defect: frames for :func:`lcplab.receipts`."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from lcplab.defects.dart import welded_chain
from lcplab.defects.drake import driven_slider, floating_gripper
from lcplab.defects.newton import sliding_block
from lcplab.defects.rapier import bouncing_ball, resting_cube

Frames = Iterator[Any]
#: Trees of hinged spheres in a walled box, and the steps of each.
SEEDS, STEPS = range(6), 300
FLOOR = '<geom type="plane" size="5 5 .1"/>'


def sparse_factor() -> Frames:
    """Free bodies with random branching trees fall into a walled box."""
    import mujoco

    for seed in SEEDS:
        model = mujoco.MjModel.from_xml_string(_trees(np.random.default_rng(seed)))
        data = mujoco.MjData(model)
        for _ in range(STEPS):
            mujoco.mj_step(model, data)
            yield model, data


def _trees(random: np.random.Generator) -> str:
    walls = "".join(
        f'<geom type="box" size="{size}" pos="{place} 1"/>'
        for size, place in ((".05 .8 1", ".8 0"), (".05 .8 1", "-.8 0"), (".8 .05 1", "0 .8"), (".8 .05 1", "0 -.8"))
    )
    count = int(random.integers(4, 7))
    trees = "".join(_tree(random, 2, f"{.2 * (number % 3 - 1)} 0 {.5 + .6 * number}", "<freejoint/>")
                    for number in range(count))
    option = '<option timestep="0.004"/><default><geom friction=".5" density="800"/></default>'
    return f'<mujoco model="trees">{option}<worldbody>{FLOOR}{walls}{trees}</worldbody></mujoco>'


def _tree(random: np.random.Generator, depth: int, place: str, joint: str) -> str:
    branches = ""
    for _ in range(int(random.integers(1, 4)) if depth else 0):
        x, y, z = random.normal(size=3) * 0.15
        axis = " ".join(f"{value:.3f}" for value in random.normal(size=3))
        hinge = f'<joint type="hinge" axis="{axis}" damping=".05"/>'
        branches += _tree(random, depth - 1, f"{x:.3f} {y:.3f} {z:.3f}", hinge)
    return f'<body pos="{place}">{joint}<geom type="sphere" size=".08"/>{branches}</body>'


def uncoupled_hessian() -> Frames:
    """Boxes of different masses fall on each other; MJX solves states of MuJoCo in at most ten iterations."""
    import jax
    import mujoco
    from mujoco import mjx

    jax.config.update("jax_enable_x64", True)
    masses = (1, 5, 1, 8)
    boxes = "".join(
        f'<body pos="{.05 * (k % 2)} {.03 * (k % 3)} {.1 + .21 * k:.2f}"><freejoint/>'
        f'<geom type="box" size=".1 .1 .1" mass="{mass}"/></body>'
        for k, mass in enumerate(masses)
    )
    option = '<option timestep="0.004" iterations="10"/>'
    model = mujoco.MjModel.from_xml_string(f"<mujoco>{option}<worldbody>{FLOOR}{boxes}</worldbody></mujoco>")
    data = mujoco.MjData(model)
    forward, on_device = jax.jit(mjx.forward), mjx.put_model(model)
    for step in range(100):
        mujoco.mj_step(model, data)
        if step % 5 == 4:
            cold = mujoco.MjData(model)
            cold.qpos[:], cold.qvel[:] = data.qpos, data.qvel
            mujoco.mj_forward(model, cold)
            cold.qacc_warmstart[:] = 0.0
            yield model, forward(on_device, mjx.put_data(model, cold))


def implicit_damping() -> Frames:
    """An arm of four damped hinges, without contacts."""
    import jax
    import mujoco
    from mujoco import mjx

    jax.config.update("jax_enable_x64", True)
    links = ""
    for k, (damping, mass) in enumerate(((1.5, 2), (0.5, 1), (0.2, 0.5), (0.1, 0.5))):
        links += (
            f'<body pos="{.25 if k else 0} 0 0"><joint type="hinge" axis="0 1 {.4 * (k % 2)}" damping="{damping}"/>'
            f'<geom type="capsule" fromto="0 0 0 .25 0 0" size=".03" mass="{mass}"/>'
        )
    option = '<option timestep="0.005"/>'
    arm = f"<mujoco>{option}<worldbody>{links}{'</body>' * 4}</worldbody></mujoco>"
    model = mujoco.MjModel.from_xml_string(arm)
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = (0.3, -0.4, 0.5, 0.2), (1, -2, 3, -1)
    step, on_device, now = jax.jit(mjx.step), mjx.put_model(model), mjx.put_data(model, data)
    for _ in range(10):
        before = np.array(now.qpos), np.array(now.qvel)
        now = step(on_device, now)
        yield model, now, before


def connect_bias() -> Frames:
    """A bar turns at 10 rad/s about its held end, without gravity: J̇v = ω² l."""
    import mujoco

    model = mujoco.MjModel.from_xml_string(
        '<mujoco><option timestep="0.001" gravity="0 0 0"/><worldbody><body name="bar" pos=".3 0 0"><freejoint/>'
        '<geom type="box" size=".3 .05 .05" mass="1"/></body></worldbody>'
        '<equality><connect body1="bar" anchor="-.3 0 0"/></equality></mujoco>'
    )
    data = mujoco.MjData(model)
    data.qvel[:] = (0, 3, 0, 0, 0, 10)
    for _ in range(20):
        mujoco.mj_forward(model, data)
        yield model, data
        mujoco.mj_step(model, data)


def sphere_in_box() -> Frames:
    """A sphere near and in a box; a distance of the surfaces from -0.25 m to -0.08 m."""
    yield from _placed(
        '<geom type="box" size=".3 .2 .25"/>', '<geom type="sphere" size=".1"/>',
        [(0.28, 0.01, 0.02), (0.25, 0, 0), (0.05, 0.15, 0.03), (0.1, 0.05, 0.02), (0.32, 0.02, 0.01)],
    )


def box_in_plate() -> Frames:
    """A box of 0.2 m at depths of 0.5 to 11 cm in a plate of 2 cm."""
    depths = (0.005, 0.012, 0.022, 0.035, 0.06, 0.11)
    yield from _placed(
        '<geom type="box" size=".5 .5 .01"/>', '<geom type="box" size=".1 .1 .1"/>',
        [(0, 0, 0.11 - depth) for depth in depths],
    )


def world_of_zeros() -> Frames:
    """Five boxes in two worlds: in one they rest, in the other they were kicked."""
    import mujoco
    import mujoco_warp
    import warp

    warp.set_device("cpu")
    boxes = "".join(
        f'<body pos="{.3 * k} 0 .06"><freejoint/><geom type="box" size=".08 .07 .06" mass="{1 + k}"/></body>'
        for k in range(5)
    )
    option = '<option jacobian="sparse" solver="CG"/>'
    model = mujoco.MjModel.from_xml_string(f"<mujoco>{option}<worldbody>{FLOOR}{boxes}</worldbody></mujoco>")
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 300)
    mujoco.mj_forward(model, data)
    data.qacc_warmstart[:] = data.qacc
    both = mujoco_warp.put_data(model, data, nworld=2)
    speeds = both.qvel.numpy()
    speeds[1, ::6] += 2.0
    both.qvel = warp.array(speeds, dtype=float)
    mujoco_warp.forward(mujoco_warp.put_model(model), both)
    yield model, both


def lost_improvements() -> Frames:
    """Boxes of 1 kg to 1 t slide down a ramp with a friction of 0.5; MuJoCo Warp solves states of MuJoCo from a cold start."""
    import mujoco
    import mujoco_warp
    import warp

    warp.set_device("cpu")
    boxes = "".join(
        f'<body pos="{.3 * k} 0 .0995"><freejoint/><geom type="box" size=".1 .1 .1" mass="{10**k}" friction=".5"/></body>'
        for k in range(4)
    )
    gravity = f"{9.81 * np.sin(0.35)} 0 {-9.81 * np.cos(0.35)}"
    option = f'<option timestep="0.004" cone="elliptic" impratio="100" gravity="{gravity}"/>'
    floor = '<geom type="plane" size="50 50 .1"/>'
    model = mujoco.MjModel.from_xml_string(f"<mujoco>{option}<worldbody>{floor}{boxes}</worldbody></mujoco>")
    data, on_device = mujoco.MjData(model), mujoco_warp.put_model(model)
    for _ in range(150):
        mujoco.mj_step(model, data, 2)
        cold = mujoco.MjData(model)
        cold.qpos[:], cold.qvel[:] = data.qpos, data.qvel
        mujoco.mj_forward(model, cold)
        own = mujoco_warp.put_data(model, cold, nconmax=64, njmax=max(64, 2 * cold.nefc))
        own.qacc_warmstart.zero_()
        mujoco_warp.forward(on_device, own)
        yield model, own


def _placed(fixed: str, free: str, places: list[tuple[float, float, float]]) -> Frames:
    """A free body at rest at each place."""
    import mujoco

    body = f"<body><freejoint/>{free}</body>"
    model = mujoco.MjModel.from_xml_string(f"<mujoco><worldbody>{fixed}{body}</worldbody></mujoco>")
    data = mujoco.MjData(model)
    for place in places:
        data.qpos[:3] = place
        mujoco.mj_forward(model, data)
        yield model, data


SCENES: dict[str, Callable[[], Frames]] = {
    scene.__name__: scene
    for scene in (
        sparse_factor, uncoupled_hessian, implicit_damping, connect_bias, sphere_in_box, box_in_plate, world_of_zeros,
        lost_improvements, welded_chain, resting_cube, floating_gripper, driven_slider, sliding_block, bouncing_ball,
    )
}
