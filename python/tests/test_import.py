"""Models of MuJoCo as scenes: every number against MuJoCo, every part without a counterpart in the list."""

import re
import subprocess
import sys

import mujoco
import numpy as np
import pytest

import lcplab
import lcplab.mujoco
from lcplab._import.command import compiled as compiled_file
from mujoco_reference import Reference, eliminated, joint_rows, mass_of, measured


STACK = """<mujoco model="stack">
  <option timestep="0.004"/>
  <default><geom friction="0.5 0.005 0.0001"/></default>
  <worldbody>
    <geom name="floor" type="plane" size="5 5 .1"/>
    <body name="lower" pos="0 0 .1"><freejoint/><geom type="box" size=".1 .1 .1" mass="1"/></body>
    <body name="upper" pos="0 0 .3"><freejoint/><geom type="box" size=".1 .1 .1" mass="3"/></body>
  </worldbody>
</mujoco>
"""

#: One mechanism for each set of joints of a body that a scene can express, with springs, dampers and welded bodies.
MECHANISMS = {
    "arm": """<body pos="0 0 1"><joint type="hinge" axis="0 1 0.3" damping="0.2"/>
                <geom type="capsule" size=".05" fromto="0 0 0 .4 .1 0"/>
                <body pos=".4 .1 0" euler="10 20 30"><joint type="slide" axis="1 0 0" stiffness="30" springref=".2" damping="2"/>
                  <geom type="box" size=".1 .05 .05" pos=".1 .02 0"/>
                  <body pos=".2 0 0"><joint type="ball"/><geom type="cylinder" size=".03 .1" pos="0 .05 0"/>
                    <body pos="0 .1 0" euler="0 40 0"><geom type="sphere" size=".06" pos=".1 0 0"/></body>
                  </body></body></body>""",
    "universal": """<body pos="0 0 1"><joint type="hinge" axis="1 0 0" pos="0 .1 0"/><joint type="hinge" axis="0 1 0" pos="0 .1 0"/>
                <geom type="box" size=".1 .2 .3" pos=".1 .2 .1"/>
                <body pos="0 0 -.3"><joint type="hinge" axis="1 0 0"/><joint type="hinge" axis="0 0 1"/>
                  <joint type="hinge" axis="0 1 0"/><geom type="capsule" size=".05" fromto="0 0 0 0 .1 -.4"/></body></body>""",
    "planar": """<body pos="0 0 1"><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/>
                <joint type="hinge" axis="0 1 0" damping=".3"/><geom type="box" size=".1 .2 .3" pos=".1 0 .1"/>
                <body pos=".1 0 -.3"><joint type="hinge" axis="0 1 0" pos="0 0 .1" stiffness="2"/>
                  <geom type="capsule" size=".05" fromto="0 0 0 .1 0 -.4"/></body></body>""",
    "table": """<body pos="0 0 1"><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>
                <geom type="box" size=".3 .2 .1" pos=".1 0 .1"/>
                <body pos=".1 0 .3"><joint type="slide" axis="0 .6 .8"/><joint type="hinge" axis="0 .6 .8" pos=".1 0 0"/>
                  <geom type="box" size=".1 .1 .05" pos="0 .1 .1"/></body></body>""",
    "free": """<body pos="0 0 1"><freejoint/><inertial mass="2" pos=".1 .2 .3" fullinertia="3 4 5 .1 .2 .3"/>
                <body pos=".3 0 0"><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>
                  <joint type="slide" axis="0 0 1"/><geom type="sphere" size=".1" pos=".1 0 0"/></body></body>""",
}


def compiled(worldbody, head=""):
    return mujoco.MjModel.from_xml_string(f"<mujoco>{head}<worldbody>{worldbody}</worldbody></mujoco>")


def moved(model):
    """A state away from the initial one, with velocities."""
    data = mujoco.MjData(model)
    data.qvel[:] = np.random.default_rng(7).normal(size=model.nv)
    mujoco.mj_integratePos(model, data.qpos, data.qvel, 0.1)
    return data


