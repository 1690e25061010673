"""Exercise 3.1: a column of balls, without a matrix.

Balls lie on each other, ball 0 on the ground, ball k with the mass m[k] (kg). Left to itself ball k would move
at u[k] (m/s, upwards positive) after the step: u* of the lesson. Contact k is the one below ball k. After the
step no contact may close, none may pull, and one that opens gives nothing. So balls that would close in on each
other move on together, with the momentum that they have; a group may run into the next one; and the ground
stops what comes down. Take the balls from the ground up and keep a list of the groups.
"""

import numpy as np


def answer(m, u):
    """The impulse of each contact (N s)."""
    raise NotImplementedError("the gap is not filled in yet")
