"""Frames from PyBullet: the step's problem is rebuilt from what PyBullet tells.

Level velocity (x in N s, w in m/s). Told: poses, velocities, masses, moments of inertia, joint axes, and the
contact points with normal and distance. Derived here:

- velocities: six of a base and one of each joint; M = G' diag(m I, inertia) G, where G turns them into the
  velocities of the links' centres of mass;
- tangents: any two that are perpendicular to the normal; mu is the product of the two bodies' coefficients, as in Bullet;
- bias = erp distance / dt of an overlap, distance / dt of a gap, with Bullet's erp 0.2; no restitution; R = 0;
- u_star = u + dt inv(M) (weights, gyroscopic torques of the links); terms G' of joint coordinates are left out;
- motors: a row for each with bounds +-(largest force) dt and the target speed; limits of joints: a row where one is near.

    python record_pybullet.py FOLDER
"""

import pathlib
import sys

import numpy as np
import pybullet as p
import pybullet_data

from frames import Rows, tangents

DT, ERP, GRAVITY = 1 / 240, 0.2, np.array([0, 0, -9.81])
NEAR = 0.02  # contacts and limits up to this gap (m, rad) are rows
JOINTS = (p.JOINT_REVOLUTE, p.JOINT_PRISMATIC)


def cross(r):
    return np.array([[0, -r[2], r[1]], [r[2], 0, -r[0]], [-r[1], r[0], 0]])


class Tree:
    """A body of PyBullet: a base, free or fixed, and links; `first` is its first velocity in u."""

    def __init__(self, body, first):
        self.body, self.first = body, first
        self.is_fixed = p.getDynamicsInfo(body, -1)[0] == 0 or body in FIXED
        self.joints = [j for j in range(p.getNumJoints(body)) if p.getJointInfo(body, j)[2] in JOINTS]
        base = 0 if self.is_fixed else 6
        self.column = {joint: base + i for i, joint in enumerate(self.joints)}
        self.size = base + len(self.joints)
        self.links = range(-1, p.getNumJoints(body))

    def center(self, link):
        """Position and orientation of a link's centre of mass."""
        if link < 0:
            return p.getBasePositionAndOrientation(self.body)
        return p.getLinkState(self.body, link, computeForwardKinematics=1)[:2]

    def jacobian(self, link, point):
        """6 x size: velocity of a link's point and angular velocity."""
        G = np.zeros((6, self.size))
        if not self.is_fixed:
            G[:3, :3] = G[3:, 3:6] = np.eye(3)
            G[:3, 3:6] = -cross(np.subtract(point, self.center(-1)[0]))
        while link >= 0:
            info = p.getJointInfo(self.body, link)
            if link in self.column:
                place, turn = p.getLinkState(self.body, link, computeForwardKinematics=1)[4:6]
                axis = np.reshape(p.getMatrixFromQuaternion(turn), (3, 3)) @ info[13]
                if info[2] == p.JOINT_REVOLUTE:
                    G[:3, self.column[link]] = np.cross(axis, np.subtract(point, place))
                    G[3:, self.column[link]] = axis
                else:
                    G[:3, self.column[link]] = axis
            link = info[16]
        return G

    def velocity(self):
        u = [] if self.is_fixed else np.concatenate(p.getBaseVelocity(self.body))
        return np.concatenate([u, [p.getJointState(self.body, joint)[1] for joint in self.joints]])

    def mass(self, u):
        """M, and the weights and gyroscopic torques as generalized forces."""
        M, force = np.zeros((self.size, self.size)), np.zeros(self.size)
        for link in self.links:
            mass, _, moments, _, turn = p.getDynamicsInfo(self.body, link)[:5]
            if mass == 0 or (link < 0 and self.is_fixed):
                continue
            place, attitude = self.center(link)
            R = np.reshape(p.getMatrixFromQuaternion(attitude), (3, 3))
            inertia = R @ np.diag(moments) @ R.T
            G = self.jacobian(link, place)
            spin = G[3:] @ u
            M += mass * G[:3].T @ G[:3] + G[3:].T @ inertia @ G[3:]
            force += mass * G[:3].T @ GRAVITY - G[3:].T @ np.cross(spin, inertia @ spin)
        return M, force


