"""Exercise 11.1: the nearest point of a square, a disc and a diamond.

`wanted` is the tangential impulse (N s) that would hold a block. Friction can give at most `limit` = μ x_n ≥ 0.
Each model of the lesson answers with the point of its figure that is nearest to `wanted`; the figures lie
around the origin. The square: both components at most `limit` in size. The disc: the length at most `limit`.
The diamond: the sum of the two sizes at most `limit`; its nearest point may lie on an edge, or be a corner.
"""

import numpy as np


def answer(wanted, limit):
    """The nearest points of the square, the disc and the diamond, in this order."""
    square = np.clip(wanted, -limit, limit)
    size = np.linalg.norm(wanted)
    disc = wanted * limit / size if size > limit else wanted
    # An edge of the diamond leads down at 45 degrees: both sizes lose the same, until one is used up.
    x, y = np.abs(wanted)
    lost = 0.0 if x + y <= limit else (x + y - limit) / 2 if abs(x - y) <= limit else max(x, y) - limit
    return square, disc, np.sign(wanted) * np.maximum(0, np.abs(wanted) - lost)
