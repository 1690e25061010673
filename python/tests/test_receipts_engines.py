"""Receipts of DART, Drake, Pinocchio, PyBullet and Newton: a stack and a hinged chain are accepted, and planted bugs are rejected at their stage.

Engines that are not installed are skipped. A planted bug is that of an engine: the problem with one wrong part is solved
accurately, and its forces and motion are reported in place of the healthy engine's.
"""

from dataclasses import replace

import numpy as np
import pytest

import lcplab
import lcplab.dart
import lcplab.drake
import lcplab.pinocchio
import lcplab.pybullet

LINK = [0.25, 0.1, 0.1]
MASSES = (1.0, 2.0, 5.0)
#: Time step (s), number of steps, and the steps whose receipts are made.
DT, STEPS, EVERY = 1e-3, 400, 5


def dart_world(scene, detector="OdeCollisionDetector", dt=DT, masses=MASSES, friction=0.5, restitution=0.0, damping=0.0):
    """Three boxes of 1, 2 and 5 kg, or four hinged links of 1 to 4 kg, that fall on a floor."""
    dart = pytest.importorskip("dartpy")
    world = dart.simulation.World()
    world.setGravity([0, 0, -9.81])
    world.setTimeStep(dt)
    world.setCollisionDetector(getattr(dart.collision, detector)())

    def shaped(node, size, mass):
        shape = dart.dynamics.BoxShape(size)
        put = node.createShapeNode(shape)
        put.createCollisionAspect()
        surface = put.createDynamicsAspect()
        surface.setFrictionCoeff(friction)
        surface.setRestitutionCoeff(restitution)
        if mass:
            node.setInertia(dart.dynamics.Inertia(mass, np.zeros(3), shape.computeInertia(mass)))

    def placed(place):
        transform = dart.math.Isometry3()
        transform.set_translation(place)
        return transform

    floor = dart.dynamics.Skeleton("floor")
    joint, node = floor.createWeldJointAndBodyNodePair()
    joint.setTransformFromParentBodyNode(placed([0, 0, -0.5]))
    node.setName("floor")
    shaped(node, [4, 4, 1], 0)
    world.addSkeleton(floor)
    if scene == "stack":
        for k, mass in enumerate(masses):
            box = dart.dynamics.Skeleton(f"box {k}")
            joint, node = box.createFreeJointAndBodyNodePair()
            joint.setRelativeTransform(placed([0.02 * k, 0, 0.1 + 0.2 * k]))
            node.setName(f"box {k}")
            shaped(node, [0.2] * 3, mass)
            world.addSkeleton(box)
        return world
    chain, node = dart.dynamics.Skeleton("chain"), None
    for k in range(4):
        if node is None:
            joint, node = chain.createFreeJointAndBodyNodePair()
            joint.setRelativeTransform(placed([0, 0, 0.2]))
            joint.setLinearVelocity([2.0, 0, 0])
        else:
            hinge = dart.dynamics.RevoluteJointProperties()
            hinge.mAxis, hinge.mT_ParentBodyToJoint = [0, 1, 0], placed([0.35, 0, 0])
            joint, node = chain.createRevoluteJointAndBodyNodePair(node, hinge)
            joint.setPosition(0, 0.3)
            joint.setDampingCoefficient(0, damping)
        node.setName(f"link {k}")
        shaped(node, LINK, 1.0 + k)
    world.addSkeleton(chain)
    return world


def dart_frames(scene, every=EVERY, **settings):
    """Every fifth step with rows."""
    world = dart_world(scene, **settings)
    for k in range(STEPS):
        before = lcplab.dart.state(world)
        world.step()
        if k % every == 0 and world.getLastCollisionResult().getNumContacts():
            yield world, None, before


