"""Exercise 14.1: a sweep without A.

Bodies move along one line. Contact i lies between rows[i] = [first, second], its gap opens at the velocity of
the second minus that of the first; None is the ground, which does not move. Do one sweep of projected
Gauss-Seidel on w = A x + b ≥ 0, x ≥ 0, x w = 0, from the given x, the rows in their order. Do not write A down:
keep u = M⁻¹ Jᵀ x, a velocity for each body, and change only those of the two bodies of a row.
"""

import numpy as np


def answer(rows, inverse_mass, b, x):
    """x after one sweep."""
    x, u = x.copy(), np.zeros(len(inverse_mass))

    def give(i, impulse):
        for body, sign in zip(rows[i], (-1, 1)):
            if body is not None:
                u[body] += sign * inverse_mass[body] * impulse

    for i in range(len(rows)):
        give(i, x[i])  # what the old x has done
    for i, (first, second) in enumerate(rows):
        of = lambda values, body: 0.0 if body is None else values[body]
        w = of(u, second) - of(u, first) + b[i]
        new = max(0.0, x[i] - w / (of(inverse_mass, first) + of(inverse_mass, second)))
        give(i, new - x[i])
        x[i] = new
    return x
