"""Limits, friction losses and coefficients of friction of MuJoCo's steps are compared with the model.

The engine steps a model with another parameter than the one that the receipt is given: what a defect of the engine would do.
"""

import copy

import numpy as np
import pytest

import lcplab

mujoco = pytest.importorskip("mujoco")

#: A shoulder with a cone as its limit, an elbow, a lift, and balls with their own rules of friction.
XML = """
<mujoco><compiler autolimits="true"/><option cone="{}"/><worldbody>
<geom name="floor" type="plane" size="5 5 .1" friction=".7 .01 .001"/>
<body name="upper" pos="0 0 1"><joint name="shoulder" type="ball" range="0 20" margin=".02"/>
 <geom name="upper" size=".05" pos=".2 0 0"/>
 <body name="lower" pos=".4 0 0"><joint name="elbow" axis="0 1 0" range="-10 10" frictionloss=".01"/>
  <geom name="lower" size=".05" pos=".2 0 0"/></body></body>
<body name="lift" pos="2 0 .3"><joint name="lift" type="slide" axis="0 0 1" range="-.1 .2" margin=".01"/>
 <geom name="lift" type="box" size=".05 .05 .05"/></body>
<body name="plain" pos="1 0 .05"><freejoint/><geom name="plain" size=".05" condim="4"/></body>
<body name="first" pos="1.5 0 .05"><freejoint/><geom name="first" size=".05" priority="1" friction=".2 .1 .1" condim="6"/></body>
<body name="paired" pos="2.5 0 .05"><freejoint/><geom name="paired" size=".05"/></body></worldbody>
<contact><pair geom1="floor" geom2="paired" friction=".9 .8 .7 .6 .5" condim="6"/></contact></mujoco>
"""


def model_of(cone, **changes):
    model = mujoco.MjModel.from_xml_string(XML.format(cone))
    for name, (place, value) in changes.items():
        getattr(model, name)[place] = value
    return model


def frames(engine):
    """Steps that this model takes, each with the state before it."""
    data = mujoco.MjData(engine)
    data.qvel[:3] = (2, -3, 1)
    data.qvel[3] = 3
    for number in range(300):
        before = data.qpos.copy(), data.qvel.copy()
        mujoco.mj_step(engine, data)
        if number % 5 == 0:
            yield copy.copy(data), before


SHOULDER, ELBOW, LIFT = range(3)
FLOOR, UPPER, LOWER, BOX, PLAIN, FIRST, PAIRED = range(7)
ELBOW_DOF = 3
CHANGES = {
    "other range of a ball joint": ({"jnt_range": ((SHOULDER, 1), 0.5)}, "limit of shoulder", "upper"),
    "other range of a hinge": ({"jnt_range": ((ELBOW, 1), 0.25)}, "limit of elbow", "lower"),
    "other margin": ({"jnt_margin": (LIFT, 0.05)}, "the limit of lift has 1 constraint rows instead of 0", "lift"),
    "a limit without rows": ({"jnt_limited": (ELBOW, 0)}, "the limit of elbow has 0 constraint rows instead of 1", "lower"),
    "other friction loss": ({"dof_frictionloss": (ELBOW_DOF, 0.02)}, "friction loss", "lower"),
    "a friction loss without rows": ({"dof_frictionloss": (ELBOW_DOF, 0)}, "friction loss", "lower"),
    "other coefficient": ({"geom_friction": ((PLAIN, 0), 1.2)}, "coefficients of friction", "plain"),
    "other priority": ({"geom_priority": (FIRST, 0)}, "coefficients of friction", "first"),
    "other condim": ({"geom_condim": (PLAIN, 3)}, "coefficients of friction", "plain"),
    "other pair": ({"pair_friction": ((0, 3), 0.1)}, "coefficients of friction", "paired"),
}


@pytest.mark.parametrize("cone", ["pyramidal", "elliptic"])
@pytest.mark.parametrize("change", CHANGES)
def test_a_row_that_is_not_that_of_the_model_is_an_error_of_assembly(change, cone):
    changes, words, body = CHANGES[change]
    stated, rejected = model_of(cone), 0
    for data, before in frames(model_of(cone, **changes)):
        receipt = lcplab.receipt(stated, data, before=before)
        if receipt.is_rejected:
            rejected += 1
            assert receipt.stage == "assembly" and words in str(receipt) and body in receipt.bodies, str(receipt)
    assert rejected >= 5


