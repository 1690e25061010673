"""A step of a MuJoCo simulation as a problem file of lcplab, and MuJoCo's own answer to it.

The engine's settings are those of the model: `lcplab.receipt` reads the step and changes nothing.
"""

import argparse

import mujoco
import numpy as np

import lcplab

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
    """The simulation after some steps and a push (m/s) of every free body along x."""
    model = mujoco.MjModel.from_xml_path(xml) if xml else mujoco.MjModel.from_xml_string(TWO_BOXES)
    if cone:
        model.opt.cone = getattr(mujoco.mjtCone, f"mjCONE_{cone.upper()}")
    data = mujoco.MjData(model)
    for _ in range(steps):
        mujoco.mj_step(model, data)
    for joint in np.flatnonzero(model.jnt_type == int(mujoco.mjtJoint.mjJNT_FREE)):
        data.qvel[model.jnt_dofadr[joint]] += push
    mujoco.mj_forward(model, data)
    return model, data


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("xml", nargs="?", help="an MJCF file; two boxes on a floor without it")
    parser.add_argument("--cone", choices=["pyramidal", "elliptic"], help="the model's own without it")
    parser.add_argument("--steps", type=int, default=20, help="steps before the one that is written")
    parser.add_argument("--push", type=float, default=0.3, help="m/s along x, given to every free body")
    parser.add_argument("--out", default="contacts.json", help="the problem file")
    parser.add_argument("--answer", default="contacts.x.json", help="MuJoCo's forces and motion")
    options = parser.parse_args()
    model, data = step(options.xml, options.cone, options.steps, options.push)
    receipt = lcplab.receipt(model, data)
    receipt.write(options.out, options.answer)
    print(receipt)


if __name__ == "__main__":
    main()
