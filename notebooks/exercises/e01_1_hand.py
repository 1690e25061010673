"""Exercise 1.1: a box, a hand and the ground.

A box of mass m (kg) stands still on the ground, z = 0. In step k, of dt (s), a hand pulls at it with the force
pull[k] (N, upwards positive; a negative one presses). g = 9.81 m/s². Before each step the box is at the height
z (m) and moves upwards at v (m/s). Only a box that touches the ground, z < 1e-9, may get an impulse x ≥ 0 (N s)
from it, by lesson 1's three sentences; in the air x = 0. Then z grows by dt times the new v.
"""

import numpy as np


def answer(m, pull, dt):
    """The impulse of the ground in each step (N s)."""
    raise NotImplementedError("the gap is not filled in yet")