@pytest.mark.parametrize("cone", ["pyramidal", "elliptic"])
def test_rows_of_limits_and_friction_are_accepted_wherever_their_joints_are(cone):
    model, kinds = model_of(cone), set()
    for data, before in frames(model):
        receipt = lcplab.receipt(model, data, before=before)
        assert receipt.ok, str(receipt)
        kinds |= {row.label for row in receipt.step.rows if row.kind == "limit joint"}
    assert {"limit joint shoulder", "limit joint elbow", "limit joint lift"} <= kinds


@pytest.mark.parametrize("turns", [0, 1])
def test_the_limit_of_a_ball_joint_does_not_depend_on_the_sign_of_its_quaternion(turns):
    model = model_of("pyramidal")
    data = mujoco.MjData(model)
    angle = 0.5
    data.qpos[:4] = (-1) ** turns * np.array([np.cos(angle / 2), 0.6 * np.sin(angle / 2), 0, 0.8 * np.sin(angle / 2)])
    mujoco.mj_forward(model, data)
    receipt = lcplab.receipt(model, data)
    assert receipt.ok and "limit joint shoulder" in [row.label for row in receipt.step.rows], str(receipt)


def test_a_model_that_changes_between_steps_is_read_again():
    model = model_of("pyramidal")
    data = mujoco.MjData(model)
    data.qvel[:] = 0.1
    mujoco.mj_forward(model, data)
    assert lcplab.receipt(model, data).ok
    model.dof_damping[:4] = 1.0
    receipt = lcplab.receipt(model, data)
    assert receipt.stage == "assembly" and "passive forces" in str(receipt), str(receipt)
    mujoco.mj_forward(model, data)
    assert lcplab.receipt(model, data).ok


def test_a_reference_acceleration_that_is_off_by_one_percent_is_an_error_of_assembly():
    model = model_of("elliptic")
    for data, before in frames(model):
        data.efc_aref[: data.nefc] *= 1.01
        receipt = lcplab.receipt(model, data, before=before)
        assert receipt.stage == "assembly" and "reference acceleration" in str(receipt), str(receipt)


def solved_with(change, model, data):
    """The step of an engine whose contacts this changes before their rows are made."""
    mujoco.mj_fwdPosition(model, data)
    change(data)
    mujoco.mj_makeConstraint(model, data)
    mujoco.mj_projectConstraint(model, data)
    mujoco.mj_fwdVelocity(model, data)
    mujoco.mj_fwdActuation(model, data)
    mujoco.mj_fwdAcceleration(model, data)
    mujoco.mj_fwdConstraint(model, data)
    return lcplab.receipt(model, data)


SHAPES = {
    "a plane and a sphere": ('type="plane" size="5 5 .1"', 'size=".05"', 0.05),
    "a plane and a box": ('type="plane" size="5 5 .1"', 'type="box" size=".05 .05 .05"', 0.05),
    "a plane and a capsule": ('type="plane" size="5 5 .1"', 'type="capsule" size=".05 .1"', 0.15),
    "two spheres": ('size=".5" pos="0 0 -.5"', 'size=".05"', 0.05),
    "a box and a sphere": ('type="box" size=".5 .5 .5" pos="0 0 -.5"', 'size=".05"', 0.05),
    "a capsule and a sphere": ('type="capsule" size=".1 .3" pos="0 0 -.1" euler="0 90 0"', 'size=".05"', 0.05),
    "two capsules": ('type="capsule" size=".1 .3" pos="0 0 -.1" euler="0 90 0"', 'type="capsule" size=".05 .1" euler="90 0 0"', 0.05),
}


