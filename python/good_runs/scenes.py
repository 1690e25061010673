"""The scenes of the list: each yields frames, as `lcplab.receipts` takes them."""

import numpy as np

FLOOR = '<geom type="plane" size="5 5 .1"/>'
#: Degrees for joints that are moved by motors.
MOTORS = """<position joint="{0}" kp="40" kv="2" forcerange="-60 60"/>"""


def mjcf(bodies, option=None, rest=""):
    words = " ".join(f'{key}="{value}"' for key, value in (option or {}).items())
    return (f'<mujoco><compiler autolimits="true"/><size memory="64M"/><option {words}/>'
            f"<worldbody>{FLOOR}{bodies}</worldbody>{rest}</mujoco>")


def run(xml, speed=0.2, forward=False):
    """Steps of MuJoCo with motors that move and forces that push all bodies."""
    import mujoco

    model = mujoco.MjModel.from_xml_string(xml)
    data, random = mujoco.MjData(model), np.random.default_rng(7)
    data.qvel[:] = speed * random.normal(size=model.nv)
    for number in range(100_000):
        data.ctrl[:] = 0.4 * np.sin(0.02 * number + np.arange(model.nu))
        if number % 50 == 0:
            data.xfrc_applied[1:] = 0.3 * model.body_mass[1:, None] * random.normal(size=(model.nbody - 1, 6))
        before = data.qpos.copy(), data.qvel.copy()
        mujoco.mj_step(model, data)
        if forward:
            mujoco.mj_forward(model, data)
        yield (model, data) if forward else (model, data, before)


def heavy_top(option=None, forward=False):
    """Five boxes on each other; the top one is 100 times as heavy as the others."""
    boxes = "".join(
        f'<body pos="{0.01 * (k % 2)} 0 {0.1 + 0.2 * k}"><freejoint/>'
        f'<geom type="box" size=".1 .1 .1" mass="{100 if k == 4 else 1}"/></body>'
        for k in range(5)
    )
    return run(mjcf(boxes, option), 0.02, forward)


def humanoid(option=None, forward=False):
    """A torso with a head, arms and legs, whose joints have limits, damping and motors; it falls and lies."""

    def limb(name, place, axis, length, radius, inner, limits):
        return (f'<body pos="{place}"><joint name="{name}" axis="{axis}" range="{limits}" damping="1" armature=".01"/>'
                f'<geom type="capsule" fromto="0 0 0 0 0 -{length}" size="{radius}"/>{inner}</body>')

    parts = '<geom type="sphere" pos="0 0 .3" size=".1"/><geom type="capsule" fromto="0 -.1 0 0 .1 0" size=".12"/>'
    joints = []
    for side, y in (("left", 1), ("right", -1)):
        foot = f'<body pos="0 0 -.42"><joint name="{side} ankle" axis="0 1 0" range="-40 40" damping="1"/>' \
               '<geom type="box" pos=".05 0 -.03" size=".1 .05 .02" friction="1 .01 .001"/></body>'
        shin = limb(f"{side} knee", "0 0 -.42", "0 1 0", 0.38, 0.05, foot, "-5 120")
        thigh = limb(f"{side} hip", f"0 {0.1 * y} -.15", "0 1 0", 0.38, 0.06, shin, "-90 60")
        hand = limb(f"{side} elbow", "0 0 -.3", "0 1 0", 0.25, 0.03, "", "-130 5")
        arm = limb(f"{side} shoulder", f"0 {0.2 * y} .15", "1 0 0", 0.27, 0.04, hand, "-90 90")
        parts += thigh + arm
        joints += [f"{side} {name}" for name in ("hip", "knee", "ankle", "shoulder", "elbow")]
    motors = "".join(MOTORS.format(name) for name in joints)
    body = f'<body pos="0 0 1.1"><freejoint/>{parts}</body>'
    return run(mjcf(body, option, f"<actuator>{motors}</actuator>"), 0.5, forward)


