"""Find the bug 3.b: one step of two bodies on a line.

Body 1 is above body 0, velocities count upwards (m/s), each body has its inverse mass (1/kg; 0 for a table that
cannot move) and its force (N). The gap opens at J u with J = [-1, 1]. The program should return the velocities
after a step of dt (s). Its users say: "With steps of 1 s everything is right. With steps of 0.01 s a book that
lies on a table flies up as if it had been kicked." There is exactly one mistake.
"""

import numpy as np


def answer(inverse_mass, u, force, dt):
    """The velocities of the two bodies after the step."""
    J = np.array([-1.0, 1])
    # A = J M⁻¹ Jᵀ and b, the velocity of the gap without an impulse.
    A = J @ (inverse_mass * J)
    b = J @ (u + inverse_mass * force)
    x = max(0.0, -b / A)
    # u⁺ = u + M⁻¹ (dt F + Jᵀ x)
    return u + inverse_mass * (dt * force + J * x)
