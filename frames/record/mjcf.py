"""Scenes in MJCF, which MuJoCo and Drake both read: plain shapes, so that nothing is downloaded."""

import numpy as np


def model(name, bodies, extra="", friction=0.6, timestep=0.005, floor=True):
    """A whole file: floor, bodies, and what stands beside them (actuators, pairs that do not collide)."""
    plane = '<geom name="floor" type="plane" size="20 20 .1"/>'
    if floor == "box":
        plane = '<geom name="floor" type="box" size="4 4 .5" pos="0 0 -.5"/>'
    return (
        f'<mujoco model="{name}"><compiler angle="degree" autolimits="true"/><option timestep="{timestep}"/>'
        f'<default><geom friction="{friction} .005 .0001" condim="3"/></default>'
        f'<worldbody>{plane}{"".join(bodies)}</worldbody>{extra}</mujoco>'
    )


def free(name, pos, geom, euler=(0, 0, 0)):
    """A body that moves freely."""
    return f'<body name="{name}" pos="{numbers(pos)}" euler="{numbers(euler)}"><freejoint/><geom {geom}/></body>'


def numbers(values):
    return " ".join(f"{value:.6g}" for value in values)


def box(half, mass, friction=None):
    slide = f' friction="{friction} .005 .0001"' if friction else ""
    return f'type="box" size="{numbers(half)}" mass="{mass}"{slide}'


def stack(masses, half=(0.1, 0.1, 0.1), shift=0.0, turn=0.0, **settings):
    """Boxes on top of each other, each shifted along x and turned about z against the one below."""
    bodies = [
        free(f"box{i}", (shift * i, 0, half[2] * (2 * i + 1)), box(half, mass), (0, 0, turn * i))
        for i, mass in enumerate(masses)
    ]
    return model("stack", bodies, **settings)


def wall(layers, across, mass=1.0, half=(0.12, 0.06, 0.05), **settings):
    """Bricks in running bond."""
    bodies = [
        free(f"brick{k}_{i}", (2.02 * half[0] * (i + 0.5 * (k % 2)), 0, half[2] * (2 * k + 1)), box(half, mass))
        for k in range(layers)
        for i in range(across - k % 2)
    ]
    return model("wall", bodies, **settings)


def pile(count, kinds, seed, radius=0.08, density=1000, width=0.35, **settings):
    """Bodies that fall into a square bin; their sizes differ by up to a half."""
    random = np.random.default_rng(seed)
    sides = [
        f'<geom type="box" size="{numbers((0.02, width, 0.4) if x else (width, 0.02, 0.4))}"'
        f' pos="{numbers((x * (width + 0.02), y * (width + 0.02), 0.4))}"/>'
        for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1))
    ]
    bodies = []
    for i in range(count):
        r = radius * random.uniform(0.7, 1.2)
        size = {"sphere": (r,), "capsule": (0.6 * r, r), "box": (r, 0.8 * r, 0.6 * r), "cylinder": (r, 0.7 * r)}
        kind = kinds[i % len(kinds)]
        place = (*random.uniform(-width / 2, width / 2, 2), radius * (1.2 + 0.9 * i))
        geom = f'type="{kind}" size="{numbers(size[kind])}" density="{density}"'
        bodies.append(free(f"body{i}", place, geom, random.uniform(-90, 90, 3)))
    return model("pile", sides + bodies, **settings)


def grasp(fingers, mass=0.5, tip="box", round=False, friction=0.8, **settings):
    """Fingers on two sliders each, inward and up, around a box or cylinder that stands on the floor."""
    geom = f'type="cylinder" size=".06 .1" mass="{mass}"' if round else box((0.05, 0.05, 0.1), mass)
    bodies, motors = [free("object", (0, 0, 0.1), geom)], []
    for i in range(fingers):
        angle = 360 * i / fingers
        geom = {"box": 'type="box" size=".01 .03 .03"', "sphere": 'type="sphere" size=".02"'}[tip]
        place = (0.09 * np.cos(np.radians(angle)), 0.09 * np.sin(np.radians(angle)), 0.12)
        bodies.append(
            f'<body name="finger{i}" pos="{numbers(place)}" euler="0 0 {angle:.6g}">'
            f'<joint name="slide{i}" type="slide" axis="-1 0 0" damping="5"/>'
            f'<joint name="lift{i}" type="slide" axis="0 0 1" damping="20"/><geom {geom} mass=".3"/></body>'
        )
        motors.append(f'<motor joint="slide{i}" ctrlrange="-100 100"/><motor joint="lift{i}" ctrlrange="-100 100"/>')
    actuators = f'<actuator>{"".join(motors)}</actuator>'
    return model(f"grasp with {fingers} fingers", bodies, actuators, friction=friction, **settings)


