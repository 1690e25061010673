"""Exercise 17.2: a test for rows.

c is a constraint of one point mass at p (m), and j is a candidate for its row: ċ = j v. Find the
first entry of j that is wrong, by moving the point a little. An entry counts as wrong if it is off by more than
1e-5 times the length |j| of the row. The constraints may be bent, and c may be the difference of large numbers:
choose your way of moving the point with care: the lesson says how far for a quotient to both sides.
"""

import numpy as np


def answer(c, p, j):
    """The number of the first wrong entry; None if all are right."""
    h = 1e-5  # to both sides, so that the bend drops out; not too near, or rounding shows
    for k in range(3):
        move = np.zeros(3)
        move[k] = h
        slope = (c(p + move) - c(p - move)) / (2 * h)
        if abs(j[k] - slope) > 1e-5 * np.linalg.norm(j):
            return k
