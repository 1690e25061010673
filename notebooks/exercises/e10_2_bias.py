"""Exercise 10.2: the bias of a contact.

The gap c (m) is the distance of two bodies along the normal. An overlap is a negative gap: c = -0.01 says that
they are 1 cm inside each other. J u⁺ = ċ is how fast the gap opens in the step. The solver sees to it that
J u⁺ + bias ≥ 0, so -bias is the least ċ that it allows: with a positive bias the gap may close, with a negative
one it has to open. The slop (m) is an overlap that is left alone, so that a resting contact does not tremble.
The bias

- of a gap, c > 0: it may close within the step dt (s), but not more. Made of c and dt.
- of an overlap deeper than the slop: the part β of what is beyond the slop goes within the step. Made of β, dt,
  c and the slop.
- of an overlap up to the slop: nothing is corrected, and it does not grow.
"""

import numpy as np


def answer(c, dt, beta, slop):
    """The bias (m/s)."""
    raise NotImplementedError("the gap is not filled in yet")
