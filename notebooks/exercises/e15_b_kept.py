"""Find the bug 15.b: a column that keeps its impulses.

Balls stand on each other, ball 0 on the ground. Each step of dt (s) starts from the impulses x of the step
before: the balls get them at once, together with gravity, and sweeps of sequential impulses correct what is
left. The program should return, after `steps` steps, x (N s) and how far each ball has moved upwards (m). Its
users say: "One ball alone is right. Under two balls the ground carries only one of them. Five jump off each
other, and without the warm start they only sank." There is exactly one mistake.
"""

import numpy as np


def answer(masses, dt, sweeps, steps):
    """The impulses of the last step, and how far each ball has moved."""
    n = len(masses)
    z, u, x = np.zeros(n), np.zeros(n), np.zeros(n)
    for step in range(steps):
        for k in range(n):
            # Contact k is the one below ball k.
            other = 0.0
            u[k] += (x[k] - other) / masses[k] - 9.81 * dt
        for sweep in range(sweeps):
            for k in range(n):
                below, give = (u[k - 1], 1 / masses[k - 1]) if k else (0.0, 0.0)
                push = max(-x[k], -(u[k] - below) / (1 / masses[k] + give))
                x[k] += push
                u[k] += push / masses[k]
                if k:
                    u[k - 1] -= push / masses[k - 1]
        z += dt * u
    return x, z
