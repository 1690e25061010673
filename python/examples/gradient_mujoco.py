"""Is MuJoCo's derivative of a step right? `mjd_transitionFD`, compared with the exact derivative.

An arm presses a box onto the floor. A motor adds M^-1 gear to the accelerations without constraints, u*, so that the
velocities after the step change by dt (du/du*) M^-1 gear. With pyramidal cones the forces of the edges are an LCP with x >= 0.
"""

import json
import tempfile
from pathlib import Path

import mujoco
import numpy as np

import lcplab

XML = """<mujoco model="pressed box"><option cone="pyramidal" solver="Newton" tolerance="0" iterations="200"/>
<worldbody><geom type="plane" size="5 5 .1"/>
<body pos="0 0 .1"><freejoint/><geom type="box" size=".1 .1 .1" mass="2"/></body>
<body pos=".5 0 .27"><joint name="hinge" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 -.45 0 -.02" size=".05" mass="1"/></body>
</worldbody><actuator><motor joint="hinge" gear="3"/></actuator></mujoco>"""


def step_as_problem(model, data):
    """The problem of the accelerations, with masses and rows; and M."""
    M, J = np.zeros((model.nv, model.nv)), data.efc_J.reshape(data.nefc, model.nv)
    mujoco.mj_fullM(model, data, M)
    entries = lambda T: [[int(i), int(j), float(T[i, j])] for i, j in np.argwhere(T)]
    motion = {
        "mass": entries(np.triu(M)), "jacobian": entries(J), "level": "acceleration", "bias": (-data.efc_aref).tolist(),
        "compliance": data.efc_R.tolist(), "target": data.qacc_smooth.tolist(),
    }
    A = J @ np.linalg.solve(M, J.T) + np.diag(data.efc_R)
    b = J @ data.qacc_smooth - data.efc_aref
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "step.json"
        file.write_text(json.dumps({"A": {"dense": A.tolist()}, "b": b.tolist(), "motion": motion}))
        return lcplab.Problem.read(file), M


def main(control=-1.0):
    """MuJoCo's derivative of all velocities with respect to the control, the exact one, and that without contacts."""
    model = mujoco.MjModel.from_xml_string(XML)
    data = mujoco.MjData(model)
    data.ctrl[0] = control
    mujoco.mj_step(model, data, 100)
    mujoco.mj_forward(model, data)
    problem, M = step_as_problem(model, data)
    exact = lcplab.gradient(problem, data.efc_force)
    pushed = np.linalg.solve(M, [0, 0, 0, 0, 0, 0, model.actuator_gear[0, 0]])
    _, du = exact.jvp(target=pushed)
    theirs = np.zeros((2 * model.nv, model.nu))
    mujoco.mjd_transitionFD(model, data, 1e-6, True, None, theirs, None, None)
    dt = model.opt.timestep
    print(exact.certificate)
    return theirs[model.nv :, 0], dt * du, dt * pushed


if __name__ == "__main__":
    for name, derivative in zip(("MuJoCo", "exact", "without contacts"), main()):
        print(f"{name:<18}", derivative)