def drake_plant(scene, dt=DT, masses=MASSES, friction=0.5, stiffness=None, dissipation=None, damping=0.05, stiction=None, actuated=False):
    """The same scenes; the links have spheres, and slide."""
    drake = pytest.importorskip("pydrake.all")
    builder = drake.DiagramBuilder()
    plant, _ = drake.AddMultibodyPlantSceneGraph(builder, dt)
    if stiction is not None:
        plant.set_stiction_tolerance(stiction)
    own, surface = drake.RigidTransform, drake.ProximityProperties()
    material = {"point_stiffness": stiffness, "dissipation": dissipation, "friction": drake.CoulombFriction(friction, friction)}
    drake.AddContactMaterial(properties=surface, **{key: value for key, value in material.items() if value is not None})
    plant.RegisterCollisionGeometry(plant.world_body(), own([0, 0, -0.5]), drake.Box(4, 4, 1), "floor", surface)
    if scene == "stack":
        for k, mass in enumerate(masses):
            body = plant.AddRigidBody(f"box {k}", drake.SpatialInertia.SolidBoxWithMass(mass, 0.2, 0.2, 0.2))
            plant.RegisterCollisionGeometry(body, own(), drake.Box(0.2, 0.2, 0.2), "shape", surface)
            plant.SetDefaultFloatingBaseBodyPose(body, own([0.02 * k, 0, 0.1 + 0.2 * k]))
    else:
        parent = None
        for k in range(4):
            body = plant.AddRigidBody(f"link {k}", drake.SpatialInertia.SolidBoxWithMass(1.0 + k, *LINK))
            plant.RegisterCollisionGeometry(body, own(), drake.Sphere(0.06), "shape", surface)
            if parent is None:
                plant.SetDefaultFloatingBaseBodyPose(body, own([0, 0, 0.15]))
            else:
                sides = ((parent, 0.175), (body, -0.175))
                frames = [plant.AddFrame(drake.FixedOffsetFrame(f"{number} of {k}", side.body_frame(), own([x, 0, 0])))
                          for number, (side, x) in enumerate(sides)]
                plant.AddJoint(drake.RevoluteJoint(f"hinge {k}", *frames, [0, 1, 0], damping=damping))
            parent = body
    if actuated:
        plant.AddJointActuator("motor", plant.GetJointByName("hinge 1"))
    plant.Finalize()
    diagram = builder.Build()
    simulator = drake.Simulator(diagram)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    if scene == "chain":
        body = plant.GetBodyByName("link 0")
        plant.SetFreeBodySpatialVelocity(context, body, drake.SpatialVelocity(w=np.zeros(3), v=np.array([2.0, 0, 0])))
    return plant, context, simulator, diagram


def drake_frames(scene, every=EVERY, **settings):
    plant, context, simulator, diagram = drake_plant(scene, **settings)
    for k in range(STEPS):
        before = lcplab.drake.state(plant, context)
        simulator.AdvanceTo((k + 1) * plant.time_step())
        if k % every == 0 and plant.get_contact_results_output_port().Eval(context).num_point_pair_contacts():
            stiction = settings.get("stiction")
            yield lcplab.drake.step(plant, context, before, stiction_tolerance=stiction) if stiction else (plant, context, before)


FRAMES = {"dart": dart_frames, "drake": drake_frames}
SCENES = [(engine, scene) for engine in FRAMES for scene in ("stack", "chain")]


@pytest.mark.parametrize(("engine", "scene"), SCENES)
def test_a_healthy_engine_is_accepted(engine, scene):
    run = lcplab.receipts(FRAMES[engine](scene))
    assert run.ok and len(run.errors) == len(run.receipts) >= 20, str(run)
    first = next(iter(run.receipts.values()))
    assert any("does not report" in part for part in first.not_checked)


#: Good settings, listed before they were run: the engine's own defaults, and each documented setting once.
GOOD = [
    ("dart", "stack", {"detector": "FCLCollisionDetector"}),
    ("dart", "stack", {"detector": "DARTCollisionDetector"}),
    ("dart", "stack", {"detector": "BulletCollisionDetector"}),
    ("dart", "stack", {"dt": 5e-3}),
    ("dart", "stack", {"masses": (1.0, 10.0, 100.0)}),
    ("dart", "stack", {"friction": 0.0}),
    ("dart", "chain", {"restitution": 0.7}),
    ("dart", "chain", {"dt": 5e-3}),
    ("dart", "chain", {"friction": 1.0}),
    ("dart", "chain", {"damping": 0.2}),
    ("drake", "stack", {"dt": 5e-3}),
    ("drake", "stack", {"masses": (1.0, 10.0, 100.0)}),
    ("drake", "stack", {"friction": 0.0}),
    ("drake", "stack", {"stiffness": 1e4, "dissipation": 5.0}),
    ("drake", "stack", {"stiction": 1e-6}),
    ("drake", "chain", {"dt": 5e-3}),
    ("drake", "chain", {"stiction": 1e-2}),
    ("drake", "chain", {"friction": 1.0}),
    ("drake", "chain", {"stiffness": 1e5, "damping": 0.5}),
]


