"""Exercise 14.3: the pattern of A before its numbers.

Each row of J touches two bodies, given by number; None is a fixed one, the ground for example.
"""

import numpy as np


def answer(rows):
    """How many entries of A = J M⁻¹ Jᵀ may differ from zero."""
    raise NotImplementedError("the gap is not filled in yet")
