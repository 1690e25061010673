"""Are MuJoCo's contact forces a solution? The receipt of a step of two boxes on a floor."""

import mujoco

import lcplab

XML = """<mujoco model="two boxes"><worldbody>
<geom type="plane" size="5 5 .1"/>
<body name="lower" pos="0 0 .1"><freejoint/><geom type="box" size=".1 .1 .1"/></body>
<body name="upper" pos=".03 .01 .3"><freejoint/><geom type="box" size=".1 .1 .1"/></body></worldbody></mujoco>"""


def main():
    model = mujoco.MjModel.from_xml_string(XML)
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 20)
    mujoco.mj_forward(model, data)
    receipt = lcplab.receipt(model, data)
    print(receipt)
    return receipt


if __name__ == "__main__":
    main()
