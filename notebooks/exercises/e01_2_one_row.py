"""Exercise 1.2: one row with two bounds.

Find the x in [lo, hi] with: w > 0 only at x = lo, w < 0 only at x = hi, where w = a x + b and a > 0.
"""

import numpy as np


def answer(a, b, lo, hi):
    """The answer of the one-row problem."""
    raise NotImplementedError("the gap is not filled in yet")
