"""Exercise 13.1: all answers of a one-row LCP.

w = a x + b, x ≥ 0, w ≥ 0, x w = 0. Neither a nor b is 0, but a may be negative, as on Painlevé's rod:
then there may be two answers, or none.
"""

import numpy as np


def answer(a, b):
    """All x that solve it, in any order."""
    raise NotImplementedError("the gap is not filled in yet")