@pytest.mark.parametrize(("engine", "scene", "settings"), GOOD, ids=str)
def test_good_settings_are_no_false_alarm(engine, scene, settings):
    run = lcplab.receipts(FRAMES[engine](scene, every=2, **settings))
    assert run.ok and not run.rejected, str(run)
    assert len(run.receipts) >= 50


def steps_of(engine, scene):
    """The steps of a healthy run that have slip or load: every fourth."""
    return [receipt.step for receipt in lcplab.receipts(FRAMES[engine](scene)).receipts.values()][::4]


def solved(step):
    """The step with the accurate answer to its own problem."""
    mass, jacobian = step.dense_mass(), step.dense_jacobian()
    matrix = jacobian @ np.linalg.solve(mass, jacobian.T) + np.diag(step.compliance)
    answer = lcplab.solve((matrix + matrix.T) / 2, jacobian @ step.target + step.bias, step.lo, step.hi)
    motion = step.target + np.linalg.solve(mass, jacobian.T @ answer.x)
    return replace(step, forces=answer.x, motion=motion)


def wrong_sign(step):
    """The Jacobian of the most loaded row has the wrong sign while the engine solves and applies impulses."""
    row = int(np.argmax(step.forces))
    rows, columns, values = step.jacobian
    wrong = solved(replace(step, jacobian=(rows, columns, np.where(rows == row, -values, values))))
    return replace(step, forces=wrong.forces, motion=wrong.motion)


def applied_twice(step):
    """The impulses are right and applied twice."""
    return replace(step, motion=2 * step.motion - step.target)


def old_bound(step):
    """The bounds of friction are those of an iteration at which no normal impulse was known: 0."""
    is_normal = np.isinf(step.hi)
    wrong = solved(replace(step, lo=np.where(is_normal, step.lo, 0.0), hi=np.where(is_normal, step.hi, 0.0)))
    return replace(step, forces=wrong.forces, motion=wrong.motion)


@pytest.mark.parametrize("bug", [(wrong_sign, "solver"), (applied_twice, "write-back"), (old_bound, "solver")],
                         ids=lambda bug: bug[0].__name__)
@pytest.mark.parametrize(("engine", "scene"), SCENES)
def test_a_planted_bug_is_rejected_at_its_stage(engine, scene, bug):
    plant, stage = bug
    run = lcplab.receipts([plant(step) for step in steps_of(engine, scene)])
    assert not run.ok and run.stages[stage] >= 0.9 * len(run.receipts), str(run)


def test_a_stack_that_dart_pushes_apart_faster_than_its_limit_is_not_rejected():
    """In stacks of three bodies DART corrects deep overlaps without the limit that holds for a pair of bodies."""
    world, random, steps = dart_world("stack"), np.random.default_rng(7), []
    for number in range(1, world.getNumSkeletons()):
        world.getSkeleton(number).setVelocities(0.3 * random.normal(size=6))
    for _ in range(30):
        before = lcplab.dart.state(world)
        world.step()
        steps.append(lcplab.receipt(world, before=before))
    assert not [str(step) for step in steps if step.is_rejected]
    assert any("deep overlaps" in part for step in steps for part in step.not_checked)


def test_a_step_of_dart_changes_nothing_and_needs_the_state_before():
    world = dart_world("stack")
    for _ in range(50):
        before = lcplab.dart.state(world)
        world.step()
    after = lcplab.dart.state(world)
    lcplab.receipt(world, before=before)
    assert all(np.array_equal(one, other) for one, other in zip(after, lcplab.dart.state(world)))
    with pytest.raises(lcplab.InputError, match="before: is missing"):
        lcplab.receipt(world)
    with pytest.raises(lcplab.InputError, match="before: has the shapes"):
        lcplab.receipt(world, before=(before[0][:3], *before[1:]))


def test_commands_of_joints_and_external_forces_are_no_false_alarm():
    world = dart_world("chain")
    chain = world.getSkeleton(1)
    verdicts = []
    for k in range(STEPS):
        chain.setForces(np.array([0.0] * 6 + [0.5, -0.3, 0.2]) * np.sin(0.1 * k))
        if k == STEPS - 1:
            chain.getBodyNode(2).addExtForce([0.0, 0.0, 3.0])
        before = lcplab.dart.state(world)
        world.step()
        if k % EVERY == 0 or k == STEPS - 1:
            verdicts.append(lcplab.receipt(world, before=before).verdict)
    assert set(verdicts[20:-1]) == {"ok"} and verdicts[-1] == "not checked"