FIXED = set()  # bodies loaded with a fixed base


def frame():
    """Rows, M and u_star of the state that the world is in."""
    p.performCollisionDetection()
    trees, k = {}, 0
    for i in range(p.getNumBodies()):
        body = p.getBodyUniqueId(i)
        trees[body] = Tree(body, k)
        k += trees[body].size
    M, u_star, rows = np.zeros((k, k)), np.zeros(k), Rows(k)
    for tree in trees.values():
        if tree.size:
            part, u = slice(tree.first, tree.first + tree.size), tree.velocity()
            M[part, part], force = tree.mass(u)
            u_star[part] = u + DT * np.linalg.solve(M[part, part], force)
            drives(tree, rows, k)
    for contact in p.getContactPoints():
        touch(contact, trees, rows, k)
    return rows, M, u_star


def drives(tree, rows, k):
    """Rows of the motors that MOTORS names, and of joints at their limits."""
    for joint in tree.joints:
        row = np.zeros(k)
        row[tree.first + tree.column[joint]] = 1
        if (tree.body, joint) in MOTORS:
            speed, force = MOTORS[tree.body, joint]
            rows.add(row, -speed, lo=-force * DT, hi=force * DT)
        lower, upper = p.getJointInfo(tree.body, joint)[8:10]
        if lower < upper:
            angle = p.getJointState(tree.body, joint)[0]
            for side, gap in ((row, angle - lower), (-row, upper - angle)):
                if gap < NEAR:
                    rows.add(side, gap * (ERP if gap < 0 else 1) / DT)


MOTORS = {}  # (body, joint) to target speed and largest force


def touch(contact, trees, rows, k):
    """The three rows of a contact point; the normal points from B to A."""
    a, b, link_a, link_b, on_a, on_b, normal, distance = contact[1:9]
    if distance > NEAR or not (trees[a].size or trees[b].size):
        return
    axes = np.array([normal, *tangents(np.array(normal))])
    J = np.zeros((3, k))
    for sign, body, link, point in ((1, a, link_a, on_a), (-1, b, link_b, on_b)):
        tree = trees[body]
        J[:, tree.first : tree.first + tree.size] += sign * axes @ tree.jacobian(link, point)[:3]
    if not np.abs(J).max():
        return
    mu = p.getDynamicsInfo(a, link_a)[1] * p.getDynamicsInfo(b, link_b)[1]
    rows.contact(J, mu, (distance * (ERP if distance < 0 else 1) / DT, 0, 0))


def begin(friction=1.0):
    """An empty world with a floor."""
    p.resetSimulation()
    FIXED.clear(), MOTORS.clear()
    p.setTimeStep(DT)
    p.setGravity(*GRAVITY)
    p.setPhysicsEngineParameter(deterministicOverlappingPairs=1)
    floor = p.createMultiBody(0, p.createCollisionShape(p.GEOM_BOX, halfExtents=[10, 10, 1]), basePosition=[0, 0, -1])
    p.changeDynamics(floor, -1, lateralFriction=friction)


def add(kind, mass, place, euler=(0, 0, 0), friction=0.6, **size):
    """A free body."""
    shape = p.createCollisionShape(getattr(p, f"GEOM_{kind.upper()}"), **size)
    body = p.createMultiBody(mass, shape, -1, place, p.getQuaternionFromEuler(euler))
    p.changeDynamics(body, -1, lateralFriction=friction, linearDamping=0, angularDamping=0)
    return body


def load(file, place, euler=(0, 0, 0), fixed=False, friction=None):
    """A body of pybullet_data, its motors off."""
    body = p.loadURDF(file, place, p.getQuaternionFromEuler(euler), useFixedBase=fixed)
    if fixed:
        FIXED.add(body)
    for link in range(-1, p.getNumJoints(body)):
        p.changeDynamics(body, link, linearDamping=0, angularDamping=0, jointDamping=0)
        if friction is not None:
            p.changeDynamics(body, link, lateralFriction=friction)
    for joint in range(p.getNumJoints(body)):
        p.setJointMotorControl2(body, joint, p.VELOCITY_CONTROL, force=0)
    return body


