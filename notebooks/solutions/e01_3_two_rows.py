"""Exercise 1.3: two rows, by trying the four cases.

Find x ≥ 0 with w = A x + b ≥ 0 and x[i] w[i] = 0 for both rows. A is symmetric, positive definite.
"""

import numpy as np


def answer(A, b):
    """The answer of the two-row problem."""
    for F in [], [0], [1], [0, 1]:
        x = np.zeros(2)
        x[F] = np.linalg.solve(A[np.ix_(F, F)], -b[F])
        if (x >= 0).all() and (A @ x + b >= -1e-12).all():
            return x