def bin(option=None, forward=False):
    """Spheres, capsules, ellipsoids and cylinders of condim 1, 3, 4 and 6 that fall between four walls."""
    random = np.random.default_rng(3)
    walls = "".join(f'<geom type="box" pos="{x} {y} .3" size="{a} {b} .3"/>'
                    for x, y, a, b in ((0.35, 0, 0.02, 0.35), (-0.35, 0, 0.02, 0.35), (0, 0.35, 0.35, 0.02), (0, -0.35, 0.35, 0.02)))
    shapes = ("sphere", "capsule", "ellipsoid", "cylinder")
    bodies = "".join(
        f'<body pos="{random.uniform(-0.25, 0.25):.3f} {random.uniform(-0.25, 0.25):.3f} {0.1 + 0.11 * (k // 4):.3f}"><freejoint/>'
        f'<geom type="{shapes[k % 4]}" size="{random.uniform(0.03, 0.06):.3f} .04 .05" condim="{(1, 3, 4, 6)[k // 4 % 4]}"/></body>'
        for k in range(20)
    )
    return run(mjcf(walls + bodies, option), forward=forward)


def gripper(option=None, forward=False):
    """Two fingers, coupled by an equality, with friction loss and limits, that hold and lift a box."""
    fingers = "".join(
        f'<body pos="{x} 0 -.08"><joint name="{name}" type="slide" axis="{-np.sign(x)} 0 0" range="0 .1" frictionloss=".05"/>'
        '<geom type="box" size=".01 .04 .06" mass=".05" friction="1.5" condim="4"/></body>'
        for name, x in (("left", -0.12), ("right", 0.12))
    )
    bodies = (f'<body pos="0 0 .3"><joint name="lift" type="slide" axis="0 0 1" damping="5"/>'
              f'<geom type="box" size=".15 .05 .02" mass=".5"/>{fingers}</body>'
              '<body pos="0 0 .2"><freejoint/><geom type="box" size=".03 .03 .2" mass=".3"/></body>')
    rest = ('<equality><joint joint1="left" joint2="right"/></equality><actuator>'
            '<position joint="left" kp="300" ctrlrange=".05 .1"/><position joint="lift" kp="200"/></actuator>')
    return run(mjcf(bodies, option, rest), 0.02, forward)


def linkage(option=None, forward=False):
    """A four-bar linkage, closed by a connect equality, with a tendon that has a limit and friction loss, over a box."""
    bars = """<site name="post" pos="0 0 .9"/><body pos="-.3 0 .5"><joint name="crank" axis="0 1 0" damping=".02"/>
    <geom type="capsule" fromto="0 0 0 0 0 .2" size=".02"/><body pos="0 0 .2"><joint axis="0 1 0"/>
    <geom type="capsule" fromto="0 0 0 .5 0 .1" size=".02"/><site name="middle" pos=".25 0 .05"/>
    <body name="rocker" pos=".5 0 .1"><joint axis="0 1 0"/><geom type="capsule" fromto="0 0 0 .1 0 -.3" size=".02"/></body></body></body>
    <body pos="0 .3 .1"><freejoint/><geom type="box" size=".1 .1 .1"/></body>"""
    rest = """<equality><connect body1="rocker" anchor=".1 0 -.3"/></equality><tendon><spatial range="0 .25" frictionloss=".2">
    <site site="post"/><site site="middle"/></spatial></tendon><actuator><motor joint="crank" gear="4"/></actuator>"""
    return run(mjcf(bars, option, rest), 0.2, forward)


