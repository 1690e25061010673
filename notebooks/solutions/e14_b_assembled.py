"""Find the bug 14.b: A, put together body by body.

Bodies move along one line. Row i lies between rows[i] = [first, second]: J has -1 at the first and +1 at the
second. The program should return the entries of A = J M⁻¹ Jᵀ, a dict {(row, column): value}: it asks each body which
rows touch it, so it never multiplies by a zero. A body with the inverse mass 0 cannot move. Its users say: "Balls
that fall on the ground are right. A ball that falls on another ball is thrown back, though nothing here is
elastic." There is exactly one mistake.
"""


def answer(rows, inverse_mass):
    """The entries of A, row by row."""
    # The rows that touch each body, with their entries in J.
    touching = [[] for _ in inverse_mass]
    for i, (first, second) in enumerate(rows):
        touching[first].append((i, -1.0))
        touching[second].append((i, 1.0))
    entries = {}
    for body, own in enumerate(touching):
        for i, J_i in own:
            for k, J_k in own:
                # Two rows may share two bodies, and a row shares both with itself.
                entries[i, k] = entries.get((i, k), 0.0) + J_i * inverse_mass[body] * J_k
    return entries
