"""Exercise 1.3: two rows, by trying the four cases.

Find x ≥ 0 with w = A x + b ≥ 0 and x[i] w[i] = 0 for both rows. A is symmetric, positive definite.
Allow for rounding: for w, -1e-12 is still 0.
"""

import numpy as np


def answer(A, b):
    """The answer of the two-row problem."""
    raise NotImplementedError("the gap is not filled in yet")
