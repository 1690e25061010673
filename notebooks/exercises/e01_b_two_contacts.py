"""Find the bug 1.b: two contacts.

The program goes through the four cases of the lesson and should return the x ≥ 0 with w = A x + b ≥ 0 and x[i]
w[i] = 0 for both rows; A is symmetric, positive definite. Its users say: "Contacts that do not feel each other
are always right. Three balls in a line are right most of the time, but sometimes a contact that should hold
goes on closing, or one pulls." There is exactly one mistake.
"""

import numpy as np


def answer(A, b):
    """The answer of the two-row problem."""
    # Neither contact pushes.
    if b[0] >= 0 and b[1] >= 0:
        return np.zeros(2)
    # Only contact i pushes: its w is 0, and the other contact, k, does not close.
    for i, k in (0, 1), (1, 0):
        push = -b[i] / A[i, i]
        opens = b[k]
        if push >= 0 and opens >= 0:
            x = np.zeros(2)
            x[i] = push
            return x
    # Both push: both w are 0.
    return np.linalg.solve(A, -b)
