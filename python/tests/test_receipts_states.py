"""Receipts of MuJoCo's steps whose poses, equalities or tolerances are not what they should be, and runs that check less."""

from dataclasses import replace

import numpy as np
import pytest

import lcplab

mujoco = pytest.importorskip("mujoco")

#: Two boxes held together, and an arm with damping.
XML = """<mujoco><option solver="{solver}" cone="{cone}" tolerance="{tolerance}"/><worldbody>
<geom type="plane" size="5 5 .1"/>
<body name="low" pos="0 0 .1"><freejoint/><geom type="box" size=".1 .1 .1"/></body>
<body name="high" pos=".02 0 .3"><freejoint/><geom type="box" size=".1 .1 .1"/></body>
<body name="left" pos="0 2 .1"><freejoint/><geom type="box" size=".1 .1 .1"/></body>
<body name="right" pos="0 2.3 .1"><freejoint/><geom type="box" size=".1 .1 .1"/></body>
<body name="arm" pos="-1 0 1"><joint name="arm" axis="0 1 0" damping=".1"/><geom type="capsule" fromto="0 0 0 .4 0 0" size=".03"/></body>
</worldbody><equality><weld name="glue" body1="left" body2="right"/></equality></mujoco>"""
STEPS = 30


def start(solver="Newton", cone="pyramidal", tolerance=1e-8):
    model = mujoco.MjModel.from_xml_string(XML.format(solver=solver, cone=cone, tolerance=tolerance))
    data = mujoco.MjData(model)
    data.qvel[0] = 1.0
    return model, data


def state(data):
    return data.qpos.copy(), data.qvel.copy()


def good(has_before=True, steps=STEPS):
    model, data = start()
    for _ in range(steps):
        before = state(data)
        mujoco.mj_step(model, data)
        yield (model, data, before) if has_before else (model, data)


def stale(is_twice=False):
    """The position stage of each step runs at the state of the step before: M and J are stale."""
    model, data = start()
    old = data.qpos.copy()
    for _ in range(STEPS):
        before = state(data)
        data.qpos[:], old = old, before[0]
        mujoco.mj_fwdPosition(model, data)
        data.qpos[:] = before[0]
        for stage in ("Velocity", "Actuation", "Acceleration", "Constraint"):
            getattr(mujoco, f"mj_fwd{stage}")(model, data)
        mujoco.mj_Euler(model, data)
        if is_twice:
            data.qvel[:] += (data.qacc - data.qacc_smooth) * model.opt.timestep
        yield model, data, before


def test_stale_kinematics_are_an_error_of_assembly():
    assert lcplab.receipts(good()).ok
    run = lcplab.receipts(stale())
    # The first step has the poses of its own state.
    assert run.stages == {"assembly": STEPS - 1}, str(run)
    last = str(list(run.receipts.values())[-1])
    assert "the poses in the data are not those of before: they differ by" in last
    assert "so that the engine used the poses of another step" in last


def test_stale_kinematics_hide_no_wrong_velocity():
    run = lcplab.receipts(stale(is_twice=True))
    last = list(run.receipts.values())[-1]
    assert [finding.stage for finding in last.findings if finding.is_rejected] == ["assembly", "write-back"]


def test_a_state_that_is_not_that_before_the_step_is_named():
    model, data = start()
    mujoco.mj_step(model, data)
    older = state(data)
    mujoco.mj_step(model, data)
    before = state(data)
    mujoco.mj_step(model, data)
    for wrong, cause in (
        (older, "or before is the state of another step"),
        (state(data), "before is the state after the step"),
    ):
        receipt = lcplab.receipt(model, data, before=wrong)
        assert receipt.stage == "assembly" and cause in str(receipt), str(receipt)
    mujoco.mj_forward(model, data)
    receipt = lcplab.receipt(model, data, before=before)
    assert receipt.stage == "assembly" and "as after mj_forward: leave before out" in str(receipt)


def test_a_run_without_the_states_that_its_baseline_had_is_not_ok(tmp_path):
    lcplab.receipts(good()).save(tmp_path / "known.json")
    assert lcplab.receipts(good(), baseline=tmp_path / "known.json").ok
    run = lcplab.receipts(good(has_before=False), baseline=tmp_path / "known.json")
    assert not run.ok and not run.missing
    assert any("assembly: the state is that after the step; pass before" in lost for lost in run.lost), run.lost


