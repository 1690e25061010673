"""Receipts of good steps of MuJoCo accuse no setting of the engine, and name what they do not check."""

import numpy as np
import pytest

import lcplab

mujoco = pytest.importorskip("mujoco")

#: A box and a ball on a floor, and a rod that turns about its held end; {0} to {4} are changed.
STACK = """<mujoco><option {0}><flag {1}/></option><worldbody><geom type="plane" size="5 5 .1"/>
<body name="box" pos="0 0 .1"><freejoint/><geom type="box" size=".1 .1 .1"/></body>
<body name="ball" pos=".02 .03 .27"><freejoint/><geom type="sphere" size=".08" condim="6" {2}/></body>
<body name="bar" pos="-2 0 1"><freejoint/><geom type="capsule" fromto="0 0 0 .3 0 0" size=".03"/></body>{3}</worldbody>
<equality><connect body1="bar" anchor="0 0 0"/></equality>{4}</mujoco>"""
#: Two links with a limit, friction loss, damping and a spring.
ARM = """<mujoco><compiler autolimits="true"/><option {0}><flag {1}/></option><worldbody><site name="wall" pos="0 0 1.3"/>
<body name="arm" pos="0 0 1"><joint name="arm" axis="0 1 0" damping=".1" frictionloss=".05" range="-40 20" {2}/>
<geom type="capsule" fromto="0 0 0 .4 0 0" size=".03"/>
<body name="hand" pos=".4 0 0"><joint name="hand" axis="0 1 0" stiffness="1" armature=".01"/>
<geom type="capsule" fromto="0 0 0 .3 0 0" size=".02"/><site name="tip" pos=".2 0 .05"/></body></body>{3}
</worldbody>{4}</mujoco>"""
MOTORS = """<actuator><position group="1" joint="hand" kp="2" ctrlrange="-.1 .1"/>
<motor joint="arm" group="2" forcerange="-.1 .1"/></actuator>"""
CORD = """<tendon><fixed name="cord" {}><joint joint="arm" coef="1"/><joint joint="hand" coef=".5"/></fixed></tendon>
<actuator><position tendon="cord" kp="5"/><motor tendon="cord"/></actuator>"""
ROPE = '<tendon><spatial name="rope" armature=".2"><site site="wall"/><site site="tip"/></spatial></tendon>'
FLAGS = ("constraint", "equality", "frictionloss", "limit", "contact", "spring", "damper", "gravity", "clampctrl",
         "filterparent", "actuation", "refsafe", "eulerdamp", "island", "warmstart")


def stack(option="", flag="", ball="", more="", end=""):
    return STACK.format(option, flag, ball, more, end)


def arm(option="", flag="", joint="", more="", end=""):
    return ARM.format(option, flag, joint, more, end)


def at(distance):
    """Bodies this far from the origin (m)."""
    place = f"{distance} 0"
    return f"""<mujoco><worldbody><geom type="plane" size="5 5 .1"/>
    <body name="box" pos="{place} .1"><freejoint/><geom type="box" size=".1 .1 .1"/></body>
    <body name="arm" pos="{place} 1"><joint/><joint axis="0 1 0" frictionloss=".01"/>
    <geom type="capsule" fromto="0 0 0 .3 .1 0" size=".03"/></body>
    <body name="bar" pos="{place} 2"><freejoint/><geom type="capsule" fromto="0 0 0 .3 0 0" size=".03"/></body></worldbody>
    <equality><connect body1="bar" anchor="0 0 0"/></equality></mujoco>"""


