"""Exercise 14.1: a sweep without A.

Bodies move along one line. Contact i lies between rows[i] = [first, second], its gap opens at the velocity of
the second minus that of the first; None is the ground, which does not move. Do one sweep of projected
Gauss-Seidel on w = A x + b ≥ 0, x ≥ 0, x w = 0, from the given x, the rows in their order. Do not write A down:
keep u = M⁻¹ Jᵀ x, a velocity for each body, and change only those of the two bodies of a row.
"""

import numpy as np


def answer(rows, inverse_mass, b, x):
    """x after one sweep."""
    raise NotImplementedError("the gap is not filled in yet")