def test_a_shorter_run_than_its_baseline_names_the_missing_frames():
    baseline = lcplab.receipts(good()).to_json()
    run = lcplab.receipts(good(steps=STEPS - 2), baseline=baseline)
    assert not run.ok and len(run.missing) == 2 and "2 frames of the baseline are missing" in str(run)


@pytest.mark.parametrize("is_in_contact", [True, False])
def test_an_equality_whose_rows_are_dropped_is_an_error_of_assembly(is_in_contact):
    model, data = start()
    if not is_in_contact:
        data.qpos[2::7][:4] += 1.0
        mujoco.mj_step(model, data)
    before = state(data)
    data.eq_active[0] = 0
    mujoco.mj_step(model, data)
    assert not lcplab.receipt(model, data, before=before).is_rejected
    data.eq_active[0] = 1
    receipt = lcplab.receipt(model, data, before=before)
    assert receipt.stage == "assembly" and set(receipt.bodies) == {"left", "right"}, str(receipt)
    assert "the active equality glue has 0 constraint rows instead of 6" in str(receipt)


@pytest.mark.parametrize(
    "equality",
    [
        '<connect body1="a" body2="b" anchor=".1 0 0"/>', '<connect body1="a" anchor=".1 0 0"/>', '<weld body1="a" body2="b"/>',
        '<weld body1="a"/>', '<connect site1="p" site2="q"/>', '<weld site1="p" site2="q"/>', '<joint joint1="h"/>',
        '<joint joint1="h" joint2="i"/>', '<weld body1="fixed" body2="wall"/>', '<connect body1="c" body2="arm" anchor="0 0 0"/>',
        '<weld body1="a" body2="wall"/>', '<weld body1="a" body2="b" active="false"/>',
    ],
)
@pytest.mark.parametrize("jacobian", ["dense", "sparse"])
def test_equalities_of_good_steps_are_accepted(equality, jacobian):
    model = mujoco.MjModel.from_xml_string(f"""<mujoco><option gravity="0 0 -1" jacobian="{jacobian}"/><worldbody>
        <body name="wall" pos="5 0 0"><geom size=".1"/></body><body name="fixed" pos="6 0 0"><geom size=".1"/></body>
        <body name="a"><freejoint/><geom size=".1"/><site name="p"/></body>
        <body name="b" pos="0 1 0"><freejoint/><geom size=".1"/><site name="q" pos="0 0 .1"/></body>
        <body name="arm" pos="3 0 0"><joint name="h" axis="0 1 0"/><geom size=".1" pos=".3 0 0"/>
        <body name="c"><joint name="i" axis="0 1 0"/><geom size=".1" pos=".3 0 .3"/></body></body></worldbody>
        <equality>{equality}</equality></mujoco>""")
    data = mujoco.MjData(model)
    for _ in range(10):
        before = state(data)
        mujoco.mj_step(model, data)
        assert not lcplab.receipt(model, data, before=before).is_rejected, str(lcplab.receipt(model, data, before=before))


def test_a_tolerance_that_the_user_loosened_does_not_make_the_solver_wrong():
    model, data = start("CG", "elliptic", 10.0)
    receipts = []
    for _ in range(60):
        before = state(data)
        mujoco.mj_step(model, data)
        receipts.append(lcplab.receipt(model, data, before=before))
    assert not any(receipt.is_rejected for receipt in receipts)
    stopped = [receipt for receipt in receipts if receipt.verdict == "unconverged"]
    assert len(stopped) > 10 and all(receipt.stopped_by == "tolerance" for receipt in stopped)
    assert all(receipt.motion_error <= 1e-2 for receipt in receipts if receipt.ok)


def test_a_mass_matrix_that_is_not_positive_definite_is_an_error_of_assembly():
    model, data = start()
    mujoco.mj_forward(model, data)
    step = lcplab.receipt(model, data).step
    mass = (step.mass[0], step.mass[1], np.where(step.mass[0] == 3, 0.0, step.mass[2]))
    receipt = lcplab.receipt(replace(step, mass=mass))
    assert receipt.stage == "assembly" and receipt.bodies == ("low",) and "mass[3, 3] is 0" in str(receipt)
