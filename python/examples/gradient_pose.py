"""How do the contact impulses of a step change with a pose? Of a ladder, with its angle to the floor.

A pose changes the rows of J and their bias smoothly, as long as the same points touch: differences of two assembled steps give
their derivative. What is not smooth, the solution of the contact problem, lcplab differentiates exactly.
"""

from math import cos, degrees, radians, sin

import numpy as np

import lcplab

MASS, LENGTH, RADIUS, FRICTION = 10.0, 4.0, 0.05, 0.3


def problem_at(angle):
    """A step from rest of a ladder at this angle (rad) between the floor and a wall without friction; both ends touch."""
    floor = {"name": "floor", "fixed": True, "shape": {"plane": [0, 0, 1]}, "friction": FRICTION}
    wall = {"name": "wall", "fixed": True, "shape": {"plane": [1, 0, 0]}, "friction": 0}
    ladder = {
        "name": "ladder", "shape": {"capsule": {"length": LENGTH, "radius": RADIUS}}, "mass": MASS, "rotation": {"y": degrees(angle) - 90},
        "position": [LENGTH / 2 * cos(angle) + RADIUS, 0, LENGTH / 2 * sin(angle) + RADIUS],
    }
    scene = lcplab.Scene.of({"step": {"dt": 0.01}, "contact": {"friction": FRICTION}, "bodies": [floor, wall, ladder]})
    scene.step()
    return scene.problem()


def data(problem):
    """The rows, the bias, the masses and the motion without contacts, as arrays."""
    motion = problem.to_json()["motion"]
    n, k = len(motion["bias"]), len(motion["target"])
    jacobian, mass = np.zeros((n, k)), np.zeros((k, k))
    for array, key in ((jacobian, "jacobian"), (mass, "mass")):
        for i, j, value in motion[key]:
            array[i, j] = value
    return {"jacobian": jacobian, "mass": mass, "bias": np.array(motion["bias"]), "target": np.array(motion["target"])}


def main(angle=radians(60), h=1e-4):
    """dx/d(angle) in N s per rad."""
    problem, after, before = (problem_at(angle + shift) for shift in (0, h, -h))
    labels = {str([row["label"] for row in own.to_json()["rows"]]) for own in (problem, after, before)}
    if len(labels) != 1:
        raise ValueError("other points touch after the displacement: there is no derivative to take")
    after, before = data(after), data(before)
    change = {key: (after[key] - before[key]) / (2 * h) for key in after}
    dx, _ = lcplab.gradient(problem).jvp(**change)
    return dx


if __name__ == "__main__":
    print(main())
