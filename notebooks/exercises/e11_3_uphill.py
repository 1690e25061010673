"""Exercise 11.3: a block is kicked up a slope.

It starts uphill with the speed v0 ≥ 0. Friction works against the sliding: downhill at first. When
the block has stopped, it may stay, or slide back. g = 9.81 m/s²; the angle θ is in radians.
"""

import numpy as np


def answer(theta, mu, v0, t):
    """Its velocity after the time t (s), counted uphill."""
    raise NotImplementedError("the gap is not filled in yet")