def drive(body, speed, force, joints=None):
    """Motors of joints, with their target speed and largest force."""
    for joint in joints or [j for j in range(p.getNumJoints(body)) if p.getJointInfo(body, j)[2] in JOINTS]:
        p.setJointMotorControl2(body, joint, p.VELOCITY_CONTROL, targetVelocity=speed, force=force)
        MOTORS[body, joint] = (speed, force)


def push(body, velocity):
    """Adds to the velocity of a base (m/s)."""
    linear, angular = p.getBaseVelocity(body)
    p.resetBaseVelocity(body, np.add(linear, velocity).tolist(), angular)
    PUSHED.append([body, list(velocity)])


PUSHED = []


def step(count):
    for _ in range(count):
        p.stepSimulation()


def save(folder, name, scene, steps):
    rows, M, u_star = frame()
    masses = [
        p.getDynamicsInfo(body, link)[0]
        for body in map(p.getBodyUniqueId, range(p.getNumBodies()))
        for link in range(0 if body in FIXED else -1, p.getNumJoints(body))
    ]
    masses = [mass for mass in masses if mass > 0]
    rows.save(
        pathlib.Path(folder) / f"pybullet_{name}.npz",
        M,
        u_star,
        cone="coulomb-cone",
        level="velocity",
        dt=DT,
        lightest=min(masses),
        source={
            "engine": "PyBullet",
            "version": "3.2.7",
            "scene": scene,
            "step": steps + 1,
            "push": list(PUSHED),
            "bodies": len(masses),
            "settings": "sequential impulses, 50 iterations, erp 0.2, dt 1/240 s",
            "derived": "M, J, u_star, bias from poses, masses and getContactPoints; friction of each pair a product",
        },
    )
    PUSHED.clear()


def bricks(layers, across, half, mass, friction=0.7):
    return [
        add(
            "box",
            mass,
            (2.02 * half[0] * (i + 0.5 * (k % 2)), 0, half[2] * (2 * k + 1)),
            friction=friction,
            halfExtents=half,
        )
        for k in range(layers)
        for i in range(across - k % 2)
    ]


def stack(masses, half, x=0.0):
    return [add("box", m, (x + 0.01 * i, 0, half[2] * (2 * i + 1)), halfExtents=half) for i, m in enumerate(masses)]


def bin_of(width, height=0.5):
    for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        half = [0.05 if x else width, 0.05 if y else width, height]
        add("box", 0, (x * (width + 0.05), y * (width + 0.05), height), friction=0.5, halfExtents=half)


def chain(links, place):
    """Balls and boxes in turn on hinges."""
    shapes = [
        p.createCollisionShape(p.GEOM_SPHERE, radius=0.04),
        p.createCollisionShape(p.GEOM_BOX, halfExtents=[0.04, 0.02, 0.02]),
    ]
    count = links - 1
    body = p.createMultiBody(
        0.3,
        shapes[1],
        -1,
        place,
        linkMasses=[0.1 + 0.4 * (i % 2) for i in range(count)],
        linkCollisionShapeIndices=[shapes[i % 2] for i in range(count)],
        linkVisualShapeIndices=[-1] * count,
        linkPositions=[[0.09, 0, 0]] * count,
        linkOrientations=[[0, 0, 0, 1]] * count,
        linkInertialFramePositions=[[0, 0, 0]] * count,
        linkInertialFrameOrientations=[[0, 0, 0, 1]] * count,
        linkParentIndices=list(range(count)),
        linkJointTypes=[p.JOINT_REVOLUTE] * count,
        linkJointAxis=[[0, 1, 0] if i % 2 else [0, 0, 1] for i in range(count)],
    )
    for link in range(-1, count):
        p.changeDynamics(body, link, lateralFriction=0.5, linearDamping=0, angularDamping=0, jointDamping=0)
    for joint in range(count):
        p.setJointMotorControl2(body, joint, p.VELOCITY_CONTROL, force=0)
    return body


