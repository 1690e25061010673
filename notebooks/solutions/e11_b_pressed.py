"""Find the bug 11.b: a block is pushed and pressed.

A block of mass m (kg) stands on the ground with friction μ. In each step of dt (s) a hand pushes it along the
ground and presses it down, forces[k] = [push, press] in N, press ≥ 0. The program should return the speed along
the ground after each step, by Coulomb's law. Its users say: "A steady load is right, but for the first moment.
If we press harder, it holds too late; and when we stop pressing, the block stops as if it were still pressed."
There is exactly one mistake.
"""


def answer(m, mu, dt, forces):
    """The speed after each step (m/s)."""
    v, x_n, speeds = 0.0, 0.0, []
    for push, press in forces:
        # The normal first: weight and press are carried, and this step's x_n bounds this step's friction.
        x_n = dt * (m * 9.81 + press)
        limit = mu * x_n
        # The tangent: friction takes what it can of the slip.
        slip = v + dt * push / m
        friction = min(max(-m * slip, -limit), limit)
        v = slip + friction / m
        speeds.append(v)
    return speeds
