"""Write docs/models.md: public models and their import as scenes.

    pip install -r python/engines.txt gymnasium dm_control pybullet example-robot-data && python python/models.py
"""

import importlib.metadata
import re
import sys
from collections import Counter
from pathlib import Path

import mujoco
import numpy as np

ROOT = Path(__file__).resolve().parent
sys.path.insert(0, str(ROOT / "tests"))

from mujoco_reference import Reference, eliminated, joint_rows, mass_of, measured  # noqa: E402

import lcplab  # noqa: E402
from lcplab import _import  # noqa: E402
from lcplab._import.command import compiled  # noqa: E402

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
}

HEAD = """# Public models and their import

This page lists {count} models of four Python packages and what [`lcplab import`](import.md) does with them:
{complete} import without loss. MuJoCo itself does not compile {unread}. For the other {others}, `lcplab import` lists the parts that a
scene cannot express and stops; with `--skip` it imports the model without these parts. The column *no counterpart* counts them by
kind in the model's initial state: an element or an attribute of it (*armature*, *range*, …), a *joint* or a shape whose *type* a scene lacks, a
*flag* or an *option* of the whole model. A part with two such properties counts twice.

The last columns compare the scene with MuJoCo {mujoco} at a random state near the initial one, without the parts that
were skipped: the mass matrix M in joint coordinates; the accelerations of all bodies without contacts, limits and dry
friction (MuJoCo's `qacc_smooth` against lcplab's solution of the joint rows); and J M⁻¹Jᵀ of MuJoCo's own contact points
after the joint rows are eliminated. Each number is the largest difference relative to the largest entry. A dash means
that MuJoCo does not compile the model, that it has no contacts at that state, or that a joint was skipped, so that the mechanisms differ. The largest
difference on this page is {worst}.

`python python/models.py` writes this page. Versions: {versions}.

| kind | model | bodies | dof | no counterpart | M | accelerations | contacts |
| --- | --- | --- | --- | --- | --- | --- | --- |
"""


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


def main():
    lines, complete, unread, worst = [], 0, 0, 0.0
    for package, (folder, kinds) in MODELS.items():
        base = Path(mujoco.__file__).parent.parent / folder
        for kind, names in kinds.items():
            for name in names:
                print(name, file=sys.stderr)
                line, is_complete, errors = row(kind, package, base / name, name)
                lines.append(line)
                complete += is_complete is True
                unread += is_complete is None
                worst = max([worst, *errors])
    versions = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in MODELS)
    head = HEAD.format(count=len(lines), complete=complete, unread=unread, others=len(lines) - complete - unread, worst=f"{worst:.0e}", mujoco=mujoco.__version__, versions=versions)
    page = ROOT.parent / "docs" / "models.md"
    page.write_text(head + "".join(sorted(lines)), encoding="utf-8")
    print(f"{len(lines)} models, {complete} complete, largest difference {worst:.1e}")


if __name__ == "__main__":
    main()