@pytest.mark.parametrize("shapes", SHAPES)
def test_a_contact_normal_that_is_turned_by_two_degrees_is_an_error_of_collision_however_small_the_overlap(shapes):
    fixed, moving, height = SHAPES[shapes]
    xml = (f'<mujoco><worldbody><geom {fixed}/><body name="moving" pos="0 0 {height - 1e-7}"><freejoint/><geom {moving}/>'
           "</body></worldbody></mujoco>")
    model = mujoco.MjModel.from_xml_string(xml)

    def turn(data):
        cosine, sine = np.cos(np.radians(2)), np.sin(np.radians(2))
        axes = data.contact[0].frame.reshape(3, 3)
        data.contact[0].frame[:] = np.ravel([cosine * axes[0] + sine * axes[1], cosine * axes[1] - sine * axes[0], axes[2]])

    assert solved_with(lambda data: None, model, mujoco.MjData(model)).ok
    receipt = solved_with(turn, model, mujoco.MjData(model))
    assert receipt.stage == "collision" and "normal" in str(receipt) and "moving" in receipt.bodies, str(receipt)


@pytest.mark.parametrize("shape", ['type="box" size=".1 .08 .06"', 'type="capsule" size=".06 .1" euler="0 90 0"'])
def test_a_corner_or_an_end_that_lost_its_contact_is_an_error_of_collision(shape):
    xml = (f'<mujoco><worldbody><geom type="plane" size="5 5 .1"/><body name="moving" pos="0 0 .0599"><freejoint/><geom {shape}/>'
           "</body></worldbody></mujoco>")
    model = mujoco.MjModel.from_xml_string(xml)

    def lose(data):
        """The last contact is where the first one is."""
        first, last = data.contact[0], data.contact[data.ncon - 1]
        last.pos[:], last.dist = first.pos, first.dist

    assert solved_with(lambda data: None, model, mujoco.MjData(model)).ok
    receipt = solved_with(lose, model, mujoco.MjData(model))
    assert receipt.stage == "collision" and "without a contact of its own" in str(receipt) and "moving" in receipt.bodies, str(receipt)


@pytest.mark.parametrize("shapes", ["a plane and a box", "a plane and a capsule lying"])
def test_a_contact_that_is_there_twice_is_an_error_of_collision(shapes):
    """The engine's second contact is a copy of the first; the shape has others, so that no corner or end lacks one."""
    shape = {"a plane and a box": 'type="box" size=".1 .08 .06" euler="0 1 0"',
             "a plane and a capsule lying": 'type="capsule" size=".06 .1" euler="0 88 0"'}[shapes]
    xml = (f'<mujoco><worldbody><geom type="plane" size="5 5 .1"/><body name="moving" pos="0 0 .06"><freejoint/>'
           f'<geom {shape} margin=".02"/></body></worldbody></mujoco>')
    model = mujoco.MjModel.from_xml_string(xml)

    def copy_first(data):
        deepest = int(np.argmin(data.contact.dist))
        highest = int(np.argmax(data.contact.dist))
        assert data.contact.dist[highest] > 0  # it is above the plane, within the margin
        for name in ("pos", "frame"):
            getattr(data.contact[highest], name)[:] = getattr(data.contact[deepest], name)
        data.contact[highest].dist = data.contact[deepest].dist

    assert solved_with(lambda data: None, model, mujoco.MjData(model)).ok
    receipt = solved_with(copy_first, model, mujoco.MjData(model))
    assert receipt.stage == "collision" and "twice" in str(receipt) and "moving" in receipt.bodies, str(receipt)


def test_the_violation_of_an_equality_with_another_constant_is_an_error_of_assembly():
    xml = """<mujoco><worldbody><body><joint name="a"/><geom size=".1"/></body><body pos="1 0 0"><joint name="b"/><geom size=".1"/>
    </body></worldbody><equality><joint joint1="a" joint2="b" polycoef="{} 1 0 0 0"/></equality></mujoco>"""
    stated, engine = (mujoco.MjModel.from_xml_string(xml.format(value)) for value in (0.0, 0.01))
    data = mujoco.MjData(engine)
    data.qpos[:] = 0.1, 0.2
    mujoco.mj_forward(engine, data)
    assert lcplab.receipt(engine, data).ok
    receipt = lcplab.receipt(stated, data)
    assert receipt.stage == "assembly" and "violation of an equality" in str(receipt), str(receipt)