SCENES = {
    **{f"{kind} {name}": scene(f'integrator="{name}"') for name in ("Euler", "RK4", "implicit", "implicitfast", "discrete")
       for kind, scene in (("stack", stack), ("arm", arm))},
    **{f"noslip {cone} {solver}": stack(f'noslip_iterations="5" cone="{cone}" solver="{solver}"')
       for cone in ("pyramidal", "elliptic") for solver in ("Newton", "CG", "PGS")},
    **{f"{kind} without {flag}": scene(flag=f'{flag}="disable"', end=end) for flag in FLAGS
       for kind, scene, end in (("stack", stack, ""), ("arm", arm, MOTORS))},
    **{f"{distance} m away": at(distance) for distance in (10, 1000, 100_000)},
    "mocap body": stack(more='<body mocap="true" pos=".02 .03 .43"><geom type="box" size=".1 .1 .1"/></body>'),
    "mocap body in the floor": stack(more='<body mocap="true" pos="1 1 0"><geom type="box" size=".1 .1 .1"/></body>'),
    "negative margin": stack(ball='margin="-0.01"'),
    "negative margin of all": stack('o_margin="-.01"', 'override="enable"'),
    "gap": stack(ball='margin=".05" gap=".05"'),
    "adhesion": stack(ball='adhesion="3"'),
    "surface velocity": stack(ball='surfacevel="1 0 0 0 0 0"'),
    "disabled actuators": arm('actuatorgroupdisable="1"', end=MOTORS),
    "clamped joint force": arm(joint='actuatorfrcrange="-.05 .05"', end=MOTORS),
    "clamped tendon force": arm(end=CORD.format('actuatorfrcrange="-.3 .3"')),
    "armature of a tendon": arm(end=ROPE),
    "actuator with armature and damping": arm(end='<actuator><motor joint="hand" armature=".1" damping=".1"/></actuator>'),
    "polynomial stiffness": arm(joint='stiffness="1 2 3"'),
    "polynomial damping": arm().replace('damping=".1"', 'damping=".1 .2 .3"'),
    "polynomial tendon": arm(end=CORD.format('stiffness="0 1" damping="0 .1"')),
    "fluid": arm('density="100" viscosity=".1" wind="1 0 0"'),
    "loose tolerance with damping": arm('tolerance="1e-3"', end=MOTORS),
}


def moving(xml):
    """A model and its data, with velocities, controls and applied forces; skips a test that needs a later version."""
    try:
        model = mujoco.MjModel.from_xml_string(xml)
    except ValueError as error:
        pytest.skip(str(error))
    data = mujoco.MjData(model)
    random = np.random.default_rng(1)
    data.qvel[:] = 0.2 * random.normal(size=model.nv)
    data.ctrl[:] = random.normal(size=model.nu)
    data.qfrc_applied[:] = 0.01 * random.normal(size=model.nv)
    data.xfrc_applied[1:] = 0.01 * random.normal(size=(model.nbody - 1, 6))
    return model, data


@pytest.mark.parametrize("is_whole", [False, True], ids=["forward", "whole"])
@pytest.mark.parametrize("scene", SCENES)
def test_a_good_step_is_not_rejected(scene, is_whole):
    model, data = moving(SCENES[scene])
    for number in range(30):
        before = data.qpos.copy(), data.qvel.copy()
        mujoco.mj_step(model, data)
        if not is_whole:
            mujoco.mj_forward(model, data)
        if number % 5 == 0:
            receipt = lcplab.receipt(model, data, before=before if is_whole else None)
            is_loose = scene.startswith("loose tolerance") and receipt.stopped_by == "tolerance"
            assert receipt.verdict in ("ok", "no rows", "not checked") or is_loose, str(receipt)


def test_a_box_that_sleeps_is_not_rejected():
    model, data = moving(stack(flag='sleep="enable"'))
    data.xfrc_applied[:], data.qfrc_applied[:], data.qvel[:] = 0, 0, 0
    slept = 0
    for _ in range(100):
        mujoco.mj_step(model, data, 10)
        receipt = lcplab.receipt(model, data)
        assert not receipt.is_rejected, str(receipt)
        slept += "collision: some trees are asleep" in receipt.not_checked
    assert slept


@pytest.mark.parametrize(
    ("scene", "part"),
    [
        ("noslip elliptic Newton", "solver: no bound on the motion, because noslip iterations change the forces"),
        ("stack discrete", "solver: no bound on the motion, because the integrator solves with an effective mass"),
        ("stack discrete", "assembly: u* and reference accelerations"),
        ("stack without constraint", "collision: contacts are disabled"),
        ("clamped tendon force", "assembly: forces of 2 actuators with"),
        ("armature of a tendon", "assembly: M and bias forces"),
        ("polynomial stiffness", "assembly: passive forces, because of springs and dampers that are not linear"),
        ("surface velocity", "assembly: reference accelerations of contacts with adhesion or a surface velocity"),
    ],
)
def test_a_part_that_a_setting_excludes_is_named(scene, part):
    model, data = moving(SCENES[scene])
    mujoco.mj_step(model, data)
    mujoco.mj_forward(model, data)
    not_checked = lcplab.receipt(model, data).not_checked
    assert any(own.startswith(part) for own in not_checked), not_checked


def test_after_a_whole_step_of_rk4_its_mean_acceleration_is_named_as_not_checked():
    model, data = moving(SCENES["stack RK4"])
    mujoco.mj_step(model, data)
    receipt = lcplab.receipt(model, data)
    assert receipt.ok and "write-back: the motion, which is a mean of the stages of RK4" in receipt.not_checked
    data.efc_force[:] *= 1.01
    assert lcplab.receipt(model, data).is_rejected