def test_an_actuated_plant_of_drake_is_not_checked():
    plant, context, simulator, diagram = drake_plant("chain", actuated=True)
    plant.get_actuation_input_port().FixValue(context, [0.5])
    before = lcplab.drake.state(plant, context)
    simulator.AdvanceTo(DT)
    receipt = lcplab.receipt(plant, context, before=before)
    assert not receipt.is_rejected and "actuation" in str(receipt)


def test_rows_that_dart_does_not_report_are_no_false_alarm():
    dart = pytest.importorskip("dartpy")
    world = dart_world("chain")
    tip = world.getSkeleton(1).getBodyNode(3)
    world.getConstraintSolver().addConstraint(dart.constraint.BallJointConstraint(tip, np.array([1.0, 0, 0.2])))
    before = lcplab.dart.state(world)
    world.step()
    receipt = lcplab.receipt(world, before=before)
    assert receipt.verdict == "not checked" and "impulses of constraints" in str(receipt)


@pytest.mark.parametrize("engine", FRAMES)
def test_the_problem_of_a_step_is_a_file_that_other_commands_read(engine, tmp_path):
    frames = FRAMES[engine]("stack")
    for _ in range(20):
        model, data, before = next(frames)
    arguments = (model, before) if engine == "dart" else (model, data, before)
    getattr(lcplab, engine).problem(*arguments, path=tmp_path / "a.json")
    assert lcplab.receipts([tmp_path]).ok
    assert lcplab.solve(lcplab.Problem.read(tmp_path / "a.json"))


def loop(q, v):
    """A chain of four hinges whose tip is held by a point: the arguments of ``constraintDynamics``, after it."""
    pin = pytest.importorskip("pinocchio")
    model, joint = pin.Model(), 0
    for k in range(4):
        axis = np.array([0.2 * k, 1.0, 0.1 * (k % 2)])
        kind = pin.JointModelRevoluteUnaligned(axis / np.linalg.norm(axis))
        joint = model.addJoint(joint, kind, pin.SE3(np.eye(3), np.array([0.3 if k else 0.0, 0, 0])), f"hinge {k}")
        inertia = pin.Inertia(1.0 + k, np.array([0.15, 0, 0]), np.diag([0.01, 0.02, 0.02]))
        model.appendBodyToJoint(joint, inertia, pin.SE3.Identity())
    data = model.createData()
    pin.forwardKinematics(model, data, np.array([0.3, -0.8, 0.5, 0.4]))
    tip = pin.SE3(np.eye(3), np.array([0.3, 0, 0]))
    held = pin.SE3(np.eye(3), data.oMi[joint].act(tip).translation)
    contact = pin.RigidConstraintModel(pin.ContactType.CONTACT_3D, model, joint, tip, 0, held)
    contact.m_baumgarte_parameters = pin.BaumgarteCorrectorParameters(10.0, 2 * 10**0.5)
    contacts, kept = [contact], [contact.createData()]
    pin.initConstraintDynamics(model, data, contacts, kept)
    arguments = (np.array(q), np.array(v), np.array([0.1, -0.2, 0.3, 0.0]), contacts, kept)
    pin.constraintDynamics(model, data, *arguments, pin.ProximalSettings(1e-12, 1e-12, 1e-10, 10))
    return model, data, *arguments


def loops():
    """States near the closed one, which is corrected."""
    random = np.random.default_rng(3)
    for _ in range(30):
        q = np.array([0.3, -0.8, 0.5, 0.4]) + 0.01 * random.normal(size=4)
        yield lcplab.pinocchio.step(*loop(q, random.normal(size=4)))


def test_a_loop_of_pinocchio_is_accepted_with_its_bias_by_differences():
    run = lcplab.receipts(loops())
    assert run.ok and len(run.errors) == 30, str(run)
    receipt = next(iter(run.receipts.values()))
    assert [finding.stage for finding in receipt.findings] == ["assembly", "solver"]


def smaller_bias(step):
    """A hundredth of the bias is missing."""
    bias = 0.99 * step.bias
    wrong = solved(replace(step, bias=bias))
    return replace(step, bias=bias, forces=wrong.forces, motion=wrong.motion)


# The rows of a loop are rigid: their forces, applied along another row than the reported one, do not cause the motion.
@pytest.mark.parametrize(("bug", "stage"), [(smaller_bias, "assembly"), (wrong_sign, "write-back"), (applied_twice, "write-back")])
def test_a_planted_bug_in_a_loop_of_pinocchio_is_rejected_at_its_stage(bug, stage):
    run = lcplab.receipts([bug(step) for step in loops()])
    assert run.stages == {stage: 30}, str(run)


