"""Less information never makes a verdict better.

Steps that are rejected lose one optional input after the other: none of them may be accepted then. It stays rejected, or it
is not checked, and the receipt says so.
"""

from dataclasses import replace

import numpy as np
import pytest

import lcplab
from lcplab._receipt.receipt import receipts_of

mujoco = pytest.importorskip("mujoco")

SCENE = """
<mujoco>
  <option timestep="0.002" cone="{cone}" solver="{solver}"/>
  <worldbody>
    <geom type="plane" size="5 5 1"/>
    <body pos="0 0 0.11"><freejoint/><geom type="box" size="0.1 0.1 0.1" mass="1"/></body>
    <body pos="0.03 0 0.32" euler="0 3 0"><freejoint/><geom type="box" size="0.1 0.1 0.1" mass="5"/></body>
    <body pos="1 0 0.6">
      <joint name="arm" axis="0 1 0" range="-40 40" limited="true"/><geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03"/>
      <body pos="0.3 0 0"><joint axis="0 1 0" frictionloss="0.1"/><geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03"/>
      <body pos="0.3 0 0"><joint type="ball"/><geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.03"/></body></body>
    </body>
  </worldbody>
  <actuator><motor joint="arm" gear="2"/></actuator>
</mujoco>
"""
SETTINGS = [(cone, solver) for cone in ("pyramidal", "elliptic") for solver in ("Newton", "CG", "PGS")]


def recorded(cone, solver, count=60):
    """Steps of MuJoCo, each with the state before it."""
    model = mujoco.MjModel.from_xml_string(SCENE.format(cone=cone, solver=solver))
    data = mujoco.MjData(model)
    data.ctrl[:] = 1.5
    for number in range(6 * count):
        before = (data.qpos.copy(), data.qvel.copy())
        mujoco.mj_step(model, data)
        if number % 6 == 5:
            yield model, data, before


def wrong_motion(model, data):
    """One of the parts of MuJoCo's data that may be wrong after a step."""
    data.qacc[0] += 1.0


def lost_force(model, data):
    data.efc_force[int(np.argmax(np.abs(data.efc_force)))] = 0.0


def wrong_bias(model, data):
    data.efc_aref[0] += 5.0


def wrong_smooth(model, data):
    data.qacc_smooth[-1] += 2.0


def wrong_push(model, data):
    data.qfrc_constraint[:] = 0.0


DEFECTS = [wrong_motion, lost_force, wrong_bias, wrong_smooth, wrong_push]


@pytest.mark.parametrize("defect", DEFECTS)
@pytest.mark.parametrize(("cone", "solver"), SETTINGS)
def test_a_rejected_step_of_mujoco_is_not_accepted_without_its_state(cone, solver, defect):
    rejected = 0
    for model, data, before in recorded(cone, solver):
        defect(model, data)
        with_state = lcplab.receipt(model, data, before=before)
        without = lcplab.receipt(model, data)
        if not with_state.is_rejected:
            continue
        rejected += 1
        if without.verdict == "ok":
            # What found it is now named as not checked.
            stage = with_state.stage
            assert any(part.startswith(stage) for part in without.not_checked), (str(with_state), str(without))
            assert set(without.not_checked) - set(with_state.not_checked), str(without)
        assert set(without.not_checked) >= {part for part in with_state.not_checked if not part.startswith("assembly")}
    assert rejected >= 15


def independent_parts(step):
    """The same step, described in full by an adapter: with what model and state require."""
    return replace(
        step, expected_jacobian=step.jacobian, expected_bias=step.bias.copy(), expected_target=step.target.copy()
    )


def wrong_steps(step, random):
    """Steps of which one part is wrong, each with the part."""
    n, k = len(step), len(step.target)
    noise = random.standard_normal
    rows, columns, values = step.jacobian
    worse = values.copy()
    worse[: max(1, len(worse) // 3)] *= -1
    yield "jacobian", replace(step, jacobian=(rows, columns, worse))
    yield "bias", replace(step, bias=step.bias + 0.5 * np.abs(step.bias).max() * noise(n))
    yield "target", replace(step, target=step.target + 0.3 * np.abs(step.target).max() * noise(k))
    yield "forces", replace(step, forces=step.forces * (1 + 0.3 * noise(n)))
    yield "motion", replace(step, motion=step.motion + 0.3 * np.abs(step.motion).max() * noise(k))
    yield "push", replace(step, reported_push=step.reported_push + 0.3 * np.abs(step.reported_push).max() * noise(k))


#: How a step loses an optional part, and what the receipt must then name as not checked.
LOSSES = {
    "expected_jacobian": (lambda step: replace(step, expected_jacobian=None), "assembly"),
    "expected_bias": (lambda step: replace(step, expected_bias=None), "assembly"),
    "expected_target": (lambda step: replace(step, expected_target=None), "assembly"),
    "reported_push": (lambda step: replace(step, reported_push=None), "write-back: generalized forces"),
    "motion": (lambda step: step.with_motion_of_forces(), "write-back: the motion"),
    "model": (lambda step: replace(step, no_bound="because its law of friction is not known"), "solver"),
    "rows": (lambda step: replace(step, rows=()), None),
}


@pytest.mark.parametrize("loss", LOSSES)
@pytest.mark.parametrize(("cone", "solver"), SETTINGS)
def test_a_rejected_step_without_one_of_its_parts_is_rejected_or_not_checked_and_says_so(cone, solver, loss):
    random = np.random.default_rng(2026)
    lose, names = LOSSES[loss]
    pairs = []
    for model, data, _ in recorded(cone, solver, 20):
        full = independent_parts(lcplab.receipt(model, data).step)
        if len(full):
            pairs += [(part, wrong, lose(wrong)) for part, wrong in wrong_steps(full, random)]
    before = receipts_of([(wrong, None) for _, wrong, _ in pairs], None)
    after = receipts_of([(lost, None) for _, _, lost in pairs], None)
    rejected = 0
    for (part, *_), own, without in zip(pairs, before, after, strict=True):
        if not own.is_rejected:
            continue
        rejected += 1
        if without.ok:
            assert names is not None and any(entry.startswith(names) for entry in without.not_checked), (part, str(own), str(without))
        if loss == "model":
            assert not without.ok, (part, str(without))
    assert rejected >= 60