@pytest.mark.parametrize("is_whole", [False, True])
def test_all_parts_without_a_check_are_named(is_whole):
    more = '<geom type="plane" size="5 5 .1"/>' + "".join(
        f'<body pos="1 0 {height}"><freejoint/><geom type="box" size=".1 .1 .1"/></body>' for height in (0.1, 0.295))
    couple = '<equality><joint joint1="arm" joint2="hand"/></equality>'
    model, data = moving(arm(end=MOTORS + couple, more=more))
    data.qpos[0] = 0.5  # beyond the limit, 20°
    mujoco.mj_forward(model, data)
    before = None
    if is_whole:
        before = data.qpos.copy(), data.qvel.copy()
        mujoco.mj_step(model, data)
    expected = {
        "collision: number, distances, positions and normals of box and box",
        "assembly: compliance of rows (solref, solimp, impratio), margins and gaps of contacts",
        "assembly: transmissions of actuators",
        "write-back: the position after the step",
    }
    if not is_whole:
        expected.add("write-back: the velocity after the step; pass before=(qpos, qvel)")
    assert set(lcplab.receipt(model, data, before=before).not_checked) == expected


def test_a_step_in_which_mujoco_resets_an_unstable_simulation_begins_at_the_reset_state(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # MuJoCo writes its warning to a file
    model, data = moving(stack())
    for _ in range(3):
        mujoco.mj_step(model, data)
    data.qvel[0] = 1e12  # more than mjMAXVAL, as of a simulation that diverged
    before = data.qpos.copy(), data.qvel.copy()
    mujoco.mj_step(model, data)
    assert data.time == model.opt.timestep
    receipt = lcplab.receipt(model, data, before=before)
    assert not receipt.is_rejected, str(receipt)
    assert "assembly: the state before the step, because MuJoCo reset an unstable simulation in it" in receipt.not_checked
    data.qvel[2] += 1e-3
    assert lcplab.receipt(model, data, before=before).stage == "write-back"


def test_two_parallel_capsules_whose_ends_overlap_may_have_the_same_contact_twice():
    capsule = '<body pos="0 0 {}"><freejoint/><geom type="capsule" size=".05 .04" condim="1"/></body>'
    model = mujoco.MjModel.from_xml_string(f"<mujoco><worldbody>{capsule.format(0.5)}{capsule.format(0.61)}</worldbody></mujoco>")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert data.ncon == 2 and np.array_equal(data.contact[0].pos, data.contact[1].pos)
    assert lcplab.receipt(model, data).ok


def test_a_contact_in_its_gap_has_no_rows_and_is_not_rejected():
    model, data = moving(stack('gravity="0 0 0"', ball='margin=".2" gap=".2"'))
    data.qvel[:], data.qpos[9] = 0, 0.35  # the ball is 7 cm above the box
    mujoco.mj_forward(model, data)
    assert any(contact.efc_address < 0 for contact in data.contact)
    assert not lcplab.receipt(model, data).is_rejected


def test_a_contact_that_lost_its_rows_is_rejected():
    model, data = moving(stack())
    mujoco.mj_forward(model, data)
    [touching] = [contact for contact in data.contact if contact.dist < 0]
    touching.efc_address = -1
    receipt = lcplab.receipt(model, data)
    assert receipt.stage == "assembly" and "has no constraint rows" in str(receipt)
    assert set(receipt.bodies) == {"box", "ball"}


def test_forces_of_constraints_without_rows_are_rejected():
    model, data = moving(stack(flag='constraint="disable"'))
    mujoco.mj_forward(model, data)
    assert lcplab.receipt(model, data).verdict == "no rows"
    data.qfrc_constraint[2] = 1.0
    receipt = lcplab.receipt(model, data)
    assert receipt.stage == "write-back" and "there are no rows" in str(receipt)


@pytest.mark.parametrize(
    ("name", "stage"),
    [
        ("qpos", "assembly"), ("qvel", "assembly"), ("ctrl", "assembly"), ("xfrc_applied", "assembly"),
        ("geom_xpos", "collision"), ("efc_J", "assembly"), ("efc_aref", "assembly"), ("qacc_smooth", "assembly"),
        ("efc_force", "solver"), ("qacc", "solver"), ("qfrc_constraint", "write-back"),
    ],
)
def test_a_number_of_the_engine_that_is_not_finite_is_rejected_with_its_stage(name, stage):
    model, data = moving(arm(end=MOTORS))
    mujoco.mj_forward(model, data)
    getattr(data, name).reshape(-1)[0] = np.nan
    receipt = lcplab.receipt(model, data)
    assert receipt.verdict == "wrong" and receipt.stage == stage and "nan" in str(receipt)
    assert name not in ("qacc", "qacc_smooth", "qfrc_constraint") or receipt.bodies == ("arm",)


def test_a_distance_of_a_contact_that_is_not_finite_is_rejected():
    model, data = moving(stack())
    mujoco.mj_forward(model, data)
    data.contact[0].dist = np.nan
    receipt = lcplab.receipt(model, data)
    assert receipt.stage == "collision" and "contact.dist[0] is nan" in str(receipt)


@pytest.mark.parametrize("place", [0, 1])
def test_a_velocity_after_the_step_that_is_not_finite_is_an_error_of_write_back(place):
    model, data = moving(arm())
    before = data.qpos.copy(), data.qvel.copy()
    mujoco.mj_step(model, data)
    (data.qpos, data.qvel)[place][0] = np.nan
    assert lcplab.receipt(model, data, before=before).stage == "write-back"


def test_a_state_before_the_step_that_is_a_view_of_the_data_is_invalid():
    model, data = moving(arm())
    for before in ((data.qpos, data.qvel), (data.qpos.copy(), data.qvel[:]), (data.qpos[:2], data.qvel.copy())):
        mujoco.mj_step(model, data)
        with pytest.raises(ValueError, match="is a view of data.q.*pass data.q.*copy"):
            lcplab.receipt(model, data, before=before)
    with pytest.raises(ValueError, match="qvel has the shape"):
        lcplab.receipt(model, data, before=(data.qpos.copy(), np.zeros(7)))


@pytest.mark.parametrize("solver", ["Newton", "CG", "PGS"])
@pytest.mark.parametrize("cone", ["pyramidal", "elliptic"])
@pytest.mark.parametrize("iterations", [2, 5])
def test_the_residual_of_a_solver_is_no_error_of_write_back(solver, cone, iterations):
    option = f'iterations="{iterations}" tolerance="0" solver="{solver}" cone="{cone}" timestep=".005"'
    model, data = moving(stack(option))
    model.dof_damping[:] = 1.0  # implicit: (M + h B) a = M u* + Jᵀx
    stages, verdicts = set(), set()
    for _ in range(20):
        before = data.qpos.copy(), data.qvel.copy()
        mujoco.mj_step(model, data)
        stages.add(lcplab.receipt(model, data, before=before, limit=1e-9).stage)
        verdicts.add(lcplab.receipt(model, data, before=before).verdict)
    assert stages <= {"solver", None} and ("solver" in stages or iterations > 2)
    assert verdicts <= {"ok", "unconverged"}


@pytest.mark.parametrize("speed", [1e-4, 1e-8, 1e-12, 0.0])
@pytest.mark.parametrize("distance", [0, 1000, 100_000])
def test_bodies_that_are_nearly_at_rest_are_not_rejected_for_rounding(distance, speed):
    model, data = moving(at(distance).replace("<equality>", '<equality><weld body1="box" body2="bar"/>'))
    data.qvel[:] *= speed
    model.opt.gravity[:] = 0
    mujoco.mj_forward(model, data)
    receipt = lcplab.receipt(model, data)
    assert not receipt.is_rejected, str(receipt)


def test_a_wrong_jacobian_of_an_equality_is_found_at_rest():
    model, data = moving(stack())
    data.qvel[:] = 0
    mujoco.mj_forward(model, data)
    assert not lcplab.receipt(model, data).is_rejected
    [row, *_] = [row for row, kind in enumerate(data.efc_type) if kind == 0]
    data.efc_J.reshape(data.nefc, model.nv)[row] *= 1.01
    receipt = lcplab.receipt(model, data)
    assert receipt.stage == "assembly" and receipt.row == row and "J of an equality" in str(receipt)


def test_a_row_of_mjx_that_is_not_finite_is_not_dropped():
    """MJX's rows are fixed in number; those without entries are not in use. MuJoCo's dense data have the same arrays."""
    from lcplab._receipt import finite, mjx

    model, data = moving(stack('cone="pyramidal" jacobian="dense"'))
    mujoco.mj_forward(model, data)
    used = mjx.read(model, data, data.qpos.copy())
    assert len(used) == data.nefc and finite.is_finite(used)
    data.efc_D[0] = np.nan
    broken = mjx.read(model, data, data.qpos.copy())
    assert len(broken) == data.nefc and lcplab.receipt(broken).rejected.what == "compliance[0] is nan"
