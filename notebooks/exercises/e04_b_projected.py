"""Find the bug 4.b: sweeps over contacts.

The program should solve w = A x + b ≥ 0, x ≥ 0, x w = 0 by projected Gauss-Seidel; A is symmetric, positive
definite. Its users say: "As long as all contacts push it is right. When one of them leaves, its neighbor goes
on closing or is thrown off, however many sweeps we allow. With a box on three contacts the impulses grew
without end." There is exactly one mistake.
"""

import numpy as np


def answer(A, b, sweeps):
    """x after this number of sweeps."""
    x = np.zeros(len(b))
    for sweep in range(sweeps):
        # With the newest x, each row makes its own w zero, but no contact pulls: the next row must not see
        # an impulse that will be taken back.
        for i in range(len(b)):
            x[i] = x[i] - (A[i] @ x + b[i]) / A[i, i]
    return np.maximum(x, 0)
