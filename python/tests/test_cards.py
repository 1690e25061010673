"""Engine cards: laws against SciPy, engines of others against lcplab, and measures that can fail."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation
from scipy.special import ellipj, ellipk

import lcplab
from lcplab import cards, engines
from lcplab.cards import PHENOMENA
from lcplab.cards import _run
from lcplab.cards.__main__ import main
from lcplab.cards._elliptic import first_kind, sine
from lcplab.cards._frames import frames
from lcplab.cards._solver import part
from lcplab.cards.phenomena import bricard, capstan, trees

NAMED = {phenomenon.name: phenomenon for phenomenon in PHENOMENA}
OTHERS = [name for name in engines.NAMES if name != "lcplab"]


def velocity():
    own = engines.by_name("lcplab")
    return own, own.settings[0]


def moved(name, changed=None, duration=None):
    """A run by lcplab of the scene with fields changed, measured as the scene without."""
    phenomenon = NAMED[name]
    reported = phenomenon.described(phenomenon.variants[-1])
    scene = phenomenon.described({**phenomenon.variants[-1], **(changed or {})})
    run = cards.simulate(*velocity(), scene, duration or phenomenon.duration)
    return cards.Run(reported, run.dt, run.t, run.poses, run.velocities, run.forces)


def test_elliptic_integrals_are_scipys():
    for k in (0.0, 0.1, 0.5, math.sin(math.pi / 4), 0.999):
        assert first_kind(k) == pytest.approx(ellipk(k * k), rel=1e-14)
        u = np.linspace(-7, 20, 50)
        np.testing.assert_allclose(sine(u, k), ellipj(u, k * k)[0], atol=1e-13)


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


def test_the_way_of_bricards_mechanism_is_closed_and_its_curve_solves_lagranges_equation():
    scene = NAMED["bricard"].described({})
    run = cards.Run(scene, 0.1, np.zeros(1), np.zeros((1, 5, 7)), np.zeros((1, 5, 6)), None)
    points, axes = np.array([joint["point"] for joint in scene["constraints"]]), "yzxyzx"
    signs = [-1, 1, 1, -1, 1, 1]

    def chain(psi):
        """The rods' middles and frames, by rotations about the scene's hinges; where the last hinge is, and by how much
        the world would be turned after it."""
        theta, phi = 2 * math.atan(math.sqrt(3) * math.cos(psi)), 2 * math.asin(math.sqrt(0.75) * math.sin(psi))
        frame, end, middles, frames = Rotation.identity(), points[0], [], []
        for k in range(5):
            turn = signs[k] * ((theta, phi)[k % 2] - math.pi / 2)
            frame = frame * Rotation.from_euler(axes[k], turn)
            along = frame.apply(points[k + 1] - points[k])
            middles.append(end + along / 2)
            frames.append(frame)
            end = end + along
        turn = signs[5] * (phi - math.pi / 2)
        return np.array(middles), frames, end, (frame * Rotation.from_euler("x", turn)).magnitude()

    def energies(psi, d=1e-5):
        (one, before, *_), (other, after, *_) = chain(psi - d), chain(psi + d)
        inertia = ((other - one) ** 2).sum() / (2 * d) ** 2
        for k, moments in enumerate(body["inertia"] for body in scene["bodies"]):
            inertia += np.array(moments) @ ((before[k].inv() * after[k]).as_rotvec() / (2 * d)) ** 2
        return inertia, 9.81 * chain(psi)[0][:, 2].sum()

    for psi in np.linspace(bricard.CUBE, math.pi - bricard.CUBE, 7):
        _, _, end, turned = chain(psi)
        assert np.abs(end - points[5]).max() < 1e-14 and turned < 1e-14
        np.testing.assert_allclose(np.ravel(bricard._energies(run, np.array([psi]))), energies(psi), rtol=1e-8)

    def rate(_, s, d=1e-5):
        low, here, high = np.transpose(bricard._energies(run, s[0] + np.array([-d, 0, d])))
        slope = (high - low) / (2 * d)
        return [s[1], -(slope[0] * s[1] ** 2 / 2 + slope[1]) / here[0]]

    t = np.linspace(0, 3, 31)
    exact = solve_ivp(rate, (0, 3), [bricard.CUBE, 0], t_eval=t, rtol=1e-9, atol=1e-10)
    angles = np.degrees(2 * np.arctan(math.sqrt(3) * np.cos(exact.y[0])))
    np.testing.assert_allclose(NAMED["bricard"].exact(cards.Curve(t, t), run), angles, atol=1e-3)


def test_bricards_mechanism_swings_as_its_inertia_says_where_steps_are_short():
    own, settings = velocity()
    for gravity, holds in ((9.81, True), (9.5, False)):
        scene = NAMED["bricard"].described({"gravity": [0, 0, -gravity]})
        run = cards.simulate(own, replace(settings, dt=0.0005), scene, 10.0)
        reported = replace(run, scene=NAMED["bricard"].described({}))
        assert all(measured.holds for measured in NAMED["bricard"].measure([reported])) == holds


@pytest.mark.parametrize(("settings", "h"), [("velocity", 0.001), ("xpbd", 0.005 / 20), ("soft", 2 * 0.005 / 8)])
def test_a_spring_of_lcplab_loses_what_an_implicit_step_takes(settings, h):
    swings, loses = cards.run("lcplab", settings, "spring").measured
    assert swings.holds and not loses.holds
    assert loses.value == pytest.approx(100 * (1 - math.exp(-50 * h * 10.5 * swings.law)), rel=1e-3)


def test_a_spring_of_lcplab_keeps_its_energy_where_the_integrator_takes_its_force():
    swings, loses = cards.run("lcplab", "acceleration", "spring").measured
    assert swings.holds and abs(loses.value) < 1e-4  # percent; a Runge-Kutta step of fourth order loses less


def test_a_spring_that_follows_its_law_keeps_it_and_another_does_not():
    spring, t = NAMED["spring"], np.linspace(0, 10, 10_001)
    scene = spring.described({})

    def hung(omega, damping):
        poses = np.tile([0, 0, -1.0, 1, 0, 0, 0], (len(t), 1, 1))
        poses[:, 0, 2] -= 9.81 / 50 * (1 - np.cos(omega * t) * np.exp(-damping * t))
        run = cards.Run(scene, 0.001, t, poses, np.zeros((len(t), 1, 6)), None)
        return [measured.holds for measured in spring.measure([run])]

    exact = math.sqrt(50)
    assert hung(exact, 0) == [True, True]
    assert hung(1.02 * exact, 0) == [False, True] and hung(exact, 0.001) == [True, False]


def test_a_thin_chain_without_weight_holds_what_the_formula_says():
    described = NAMED["capstan"].described({"bodies.heavy.mass": 3.0})
    thin = [{**body, "mass": 1e-12, "shape": {"sphere": 1e-12}} for body in described["bodies"][2:-1]]
    scene = {**described, "bodies": [*described["bodies"][:2], *thin, described["bodies"][-1]]}
    run = cards.Run(scene, 0.001, np.zeros(1), np.zeros((1, 20, 7)), np.zeros((1, 20, 6)), None)
    part = 0.3 * math.tan(math.radians(7.5))
    factor = ((1 + part) / (1 - part)) ** 12
    assert capstan._turns(run) == pytest.approx((math.exp(0.3 * math.pi), factor), rel=1e-12)
    assert capstan._limits(run) == pytest.approx((factor, 9.81 * (3 - factor) / (3 + factor)), rel=1e-9)


def test_a_chain_with_less_friction_slides_and_with_more_is_held():
    variants, measure = NAMED["capstan"].variants, NAMED["capstan"].measure
    reported = [NAMED["capstan"].described(variant) for variant in variants]

    def found(friction):
        scenes = [NAMED["capstan"].described({**variant, "contact.friction": friction}) for variant in variants]
        runs = [cards.simulate(*velocity(), scene, 0.4) for scene in scenes]
        return [own.holds for own in measure([replace(run, scene=one) for run, one in zip(runs, reported, strict=True)])]

    assert found(0.26) == [False, False] and found(0.305)[0] and not found(0.32)[1]


def test_an_error_that_stays_is_of_no_order():
    own, order = velocity()[0], NAMED["order"]

    def lacks(gravity):
        scene, reported = (order.described({"gravity": [0, 0, -g]}) for g in (gravity, 9.81))
        steps = [replace(own.settings[0], dt=0.001 * part) for part in order.steps]
        return order.measure([replace(cards.simulate(own, step, scene, 2.0), scene=reported) for step in steps])[0]

    assert lacks(9.81).holds
    assert lacks(9.5).value == pytest.approx(1, abs=0.05)


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
    "free_fall creep wall capstan lift stopping predictability painleve weight bounce order chain flying_tree standing_tree top"
    .split(),
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
        ("flying_tree", {"gravity": [0, 0, -9]}),
        ("standing_tree", {"contact.friction": 0.25}),
        ("standing_tree", {"gravity": [0, 0, -9.6]}),
    ],
)
def test_a_measure_notices_another_motion(name, changed):
    runs = [moved(name, changed)] * len(NAMED[name].variants)
    assert not all(measured.holds for measured in NAMED[name].measure(runs)), NAMED[name].measure(runs)


def test_a_tree_that_spins_as_one_body_has_the_momentum_and_energy_of_its_inertia():
    scene = NAMED["flying_tree"].described({})
    run = moved("flying_tree", duration=0.001)
    masses = np.array([body["mass"] for body in scene["bodies"]])
    places = np.array([body["position"] for body in scene["bodies"]])
    arms = places - masses @ places / masses.sum()
    inertia = np.zeros((3, 3))
    for body, mass, arm in zip(scene["bodies"], masses, arms, strict=True):
        w, *xyz = body["rotation"]["quaternion"]
        axes = Rotation.from_quat([*xyz, w]).as_matrix()
        inertia += axes @ np.diag(body["inertia"]) @ axes.T + mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    spin = np.array([4, 0.5, 0])
    momentum, energy = trees._invariants(run)
    np.testing.assert_allclose(momentum[0], inertia @ spin, rtol=1e-6, atol=1e-6)
    assert energy[0] == pytest.approx(spin @ inertia @ spin / 2, rel=1e-6)


@pytest.mark.parametrize("change", [(1, 1.02), (5, 1.05), (12, 0.9)])
def test_a_tree_whose_limb_or_twig_gains_speed_out_of_nothing_misses_its_law(change):
    run = moved("flying_tree")
    assert all(measured.holds for measured in NAMED["flying_tree"].measure([run]))
    body, factor = change
    velocities = run.velocities.copy()
    velocities[len(velocities) // 2 :, body] *= factor
    assert not all(measured.holds for measured in NAMED["flying_tree"].measure([replace(run, velocities=velocities)]))


def test_a_leg_of_the_standing_tree_has_the_thrust_of_statics():
    # About a leg's hinge, 0.28 m inside its foot and 0.5 m above the ground: the normal force and the weights of the foot
    # (1 kg) and of the chains at half the distance (1.2 kg) balance the friction.
    run, g = moved("standing_tree"), 9.81
    normal = (3 + 3 * (1 + 1.2)) * g / 3
    thrust = 0.28 / 0.5 * (normal - g - 1.2 * g / 2)
    assert thrust / normal == pytest.approx(0.28)
    plates = [run.number(f"plate {k}") for k in (1, 2, 3)]
    forces = run.forces[run.after(1.0) :, plates].mean(axis=0)
    np.testing.assert_allclose(forces[:, 2], -normal, rtol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(forces[:, :2], axis=1), thrust, rtol=1e-3)


def test_a_body_that_moves_on_its_joint_at_the_start_is_refused():
    scene = NAMED["flying_tree"].described({})
    joint, bodies = engines.joints(scene)[0], scene["bodies"]
    np.testing.assert_array_equal(engines.rates(joint, bodies, joint.child), [0.0])
    faster = [{**body, "angular_velocity": [4, 0.6, 0]} if k == joint.child else body for k, body in enumerate(bodies)]
    with pytest.raises(engines.Unsupported, match="moves at the start relative to the parent"):
        engines.rates(joint, faster, joint.child)


def test_the_way_of_two_cubes_differs_as_their_speeds_and_their_friction_say():
    def farther(friction):
        speeds = [[2, 0, 0], [2.0001, 0, 0]]
        changed = [{"contact.friction": friction, "bodies.cube.velocity": speed} for speed in speeds]
        return NAMED["predictability"].measure([moved("predictability", own) for own in changed])[0]

    assert farther(0.5).holds
    assert farther(0.52).law == pytest.approx(2 / (0.5 * 9.81), rel=1e-4) and not farther(0.52).holds


def test_a_ball_whose_contacts_are_seen_early_enough_stays_before_the_wall():
    # At velocity level the gap is a row as soon as it is within the margin: 0.1 m in a step of 1 ms. Unless the scene
    # states another one it is as wide as the ball flies in a step.
    def holds(margin):
        starts = [moved("bullet", {"contact.margin": margin, **place}) for place in NAMED["bullet"].variants]
        return NAMED["bullet"].measure(starts)[0].holds

    assert not holds(0.05) and holds(0.11)
    assert cards.run("lcplab", "acceleration", "bullet").holds
    assert cards.run("lcplab", "velocity", "bullet").holds


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


def test_a_tree_that_hangs_on_nothing_is_free(other):
    described = chain()
    scene = {**described, "constraints": described["constraints"][1:]}
    assert [joint.parent for joint in engines.joints(scene)] == [0]
    run = cards.simulate(*other, scene, 0.25)
    fallen = np.array(scene["gravity"]) * 0.25**2 / 2
    np.testing.assert_allclose(run.poses[-1] - run.poses[0], np.tile([*fallen, 0, 0, 0, 0], (2, 1)), atol=0.006)


def test_a_translated_spring_pulls_as_lcplabs_does(other):
    turn = {"quaternion": [0.8, 0.36, 0.48, 0.0]}
    box = {"shape": {"box": [0.4, 0.1, 0.2]}, "mass": 2.0, "rotation": turn}
    scene = lcplab.Scene.described({
        "bodies": [{"name": "upper", "position": [0, 0, 0], **box}, {"name": "lower", "position": [0.5, 0, -1], **box}],
        "constraints": [
            {"kind": "spring", "bodies": ["upper"], "points": [[0, 0, 1], [0.1, 0, 0]], "length": 0.7, "stiffness": 100},
            {"kind": "spring", "bodies": ["upper", "lower"], "points": [[0, 0.1, 0], [0.4, 0, -1]], "stiffness": 200},
        ],
    })
    own = engines.by_name("lcplab")
    exact = cards.simulate(own, replace(own.settings[0], dt=0.0001), scene, 0.25)
    try:
        run = cards.simulate(*other, scene, 0.25)
    except engines.Unsupported as why:
        assert other[0].name in ("pybullet", "dart", "pinocchio")
        pytest.skip(str(why))
    np.testing.assert_allclose(run.poses[-1, :, :3], exact.poses[-1, :, :3], atol=0.01)
    np.testing.assert_allclose(run.velocities[-1], exact.velocities[-1], atol=0.15)


def test_forces_of_a_cube_that_sticks_are_its_weight_in_all_directions(other):
    scene = NAMED["creep"].described({})
    try:
        run = cards.simulate(*other, scene, 1.0)
    except engines.Unsupported as why:
        pytest.skip(str(why))
    if run.forces is None:
        pytest.skip("forces are not reported")
    mean = run.forces[run.after(0.5) :].mean(axis=0)
    reported = [2] if other[0].name == "rapier" else [0, 1, 2]  # Rapier tells normal forces alone
    np.testing.assert_allclose(mean[1][reported], -np.array(scene["gravity"])[reported], atol=0.05)
    np.testing.assert_allclose(mean[0][reported], np.array(scene["gravity"])[reported], atol=0.05)


def test_what_an_engine_cannot_express_is_refused(other):
    engine, settings = other
    if engine.name != "pinocchio":  # to which bodies have no shape
        cylinder = {"name": "peg", "shape": {"cylinder": {"length": 1, "radius": 0.1}}, "mass": 1, "inertia": [1, 1, 1]}
        with pytest.raises(engines.Unsupported, match="shape"):
            engine.build(lcplab.Scene.described({"bodies": [cylinder]}), settings)
    pushed = {"name": "ball", "shape": {"sphere": 0.1}, "mass": 1.0, "force": [1.0, 0, 0]}
    with pytest.raises(engines.Unsupported, match="force"):
        engine.build(lcplab.Scene.described({"bodies": [pushed]}), settings)


def test_the_command_writes_a_record_that_the_report_draws(tmp_path, capfd):
    out = tmp_path / "page"
    assert main(["--engine", "lcplab", "--phenomenon", "free_fall,stopping", "--report", str(out)]) == 0
    record = json.loads((out / "engines.json").read_text(encoding="utf-8"))
    assert [own["name"] for own in record["phenomena"]] == ["free_fall", "stopping"]
    assert "Does a sliding cube stop at the right distance?" in (out / "index.html").read_text(encoding="utf-8")
    assert "✓  stops after" in capfd.readouterr().out


@pytest.mark.parametrize("name", ["engines.json", "engines.toml", "index.html"])
def test_nothing_is_written_through_a_link_in_a_folder(tmp_path, capfd, name):
    out, keys = tmp_path / "page", tmp_path / "keys"
    out.mkdir()
    keys.write_text("keys", encoding="utf-8")
    (out / name).symlink_to(keys)
    assert main(["--engine", "lcplab", "--phenomenon", "free_fall", "--report", str(out)]) == 2
    assert keys.read_text(encoding="utf-8") == "keys"
    assert "is a symbolic link" in capfd.readouterr().err


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
    posed = world.problem()
    assert not lcplab.judge(posed.problem, x=0.99 * posed.answer, tolerance=1e-6)


def brick():
    """A brick of three moments that lands turning, on a corner, and slides."""
    return lcplab.Scene.described({
        "gravity": [1.0, 0.5, -9.81],
        "contact": {"friction": 0.5},
        "bodies": [
            {"name": "floor", "fixed": True, "shape": {"plane": [0, 0, 1]}},
            {"name": "brick", "shape": {"box": [0.2, 0.1, 0.05]}, "mass": 2.0, "position": [0, 0, 0.15],
             "rotation": {"quaternion": [0.8, 0.36, 0.48, 0]}, "velocity": [1, 0.5, 0], "angular_velocity": [3, -2, 5]},
        ],
    })


def installed(name):
    engine = engines.by_name(name)
    if not engine.is_installed:
        pytest.skip(f"{engine.package} is not installed")
    return engine


def dense(triplets, rows, columns):
    matrix = np.zeros((rows, columns))
    for i, j, value in triplets:
        matrix[i, j] = value
    return matrix


def steps(engine, settings, scene, duration):
    """What is posed in each step in which something touches, and the velocities after it."""
    world = engine.build(scene, settings)
    for _ in range(round(duration / settings.dt)):
        try:
            posed = world.problem()
        except engines.Unsupported:
            continue
        yield posed, world.velocities()


@pytest.mark.parametrize(("name", "error"), [("pybullet", 1e-9), ("drake", 1e-6), ("dart", 1e-11)])
@pytest.mark.parametrize("scene", ["brick", "creep", "weight", "mass_ratio", "stopping"])
def test_an_engines_step_is_what_its_own_answer_makes_of_the_problem_that_is_posed(name, error, scene):
    # Drake's unknowns are the velocities. Its forces follow from them, and it stops when momentum is balanced to 1e-6
    # of itself or of the impulses, each entry over the root of its mass (Castro et al. 2022, SAP).
    engine = installed(name)
    described = brick() if scene == "brick" else NAMED[scene].described({})
    free = [not body["fixed"] for body in described["bodies"]]
    touched = 0
    for posed, velocities in steps(engine, engine.settings[0], described, 0.4):
        motion, n = posed.more["motion"], len(posed.answer)
        target, k = np.array(motion["target"]), len(motion["target"])
        half, jacobian = dense(motion["mass"], k, k), dense(motion["jacobian"], n, k)
        mass = half + np.triu(half, 1).T
        reported = target + np.linalg.solve(mass, jacobian.T @ posed.answer)
        own = velocities[free].ravel()
        parts = mass @ (own - reported), mass @ own, jacobian.T @ posed.answer
        imbalance, momentum, impulse = (np.linalg.norm(part / np.sqrt(np.diag(mass))) for part in parts)
        assert imbalance <= error * max(momentum, impulse)
        problem = posed.problem
        matrix = jacobian @ np.linalg.solve(mass, jacobian.T) + np.diag(motion["compliance"])
        np.testing.assert_allclose(problem.A, matrix, atol=1e-9 * np.abs(matrix).max())
        np.testing.assert_allclose(problem.b, jacobian @ target + motion["bias"], atol=1e-12)
        assert [row["kind"] for row in posed.more["rows"][:3]] == ["normal", "friction", "friction"]
        touched += 1
    assert touched > 20


@pytest.mark.parametrize(
    ("name", "settings", "residual"),
    [
        ("pybullet", "accurate", 1e-9),
        ("drake", "defaults", 1e-5),
        ("dart", "defaults", 1e-10),
        ("dart", "accurate", 1e-10),
    ],
)
def test_an_engine_that_iterates_long_enough_solves_what_is_posed_of_it(name, settings, residual):
    engine = installed(name)
    chosen = next(own for own in engine.settings if own.name == settings)
    for scene in ("creep", "weight"):
        for posed, _ in list(steps(engine, chosen, NAMED[scene].described({}), 0.2))[-20:]:
            verdict = lcplab.judge(posed.problem, x=posed.answer, tolerance=residual)
            assert verdict, (scene, verdict)
            assert not lcplab.judge(posed.problem, x=0.99 * posed.answer, tolerance=residual)


@pytest.mark.parametrize("name", ["pybullet", "dart"])
def test_the_problem_of_a_bounce_asks_for_its_part_of_the_speed(name):
    engine = installed(name)
    bounces = 0
    for posed, velocities in steps(engine, engine.settings[0], NAMED["bounce"].described({}), 1.0):
        if velocities[1, 2] > 1.0:
            approach = posed.more["motion"]["target"][2]
            if approach < 0:
                assert velocities[1, 2] == pytest.approx(-0.5 * approach, rel=0.1)  # and what corrects the overlap
                assert lcplab.judge(posed.problem, x=posed.answer, tolerance=1e-9)
                bounces += 1
    assert bounces > 0


def test_bullets_friction_is_along_the_sliding_over_the_diagonal():
    # x_t is μ x_n along −w_t/a_t, entry by entry: up to 30° beside the sliding of a brick that stands on a corner.
    engine = installed("pybullet")
    angles = []
    for posed, _ in steps(engine, engine.settings[1], brick(), 0.4):
        matrix, x = posed.problem.A, posed.answer
        w = matrix @ x + posed.problem.b
        for i in range(0, len(x), 3):
            tangents = slice(i + 1, i + 3)
            if x[i] < 1e-3 or np.linalg.norm(w[tangents]) < 0.1:
                continue
            along = -w[tangents] / matrix.diagonal()[tangents]
            expected = 0.5 * x[i] * along / np.linalg.norm(along)
            np.testing.assert_allclose(x[tangents], expected, atol=1e-3 * x[i])
            cosine = -x[tangents] @ w[tangents] / np.linalg.norm(x[tangents]) / np.linalg.norm(w[tangents])
            angles.append(math.degrees(math.acos(min(cosine, 1.0))))
    assert max(angles) > 5


def test_pinocchios_solver_answers_the_problems_that_lcplab_poses():
    installed("pinocchio")
    found = frames("pinocchio")
    assert [own["phenomenon"] for own in found] == ["creep", "stopping", "weight", "mass_ratio"]
    for own in found:
        assert own["residual"] < 1e-4 and own["problem"]["model"] == "coulomb-cone", own
        assert "apgd" in {s["solver"] for s in own["solvers"] if s["accepted"]}


@pytest.mark.parametrize("name", ["mujoco", "pybullet", "drake", "dart", "pinocchio"])
def test_a_frame_is_a_problem_file_whose_worst_row_has_a_name(name, tmp_path):
    installed(name)
    found = frames(name)
    assert found
    for own in found:
        file = tmp_path / "frame.json"
        file.write_text(json.dumps(own["problem"]), encoding="utf-8")
        problem = lcplab.Problem.read(file)
        assert len(problem) == own["rows"] == len(own["answer"])
        assert lcplab.judge(problem, x=own["answer"], tolerance=1e-6).verdict == own["verdict"]
        assert name == "mujoco" or len(problem.to_json()["rows"]) == own["rows"]
        assert (own["row"] is None) == ("missed" not in own)
        if own["row"] is not None:
            assert 0 < own["missed"] < 2e-3  # m/s


def test_an_engine_that_was_translated_wrongly_is_left_out_of_the_record():
    right = cards.run("lcplab", "velocity", "free_fall")
    wrong = replace(right, engine="mujoco", settings="accurate", measured=[replace(right.measured[0], value=0.0)])
    other = replace(wrong, measured=right.measured)
    kept = cards.record([("free_fall", right), ("free_fall", wrong), ("lift", other)])
    assert [engine["name"] for engine in kept["engines"]] == ["lcplab"]
    assert [own["name"] for own in kept["phenomena"]] == ["free_fall"]


def test_records_of_engines_in_their_own_environments_are_one(tmp_path, capfd):
    one, other = (cards.record([(name, cards.run("lcplab", "velocity", name))]) for name in ("stopping", "free_fall"))
    foreign = json.loads(json.dumps(other).replace('"lcplab"', '"mujoco"'))
    files = [tmp_path / name for name in ("a.json", "b.json")]
    for file, own in zip(files, (one, foreign), strict=True):
        file.write_text(json.dumps(own), encoding="utf-8")
    assert main(["--merge", *map(str, files), "--out", str(tmp_path / "all.json")]) == 0
    both = json.loads((tmp_path / "all.json").read_text(encoding="utf-8"))
    assert [engine["name"] for engine in both["engines"]] == ["mujoco", "lcplab"]
    assert [own["name"] for own in both["phenomena"]] == ["free_fall", "stopping"]
    assert both["phenomena"][0]["columns"] == foreign["phenomena"][0]["columns"]
    foreign["engines"][0] |= {"name": "lcplab", "version": "0.0"}
    files[1].write_text(json.dumps(foreign), encoding="utf-8")
    assert main(["--merge", *map(str, files)]) == 2
    assert "lcplab: the records have the versions" in capfd.readouterr().err


def stop(error, **more):
    """A step that stops a body of 2 kg on a compliant row, with an error of its force."""
    return lcplab.EngineStep.of("mine", [[2.0]], [[1.0]], [0.0], [-3.0], [3.0 + error], compliance=0.5, **more)


def test_the_solvers_part_is_the_largest_error_of_the_reported_steps():
    scene = NAMED["stopping"].described({})
    run = cards.Run(scene, 0.001, np.zeros(1), np.zeros((1, 2, 7)), np.zeros((1, 2, 6)), None)

    def of(reported, why=""):
        return part([replace(run, reported=reported, unreported=why)])

    # The force 3 + e gives the motion -1.5 + e/2, and the constraints change it by 1.5: an error of e/3.
    found = of([stop(0.0), stop(0.03), stop(-0.3)])
    assert (found.steps, found.above, found.limit, found.is_bound) == (3, 2, 1e-6, True)
    assert 0.1 <= found.error < 0.15
    free = lcplab.EngineStep.of("mine", [[2.0]], np.zeros((0, 1)), [], [-3.0], [], [-3.0])
    assert of([free]).why == "no rows" and of([], "no report").why == "no report"
    hidden = stop(0.3, no_bound="because loops are not known")
    assert of([hidden]).why == "loops are not known" and of([hidden, stop(0.0)]).steps == 1


@pytest.mark.parametrize("name", [name for name in OTHERS if name != "rapier"])
def test_checked_steps_leave_a_run_as_it_is(name, monkeypatch):
    engine = installed(name)
    scene = NAMED["pendulum" if name == "pinocchio" else "weight"].described({})
    checked = cards.simulate(engine, engine.settings[0], scene, 0.1)
    monkeypatch.setattr(_run, "_take", lambda world, taken: world.step() or "")
    plain = cards.simulate(engine, engine.settings[0], scene, 0.1)
    # DART's order of contacts depends on addresses: any new object, as lcplab's copy of the world, changes its rounding.
    np.testing.assert_allclose(checked.poses, plain.poses, rtol=0, atol=1e-7 if name == "dart" else 0)
    assert not plain.reported and (len(checked.reported) >= 20 or checked.unreported)


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
    for (value, tolerance), reported in zip(found, of["measured"], strict=True):
        assert value == pytest.approx(reported["value"], rel=1e-3, abs=1e-3 * tolerance)
