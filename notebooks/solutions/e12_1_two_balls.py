"""Exercise 12.1: two balls collide.

Ball 0 is on the left, ball 1 on the right; velocities count to the right. If they approach, they
separate at e times that speed, and momentum stays. If they do not approach, nothing happens.
"""


def answer(m, v, e):
    """The velocities after the impact."""
    x = max(0.0, (1 + e) * (v[0] - v[1]) / (1 / m[0] + 1 / m[1]))
    return v[0] - x / m[0], v[1] + x / m[1]
