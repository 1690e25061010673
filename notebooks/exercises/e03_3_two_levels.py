"""Exercise 3.3: a pendulum at both levels.

A bob of mass m (kg) at the angle φ (rad) from the vertical turns at ω (rad/s) on a rod of length l (m).
The row's direction n points from the pivot to the bob, x ≥ 0 would push the bob away. The bob moves
along the circle, so J u = 0 now. Gravity along n is g cos φ.
"""

import numpy as np


def answer(m, l, g, phi, omega, dt):
    """The impulse x (N s) of one step dt (s) at velocity level, and the force λ (N) at acceleration
    level.
    """
    raise NotImplementedError("the gap is not filled in yet")
