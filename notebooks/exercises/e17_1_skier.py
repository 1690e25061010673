"""Exercise 17.1: a skier, and where she takes off.

A skier of mass m (kg) is on a hill of the height z = h(x), without friction. At her place h has the slope h'
and the bend h''; she moves along the snow with v_x (m/s). The gap is c = z - h(x). Find J and J'u, and then the
force of the snow at acceleration level: it may push but not pull, and c̈ ≥ 0. If c̈ > 0 without a force, she
takes off. g = 9.81 m/s².
"""

import numpy as np


def answer(m, slope, bend, v_x):
    """The force of the snow on her, [F_x, F_z] (N)."""
    raise NotImplementedError("the gap is not filled in yet")
