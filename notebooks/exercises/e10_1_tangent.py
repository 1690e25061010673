"""Exercise 10.1: leaving the circle.

A bob on a circle of radius l (m) moves at the speed v (m/s) along the tangent for a time dt (s). How
much farther from the center is it then? Exactly, please, not only for short steps.
"""

import numpy as np


def answer(l, v, dt):
    """How much the distance has grown (m)."""
    raise NotImplementedError("the gap is not filled in yet")
