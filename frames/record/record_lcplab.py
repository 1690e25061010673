"""Frames from lcplab's own scenes: a scene is stepped, some bodies are pushed, and a later step is exported.

Level velocity: the arrays are those of the key `motion` of `lcplab export` (x in N s, w in m/s). Nothing is derived.

    python record_lcplab.py FOLDER [LCPLAB]
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

from frames import Rows

HEAD = """
[step]
dt = 0.01
count = 400
baumgarte = 0.2
[contact]
friction = {friction}
margin = {margin}
[[bodies]]
name = "ground"
fixed = true
shape = {{ plane = [0, 0, 1] }}
"""


def body(name, shape, mass, position, extra=""):
    """One body as TOML."""
    return f'[[bodies]]\nname = "{name}"\nshape = {shape}\nmass = {mass:.6g}\nposition = {list(position)}\n{extra}\n'


def wall():
    """Bricks in running bond, three layers."""
    text = HEAD.format(friction=0.5, margin=0.01)
    for k in range(3):
        for i in range(3 - k % 2):
            text += body(
                f"brick{k}{i}", "{ box = [0.4, 0.2, 0.1] }", 2, (0.404 * (i + 0.5 * (k % 2)), 0, 0.05 + 0.1 * k)
            )
    return text


def heap():
    """Balls and capsules of 0.2 to 20 kg that fall between four walls."""
    random = np.random.default_rng(4)
    text = HEAD.format(friction=0.4, margin=0.02)
    for i, normal in enumerate(([1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0])):
        place = [-0.35 * c for c in normal]
        text += f'[[bodies]]\nname = "side{i}"\nfixed = true\nshape = {{ plane = {normal} }}\nposition = {place}\n'
    for i in range(18):
        shape = "{ sphere = 0.12 }" if i % 2 else "{ capsule = { length = 0.2, radius = 0.09 } }"
        place = (*np.round(random.uniform(-0.15, 0.15, 2), 3), round(0.15 + 0.25 * i, 3))
        text += body(f"body{i}", shape, 0.2 * 10 ** (2 * random.uniform()), [float(c) for c in place])
    return text


def table():
    """A heavy slab on six light legs of boxes, with two boxes on it: each layer is carried by more than it needs."""
    text = HEAD.format(friction=0.7, margin=0.01)
    for i in range(6):
        text += body(f"leg{i}", "{ box = [0.1, 0.1, 0.5] }", 0.5, (0.5 * (i % 3) - 0.5, 0.6 * (i // 3) - 0.3, 0.25))
    text += body("slab", "{ box = [1.4, 0.9, 0.1] }", 200, (0, 0, 0.55))
    text += body("left", "{ box = [0.3, 0.3, 0.3] }", 5, (-0.4, 0, 0.75)) + body(
        "right", "{ box = [0.3, 0.3, 0.3] }", 50, (0.4, 0.1, 0.75)
    )
    return text


OWN = {"wall": wall, "heap": heap, "table": table}


def lcplab(*words):
    subprocess.run([LCPLAB, *map(str, words)], check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def record(folder, name, scene, *, steps, push, sets=(), after=1, turn=None):
    """Steps, then a push (m/s) of bodies (all of them: "*"), then the export of step `after`."""
    with tempfile.TemporaryDirectory() as work:
        work = pathlib.Path(work)
        start = scene
        if scene in OWN:
            start = work / f"{scene}.toml"
            start.write_text(OWN[scene]())
        options = [word for text in sets for word in ("--set", text)]
        lcplab("simulate", start, *options, "--steps", steps, "--out", work / "out")
        pushed = work / "pushed.toml"
        pushed.write_text(faster((work / "out" / "final.toml").read_text(), push))
        lcplab("export", pushed, "--step", after, "--out", work / "step.json")
        step = json.loads((work / "step.json").read_text())
    motion = step["motion"]
    rows = Rows(len(motion["target"]))
    J = filled(motion["jacobian"], len(step["b"]), rows.k)
    M = filled(motion["mass"], rows.k, rows.k)
    M = M + M.T - np.diag(np.diag(M))
    index = step.get("friction_index", [-1] * len(J))
    for i, k in enumerate(index):
        bounds = (float(step["lo"][i]), float(step["hi"][i]))
        rows.add(J[i], motion["bias"][i], motion["compliance"][i], *bounds, k, step["mu"][i] if k >= 0 else 0.0)
    version = subprocess.run([LCPLAB, "--version"], capture_output=True, text=True).stdout.split()[-1]
    rows.save(
        pathlib.Path(folder) / f"lcplab_{name}.npz",
        M,
        motion["target"],
        cone="coulomb-cone",
        level="velocity",
        dt=step["dt"],
        lightest=step["scale"] / 9.81 / step["dt"],
        source={
            "engine": "lcplab",
            "version": version,
            "scene": f"record_lcplab.py {scene}" if scene in OWN else f"scenes/{scene}.toml",
            "step": steps + after,
            "push": push,
            "bodies": len(step["bodies"]),
            "settings": ", ".join(sets) or "the scene's",
            "derived": "nothing",
        },
    )


def faster(text, push):
    """The scene with the push added to the velocities of its [[start]]."""
    head, *parts = text.split("[[start]]")
    for i, part in enumerate(parts):
        name = re.search(r'body = "(.*)"', part)[1]
        add = push.get(name, push.get("*"))
        if add:
            old = json.loads(re.search(r"^velocity = (\[.*\])", part, re.M)[1])
            new = f"velocity = {[a + b for a, b in zip(old, add)]}"
            parts[i] = re.sub(r"^velocity = \[.*\]", new, part, flags=re.M)
    return "[[start]]".join([head] + parts)


def filled(triplets, rows, columns):
    matrix = np.zeros((rows, columns))
    for i, j, value in triplets:
        matrix[i, j] = value
    return matrix


def main(folder):
    put = lambda name, scene, **settings: record(folder, name, scene, **settings)
    put("stack_pushed", "stack", steps=5, push={"box2": [1, 0.4, 0]}, after=3)
    put("stack15_pushed", "stack15", steps=3, push={"box8": [0.5, -1, 0]})
    put("mass_ratio_pyramid", "mass_ratio1", steps=3, push={"load": [1, 0.2, -1]})
    put("mass_ratio_thousand", "mass_ratio3", steps=5, push={"*": [0.2, 0.5, -0.3]})
    put("card_house", "card_house", steps=5, push={"*": [0.3, 0.1, 0]})
    put("arch_keystone", "arch", steps=3, push={"*": [0.2, 0.5, -0.5]}, sets=["contact.friction=0.4"])
    put("dominoes_first", "dominoes", steps=150, push={"*": [0.2, 0, 0]}, sets=["generate.count=5"])
    put("dominoes_fallen", "dominoes", steps=500, push={"*": [0.3, 0.6, 0]}, sets=["contact.friction=0.5"])
    put("rolling_balls", "rolling_balls", steps=20, push={"box": [1, 1, 0]})
    put("ramp", "friction_ramp", steps=10, push={"*": [0, 0.8, 0]})
    put("ragdoll_fallen", "ragdoll", steps=500, push={"*": [0.5, 0.5, 0]})
    put("pyramid_pushed", "pyramid", steps=3, push={"*": [0.4, -0.2, 0]}, sets=["generate.base=4"])
    put("wall", "wall", steps=5, push={"brick21": [0, 1, 0], "brick00": [0.5, 0, 0]})
    put("heap", "heap", steps=300, push={"body2": [1, 0, 1], "body9": [0, -1, 0]})
    put("table", "table", steps=5, push={"slab": [0.6, 0.3, 0]})


if __name__ == "__main__":
    LCPLAB = sys.argv[2] if len(sys.argv) > 2 else "lcplab"
    main(sys.argv[1])
