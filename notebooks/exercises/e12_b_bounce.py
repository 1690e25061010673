"""Find the bug 12.b: a ball that bounces.

A ball starts at rest at this height (m) over the ground. A contact has a bias, and the velocity after a step is
at least -bias. While the ground is out of reach the gap may close within the step of dt (s), but not more; a
ball that hits leaves with e times its speed before the step. The program should return [height, velocity] after
each step. Its users say: "With e = 1 the ball should come back forever. It loses height, at each bounce
another amount, and soon it hardly leaves the ground. Shorter steps do not help." There is exactly one mistake.
"""


def answer(height, e, dt, steps):
    """[height, velocity] after each step."""
    z, v, states = height, 0.0, []
    for step in range(steps):
        free = v - 9.81 * dt
        bias = z / dt  # the gap may close within the step
        if free + bias < 0:
            bias += e * min(v, 0.0)  # the ball hits; v < 0 is its velocity before
        v = max(free, -bias)
        z += dt * v
        states.append((z, v))
    return states
