"""Exercise 2.1: the row of a rod.

A bob at p (m) hangs on a rod from the origin and moves at v (m/s). With c = |p| − l, find the row J
with ċ = J v, and J'u: what c̈ is when the bob flies straight on.
"""

import numpy as np


def answer(p, v):
    """J (three numbers) and J'u (m/s²)."""
    raise NotImplementedError("the gap is not filled in yet")