def card_world(engine, scene):
    """A world of the engine cards."""
    from lcplab import engines

    own = engines.by_name(engine)
    if not own.is_installed:
        pytest.skip(f"{own.package} is not installed")
    return own.build(lcplab.Scene.described(scene), own.settings[0])


@pytest.mark.parametrize("engine", ["pybullet", "drake", "dart"])
def test_a_world_of_the_engine_cards_takes_a_step_and_is_accepted(engine):
    world = card_world(engine, "stack")
    for _ in range(20):
        world.step()
    receipt = lcplab.receipt(world)
    verdicts = ("ok", "unconverged") if engine == "pybullet" else ("ok",)
    assert receipt.verdict in verdicts, str(receipt)
    assert lcplab.receipt(applied_twice(receipt.step)).stage == "write-back"


def newton_step():
    """A step of the solver MuJoCo of Newton, in single precision: boxes of 1, 2 and 5 kg on a plane."""
    newton = pytest.importorskip("newton")
    warp = pytest.importorskip("warp")
    pytest.importorskip("mujoco_warp")
    warp.set_device("cpu")
    builder = newton.ModelBuilder()
    builder.add_ground_plane()
    for k, mass in enumerate(MASSES):
        body = builder.add_body(xform=warp.transform((0.02 * k, 0, 0.1 + 0.2 * k), warp.quat_identity()))
        shape = newton.ModelBuilder.ShapeConfig(density=mass / 0.008, mu=0.5)
        builder.add_shape_box(body, hx=0.1, hy=0.1, hz=0.1, cfg=shape)
    model = builder.finalize()
    solver = newton.solvers.SolverMuJoCo(model)
    now, then = model.state(), model.state()
    for _ in range(60):
        now.clear_forces()
        solver.step(now, then, model.control(), None, 2e-3)
        now, then = then, now
    return solver.mj_model, solver.mjw_data


def test_a_step_of_newton_is_accepted_and_planted_bugs_are_rejected():
    model, data = newton_step()
    receipt = lcplab.receipt(model, data)
    assert receipt.ok and receipt.step.bits == 32 and len(receipt.step) >= 12, str(receipt)
    assert lcplab.receipt(wrong_sign(receipt.step)).stage == "solver"
    assert lcplab.receipt(applied_twice(receipt.step)).stage == "write-back"


def test_an_engine_that_does_not_report_its_problem_says_so():
    from lcplab.engines import Unsupported

    with pytest.raises(Unsupported, match="Rapier does not report its problem"):
        lcplab.receipt(card_world("rapier", "stack"))


def pybullet_steps(damping=None, friction=0.7, masses=MASSES, restitution=0.0, drop=0.0, iterations=None):
    """Every fifth step of three boxes on a floor; a body has the damping of PyBullet unless it is given."""
    pybullet = pytest.importorskip("pybullet")
    client = pybullet.connect(pybullet.DIRECT)
    at = {"physicsClientId": client}
    try:
        pybullet.setGravity(0, 0, -9.81, **at)
        if iterations is not None:
            pybullet.setPhysicsEngineParameter(numSolverIterations=iterations, solverResidualThreshold=0.0, **at)
        for mass, half, place in ((0, [5, 5, 1], [0, 0, -1]),
                                  *((m, [0.1] * 3, [0.02 * k, 0, drop + 0.1 + 0.2 * k]) for k, m in enumerate(masses))):
            shape = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=half, **at)
            body = pybullet.createMultiBody(mass, shape, -1, place, **at)
            more = {} if damping is None else {"linearDamping": damping, "angularDamping": damping}
            pybullet.changeDynamics(body, -1, lateralFriction=friction, restitution=restitution, **more, **at)
        for k in range(200):
            before = lcplab.pybullet.state(client)
            pybullet.stepSimulation(**at)
            if k % EVERY == 0 and pybullet.getContactPoints(**at):
                yield lcplab.pybullet.step(before, client, **({} if damping is None else {"damping": damping}))
    finally:
        pybullet.disconnect(**at)


PYBULLET = [{}, {"damping": 0.0}, {"friction": 0.3}, {"masses": (1.0, 10.0, 100.0)}, {"restitution": 0.8, "drop": 0.3}]


@pytest.mark.parametrize("settings", PYBULLET, ids=str)
def test_the_motion_of_pybullet_is_that_of_its_impulses(settings):
    run = lcplab.receipts(pybullet_steps(**settings))
    assert not run.rejected and len(run.receipts) >= 30, str(run)


