"""Find the bug 2.b: the row of a contact.

Two bodies touch at a point. Given are their centers, the point (all in m), and a normal that points from body 0
to body 1, of any length. The program should return the row J with ċ = J u, u = (v0, ω0, v1, ω1): how fast the
gap opens. Its users say: "Balls that meet are right. But a box that comes down on an edge starts to turn the
wrong way round, and the edge goes on into the ground." There is exactly one mistake.
"""

import numpy as np


def answer(centers, point, normal):
    """J, twelve numbers."""
    n = normal / np.linalg.norm(normal)
    r0, r1 = point - centers[0], point - centers[1]
    # Body 0 closes the gap where body 1 opens it.
    return np.concatenate([-n, -np.cross(r0, n), n, np.cross(n, r1)])