@pytest.mark.parametrize("name", MECHANISMS)
def test_masses_joints_and_accelerations_are_those_of_mujoco(name):
    model = compiled(MECHANISMS[name])
    reference = Reference(model, moved(model))
    assert reference.imported.refusals == []
    jacobian, _ = reference.motions()
    scene = reference.without_contacts()
    np.testing.assert_allclose(jacobian.T @ mass_of(scene) @ jacobian, reference.mass_matrix(), rtol=1e-9, atol=1e-12)
    expected = reference.accelerations()
    np.testing.assert_allclose(measured(scene), expected, rtol=1e-9, atol=1e-10 * np.abs(expected).max())
    # The joint rows leave exactly MuJoCo's motions.
    mass, rows = joint_rows(scene)
    assert np.abs(rows @ jacobian).max() < 1e-12
    assert np.linalg.matrix_rank(rows, tol=1e-9) == rows.shape[1] - model.nv
    np.testing.assert_allclose(mass, mass_of(scene), rtol=1e-12, atol=1e-15)


DRIVEN = """<mujoco><compiler angle="radian"/><worldbody><body pos="0 0 1"><joint name="a" axis="0 1 .3" stiffness="4" springref=".7"/>
    <geom type="capsule" size=".05" fromto="0 0 0 .4 .1 0"/>
    <body pos=".4 .1 0"><joint name="b" type="slide" axis="1 0 0"/><geom type="box" size=".1 .05 .05" pos=".1 .02 0"/>
      <body pos=".2 0 0"><joint name="c" axis="0 0 1"/><geom type="capsule" size=".05" fromto="0 0 0 .3 0 .1"/></body></body></body></worldbody>
  <actuator><motor joint="a" gear="-3" ctrlrange="-1 1" ctrllimited="true"/><position joint="b" kp="20" kv="3" gear="2"/>
    <velocity joint="c" kv=".5" gear="-1.5"/><motor joint="c" forcerange="-.2 .2" forcelimited="true"/></actuator></mujoco>"""