def free_bodies(folder):
    begin(0.8)
    masses = (50, 0.5, 20, 0.2, 5)
    boxes = [
        add("box", m, (0.02 * i, 0, 0.1 + 0.2 * i), (0, 0, 0.3 * i), halfExtents=[0.1, 0.1, 0.1])
        for i, m in enumerate(masses)
    ]
    step(30), push(boxes[3], (0.3, -0.6, 0)), step(1)
    save(folder, "stack_turned_mass_ratio", "record_pybullet.py: boxes of 50, 0.5, 20, 0.2 and 5 kg, each turned", 31)

    begin(0.7)
    boxes = bricks(4, 3, [0.12, 0.06, 0.05], 2.0)
    step(60), push(boxes[4], (0, 1.2, 0)), step(2)
    save(folder, "wall", "record_pybullet.py: bricks(4, 3)", 62)

    begin(0.6)
    bin_of(0.3)
    random = np.random.default_rng(5)
    balls = [
        add("sphere", float(random.choice([0.1, 1, 10])), (*random.uniform(-0.2, 0.2, 2), 0.1 + 0.12 * i), radius=0.08)
        for i in range(24)
    ]
    step(400), push(balls[0], (1, 1, 0)), step(1)
    save(folder, "pile_spheres", "record_pybullet.py: 24 balls of 0.1, 1 and 10 kg in a bin", 401)

    begin(0.6)
    bin_of(0.25)
    for i in range(16):
        place = (*random.uniform(-0.1, 0.1, 2), 0.1 + 0.16 * i)
        if i % 2:
            add("capsule", 1, place, random.uniform(-1, 1, 3), 0.4, radius=0.06, height=0.2)
        else:
            add("cylinder", 2, place, random.uniform(-1, 1, 3), 0.4, radius=0.08, height=0.12)
    step(450), push(p.getNumBodies() - 1, (0, 0, -1)), step(1)
    save(folder, "pile_capsules_cylinders", "record_pybullet.py: 8 capsules and 8 cylinders in a bin", 451)

    begin(0.8)
    tiles = [
        add("box", 0.2, (0.07 * i, 0, 0.1), (0, 0.25 if i == 0 else 0, 0), 0.3, halfExtents=[0.012, 0.05, 0.1])
        for i in range(9)
    ]
    step(75), push(tiles[5], (0.2, 0.2, 0)), step(1)
    save(folder, "dominoes", "record_pybullet.py: 9 dominoes", 76)

    begin(0.7)
    for k in range(3):
        for i in range(3):
            place = (0.07 * (i - 1), 0, 0.02 + 0.04 * k) if k % 2 else (0, 0.07 * (i - 1), 0.02 + 0.04 * k)
            half = [0.034, 0.105, 0.02] if k % 2 else [0.105, 0.034, 0.02]
            add("box", 0.3, place, friction=0.6, halfExtents=half)
    step(40), push(5, (0.4, 0, 0)), step(1)
    save(folder, "jenga", "record_pybullet.py: a tower of 3 layers of 3 planks", 41)

    begin(0.5)
    bodies = [
        load(
            "teddy_vhacd.urdf" if i % 2 else "duck_vhacd.urdf",
            (0.02 * i, 0.01 * i, 0.05 + 0.13 * i),
            (1.57, 0, 0.5 * i),
            friction=0.7,
        )
        for i in range(6)
    ]
    step(150), push(bodies[0], (0.5, 0, 0)), step(1)
    save(folder, "ducks_and_teddies", "pybullet_data duck_vhacd.urdf, teddy_vhacd.urdf", 151)


