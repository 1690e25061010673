"""Exercise 4.2: one contact of sequential impulses.

A body of this inverse mass (1/kg) moves at v (m/s, away from the ground is positive). The contact has given it
the impulse `total` (N s) so far in this step. Correct the contact's velocity to 0, as far as a contact can: it
may take back what it has given, but all in all it may not pull.
"""


def answer(v, inverse_mass, total):
    """The velocity and the total impulse after the correction."""
    new = max(0.0, total - v / inverse_mass)
    return v + (new - total) * inverse_mass, new