def test_motors_and_servos_accelerate_bodies_as_in_mujoco():
    model = mujoco.MjModel.from_xml_string(DRIVEN)
    data = moved(model)
    data.ctrl[:] = 2, 0.3, -4, 5  # the first and the last are limited to 1 and 0.2
    reference = Reference(model, data)
    assert reference.imported.refusals == []
    without = Reference(model, moved(model))
    expected = reference.accelerations()
    assert np.abs(expected - without.accelerations()).max() > 1
    np.testing.assert_allclose(measured(reference.without_contacts()), expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


def test_springs_of_servos_move_their_joints_as_in_mujoco():
    model = mujoco.MjModel.from_xml_string(DRIVEN)
    data = moved(model)
    data.ctrl[:] = 0.5, 0.3, -4, 0.1
    description = {**lcplab.mujoco.scene(model, data).scene, "step": {"dt": 1e-3}}
    errors = []
    for dt in (1e-3, 5e-4):
        scene, run = lcplab.Scene.of({**description, "step": {"dt": dt}}), mujoco.MjData(model)
        mujoco.mj_copyData(run, model, data)
        model.opt.timestep = dt / 20
        for _ in range(round(0.2 / dt)):
            scene.step()
            mujoco.mj_step(model, run, nstep=20)
        mujoco.mj_forward(model, run)
        errors.append(np.abs(scene.poses[:, :3] - run.xipos[1:]).max())
    # The error of the time step is of first order, and small.
    assert errors[0] < 2e-3 and errors[1] == pytest.approx(errors[0] / 2, rel=0.1)


def test_a_motor_whose_force_changes_or_is_limited_by_its_joint_is_refused():
    text = '<mujoco><worldbody><body><joint name="j" actuatorfrcrange="-1 1"/><geom size=".1" pos=".1 0 0"/></body></worldbody>' \
           '<actuator><motor joint="j"/><general joint="j" dyntype="filter" dynprm="1"/></actuator></mujoco>'
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    assert lcplab.mujoco.scene(model, data).refusals == []
    for ctrl, message in (((0, 1), "its activation changes"), ((2, 0), "limit of its joint's actuator force is reached")):
        data.ctrl[:] = ctrl
        (refusal,) = lcplab.mujoco.scene(model, data).refusals
        assert message in refusal.reason
    data.ctrl[:] = 0.5, 0
    (_, motor) = lcplab.mujoco.scene(model, data).scene["constraints"]
    assert motor["effort"] == 0.5 and lcplab.Scene.from_mujoco(model, data).step()


def test_a_of_contacts_is_that_of_mujoco_after_the_joints_are_eliminated():
    floor = '<geom type="plane" size="5 5 .1" pos="0 0 .55"/>'
    reference = Reference(model := compiled(floor + MECHANISMS["arm"] + MECHANISMS["universal"]), mujoco.MjData(model))
    own, maximal = reference.contact_rows()
    assert len(own) >= 6
    mass, rows = joint_rows(reference.without_contacts())
    expected = reference.delassus(own)
    np.testing.assert_allclose(eliminated(mass, rows, maximal), expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


def test_a_stack_has_the_shapes_masses_friction_and_step_of_its_file():
    scene = lcplab.mujoco.scene(mujoco.MjModel.from_xml_string(STACK)).scene
    floor, lower, upper = scene["bodies"]
    assert (floor["name"], floor["fixed"], floor["shape"]) == ("floor", True, {"plane": [0, 0, 1]})
    assert lower["shape"] == {"box": [0.2, 0.2, 0.2]} and upper["position"] == [0, 0, 0.3]
    assert (lower["mass"], upper["mass"]) == (1, 3)
    # m (a² + a²)/12
    assert upper["inertia"] == pytest.approx([3 * 2 * 0.04 / 12] * 3, rel=1e-14)
    assert (scene["contact"], scene["step"]) == ({"friction": 0.5}, {"dt": 0.004})


def test_an_imported_stack_rests_and_its_contacts_carry_it():
    scene = lcplab.Scene.from_mujoco(mujoco.MjModel.from_xml_string(STACK))
    for _ in range(20):
        assert scene.step()
    assert np.abs(scene.velocities).max() < 1e-9
    assert scene.forces()[1:, 2] == pytest.approx([9.81, 3 * 9.81], rel=1e-9)


def test_ranges_and_friction_losses_become_stops_and_brakes_at_the_imported_position():
    model = compiled('<body><joint name="elbow" axis="0 0 1" range="-1 2" limited="true" frictionloss=".3"/>'
                     '<geom size=".1" pos=".2 0 0"/></body>', '<compiler angle="radian"/>')
    data = mujoco.MjData(model)
    data.qpos[0] = 0.5
    constraints = lcplab.mujoco.scene(model, data).scene["constraints"]
    hinge, stops, brake = constraints
    assert (hinge["kind"], hinge["point"], hinge["axis"]) == ("hinge", [0, 0, 0], [0, 0, 1])
    assert (stops["kind"], stops["limits"]) == ("limit_rotation", [-1.5, 1.5])
    assert (brake["kind"], brake["speed"], brake["effort"]) == ("motor_rotation", 0, 0.3)


def test_pairs_that_mujoco_excludes_are_without_contact():
    bodies = "".join(f'<body name="{name}" pos="{k} 0 0"><freejoint/><geom size=".1"/></body>' for k, name in enumerate("abc"))
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><worldbody>{bodies}</worldbody><contact><exclude body1="a" body2="c"/></contact></mujoco>')
    assert lcplab.mujoco.scene(model).scene["pairs"] == [{"bodies": ["a", "c"], "without_contact": True}]


def test_the_friction_of_a_pair_is_that_of_mujoco_and_not_the_geometric_mean():
    geoms = '<geom name="floor" type="plane" size="1 1 1" friction=".2"/>'
    bodies = "".join(f'<body name="{n}" pos="{k} 0 .1"><freejoint/><geom size=".1" friction="{mu}"/></body>'
                     for k, (n, mu) in enumerate({"a": 0.1, "b": 0.9, "c": 0.1}.items()))
    scene = lcplab.mujoco.scene(compiled(geoms + bodies)).scene
    assert scene["contact"]["friction"] == 0.9  # of a with b and c with b and b with the floor
    listed = {tuple(pair["bodies"]): pair["friction"] for pair in scene["pairs"]}
    assert listed == {("floor", "a"): 0.2, ("floor", "c"): 0.2, ("a", "c"): 0.1}


def test_an_offset_shape_keeps_the_stated_center_of_mass_in_contact():
    body = '<body name="club" pos="0 0 .2"><freejoint/><inertial mass="2" pos=".1 0 0" diaginertia=".1 .2 .25"/>' \
           '<geom size=".2"/><geom size=".2" pos=".4 0 0"/></body>'
    scene = lcplab.Scene.from_mujoco(compiled('<geom type="plane" size="1 1 1"/>' + body))
    step = scene.step()
    rows = scene.problem().to_json()["rows"]
    normals = [x for row, x in zip(rows, step.x) if row["label"].startswith("normal")]
    # The center of mass divides the distance of the balls 1 to 3, so they carry 3/4 and 1/4 of the weight.
    weight = 2 * 9.81 * 0.002
    assert sorted(normals) == pytest.approx([weight / 4, 3 * weight / 4], rel=1e-9)


def test_a_range_with_a_margin_stops_where_mujoco_stops():
    model = compiled('<body><joint type="slide" axis="1 0 0" range="-1 2" limited="true" margin=".1" solreflimit=".005 1"/>'
                     '<geom size=".1" mass="1"/></body>', '<option gravity="0 0 0"/>')
    (_, stops) = lcplab.mujoco.scene(model).scene["constraints"]
    data = mujoco.MjData(model)
    for force, stop in zip((-1, 1), stops["limits"]):
        data.qfrc_applied[0] = force
        mujoco.mj_step(model, data, nstep=5000)
        assert data.qpos[0] == pytest.approx(stop, abs=1e-4)
    model.jnt_margin[0] = 1.6  # leaves no position
    assert "the range less margin" in str(lcplab.mujoco.scene(model).refusals[0])


TIED = """<mujoco><worldbody><site name="hook" pos=".1 .2 3"/>
  <body name="a" pos="0 0 2" euler="10 20 30"><freejoint/><geom type="box" size=".1 .2 .3"/><site name="a" pos=".1 0 .1"/></body>
  <body name="b" pos=".5 .3 1"><freejoint/><geom type="box" size=".1 .1 .2"/><site name="b" pos="0 .05 .2"/></body></worldbody>
  <contact><exclude body1="a" body2="b"/></contact>
  <tendon><spatial name="up" {up}><site site="a"/><site site="hook"/></spatial>
    <spatial name="down" {down}><site site="b"/><site site="a"/></spatial></tendon></mujoco>"""


def test_springs_of_straight_tendons_accelerate_bodies_as_in_mujoco():
    springs = 'stiffness="300" springlength=".4" damping="20"', 'damping="30"'
    model = mujoco.MjModel.from_xml_string(TIED.format(up=springs[0], down=springs[1]))
    reference = Reference(model, moved(model))
    assert reference.imported.refusals == []
    expected = reference.accelerations()
    weight = np.zeros_like(expected)
    weight[2::6] = -9.81
    assert np.abs(expected - weight).max() > 10
    np.testing.assert_allclose(measured(reference.without_contacts()), expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


def test_a_limited_straight_tendon_is_a_rope_that_carries_only_tension():
    model = mujoco.MjModel.from_xml_string("""<mujoco><worldbody><site name="hook" pos="0 0 1"/>
      <body name="ball"><freejoint/><geom size=".1" mass="2"/><site name="ball"/></body></worldbody>
      <tendon><spatial limited="true" range="-1 1.25" margin=".25"><site site="hook"/><site site="ball"/></spatial></tendon></mujoco>""")
    scene = lcplab.Scene.from_mujoco(model)
    step = scene.step()
    assert step.x == pytest.approx([2 * 9.81 * 0.002], rel=1e-9)  # N s: the weight
    assert np.abs(scene.velocities).max() < 1e-12
    data = mujoco.MjData(model)
    data.qpos[2] = 0.5  # slack
    scene = lcplab.Scene.from_mujoco(model, data)
    scene.step()
    assert scene.velocities[0, 2] == pytest.approx(-9.81 * 0.002, rel=1e-9)
    data.qpos[2] = -0.1
    assert "the length 1.1 exceeds 1" in str(lcplab.mujoco.scene(model, data).refusals[0])


REFUSED = {
    "armature": ('<joint name="j" armature=".1"/><geom size=".1"/>', "", "<joint> 'j' of body 'b': armature = 0.1"),
    "several hinges": ('<joint name="j" axis="1 0 0" damping="1"/><joint axis="0 1 0"/><geom size=".1"/>', "",
                       "<joint> 'j' of body 'b': damping of one of several hinges"),
    "skew axes": ('<joint name="j" axis="1 0 0"/><joint axis="1 1 0"/><geom size=".1"/>', "",
                  "two hinges of one body whose axes are not perpendicular"),
    "slide after hinge": ('<joint name="j" axis="1 0 0"/><joint type="slide" axis="0 1 0"/><geom size=".1"/>', "",
                          "a slide after a hinge"),
    "ball range": ('<joint name="j" type="ball" range="0 30"/><geom size=".1"/>', "", "range of a ball joint"),
    "ellipsoid": ('<freejoint/><geom name="g" type="ellipsoid" size=".1 .2 .3"/>',
                  '<worldbody><geom type="plane" size="1 1 1"/></worldbody>', "<geom> 'g' of body 'b': type 'ellipsoid'"),
    "condim": ('<freejoint/><geom size=".1" condim="4"/>',
               '<worldbody><geom name="floor" type="plane" size="1 1 1"/></worldbody>', "<contact> 'b, floor': condim = 4"),
    "margin": ('<freejoint/><geom name="g" size=".1" margin=".01"/>',
               '<worldbody><geom type="plane" size="1 1 1"/></worldbody>', "<geom> 'g' of body 'b': margin"),
    "limited servo": ('<joint name="j"/><geom size=".1"/>',
                      '<actuator><position name="servo" joint="j" kp="5" forcerange="-1 1"/></actuator>',
                      "<actuator> 'servo': its force depends on position or speed and is limited"),
    "servo of a ball": ('<joint name="j" type="ball"/><geom size=".1"/>', '<actuator><position name="servo" joint="j" kp="5"/></actuator>',
                        "<actuator> 'servo': its force acts on a free or ball joint"),
    "muscle": ('<joint name="j" axis="0 1 0" range="-50 50"/><geom size=".1" pos=".1 0 0"/>',
               '<actuator><muscle name="m" joint="j" lengthrange=".1 .2"/></actuator>', "<actuator> 'm': its force is not linear"),
    "fluid": ('<freejoint/><geom size=".1"/>', '<option density="1.2"/>', "<option> 'density': forces of a fluid"),
    "coupling": ('<joint name="j"/><geom size=".1"/>', '<equality><joint name="gear" joint1="j"/></equality>',
                 "<joint> 'gear': an equality of this kind, such as a coupling"),
    "rotor of an actuator": ('<joint name="j"/><geom size=".1"/>', '<actuator><motor name="m" joint="j" gear="5" armature=".1"/></actuator>',
                             "<actuator> 'm': armature = 0.1"),
    "damper of an actuator": ('<joint name="j"/><geom size=".1"/>',
                              '<option><flag actuation="disable"/></option><actuator><motor name="m" joint="j" damping=".1"/></actuator>',
                              "<actuator> 'm': damping = 0.1"),
    "spring of a free joint": ('<joint name="j" type="free" stiffness="3"/><geom size=".1"/>', "", "stiffness of a free joint"),
    "higher terms of a hinge": ('<joint name="j" stiffness="0 .5 .5"/><geom size=".1"/>', "", "with terms of higher order"),
    "higher terms of a ball": ('<joint name="j" type="ball" damping="0 .5 .5"/><geom size=".1"/>', "", "damping of a ball joint"),
    "higher terms of a tendon": ('<joint name="j"/><geom size=".1"/>',
                                 '<tendon><fixed name="t" damping="0 .5 .5"><joint joint="j" coef="1"/></fixed></tendon>',
                                 "<tendon> 't': dampingpoly of a tendon"),
    "sleep": ('<joint name="j"/><geom size=".1"/></body><body name="s" sleep="init"><freejoint/><geom size=".1"/>',
              '<option><flag sleep="enable"/></option>', "<body> 's': sleep = init"),
    "tendon": ('<joint name="j"/><geom size=".1"/>',
               '<tendon><fixed name="cable" stiffness="3"><joint joint="j" coef="1"/></fixed></tendon>',
               "<tendon> 'cable': stiffness of a tendon"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_has_no_counterpart_is_refused_by_element_and_name(case):
    inner, rest, message = REFUSED[case]
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><worldbody><body name="b" pos="0 0 1">{inner}</body></worldbody>{rest}</mujoco>')
    with pytest.raises(lcplab.InputError) as refused:
        lcplab.Scene.from_mujoco(model)
    assert message in str(refused.value)


def test_the_state_of_the_caller_is_not_changed():
    model = compiled(MECHANISMS["arm"])
    data = moved(model)
    before = data.qpos.copy(), data.qvel.copy(), data.xpos.copy()
    lcplab.mujoco.scene(model, data)
    assert all(np.array_equal(one, other) for one, other in zip(before, (data.qpos, data.qvel, data.xpos)))


def test_equalities_become_joints_and_violated_ones_are_refused():
    bodies = '<body name="a"><freejoint/><geom size=".1"/></body><body name="b" pos="1 0 0"><freejoint/><geom size=".1"/></body>'
    text = '<mujoco><worldbody>{}</worldbody><equality><connect body1="a" body2="b" anchor=".5 0 0"/>' \
           '<weld name="w" body1="a" body2="b"/></equality></mujoco>'
    model = mujoco.MjModel.from_xml_string(text.format(bodies))
    kinds = {c["kind"]: c for c in lcplab.mujoco.scene(model).scene["constraints"]}
    assert set(kinds) == {"ball", "fixed"} and kinds["ball"]["point"] == [0.5, 0, 0]
    data = mujoco.MjData(model)
    data.qpos[0] = 0.1
    refusals = [str(refusal) for refusal in lcplab.mujoco.scene(model, data).refusals]
    assert any("<connect>" in line and "violated by 0.1" in line for line in refusals)
    assert any("<weld> 'w'" in line for line in refusals)


def command(*words, cwd):
    return subprocess.run([sys.executable, "-m", "lcplab", *words], cwd=cwd, capture_output=True, text=True)


def test_the_command_writes_the_scene_with_all_digits(tmp_path):
    (tmp_path / "stack.xml").write_text(STACK)
    done = command("import", "stack.xml", "--out", "stack.toml", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    direct = lcplab.Scene.from_mujoco(mujoco.MjModel.from_xml_string(STACK))
    loaded = lcplab.Scene.load(tmp_path / "stack.toml")
    assert np.array_equal(loaded.poses, direct.poses) and loaded.title == "stack"
    loaded.step()
    direct.step()
    assert np.array_equal(loaded.velocities, direct.velocities)


def test_the_command_refuses_with_file_line_and_element_and_skips_on_request(tmp_path):
    text = STACK.replace('<freejoint/><geom type="box" size=".1 .1 .1" mass="3"/>',
                         '\n<joint name="lift" type="slide" axis="0 0 1" armature="2"/><geom type="box" size=".1 .1 .1" mass="3"/>')
    (tmp_path / "stack.xml").write_text(text)
    done = command("import", "stack.xml", "--out", "stack.toml", cwd=tmp_path)
    assert done.returncode == 2 and not (tmp_path / "stack.toml").exists()
    line = 1 + text[: text.index('<joint name="lift"')].count("\n")
    assert f"error: stack.xml:{line}: <joint> 'lift' of body 'upper': armature = 2" in done.stderr
    done = command("import", "stack.xml", "--skip", "--out", "stack.toml", cwd=tmp_path)
    assert done.returncode == 0 and f"skipped: stack.xml:{line}: <joint> 'lift'" in done.stderr
    written = (tmp_path / "stack.toml").read_text()
    assert f"# Skipped: stack.xml:{line}: <joint> 'lift'" in written and 'kind = "slider"' in written


#: Elements without names, one a line; each of those marked with a number is refused at its own line.
UNNAMED = """<mujoco>
<option timestep="0.01"/>
<option density="1"/>  <!-- 3: density -->
<option><flag limit="disable"/></option>  <!-- 4: 'limit' -->
<default><geom size=".1"/><joint damping="0"/></default>
<worldbody>
<geom type="plane" size="1 1 1" pos="0 0 -9"/>
<frame pos="0 0 1">
<body>
<joint axis="1 0 0"/>
<geom/>
<body pos="1 0 0">
<joint armature=".1"/>  <!-- 13: armature = 0.1 -->
<geom contype="0" conaffinity="0"/>
</body>
<geom pos="0 9 0" condim="4"/>  <!-- 16: condim = 4 -->
</body>
</frame>
<replicate count="2" offset="0 5 0">
<body>
<joint type="ball" damping=".3"/>  <!-- 21: damping of a ball -->
<geom pos="0 0 .3"/>
</body>
</replicate>
<include file="part.xml"/>
<body name="last" pos="9 0 0"><joint name="last"/>
<geom margin=".01"/>  <!-- 27: margin -->
</body>
</worldbody>
<actuator>
<motor joint="last"/>
<position joint="last" forcerange="-1 1"/>  <!-- 32: its force depends -->
</actuator>
<equality>
<joint joint1="last"/>  <!-- 35: an equality of this kind -->
</equality>
<tendon>
<fixed frictionloss="1"><joint joint="last" coef="1"/></fixed>  <!-- 38: frictionloss of a tendon -->
</tendon>
</mujoco>
"""
PART = """<mujocoinclude>
<body pos="0 0 5">
<freejoint/>
<geom type="ellipsoid" size=".1 .2 .3"/>  <!-- 4: 'ellipsoid' -->
</body>
</mujocoinclude>
"""


def test_elements_without_names_are_refused_at_their_lines_also_in_included_files(tmp_path):
    (tmp_path / "robot.xml").write_text(UNNAMED)
    (tmp_path / "part.xml").write_text(PART)
    done = command("import", "robot.xml", cwd=tmp_path)
    lines = done.stderr.splitlines()
    for name, text in (("robot.xml", UNNAMED), ("part.xml", PART)):
        for number, message in re.findall(r"<!-- (\d+): (.*?) -->", text):
            assert any(line.startswith(f"error: {name}:{number}: <") and message in line for line in lines), (message, lines)
    assert done.returncode == 2 and all(re.match(r"error: \w+\.xml:\d+: <", line) for line in lines[:-1])


def test_the_command_imports_a_keyframe_and_finds_elements_that_share_a_name(tmp_path):
    (tmp_path / "arm.xml").write_text("""<mujoco><worldbody><geom type="plane" size="1 1 1" pos="0 0 -9"/><body name="arm" pos="0 0 1">
      <joint name="swing" axis="0 1 0"/><geom type="capsule" size=".1" fromto="0 0 0 1 0 0"/></body></worldbody>
      <actuator>
        <position name="swing" joint="swing" kp="3" forcerange="-1 1"/></actuator>
      <keyframe><key name="down" qpos="1.5707963267948966"/></keyframe></mujoco>""")
    done = command("import", "arm.xml", "--skip", "--keyframe", "down", cwd=tmp_path)
    assert "skipped: arm.xml:4: <actuator> 'swing'" in done.stderr
    (_, position) = [line for line in done.stdout.splitlines() if line.startswith("position")]
    # A rotation by +90° about y turns x downwards.
    assert eval(position.split("=")[1]) == pytest.approx([0, 0, 0.5], abs=1e-9)
    done = command("import", "arm.xml", "--skip", "--keyframe", "up", cwd=tmp_path)
    assert done.returncode == 2 and "has no keyframe 'up'" in done.stderr


def test_without_mujoco_the_command_names_the_package_to_install(tmp_path):
    (tmp_path / "stack.xml").write_text(STACK)
    code = "import sys; sys.modules['mujoco'] = None; sys.argv = ['lcplab', 'import', 'stack.xml']; " \
           "from lcplab.__main__ import main; sys.exit(main())"
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 2 and 'pip install "./python[mujoco]"' in done.stderr


def test_a_urdf_file_is_imported_and_other_files_are_reported(tmp_path):
    (tmp_path / "arm.urdf").write_text("""<robot name="arm"><link name="base"/>
      <link name="rod"><inertial><origin xyz="0 0 .5"/><mass value="2"/>
        <inertia ixx=".1" iyy=".2" izz=".15" ixy="0" ixz="0" iyz="0"/></inertial></link>
      <joint name="pivot" type="revolute"><parent link="base"/><child link="rod"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/>
        <limit lower="-1" upper="1" effort="5" velocity="1"/></joint></robot>""")
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "arm.urdf"))
    scene = lcplab.mujoco.scene(model).scene
    (rod,) = scene["bodies"]
    assert (rod["mass"], rod["position"]) == (2, [0, 0, 1.5])
    assert sorted(rod["inertia"]) == pytest.approx([0.1, 0.15, 0.2], rel=1e-9)
    assert scene["constraints"][0]["axis"] == [0, 1, 0] and scene["constraints"][1]["limits"] == [-1, 1]
    (tmp_path / "scene.sdf").write_text('<sdf version="1.6"/>')
    for name, message in (("none.xml", "error: none.xml: No such file or directory"), ("scene.sdf", "MuJoCo cannot compile it")):
        done = command("import", name, cwd=tmp_path)
        assert done.returncode == 2 and message in done.stderr and "Traceback" not in done.stderr


def test_meshes_of_a_package_are_found_in_the_folders_above(tmp_path):
    corners = [(x, y, z) for x in (0, 1) for y in (0, 2) for z in (0, 4)]
    (tmp_path / "arm" / "meshes").mkdir(parents=True)
    (tmp_path / "arm" / "urdf").mkdir()
    faces = [(1, 3, 2), (2, 3, 4), (5, 6, 7), (6, 8, 7), (1, 2, 5), (2, 6, 5), (3, 7, 4), (4, 7, 8), (1, 5, 3), (3, 5, 7), (2, 4, 6), (4, 8, 6)]
    (tmp_path / "arm" / "meshes" / "block.obj").write_text(
        "".join(f"v {x} {y} {z}\n" for x, y, z in corners) + "".join(f"f {a} {b} {c}\n" for a, b, c in faces))
    robot = """<robot name="arm"><link name="base"/><link name="block">
      <inertial><origin xyz=".5 1 2"/><mass value="2"/><inertia ixx="4" iyy="3" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
      <collision><geometry><mesh filename="package://arm/meshes/{}.obj"/></geometry></collision></link>
      <link name="other"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
      <collision><geometry><sphere radius=".1"/></geometry></collision></link>
      <joint name="a" type="continuous"><parent link="base"/><child link="block"/></joint>
      <joint name="b" type="continuous"><parent link="base"/><child link="other"/><origin xyz="9 0 0"/></joint></robot>"""
    path = tmp_path / "arm" / "urdf" / "arm.urdf"
    path.write_text(robot.format("block"))
    block = lcplab.mujoco.scene(compiled_file(path)).scene["bodies"][0]
    (part,) = block["shape"]["compound"]
    turn = np.zeros(9)
    for_part, for_body = part["rotation"]["quaternion"], block["rotation"]["quaternion"]
    found = np.array(part["shape"]["hull"])
    for place, quaternion in ((part["position"], for_part), (block["position"], for_body)):
        mujoco.mju_quat2Mat(turn, np.array(quaternion))
        found = found @ turn.reshape(3, 3).T + place
    assert sorted(map(tuple, found.round(6))) == sorted(corners)
    path.write_text(robot.format("missing"))
    done = command("import", str(path), cwd=tmp_path)
    assert done.returncode == 2 and "'package://arm/meshes/missing.obj': the file is not in a folder above" in done.stderr


def test_one_line_writes_the_problem_of_a_step_and_the_judge_reads_it(tmp_path):
    model = mujoco.MjModel.from_xml_string(STACK)
    data = mujoco.MjData(model)
    for _ in range(5):
        mujoco.mj_step(model, data)
    file = lcplab.mujoco.problem(model, data, tmp_path / "frame.json")
    assert len(file["b"]) == data.nefc > 0
    problem = lcplab.Problem.read(tmp_path / "frame.json")
    np.testing.assert_allclose(problem.b, file["b"])
    assert (tmp_path / "frame.x.json").exists()
    assert lcplab.judge(problem, x=data.efc_force[: data.nefc], tolerance=1e-6)