def vehicle(wheel_mass=1.0, load=0.0, steps=3, **settings):
    """A car on four wheels, on a slab and boards of different heights, with or without a load on its back."""
    wheels = "".join(
        f'<body pos="{x} {y} -.05" euler="90 0 0"><joint name="wheel{x}{y}" type="hinge" axis="0 0 1" damping=".05"/>'
        f'<geom type="{kind}" size=".1 .04" mass="{wheel_mass}"/></body>'
        for x, kind in ((0.25, "cylinder"), (-0.25, "cylinder"))
        for y in (0.2, -0.2)
    )
    boards = [free(f"board{i}", (0.24 - 0.48 * i, 0, 0.01), box((0.1, 0.4, 0.01), 0.5)) for i in range(steps)]
    top = [free("load", (0, 0, 0.34), box((0.15, 0.12, 0.1), load))] if load else []
    car = f'<body name="car" pos="0 0 .18"><freejoint/><geom type="box" size=".35 .14 .05" mass="8"/>{wheels}</body>'
    return model("car", boards + [car] + top, **settings)


def chain(links, length=0.08, radius=0.02, pos=(0, 0, 0.3), posts=0, **settings):
    """Capsules on hinges that turn about two axes in turn; it falls on the floor or over posts."""
    inner = ""
    for i in reversed(range(links)):
        axis = "0 1 0" if i % 2 else "0 0 1"
        joint = f'<joint type="hinge" axis="{axis}" damping=".002"/>' if i else "<freejoint/>"
        name = f'name="link{i}"'
        inner = (
            f'<body {name} pos="{numbers(pos) if i == 0 else numbers((length, 0, 0))}">{joint}'
            f'<geom type="capsule" fromto="0 0 0 {length * 0.9:.6g} 0 0" size="{radius}" density="2000"/>{inner}</body>'
        )
    bars = [
        f'<geom type="capsule" fromto="{0.16 + 0.24 * i:.6g} -.3 .1 {0.16 + 0.24 * i:.6g} .3 .1" size=".04"/>'
        for i in range(posts)
    ]
    return model("chain", bars + [inner], **settings)


def arm(mass=2.0, boxes=1, **settings):
    """An arm with three joints whose hand pushes a row of boxes."""
    robot = (
        '<body name="upper" pos="-.6 0 .1"><joint name="turn" type="hinge" axis="0 0 1" damping="1"/>'
        '<geom type="capsule" fromto="0 0 0 .3 0 0" size=".04" mass="2"/>'
        '<body name="fore" pos=".3 0 0"><joint name="elbow" type="hinge" axis="0 0 1" damping="1"/>'
        '<geom type="capsule" fromto=".05 0 0 .22 0 0" size=".03" mass="1"/>'
        '<body name="hand" pos=".26 0 0"><joint name="wrist" type="hinge" axis="0 1 0" damping=".2"/>'
        '<geom type="box" size=".015 .08 .05" mass=".3"/></body></body></body>'
    )
    bodies = [free(f"box{i}", (0.06 + 0.164 * i, 0, 0.08), box((0.08, 0.08, 0.08), mass)) for i in range(boxes)]
    motors = '<actuator><motor joint="turn"/><motor joint="elbow"/><motor joint="wrist"/></actuator>'
    return model("arm", [robot] + bodies, motors, **settings)


def dominoes(count, spacing=0.09, **settings):
    """Dominoes in a row, the first of which leans."""
    half = (0.012, 0.05, 0.1)
    bodies = [
        free(
            f"domino{i}",
            (spacing * i, 0, half[2] + (0.002 if i == 0 else 0)),
            box(half, 0.2),
            (0, 12 if i == 0 else 0, 0),
        )
        for i in range(count)
    ]
    return model("dominoes", bodies, **settings)


