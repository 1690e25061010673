"""Find the bug 8.b: sweeps that know when to stop.

The program should sweep over contacts, w = A x + b ≥ 0, x ≥ 0, x w = 0, until the natural residual is at most
the tolerance, and return x and the number of sweeps. Its users say: "The answers are right. But as soon as a
contact opens it does all of its thousand sweeps, though the first few were enough." There is exactly one
mistake.
"""

import numpy as np


def answer(A, b, tolerance):
    """x, and the number of sweeps that were done."""
    x = np.zeros(len(b))
    for sweep in range(1, 1001):
        for i in range(len(b)):
            x[i] = max(0.0, x[i] - (A[i] @ x + b[i]) / A[i, i])
        residual = np.abs(np.minimum(x, A @ x + b)).max()
        if residual <= tolerance:
            return x, sweep
    return x, 1000
