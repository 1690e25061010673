"""Steps of MuJoCo with elliptic cones, solved by lcplab: the answers are proved."""

import json

import pytest

import lcplab

mujoco = pytest.importorskip("mujoco")
from lcplab.mujoco import problem  # noqa: E402

WORLD = """
<mujoco>
  <option cone="elliptic"/>
  <default><geom friction="{mu} 0 0" condim="3"/></default>
  <worldbody><geom type="plane" size="5 5 1" euler="0 {slope} 0"/>{bodies}</worldbody>
</mujoco>
"""


def body(place, turned, shape, size):
    return f'<body pos="{place}" euler="{turned}"><freejoint/><geom type="{shape}" size="{size}"/></body>'


BODIES = {
    "a box that lands": (0, body("0 0 .3", "10 20 0", "box", ".1 .15 .05")),
    "a stack": (0, "".join(body(f"{0.003 * k} 0 {0.1 + 0.2 * k}", "0 0 0", "box", ".1 .1 .1") for k in range(3))),
    "balls": (0, "".join(body(f"{0.15 * (k % 3)} {0.13 * (k // 3)} {0.1 + 0.05 * k}", "0 0 0", "sphere", ".08") for k in range(6))),
    "capsules": (0, "".join(body(f"0 {0.1 * k} {0.2 + 0.1 * k}", f"0 {80 + 5 * k} {20 * k}", "capsule", ".05 .15") for k in range(3))),
    "a slope": (25, body("0 0 .25", "0 25 0", "box", ".1 .1 .1")),
    "a pendulum that hits the floor": (
        0,
        '<body pos="0 0 .45"><joint type="hinge" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 .4 0 0" size=".03"/>'
        '<body pos=".4 0 0"><joint type="hinge" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 .3 0 0" size=".03"/></body></body>',
    ),
}


def frames(slope, bodies, mu):
    """The problem of every 25th step with contacts, at most twelve."""
    model = mujoco.MjModel.from_xml_string(WORLD.format(slope=slope, bodies=bodies, mu=mu))
    data = mujoco.MjData(model)
    if model.nv >= 6:
        data.qvel[:2] = 0.5, 0.2
    count = 0
    for step in range(600):
        mujoco.mj_step(model, data)
        if data.ncon and step % 25 == 0 and count < 12:
            count += 1
            yield problem(model, data)


def test_of_two_hundred_steps_nine_in_ten_have_a_proof_within_1e_9(tmp_path):
    place = tmp_path / "frame.json"
    found = []
    for slope, bodies in BODIES.values():
        for mu in (0.2, 0.6, 1.2):
            for frame in frames(slope, bodies, mu):
                place.write_text(json.dumps(frame))
                posed = lcplab.Problem.read(place)
                assert posed.model == "associated-cone"
                result = lcplab.solve(posed, tolerance=1e-12)
                assert result
                proof = lcplab.prove(posed, result.x)
                size = abs(result.x).max(initial=0.0)
                found.append(proof.data["distance"] / size if proof and size > 0 else float(not proof))
    assert len(found) >= 200
    within = sum(distance <= 1e-9 for distance in found)
    assert within >= 0.9 * len(found), f"{within} of {len(found)}"
