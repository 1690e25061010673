"""Receipts of MuJoCo's steps: good ones are ok, and one thing that is changed afterwards is found at its stage."""

import numpy as np
import pytest

import lcplab

mujoco = pytest.importorskip("mujoco")

#: Contacts of all condims, a loop, a limit, friction losses, a spring, a tendon and an actuator.
XML = """
<mujoco model="everything"><option timestep="0.002"/><worldbody>
<geom type="plane" size="5 5 .1"/>
<body name="box" pos="0 0 .1"><freejoint/><geom type="box" size=".1 .1 .1"/></body>
<body name="ball" pos=".02 .03 .27"><freejoint/><geom type="sphere" size=".08" condim="6"/></body>
<body name="rod" pos=".6 0 .05"><freejoint/><geom type="capsule" size=".05 .1" euler="90 0 0" condim="4"/></body>
<body name="bead" pos="1 0 .05"><freejoint/><geom type="sphere" size=".05" condim="1"/></body>
<body name="arm" pos="-1 0 1"><joint name="arm" axis="0 1 0" damping=".1" frictionloss=".1" limited="true" range="-20 20"/>
 <geom type="capsule" fromto="0 0 0 .4 0 0" size=".03"/>
 <body name="hand" pos=".4 0 0"><joint name="hand" axis="0 1 0" stiffness="1" armature=".01"/>
  <geom type="capsule" fromto="0 0 0 .3 0 0" size=".02"/></body></body>
<body name="bar" pos="-2 0 1"><freejoint/><geom type="capsule" fromto="0 0 0 .3 0 0" size=".03"/></body>
</worldbody>
<equality><connect body1="bar" anchor="0 0 0"/></equality>
<tendon><fixed name="cord" limited="true" range="-1 .3" frictionloss=".05"><joint joint="arm" coef="1"/>
<joint joint="hand" coef=".5"/></fixed></tendon>
<actuator><position joint="hand" kp="2" ctrlrange="-1 1"/></actuator></mujoco>
"""


def everything(cone="pyramidal", solver="Newton", jacobian="dense", steps=120):
    model = mujoco.MjModel.from_xml_string(XML)
    model.opt.cone = getattr(mujoco.mjtCone, f"mjCONE_{cone.upper()}")
    model.opt.solver = getattr(mujoco.mjtSolver, f"mjSOL_{solver.upper()}")
    model.opt.jacobian = getattr(mujoco.mjtJacobian, f"mjJAC_{jacobian.upper()}")
    data = mujoco.MjData(model)
    data.qvel[-3:] = (1, 2, 3)  # the bar turns about its held end
    data.ctrl[0] = 0.5
    mujoco.mj_step(model, data, steps)
    mujoco.mj_forward(model, data)
    return model, data


@pytest.mark.parametrize("cone", ["pyramidal", "elliptic"])
@pytest.mark.parametrize("solver", ["Newton", "CG", "PGS"])
@pytest.mark.parametrize("jacobian", ["dense", "sparse"])
def test_a_good_step_is_ok_with_all_kinds_of_rows(cone, solver, jacobian):
    model, data = everything(cone, solver, jacobian)
    receipt = lcplab.receipt(model, data)
    assert receipt.ok, str(receipt)
    kinds = {row.kind for row in receipt.step.rows}
    assert {"equality", "friction dof", "friction tendon", "limit joint", f"contact {cone}"} <= kinds


def test_nothing_of_the_engine_is_changed():
    model, data = everything()
    names = [name for name in dir(data) if isinstance(getattr(data, name), np.ndarray)]
    before = {name: getattr(data, name).copy() for name in names}
    options = str(model.opt)
    lcplab.receipt(model, data)
    assert str(model.opt) == options
    assert all(np.array_equal(getattr(data, name), before[name], equal_nan=True) for name in names)


def other_motion(data):
    data.qacc[:] *= 1.01


def other_forces(data):
    data.efc_force[:] *= 1.01


def no_reported_forces(data):
    data.qfrc_constraint[:] = 0


def other_sign_in_a_row(data):
    row = data.contact[0].efc_address
    data.efc_J.reshape(data.nefc, -1)[row] *= -1


def no_reference_acceleration(data):
    data.efc_aref[0] = 0


def no_gravity(data):
    data.qacc_smooth[:] *= 0.5


def other_depth(data):
    data.contact[0].dist -= 0.01


def other_position(data):
    data.contact[0].pos[2] += 0.001


def other_normal(data):
    """Turned by 0.1 rad."""
    data.contact[0].frame[:3] = (np.sin(0.1), 0, np.cos(0.1))


@pytest.mark.parametrize(
    ("change", "stages"),
    [
        (other_position, {"collision"}),
        (other_normal, {"collision"}),
        (other_motion, {"write-back"}),
        (other_forces, {"write-back"}),
        (no_reported_forces, {"write-back"}),
        (other_sign_in_a_row, {"assembly"}),
        (no_reference_acceleration, {"assembly"}),
        (no_gravity, {"assembly"}),
        (other_depth, {"collision"}),
    ],
)
def test_what_is_changed_after_the_step_is_found_at_its_stage(change, stages):
    model, data = everything()
    change(data)
    receipt = lcplab.receipt(model, data)
    assert receipt.stage in stages, str(receipt)


@pytest.mark.parametrize("damping", [0.0, 0.3])
def test_after_a_whole_step_the_velocity_is_that_of_the_acceleration(damping):
    model, data = everything()
    model.dof_damping[:] = damping
    mujoco.mj_forward(model, data)
    before = data.qpos.copy(), data.qvel.copy()
    mujoco.mj_step(model, data)
    assert lcplab.receipt(model, data, before=before).ok
    alone = lcplab.receipt(model, data)
    assert alone.ok and any(part.startswith("assembly") for part in alone.not_checked)
    data.qvel[0] += 0.01
    assert lcplab.receipt(model, data, before=before).stage == "write-back"


def test_shapes_that_overlap_without_a_contact_are_found_where_there_are_no_rows():
    model = mujoco.MjModel.from_xml_string(
        '<mujoco><worldbody><geom type="plane" size="5 5 .1"/><body name="ball" pos="0 0 .05"><freejoint/>'
        '<geom type="sphere" size=".1"/></body></worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert lcplab.receipt(model, data).ok
    model.geom_margin[:] = 0
    data.ncon, data.nefc = 0, 0
    data.qacc[:] = data.qacc_smooth
    receipt = lcplab.receipt(model, data)
    assert receipt.stage == "collision" and receipt.bodies == ("world", "ball")
