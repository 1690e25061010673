"""Exercise 14.3: the pattern of A before its numbers.

Each row of J touches two bodies, given by number; None is a fixed one, the ground for example.
"""


def answer(rows):
    """How many entries of A = J M⁻¹ Jᵀ may differ from zero."""
    moving = [{body for body in row if body is not None} for row in rows]
    return sum(bool(a & b) for a in moving for b in moving)
