"""Exercise 3.2: the matrix A.

Three bodies move along one line, body k with the inverse mass inverse_mass[k] (1/kg). Row i of J says
how the gap i opens. Entry A[i, k] is how fast gap i opens after a unit impulse in row k.
"""

import numpy as np


def answer(J, inverse_mass):
    """A = J M⁻¹ Jᵀ (1/kg)."""
    raise NotImplementedError("the gap is not filled in yet")
