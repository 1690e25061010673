"""Elliptic integrals and functions, by the arithmetic-geometric mean."""

import math

import numpy as np

from lcplab.engines import Array


def first_kind(k: float) -> float:
    """K(k), the complete elliptic integral of the first kind of the modulus k.

    >>> round(first_kind(math.sin(math.pi / 4)), 6)
    1.854075
    """
    a, g = 1.0, math.sqrt(1 - k * k)
    while abs(a - g) > 1e-15 * a:
        a, g = (a + g) / 2, math.sqrt(a * g)
    return math.pi / (2 * a)


def sine(u: Array, k: float) -> Array:
    """sn(u, k), Jacobi's sine of the modulus k; a quarter of its period is K(k).

    >>> float(sine(np.array([first_kind(0.8)]), 0.8)[0])
    1.0
    """
    a, c = [1.0], [k]
    g = math.sqrt(1 - k * k)
    while abs(c[-1]) > 1e-16 * a[-1]:
        c.append((a[-1] - g) / 2)
        a, g = [*a, (a[-1] + g) / 2], math.sqrt(a[-1] * g)
    angle = 2.0 ** (len(a) - 1) * a[-1] * u
    for n in range(len(a) - 1, 0, -1):
        angle = (angle + np.arcsin(c[n] / a[n] * np.sin(angle))) / 2
    return np.asarray(np.sin(angle))
