"""Exercise 15.3: what a mass ratio costs.

Two bodies, one contact each, `below` and `above` their masses. Each sweep of PGS multiplies the error of
the upper contact's impulse by ρ, which you can find from A.
"""

import numpy as np


def answer(below, above, reduction):
    """The least number of sweeps after which the error is at most reduction (between 0 and 1) of what
    it was.
    """
    raise NotImplementedError("the gap is not filled in yet")