def trees(folder):
    begin(0.8)
    body = chain(20, (0, 0, 0.04))
    step(60), push(body, (0, 1, 0)), step(3)
    save(folder, "chain", "record_pybullet.py: 20 links on the floor", 63)

    begin(0.8)
    body = load("laikago/laikago_toes.urdf", (0, 0, 0.48), (1.57, 0, 1.57), friction=0.8)
    drive(body, 0, 20)
    add("box", 3, (0, 0, 0.66), halfExtents=[0.12, 0.06, 0.05])
    step(60), push(body, (1, 0.5, 0)), step(2)
    save(folder, "laikago_loaded", "pybullet_data laikago/laikago_toes.urdf with a box of 3 kg on its back", 62)

    begin(0.8)
    body = load("mini_cheetah/mini_cheetah.urdf", (0, 0, 0.25), friction=0.6)
    step(200), push(body, (0, 1, 0)), step(1)
    save(folder, "mini_cheetah_fallen", "pybullet_data mini_cheetah/mini_cheetah.urdf", 201)

    begin(0.9)
    body = load("husky/husky.urdf", (0, 0, 0.15), friction=0.8)
    drive(body, 5, 30)
    boxes = [
        add("box", m, (0.1 * i - 0.1, 0, 0.6 + 0.2 * i), halfExtents=[0.15, 0.15, 0.1]) for i, m in enumerate((5, 40))
    ]
    step(100), push(body, (0.5, 0.5, 0)), step(1)
    save(folder, "husky_loaded", "pybullet_data husky/husky.urdf with boxes of 5 and 40 kg", 101)

    begin(0.9)
    body = load("racecar/racecar.urdf", (0, 0, 0.1), friction=0.8)
    for i in range(3):
        add("box", 1, (0.15 * i, 0, 0.01), halfExtents=[0.05, 0.3, 0.01])
    step(100), push(body, (1, 0, 0)), step(1)
    save(folder, "racecar_on_boards", "pybullet_data racecar/racecar.urdf on 3 boards", 101)

    begin(0.7)
    body = load("kuka_iiwa/model.urdf", (-0.6, 0, 0), fixed=True, friction=0.5)
    for joint, angle in enumerate((0, 1.15, 0, -1.2, 0, 0.8, 0)):
        p.resetJointState(body, joint, angle)
    drive(body, 0, 200), drive(body, 0.5, 200, [1])
    boxes = [add("box", m, (0.02 + 0.21 * i, 0, 0.1), halfExtents=[0.1, 0.1, 0.1]) for i, m in enumerate((2, 5, 10))]
    step(120), push(boxes[1], (0, 0.3, 0)), step(1)
    save(folder, "kuka_pushes_boxes", "pybullet_data kuka_iiwa/model.urdf and boxes of 2, 5 and 10 kg", 121)

    begin(0.8)
    body = load("r2d2.urdf", (0, 0, 0.5), friction=0.6)
    stack([3, 1, 5], [0.2, 0.15, 0.1], x=0.75)
    drive(body, 2, 10, [j for j in range(p.getNumJoints(body)) if b"wheel_joint" in p.getJointInfo(body, j)[1]])
    step(50), push(body, (0.8, 0.2, 0)), step(30)
    save(folder, "r2d2_and_stack", "pybullet_data r2d2.urdf beside a stack of 3", 80)

    begin(0.9)
    fingers = grasp()
    drive(fingers, -0.2, 30)
    step(120), push(1 + fingers, (0, 0.2, 0)), step(1)
    save(folder, "grasp_two", "record_pybullet.py: two fingers on sliders close on two boxes", 121)


def grasp():
    """A fixed palm with two fingers on sliders; two boxes on each other stand between them."""
    palm = p.createCollisionShape(p.GEOM_BOX, halfExtents=[0.02, 0.02, 0.02])
    finger = p.createCollisionShape(p.GEOM_BOX, halfExtents=[0.01, 0.04, 0.08])
    body = p.createMultiBody(
        0,
        palm,
        -1,
        (0, 0, 0.5),
        linkMasses=[0.5, 0.5],
        linkCollisionShapeIndices=[finger] * 2,
        linkVisualShapeIndices=[-1] * 2,
        linkPositions=[[0.065, 0, -0.39], [-0.065, 0, -0.39]],
        linkOrientations=[[0, 0, 0, 1]] * 2,
        linkInertialFramePositions=[[0, 0, 0]] * 2,
        linkInertialFrameOrientations=[[0, 0, 0, 1]] * 2,
        linkParentIndices=[0, 0],
        linkJointTypes=[p.JOINT_PRISMATIC] * 2,
        linkJointAxis=[[1, 0, 0], [-1, 0, 0]],
    )
    for link in (0, 1):
        p.changeDynamics(body, link, lateralFriction=1, linearDamping=0, angularDamping=0, jointDamping=0)
    add("box", 0.5, (0, 0, 0.05), friction=0.8, halfExtents=[0.05, 0.05, 0.05])
    add("box", 2, (0, 0, 0.15), friction=0.8, halfExtents=[0.05, 0.05, 0.05])
    return body


def main(folder):
    p.connect(p.DIRECT)
    p.setAdditionalSearchPath(pybullet_data.getDataPath())
    free_bodies(folder)
    trees(folder)


if __name__ == "__main__":
    main(sys.argv[1])