def trees(option=None, forward=False):
    """Free bodies with branches of hinged spheres, that fall into a walled box."""
    random = np.random.default_rng(11)

    def tree(depth, place, joint):
        branches = "".join(
            tree(depth - 1, " ".join(f"{value:.3f}" for value in 0.12 * direction / np.linalg.norm(direction)),
                 f'<joint axis="{" ".join(f"{value:.3f}" for value in random.normal(size=3))}" damping=".05"/>')
            for direction in random.normal(size=(2 if depth else 0, 3))
        )
        return f'<body pos="{place}">{joint}<geom size=".05" friction=".5"/>{branches}</body>'

    walls = "".join(f'<geom type="box" pos="{x} {y} .5" size="{a} {b} .5"/>'
                    for x, y, a, b in ((0.6, 0, 0.05, 0.6), (-0.6, 0, 0.05, 0.6), (0, 0.6, 0.6, 0.05), (0, -0.6, 0.6, 0.05)))
    bodies = "".join(tree(2, f"{0.2 * (k % 3 - 1)} 0 {0.4 + 0.5 * k}", "<freejoint/>") for k in range(3))
    return run(mjcf(walls + bodies, option), forward=forward)


def warp_stack(option=None):
    """Three boxes on a floor in MuJoCo Warp, on the processor."""
    import mujoco
    import mujoco_warp
    import warp

    warp.config.log_level = warp.LOG_WARNING
    warp.set_device("cpu")
    boxes = "".join(f'<body pos="{0.02 * k} 0 {0.1 + 0.205 * k}"><freejoint/><geom type="box" size=".1 .1 .1" mass="{m}"/></body>'
                    for k, m in enumerate((1, 2, 5)))
    model = mujoco.MjModel.from_xml_string(mjcf(boxes, {"iterations": "100", **(option or {})}))
    own = mujoco.MjData(model)
    own.qvel[:] = 0.2 * np.random.default_rng(7).normal(size=model.nv)
    mujoco.mj_forward(model, own)
    there = mujoco_warp.put_model(model)
    data = mujoco_warp.put_data(model, own, nconmax=64, njmax=512)
    for _ in range(100_000):
        mujoco_warp.forward(there, data)
        yield model, data
        mujoco_warp.step(there, data)


def drake_stack(dt=1e-3, masses=(1.0, 2.0, 5.0)):
    return _drake(dt, masses, False)


def drake_chain(dt=1e-3):
    return _drake(dt, (1.0, 2.0, 3.0, 4.0), True)


def _drake(dt, masses, is_chain):
    """Boxes on each other, or hinged links that slide on spheres, pushed again and again."""
    import pydrake.all as drake

    import lcplab.drake

    builder = drake.DiagramBuilder()
    plant, _ = drake.AddMultibodyPlantSceneGraph(builder, dt)
    own, surface, parent = drake.RigidTransform, drake.ProximityProperties(), None
    drake.AddContactMaterial(properties=surface, friction=drake.CoulombFriction(0.5, 0.5))
    plant.RegisterCollisionGeometry(plant.world_body(), own([0, 0, -0.5]), drake.Box(40, 40, 1), "floor", surface)
    for k, mass in enumerate(masses):
        body = plant.AddRigidBody(f"body {k}", drake.SpatialInertia.SolidBoxWithMass(mass, 0.2, 0.2, 0.2))
        shape = drake.Sphere(0.06) if is_chain else drake.Box(0.2, 0.2, 0.2)
        plant.RegisterCollisionGeometry(body, own(), shape, "shape", surface)
        if not is_chain or parent is None:
            plant.SetDefaultFloatingBaseBodyPose(body, own([0.02 * k, 0, 0.1 + 0.2 * k]))
        else:
            ends = [plant.AddFrame(drake.FixedOffsetFrame(f"{name} of {k}", at.body_frame(), own([x, 0, 0])))
                    for name, at, x in (("parent", parent, 0.175), ("child", body, -0.175))]
            plant.AddJoint(drake.RevoluteJoint(f"hinge {k}", *ends, [0, 1, 0], damping=0.05))
        parent = body
    plant.Finalize()
    diagram = builder.Build()
    simulator = drake.Simulator(diagram)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    random = np.random.default_rng(7)
    for number in range(100_000):
        if number % 300 == 0:
            plant.SetVelocities(context, 0.3 * random.normal(size=plant.num_velocities()))
        before = lcplab.drake.state(plant, context)
        simulator.AdvanceTo((number + 1) * dt)
        yield plant, context, before


