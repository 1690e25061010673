"""Frames from MuJoCo: J, M, R, qacc_smooth and aref of a step, as MuJoCo's own dual problem states them.

Level acceleration: u_star = qacc_smooth (m/s^2), bias = -aref, R = efc_R, x = efc_force (N). Elliptic cones are
the law associated-cone; of pyramidal cones each edge is a row with x >= 0. Nothing is derived.

    python record_mujoco.py FOLDER
"""

import pathlib
import sys

import dm_control
import mujoco
import numpy as np
from mujoco import mjtConstraint as Kind

import mjcf
from frames import Rows

SUITE = pathlib.Path(dm_control.__file__).parent / "suite"


def suite(file):
    """A model of dm_control's suite (Apache 2.0) on its own; every pair touches with three rows."""
    text = (SUITE / file).read_text()
    assets = {}
    for path in (SUITE / "common").glob("*.xml"):
        assets[f"./common/{path.name}"] = path.read_bytes()
    for path in (SUITE / "dog_assets").glob("*"):
        assets[f"dog_assets/{path.name}"] = path.read_bytes()
    model = mujoco.MjModel.from_xml_string(text, assets)
    model.geom_condim[:] = 3
    return model


def record(folder, name, model, *, steps, push={}, cone="elliptic", control=(), impratio=1.0, scene=None):
    """Steps, then pushes (m/s, rad/s: six numbers of a free body), and writes the frame that they leave."""
    scene = scene or "mjcf.py"
    if isinstance(model, str):
        model = mujoco.MjModel.from_xml_string(model)
    model.opt.cone = getattr(mujoco.mjtCone, f"mjCONE_{cone.upper()}")
    model.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
    model.opt.impratio = impratio
    data = mujoco.MjData(model)
    data.ctrl[: len(control)] = control
    for _ in range(steps):
        mujoco.mj_step(model, data)
    for body, velocity in push.items():
        first = model.jnt_dofadr[model.body_jntadr[model.body(body).id]]
        data.qvel[first : first + 6] += np.array(velocity, float)
    mujoco.mj_forward(model, data)
    M = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, M)
    rows(model, data).save(
        pathlib.Path(folder) / f"{name}.npz",
        M,
        data.qacc_smooth,
        cone="associated-cone" if cone == "elliptic" else "box",
        level="acceleration",
        dt=model.opt.timestep,
        lightest=model.body_mass[moving(model)].min(),
        source={
            "engine": "MuJoCo",
            "version": mujoco.__version__,
            "scene": scene,
            "step": steps + 1,
            "push": {body: list(velocity) for body, velocity in push.items()},
            "bodies": len(moving(model)),
            "settings": f"cone={cone}, impratio={impratio}, Newton, default solref and solimp",
            "derived": "nothing",
        },
    )


def moving(model):
    """The bodies that can move and have a mass."""
    return np.flatnonzero((model.body_weldid != 0) & (model.body_mass > 0))


def rows(model, data):
    """The constraint rows of the step."""
    n, nv = data.nefc, model.nv
    J = data.efc_J.reshape(n, nv)
    found = Rows(nv)
    row = 0
    while row < n:
        kind = Kind(data.efc_type[row])
        bias, R = -data.efc_aref, data.efc_R
        if kind == Kind.mjCNSTR_CONTACT_ELLIPTIC:
            contact = data.contact[data.efc_id[row]]
            if contact.dim != 3 or contact.friction[0] != contact.friction[1]:
                sys.exit("a cone that is not circular in two directions")
            three = slice(row, row + 3)
            found.contact(J[three], contact.friction[0], bias[three], R[three])
            row += 3
            continue
        lo, hi = 0.0, np.inf
        if kind == Kind.mjCNSTR_EQUALITY:
            lo = -np.inf
        elif kind in (Kind.mjCNSTR_FRICTION_DOF, Kind.mjCNSTR_FRICTION_TENDON):
            hi = data.efc_frictionloss[row]
            lo = -hi
        found.add(J[row], bias[row], R[row], lo, hi)
        row += 1
    return found


def main(folder):
    put = lambda name, model, **settings: record(folder, f"mujoco_{name}", model, **settings)
    put("stack_pushed", mjcf.stack([1] * 5, shift=0.01, turn=8), steps=60, push={"box2": (1, 0.3, 0, 0, 0, 0)})
    put(
        "stack_heavy_top",
        mjcf.stack([0.2, 0.5, 2, 10, 50, 200], half=(0.15, 0.1, 0.05)),
        steps=100,
        push={"box0": (0.5, 1, 0, 0, 0, 3)},
        impratio=10,
    )
    put(
        "stack_pyramidal",
        mjcf.stack([2] * 4, turn=20, friction=0.4),
        steps=50,
        push={"box1": (-1, 0.6, 0, 0, 0, 1)},
        cone="pyramidal",
    )
    put(
        "pile_capsules",
        mjcf.pile(24, ["capsule", "sphere"], 2, width=0.25),
        steps=400,
        push={"body0": (1, 0, 0, 0, 0, 0)},
    )
    put(
        "pile_mixed",
        mjcf.pile(14, ["box", "capsule", "cylinder"], 3, width=0.22, friction=0.3),
        steps=350,
        push={"body5": (0, 0, -2, 0, 0, 0)},
    )
    put(
        "grasp_three_pyramidal",
        mjcf.grasp(3, mass=2, round=True),
        steps=200,
        control=(40, 4) * 3,
        cone="pyramidal",
        push={"object": (0, 0, -0.2, 0, 0, 1)},
    )
    put(
        "grasp_four",
        mjcf.grasp(4, mass=0.05),
        steps=200,
        control=(60, 2) * 4,
        impratio=100,
        push={"object": (0.2, 0, 0.1, 0, 0, 0)},
    )
    put("humanoid_standing", mjcf.humanoid(), steps=20, push={"pelvis": (0.8, 0, 0, 0, 0, 0)})
    put("humanoid_fallen_pyramidal", mjcf.humanoid(), steps=760, push={"pelvis": (0, 1, 0, 0, 0, 0)}, cone="pyramidal")
    put("humanoid_lying", mjcf.humanoid(height=0.25, lean=-90), steps=200, push={"pelvis": (0.5, 0.5, 0, 0, 0, 0)})
    put(
        "dog_suite",
        suite("dog.xml"),
        steps=300,
        push={"torso": (0.5, 0, -1, 0, 0, 0)},
        scene="dm_control suite/dog.xml",
    )
    put(
        "wall_long",
        mjcf.wall(3, 5, mass=0.5, friction=0.3),
        steps=60,
        push={"brick1_1": (0.2, 0.8, 0, 0, 0, 0)},
        impratio=10,
    )
    put("vehicle_loaded", mjcf.vehicle(load=30, steps=2), steps=100, push={"car": (1, 0.5, 0, 0, 0, 0)})
    put(
        "chain_on_posts",
        mjcf.chain(40, length=0.05, pos=(-0.4, 0, 0.16), posts=4),
        steps=250,
        push={"link0": (0, 0.5, 0, 0, 0, 0)},
    )
    put("arm_three_boxes", mjcf.arm(boxes=3), steps=100, control=(15, 8, 0), push={"box2": (0, 0.4, 0, 0, 0, 0)})


if __name__ == "__main__":
    main(sys.argv[1])
