"""Exercise 11.2: the nearest point of the friction cone.

The cone is all [x_n, x_t1, x_t2] with |x_t| ≤ μ x_n. Three cases: the point lies in it; its nearest
point is the tip, [0, 0, 0]; or its nearest point lies on the surface, where x_n changes too!
"""

import numpy as np


def answer(p, mu):
    """The point of the cone that is nearest to p = [p_n, p_t1, p_t2]; μ > 0."""
    raise NotImplementedError("the gap is not filled in yet")
