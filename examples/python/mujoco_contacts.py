"""A step of a MuJoCo simulation as a problem file of lcplab, and MuJoCo's own answer to it.

MuJoCo's constraint forces f solve the dual problem (documentation, "Computation", "Dual problem")

    min over f in Omega   1/2 f' (A + R) f + f' (a0 - aref)        A = J inv(M) J'

so lcplab's matrix is A + R: R > 0 makes every contact soft, and f unique. b = J qacc_smooth - aref is an
acceleration (m/s^2), f a force (N). Omega is a box for pyramidal cones (each edge >= 0), for friction losses
and for limits; for elliptic cones it is |f_t| <= mu f_n, and the minimum is lcplab's model associated-cone.
"""

import argparse
import json
import sys

import mujoco
import numpy as np
from mujoco import mjtConstraint as Row

TWO_BOXES = """
<mujoco model="two boxes">
  <option timestep="0.005" cone="pyramidal"/>
  <default><geom friction=".3"/></default>
  <worldbody>
    <geom name="floor" type="plane" size="5 5 .1"/>
    <body name="lower" pos="0 0 .1"><freejoint/><geom name="lower" type="box" size=".1 .1 .1"/></body>
    <body name="upper" pos=".03 .01 .3" euler="0 0 10"><freejoint/><geom name="upper" type="box" size=".1 .1 .1"/></body>
  </worldbody>
</mujoco>
"""


def step(xml, cone, steps, push):
    """The simulation after so many steps and a push (m/s) of every body along x."""
    model = mujoco.MjModel.from_xml_path(xml) if xml else mujoco.MjModel.from_xml_string(TWO_BOXES)
    if cone:
        model.opt.cone = getattr(mujoco.mjtCone, f"mjCONE_{cone.upper()}")
    model.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
    model.opt.iterations, model.opt.ls_iterations, model.opt.tolerance = 1000, 1000, 0
    model.opt.noslip_iterations = 0  # it would change the forces after they are found
    data = mujoco.MjData(model)
    for _ in range(steps):
        mujoco.mj_step(model, data)
    for joint in np.flatnonzero(model.jnt_type == mujoco.mjtJoint.mjJNT_FREE):
        data.qvel[model.jnt_dofadr[joint]] += push
    mujoco.mj_forward(model, data)
    return model, data


def problem(model, data):
    """The step's dual problem as a problem file."""
    n = data.nefc
    J = data.efc_J.reshape(n, model.nv)
    inv_M_J = np.zeros((n, model.nv))
    mujoco.mj_solveM(model, data, inv_M_J, np.ascontiguousarray(J))
    A = J @ inv_M_J.T
    A = (A + A.T) / 2 + np.diag(data.efc_R)  # A is symmetric but for rounding
    b = J @ data.qacc_smooth - data.efc_aref
    lo, hi = np.zeros(n), np.full(n, np.inf)
    index, mu, rows = [-1] * n, [0.0] * n, []
    row = 0
    while row < n:
        kind = Row(data.efc_type[row])
        word = kind.name.removeprefix("mjCNSTR_").lower()
        if kind == Row.mjCNSTR_EQUALITY:
            lo[row] = -np.inf
        elif kind in (Row.mjCNSTR_FRICTION_DOF, Row.mjCNSTR_FRICTION_TENDON):
            lo[row], hi[row] = -data.efc_frictionloss[row], data.efc_frictionloss[row]
        elif kind == Row.mjCNSTR_CONTACT_ELLIPTIC:
            contact = data.contact[data.efc_id[row]]
            if contact.dim != 3 or contact.friction[0] != contact.friction[1]:
                sys.exit(f"contact {data.efc_id[row]}: only condim 3 with one coefficient is a circular cone")
            for tangent in (row + 1, row + 2):
                index[tangent], mu[tangent], lo[tangent] = row, contact.friction[0], -np.inf
            rows += [{"label": f"{axis} {data.efc_id[row]}", "kind": word, "unit": "N"} for axis in ("n", "t1", "t2")]
            row += 3
            continue
        rows.append({"label": f"{word} {data.efc_id[row]}", "kind": word, "unit": "N"})
        row += 1
    name = model.names.split(b"\0")[0].decode() or "model"  # the first name is that of the model
    number = lambda bound: bound if np.isfinite(bound) else ("inf" if bound > 0 else "-inf")
    file = {
        "name": f"{name} at {data.time:.3f} s",
        "source": f"MuJoCo {mujoco.__version__}: A + R, b = J qacc_smooth - aref; forces in N",
        "A": {"dense": A.tolist()},
        "b": b.tolist(),
        "lo": [number(bound) for bound in lo],
        "hi": [number(bound) for bound in hi],
        "rows": rows,
    }
    if any(k >= 0 for k in index):
        file |= {"friction_index": index, "mu": mu, "model": "associated-cone"}
    return file


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("xml", nargs="?", help="an MJCF file; two boxes on a floor without it")
    parser.add_argument("--cone", choices=["pyramidal", "elliptic"], help="the model's own without it")
    parser.add_argument("--steps", type=int, default=20, help="steps before the one that is written")
    parser.add_argument("--push", type=float, default=0.3, help="m/s along x, given to every free body")
    parser.add_argument("--out", default="contacts.json", help="the problem file")
    parser.add_argument("--answer", default="mujoco.json", help="MuJoCo's forces")
    options = parser.parse_args()
    model, data = step(options.xml, options.cone, options.steps, options.push)
    if data.nefc == 0:
        sys.exit("nothing touches: no constraint forces in this step")
    file = problem(model, data)
    with open(options.out, "w") as out:
        json.dump(file, out)
    with open(options.answer, "w") as out:
        json.dump({"x": data.efc_force.tolist(), "solver": f"MuJoCo {mujoco.__version__}"}, out)
    print(f"{options.out}: {file['name']}, {data.nefc} rows, {data.ncon} contacts; forces in {options.answer}")


if __name__ == "__main__":
    main()
