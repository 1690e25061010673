"""Find the bug 17.b: a bead with friction on a wire.

A bead of mass m (kg) starts at rest on a straight wire z = slope x and rubs on it with the friction μ. The
constraint is c = z - slope x, one equation, so its impulse may have either sign. The program should return the
speed along the wire after `steps` steps of dt (s), to the right positive. Its users say: "On a level wire, and
without friction, it is right. On a slope the bead gets too fast, and it slides where it should stay: at 30°
with μ = 0.6." There is exactly one mistake.
"""

import numpy as np


def answer(slope, mu, m, dt, steps):
    """The speed along the wire (m/s)."""
    size = np.hypot(1, slope)
    along, J = np.array([1, slope]) / size, np.array([-slope, 1.0])  # ċ = J u
    A, u = J @ J / m, np.zeros(2)
    for step in range(steps):
        u[1] -= 9.81 * dt
        # The wire: ċ = 0.
        x = -(J @ u) / A
        u += J * x / m
        # Friction, at most μ times the normal force, against the slip.
        limit = mu * abs(x) * size  # the impulse is Jᵀ x, and J is no unit vector
        rub = min(max(-m * (along @ u), -limit), limit)
        u += along * rub / m
    return along @ u
