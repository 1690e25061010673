"""Exercise 2.2: the rows of a nail.

A nail holds the point of a body that lies at the arm r (m) from its center. The point moves at
ċ = v + ω × r. Write the three rows of J, so that ċ = J u with u = (v_x, v_y, v_z, ω_x, ω_y, ω_z).
"""

import numpy as np


def answer(r):
    """J, row by row."""
    raise NotImplementedError("the gap is not filled in yet")
