"""Find the bug 10.b: a pendulum with feedback.

A bob of 1 kg hangs on a rod of length l (m) from the origin. Coordinates are x and z (m), gravity g (m/s²) acts
along -z, and it starts at rest at `start`. Each step of dt (s) finds the impulse along the rod, and feedback
takes the part β of the rod's error out. The program should return the place after `steps` steps. Its users say:
"With dt = 1 s an error goes as it should. With 60 steps a second and β = 0.2 a rod of 1 m gets 20 cm longer
while it swings, and when it hangs still, more than a tenth of an error is there after ten seconds." There is
exactly one mistake.
"""

import numpy as np


def answer(start, l, g, beta, dt, steps):
    """The place of the bob after the steps."""
    p, u = np.array(start, dtype=float), np.zeros(2)
    for step in range(steps):
        length = np.linalg.norm(p)
        n, c = p / length, length - l
        u[1] -= dt * g
        # Along the rod the bob shall move so that c gets smaller: w = n u + feedback + x = 0.
        x = -(n @ u + beta / dt * c)
        u += n * x
        p += dt * u
    return p
