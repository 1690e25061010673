"""Are MuJoCo's contact forces a solution? A step of two boxes on a floor, judged in ten lines."""

import mujoco
import numpy as np

import lcplab

XML = """<mujoco><option cone="pyramidal" jacobian="dense" iterations="1000" ls_iterations="1000" tolerance="0"/><worldbody>
<geom type="plane" size="5 5 .1"/>
<body pos="0 0 .1"><freejoint/><geom type="box" size=".1 .1 .1"/></body>
<body pos=".03 .01 .3"><freejoint/><geom type="box" size=".1 .1 .1"/></body></worldbody></mujoco>"""


def main():
    model = mujoco.MjModel.from_xml_string(XML)
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 20)
    mujoco.mj_forward(model, data)
    J = data.efc_J.reshape(data.nefc, model.nv)
    inverse_M_J = np.zeros_like(J)
    mujoco.mj_solveM(model, data, inverse_M_J, np.ascontiguousarray(J))
    A = J @ inverse_M_J.T + np.diag(data.efc_R)  # MuJoCo's contacts are soft: A + R
    b = J @ data.qacc_smooth - data.efc_aref
    verdict = lcplab.judge(A, b, data.efc_force, tolerance=1e-6)
    print(data.nefc, "rows:", verdict)
    return verdict


if __name__ == "__main__":
    main()