@pytest.mark.parametrize("settings", PYBULLET, ids=str)
def test_pybullet_satisfies_coulombs_law_if_its_solver_runs_long_enough(settings):
    run = lcplab.receipts(pybullet_steps(**settings, iterations=5000))
    assert run.ok and len(run.errors) == len(run.receipts) >= 30, str(run)
    assert all(receipt.ok for receipt in run.receipts.values()), str(run)


def test_the_defaults_of_pybullet_leave_a_stack_unconverged():
    """With 50 iterations, masses of 1, 10 and 100 kg move into each other at 0.14 m/s, 15 % of what the contacts change."""
    run = lcplab.receipts(pybullet_steps(masses=(1.0, 10.0, 100.0)))
    assert not run.ok and len(run.unconverged) >= 30 and run.quantiles["0.5"] > 0.1


@pytest.mark.parametrize("change", ["no friction", "sideways", "pulling", "half"])
def test_other_impulses_than_pybullets_are_no_solution(change):
    for step in pybullet_steps(friction=0.3, iterations=5000):
        forces = step.forces.copy()
        if change == "no friction":
            forces[1::3], forces[2::3] = 0, 0
        elif change == "sideways":
            forces[1::3], forces[2::3] = forces[2::3].copy(), -forces[1::3]
        elif change == "pulling":
            forces[0] *= -1
        else:
            forces *= 0.5
        motion = step.target + np.linalg.solve(step.dense_mass(), step.push(forces))
        if step.norm(motion - step.motion) > 1e-2 * step.effect:
            receipt = lcplab.receipt(replace(step, forces=forces, motion=motion, has_converged=True))
            assert receipt.stage == "solver" and receipt.is_rejected, str(receipt)


def test_impulses_that_pybullet_applies_twice_are_rejected():
    run = lcplab.receipts([applied_twice(step) for step in pybullet_steps()])
    assert run.stages == {"write-back": len(run.receipts)}


def test_a_velocity_or_a_force_that_is_not_of_pybullets_contacts_is_wrong():
    pybullet = pytest.importorskip("pybullet")
    client = pybullet.connect(pybullet.DIRECT)
    at = {"physicsClientId": client}
    try:
        pybullet.setGravity(0, 0, -9.81, **at)
        floor = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=[5, 5, 1], **at)
        pybullet.createMultiBody(0, floor, -1, [0, 0, -1], **at)
        box = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=[0.1] * 3, **at)
        body = pybullet.createMultiBody(2.0, box, -1, [0, 0, 0.1], **at)
        for _ in range(20):
            pybullet.stepSimulation(**at)

        def receipt(before_step, after_step):
            before = lcplab.pybullet.state(client)
            before_step()
            pybullet.stepSimulation(**at)
            after_step()
            return lcplab.receipt(lcplab.pybullet.step(before, client))

        def push():
            pybullet.applyExternalForce(body, -1, [0, 0, 5.0], [0, 0, 0], pybullet.LINK_FRAME, **at)

        def kick():
            pybullet.resetBaseVelocity(body, [0.1, 0, 0], **at)

        def nothing():
            pass

        assert receipt(nothing, nothing).verdict in ("ok", "unconverged")
        for done in (receipt(push, nothing), receipt(nothing, kick)):
            assert (done.verdict, done.stage) == ("wrong", "write-back")
    finally:
        pybullet.disconnect(client)


def test_bodies_of_pybullet_with_joints_are_invalid():
    pybullet = pytest.importorskip("pybullet")
    client = pybullet.connect(pybullet.DIRECT)
    try:
        shape = pybullet.createCollisionShape(pybullet.GEOM_SPHERE, radius=0.1, physicsClientId=client)
        pybullet.createMultiBody(
            1.0, shape, linkMasses=[1.0], linkCollisionShapeIndices=[shape], linkVisualShapeIndices=[-1],
            linkPositions=[[0, 0, 0.3]], linkOrientations=[[0, 0, 0, 1]], linkInertialFramePositions=[[0, 0, 0]],
            linkInertialFrameOrientations=[[0, 0, 0, 1]], linkParentIndices=[0], linkJointTypes=[pybullet.JOINT_REVOLUTE],
            linkJointAxis=[[0, 1, 0]], physicsClientId=client,
        )
        with pytest.raises(lcplab.InputError, match="has joints"):
            lcplab.pybullet.step(lcplab.pybullet.state(client), client)
    finally:
        pybullet.disconnect(client)
