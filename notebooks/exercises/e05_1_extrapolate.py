"""Exercise 5.1: where the sweeps will end.

After some sweeps the whole error shrinks by the same factor ρ a sweep, -1 < ρ < 1. You have the x of three
sweeps in a row, the newest last. Find ρ from the two changes of x, and from ρ where infinitely many sweeps
would end. ρ may be negative. It may be that some rows, or all, have not changed. All rows are contacts: no x of
the answer may be negative.
"""

import numpy as np


def answer(sweeps):
    """x after infinitely many sweeps."""
    raise NotImplementedError("the gap is not filled in yet")
