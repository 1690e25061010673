"""Exercise 7.1: Murty's least-index rule.

Given the point of an active set: free rows have w = 0, the others x = 0. A row is wrong if its x or its w is
negative.
"""

import numpy as np


def answer(x, w):
    """The row that changes sides next; None if no row is wrong."""
    raise NotImplementedError("the gap is not filled in yet")