def dart_stack(masses=(1.0, 2.0, 5.0), friction=0.5):
    return _dart(masses, friction, False)


def dart_chain(friction=0.5):
    return _dart((1.0, 2.0, 3.0, 4.0), friction, True)


def _dart(masses, friction, is_chain):
    """Boxes on each other, or hinged links, on a floor, pushed again and again."""
    import dartpy as dart

    import lcplab.dart

    world = dart.simulation.World()
    world.setGravity([0, 0, -9.81])
    world.setTimeStep(1e-3)
    world.setCollisionDetector(dart.collision.OdeCollisionDetector())

    def shaped(node, size, mass):
        shape = dart.dynamics.BoxShape(size)
        put = node.createShapeNode(shape)
        put.createCollisionAspect()
        put.createDynamicsAspect().setFrictionCoeff(friction)
        if mass:
            node.setInertia(dart.dynamics.Inertia(mass, np.zeros(3), shape.computeInertia(mass)))

    def placed(place):
        transform = dart.math.Isometry3()
        transform.set_translation(place)
        return transform

    def skeleton(name):
        made = dart.dynamics.Skeleton(name)
        made.setName(name)
        return made

    floor = skeleton("floor")
    joint, node = floor.createWeldJointAndBodyNodePair()
    joint.setTransformFromParentBodyNode(placed([0, 0, -0.5]))
    shaped(node, [40, 40, 1], 0)
    world.addSkeleton(floor)
    moving, node = [], None
    for k, mass in enumerate(masses):
        if is_chain and node is not None:
            hinge = dart.dynamics.RevoluteJointProperties()
            hinge.mAxis, hinge.mT_ParentBodyToJoint = [0, 1, 0], placed([0.35, 0, 0])
            joint, node = moving[0].createRevoluteJointAndBodyNodePair(node, hinge)
        else:
            moving.append(skeleton(f"body {k}"))
            joint, node = moving[-1].createFreeJointAndBodyNodePair()
            joint.setRelativeTransform(placed([0.02 * k, 0, 0.1 + 0.2 * k]))
        node.setName(f"body {k}")
        shaped(node, [0.25, 0.1, 0.1] if is_chain else [0.2] * 3, mass)
    for own in moving:
        world.addSkeleton(own)
    random = np.random.default_rng(7)
    for number in range(100_000):
        if number % 300 == 0:
            for own in moving:
                own.setVelocities(0.3 * random.normal(size=own.getNumDofs()))
        before = lcplab.dart.state(world)
        world.step()
        yield world, None, before


def pybullet_boxes(iterations):
    """Two boxes on a floor, which are pushed sideways again and again."""
    import pybullet

    import lcplab.pybullet

    pybullet.connect(pybullet.DIRECT)
    pybullet.setGravity(0, 0, -9.81)
    pybullet.setPhysicsEngineParameter(numSolverIterations=iterations, solverResidualThreshold=0.0)
    floor = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=[20, 20, 0.5])
    pybullet.createMultiBody(0, floor, basePosition=[0, 0, -0.5])
    shape = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=[0.1] * 3)
    boxes = [pybullet.createMultiBody(mass, shape, basePosition=[x, 0, 0.1]) for mass, x in ((1.0, 0.0), (3.0, 1.0))]
    random = np.random.default_rng(7)
    for number in range(100_000):
        if number % 100 == 0:
            for box in boxes:
                pybullet.resetBaseVelocity(box, [*random.normal(size=2), 0.0], [0.0, 0.0, 0.0])
        before = lcplab.pybullet.state()
        pybullet.stepSimulation()
        yield lcplab.pybullet.step(before)
