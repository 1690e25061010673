"""Elliptic integrals, by the arithmetic-geometric mean."""

import math


def first_kind(k: float) -> float:
    """K(k), the complete elliptic integral of the first kind of the modulus k.

    >>> round(first_kind(math.sin(math.pi / 4)), 6)
    1.854075
    """
    a, g = 1.0, math.sqrt(1 - k * k)
    while abs(a - g) > 1e-15 * a:
        a, g = (a + g) / 2, math.sqrt(a * g)
    return math.pi / (2 * a)
