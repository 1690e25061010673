"""Exercise 11.3: a block is kicked up a slope.

It starts uphill with the speed v0 ≥ 0. Friction works against the sliding: downhill at first. When
the block has stopped, it may stay, or slide back. g = 9.81 m/s²; the angle θ is in radians.
"""

import numpy as np


def answer(theta, mu, v0, t):
    """Its velocity after the time t (s), counted uphill."""
    sin, cos = np.sin(theta), np.cos(theta)
    stops_at = v0 / (9.81 * (sin + mu * cos))
    if t < stops_at:
        return v0 - 9.81 * (sin + mu * cos) * t
    return -max(0.0, 9.81 * (sin - mu * cos)) * (t - stops_at)