def walker(legs, mass=6.0, load=0.0, **settings):
    """A trunk on legs of two parts with feet of balls: two legs in a row, or four, or six."""
    limbs = ""
    for i in range(legs):
        x, y = 0.4 * (i // 2) / max(legs // 2 - 1, 1) - 0.2, 0.14 * (1 - 2 * (i % 2))
        limbs += (
            f'<body pos="{x:.6g} {y:.6g} -.03"><joint type="hinge" axis="1 0 0" range="-30 30" damping=".5"/>'
            f'<joint name="hip{i}" type="hinge" axis="0 1 0" range="-60 60" damping=".5" stiffness="30" springref="-25"/>'
            '<geom type="capsule" fromto="0 0 0 0 0 -.18" size=".03" mass=".6"/>'
            f'<body pos="0 0 -.18"><joint name="knee{i}" type="hinge" axis="0 1 0" range="0 110" damping=".5"'
            ' stiffness="30" springref="50"/><geom type="capsule" fromto="0 0 -.03 0 0 -.16" size=".022" mass=".3"/>'
            '<geom type="sphere" pos="0 0 -.19" size=".03" mass=".1"/></body></body>'
        )
    trunk = f'<geom type="box" size=".28 .11 .05" mass="{mass}"/>'
    body = f'<body name="trunk" pos="0 0 .42"><freejoint/>{trunk}{limbs}</body>'
    top = [free("load", (0, 0, 0.52), box((0.15, 0.08, 0.05), load))] if load else []
    return model(f"walker with {legs} legs", [body] + top, **settings)


def humanoid(height=1.015, lean=0, **settings):
    """A human figure of 12 parts and 18 hinges on feet of boxes; lean turns it about y (degrees)."""
    leg = lambda side, y: (
        f'<body pos="0 {y} -.12"><joint type="hinge" axis="1 0 0" range="-25 25" damping="3" stiffness="60"/>'
        f'<joint type="hinge" axis="0 1 0" range="-100 20" damping="3" stiffness="120"/>'
        f'<geom type="capsule" fromto="0 0 -.03 0 0 -.36" size=".06" mass="7"/>'
        f'<body pos="0 0 -.42"><joint type="hinge" axis="0 1 0" range="0 140" damping="2" stiffness="120"/>'
        '<geom type="capsule" fromto="0 0 -.02 0 0 -.34" size=".045" mass="3.5"/>'
        '<body pos="0 0 -.42"><joint type="hinge" axis="0 1 0" range="-40 40" damping="1" stiffness="60"/>'
        '<joint type="hinge" axis="1 0 0" range="-20 20" damping="1" stiffness="60"/>'
        f'<geom name="foot_{side}" type="box" pos=".05 0 -.03" size=".12 .05 .025" mass="1"/></body></body></body>'
    )
    upper = lambda side, y: (
        f'<body pos="0 {y} .38"><joint type="hinge" axis="0 1 0" range="-120 60" damping="1" stiffness="5"/>'
        f'<joint type="hinge" axis="1 0 0" range="-90 90" damping="1" stiffness="5"/>'
        '<geom type="capsule" fromto="0 0 -.05 0 0 -.26" size=".035" mass="2"/>'
        '<body pos="0 0 -.3"><joint type="hinge" axis="0 1 0" range="-130 0" damping=".5" stiffness="5"/>'
        '<geom type="capsule" fromto="0 0 -.02 0 0 -.24" size=".03" mass="1.5"/></body></body>'
    )
    body = (
        f'<body name="pelvis" pos="0 0 {height}" euler="0 {lean} 0"><freejoint/><geom type="box" size=".08 .14 .07" mass="10"/>'
        '<body pos="0 0 .12"><joint type="hinge" axis="0 1 0" range="-30 60" damping="4" stiffness="150"/>'
        '<joint type="hinge" axis="1 0 0" range="-30 30" damping="4" stiffness="150"/>'
        '<geom type="box" pos="0 0 .2" size=".09 .16 .18" mass="22"/><geom type="sphere" pos="0 0 .52" size=".1" mass="5"/>'
        f'{upper("left", 0.22)}{upper("right", -0.22)}</body>{leg("left", 0.09)}{leg("right", -0.09)}</body>'
    )
    return model("humanoid", [body], **settings)
