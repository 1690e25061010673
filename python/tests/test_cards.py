"""Engine cards: laws against SciPy, engines of others against lcplab, and measures that can fail."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipk

import lcplab
from lcplab import cards, engines
from lcplab.cards import PHENOMENA
from lcplab.cards.__main__ import main
from lcplab.cards._elliptic import first_kind
from lcplab.cards._frames import frames

NAMED = {phenomenon.name: phenomenon for phenomenon in PHENOMENA}
OTHERS = [name for name in engines.NAMES if name != "lcplab"]


def velocity():
    own = engines.by_name("lcplab")
    return own, own.settings[0]


def moved(name, changed=None, duration=None):
    """A run by lcplab of the scene with fields changed, measured as the scene without."""
    phenomenon = NAMED[name]
    told = phenomenon.described(phenomenon.variants[-1])
    scene = phenomenon.described({**phenomenon.variants[-1], **(changed or {})})
    run = cards.simulate(*velocity(), scene, duration or phenomenon.duration)
    return cards.Run(told, run.dt, run.t, run.poses, run.velocities, run.forces)


def test_elliptic_integrals_are_scipys():
    for k in (0.0, 0.1, 0.5, math.sin(math.pi / 4), 0.999):
        assert first_kind(k) == pytest.approx(ellipk(k * k), rel=1e-14)


@pytest.mark.parametrize(
    ("name", "square", "start"),
    [
        ("pendulum", 9.81 * 0.5 / ((1 + 0.05**2) / 12 + 0.25), 90.0),
        ("closed_loop", 9.81 / (2 * ((0.25 + 0.05**2) / 12 + 0.0625) + 0.25), 60.0),
    ],
)
def test_the_curve_of_a_swing_solves_its_equation(name, square, start):
    run = moved(name, duration=0.01)
    t = np.linspace(0, 3, 31)
    curve = NAMED[name].exact(cards.Curve(t, t), run)
    exact = solve_ivp(
        lambda _, s: [s[1], -square * math.sin(s[0])], (0, 3), [math.radians(start), 0], t_eval=t, rtol=1e-11, atol=1e-12
    )
    np.testing.assert_allclose(np.abs(curve), np.abs(np.degrees(exact.y[0])), atol=1e-5)


def test_the_curve_of_the_brick_solves_eulers_equations():
    run = moved("angular_momentum", duration=0.01)
    one, two, three = np.array([0.04 + 0.01, 0.09 + 0.01, 0.09 + 0.04]) / 12
    t = np.linspace(0, 6, 61)

    def rate(_, w):
        return [(two - three) / one * w[1] * w[2], (three - one) / two * w[2] * w[0], (one - two) / three * w[0] * w[1]]

    exact = solve_ivp(rate, (0, 6), [0, 5, 0.5], t_eval=t, rtol=1e-11, atol=1e-12)
    np.testing.assert_allclose(NAMED["angular_momentum"].exact(cards.Curve(t, t), run), exact.y[1], atol=1e-5)


@pytest.mark.parametrize(
    "name",
    "free_fall creep wall lift stopping predictability painleve weight bounce chain top".split(),
)
def test_velocity_level_keeps_the_laws(name):
    column = cards.run("lcplab", "velocity", name)
    assert column.failed is None and column.holds, column.measured


@pytest.mark.parametrize(
    ("name", "changed"),
    [
        ("free_fall", {"gravity": [0, 0, -9]}),
        ("free_fall", {"bodies.cube.angular_velocity": [1, 1, 1.1]}),
        ("creep", {"contact.friction": 0.363}),  # tan 20° = 0.36397
        ("lift", {"bodies.cube.velocity": [6, 0, 0.2]}),
        ("stopping", {"contact.friction": 0.48}),
        ("stopping", {"bodies.cube.velocity": [1.98, 0.3, 0]}),
        ("bounce", {"contact.restitution": 0.55}),
        ("bounce", {"contact.restitution": 0.45}),
        ("mass_ratio", {"bodies.heavy.position": [0.12, 0, 0.15]}),  # beyond the edge
        ("pendulum", {"gravity": [0, 0, -9.5]}),
        ("pendulum", {"bodies.rod.velocity": [0, 0, -1], "bodies.rod.angular_velocity": [0, 2, 0]}),
        ("angular_momentum", {"bodies.brick.angular_velocity": [0, 5, 0.6]}),
        ("closed_loop", {"gravity": [0, 0, -9.5]}),
        ("wall", {"contact.friction": 0.333}),  # g_z/g_x = 1/3
        ("painleve", {"gravity": [0, 0, 9.81]}),
        ("bullet", {"bodies.wall.position": [0.0102, 0, 0], "contact.margin": 0.2}),  # 0.2 mm past
        ("chain", {"bodies.load.velocity": [1, 0, 0]}),
        ("top", {"bodies.top.angular_velocity": [5.6, 0, 12.7]}),
    ],
)
def test_a_measure_notices_another_motion(name, changed):
    runs = [moved(name, changed)] * len(NAMED[name].variants)
    assert not all(measured.holds for measured in NAMED[name].measure(runs)), NAMED[name].measure(runs)


def test_the_way_of_two_cubes_differs_as_their_speeds_and_their_friction_say():
    def farther(friction):
        speeds = [[2, 0, 0], [2.0001, 0, 0]]
        changed = [{"contact.friction": friction, "bodies.cube.velocity": speed} for speed in speeds]
        return NAMED["predictability"].measure([moved("predictability", own) for own in changed])[0]

    assert farther(0.5).holds
    assert farther(0.52).law == pytest.approx(2 / (0.5 * 9.81), rel=1e-4) and not farther(0.52).holds


def test_a_ball_whose_contacts_are_seen_early_enough_stays_before_the_wall():
    # At velocity level the gap is a row as soon as it is within the margin: 0.1 m in a step of 1 ms.
    assert NAMED["bullet"].measure([moved("bullet", {"contact.margin": 0.11})])[0].holds
    assert cards.run("lcplab", "acceleration", "bullet").holds
    assert not cards.run("lcplab", "velocity", "bullet").holds


def test_the_top_goes_round_as_the_torque_of_its_weight_says():
    column = cards.run("lcplab", "acceleration", "top")
    nods, goes_round = column.measured
    assert goes_round.law == pytest.approx(math.degrees(30.0), rel=1e-12)
    assert nods.value < 1e-4 and goes_round.value == pytest.approx(goes_round.law, rel=1e-6)


def test_the_rods_energy_after_it_jams_is_that_of_a_turn_about_its_tip():
    # v |r_z|/(I/m + r²) about the tip, which neither slides nor sinks in.
    run = moved("painleve", duration=0.001)
    r, inertia = np.array([0.5 - 0.01 * 2, -1 - 0.01]) / math.sqrt(5), (0.25 + 0.0001) / 3
    assert r == pytest.approx([0.2146625, -0.4516857], abs=1e-6)
    assert run.velocities[1, 1, 4] == pytest.approx(3 * -r[1] / (inertia + r @ r), rel=0.01)


@pytest.mark.parametrize("name", ["weight", "tower"])
def test_a_measure_notices_forces_that_lack_a_fiftieth_and_bodies_that_wander(name):
    run = moved(name, duration=2.0)
    assert all(measured.holds for measured in NAMED[name].measure([run]))
    poses = run.poses.copy()
    poses[-1, -1, 0] += 0.0011
    wrong = cards.Run(run.scene, run.dt, run.t, poses, run.velocities, 0.98 * run.forces)
    assert not all(measured.holds for measured in NAMED[name].measure([wrong]))


def test_joints_are_a_tree_from_the_world_and_what_closes_loops():
    scene = NAMED["closed_loop"].described({})
    joints = engines.joints(scene)
    assert [joint.closes for joint in joints] == [False, False, False, True]
    assert {joint.child for joint in joints[:3]} == {0, 1, 2}
    assert joints[0].parent is None
    for broken in ({"limits": [0, 1]}, {"effort": 1.0}, {"kind": "slider"}):
        hinge = {**scene["constraints"][0], **broken}
        with pytest.raises(engines.Unsupported):
            engines.joints({**scene, "constraints": [hinge]})


def chain():
    """Two bars in space: a slanting hinge at the world, a ball between them, both turned."""
    turn = {"quaternion": [0.8, 0.36, 0.48, 0.0]}
    return lcplab.Scene.described({
        "gravity": [1.0, -2.0, -9.0],
        "bodies": [
            {"name": "upper", "shape": {"box": [0.4, 0.1, 0.2]}, "mass": 2.0, "position": [0.2, 0, 0], "rotation": turn},
            {"name": "lower", "shape": {"box": [0.1, 0.5, 0.1]}, "mass": 1.0, "position": [0.5, 0.3, 0.1], "rotation": turn},
        ],
        "constraints": [
            {"kind": "hinge", "bodies": ["upper"], "point": [0, 0, 0], "axis": [0, 1, 1]},
            {"kind": "ball", "bodies": ["upper", "lower"], "point": [0.4, 0.1, 0.0]},
        ],
    })


@pytest.fixture(params=OTHERS)
def other(request):
    engine = engines.by_name(request.param)
    if not engine.is_installed:
        pytest.skip(f"{engine.package} is not installed")
    return engine, next(own for own in engine.settings if own.name == "accurate")


def test_a_translated_cube_flies_and_turns_as_it_must(other):
    column = cards.run(other[0].name, "accurate", "free_fall")
    assert column.holds, column


def test_a_translated_chain_moves_as_lcplabs_does(other):
    own = engines.by_name("lcplab")
    exact = cards.simulate(own, own.settings[1], chain(), 0.25)
    run = cards.simulate(*other, chain(), 0.25)
    np.testing.assert_allclose(run.poses[-1, :, :3], exact.poses[-1, :, :3], atol=0.01)
    turns = np.abs((run.poses[-1, :, 3:] * exact.poses[-1, :, 3:]).sum(axis=1))
    np.testing.assert_allclose(turns, 1, atol=1e-3)
    np.testing.assert_allclose(run.velocities[-1], exact.velocities[-1], atol=0.1)


def test_forces_of_a_cube_that_sticks_are_its_weight_in_all_directions(other):
    scene = NAMED["creep"].described({})
    try:
        run = cards.simulate(*other, scene, 1.0)
    except engines.Unsupported as why:
        pytest.skip(str(why))
    if run.forces is None:
        pytest.skip("forces are not told")
    mean = run.forces[run.after(0.5) :].mean(axis=0)
    told = [2] if other[0].name == "rapier" else [0, 1, 2]  # Rapier tells normal forces alone
    np.testing.assert_allclose(mean[1][told], -np.array(scene["gravity"])[told], atol=0.05)
    np.testing.assert_allclose(mean[0][told], np.array(scene["gravity"])[told], atol=0.05)


def test_what_an_engine_cannot_express_is_refused(other):
    engine, settings = other
    if engine.name != "pinocchio":  # to which bodies have no shape
        capsule = {"name": "peg", "shape": {"capsule": {"length": 1, "radius": 0.1}}, "mass": 1.0}
        with pytest.raises(engines.Unsupported, match="shape"):
            engine.build(lcplab.Scene.described({"bodies": [capsule]}), settings)
    pushed = {"name": "ball", "shape": {"sphere": 0.1}, "mass": 1.0, "force": [1.0, 0, 0]}
    with pytest.raises(engines.Unsupported, match="force"):
        engine.build(lcplab.Scene.described({"bodies": [pushed]}), settings)


def test_the_command_writes_a_record_that_the_report_draws(tmp_path, capfd):
    out = tmp_path / "page"
    assert main(["--engine", "lcplab", "--phenomenon", "free_fall,stopping", "--report", str(out)]) == 0
    record = json.loads((out / "engines.json").read_text(encoding="utf-8"))
    assert [own["name"] for own in record["phenomena"]] == ["free_fall", "stopping"]
    assert "Where does a sliding cube stop?" in (out / "index.html").read_text(encoding="utf-8")
    assert "✓  stops after" in capfd.readouterr().out


def test_mujocos_own_forces_solve_the_problem_that_it_poses():
    pytest.importorskip("mujoco")
    found = frames("mujoco")
    assert [(own["phenomenon"], own["rows"]) for own in found] == [
        ("creep", 16), ("stopping", 8), ("weight", 48), ("mass_ratio", 32)  # four a corner; what slides is on its front two
    ]
    for own in found:
        assert own["verdict"] == "proved" and own["residual"] < 1e-6, own
        assert {"newton", "dantzig", "lemke"} <= {s["solver"] for s in own["solvers"] if s["accepted"]}
    engine = engines.by_name("mujoco")
    world = engine.build(NAMED["stopping"].described({}), engine.settings[0])
    for _ in range(100):
        world.step()
    problem, answer = world.problem()
    assert not lcplab.judge(problem, x=0.99 * answer, tolerance=1e-6)


def test_an_engine_that_was_translated_wrongly_is_left_out_of_the_record():
    right = cards.run("lcplab", "velocity", "free_fall")
    wrong = replace(right, engine="mujoco", settings="accurate", measured=[replace(right.measured[0], value=0.0)])
    other = replace(wrong, measured=right.measured)
    kept = cards.record([("free_fall", right), ("free_fall", wrong), ("lift", other)])
    assert [engine["name"] for engine in kept["engines"]] == ["lcplab"]
    assert [own["name"] for own in kept["phenomena"]] == ["free_fall"]


def test_unknown_engines_and_phenomena_are_one_message(capfd):
    assert main(["--engine", "magic"]) == 2
    assert "there is no engine 'magic'; known are mujoco" in capfd.readouterr().err
    assert main(["--phenomenon", "magic"]) == 2
    assert "there is no phenomenon 'magic'; known are free_fall" in capfd.readouterr().err


@pytest.mark.parametrize("name", ["creep", "weight", "angular_momentum"])
@pytest.mark.parametrize("settings", ["defaults", "accurate"])
def test_the_pinned_mujoco_gives_the_numbers_of_the_shipped_record(name, settings):
    file = Path(__file__).parents[2] / "reports" / "engines.json"
    record = json.loads(file.read_text(encoding="utf-8"))
    recorded = next(own for own in record["engines"] if own["name"] == "mujoco")
    engine = engines.by_name("mujoco")
    if not engine.is_installed or engine.version != recorded["version"]:
        pytest.skip(f"mujoco {recorded['version']} is not installed")
    phenomenon = next(own for own in record["phenomena"] if own["name"] == name)
    of = next(own for own in phenomenon["columns"] if (own["engine"], own["settings"]) == ("mujoco", settings))
    found = [(m.value, m.tolerance) for m in cards.run("mujoco", settings, name).measured]
    for (value, tolerance), told in zip(found, of["measured"], strict=True):
        assert value == pytest.approx(told["value"], rel=1e-3, abs=1e-3 * tolerance)
