"""Exercise 3.1: a column of balls, without a matrix.

Balls lie on each other, ball 0 on the ground, ball k with the mass m[k] (kg). Left to itself ball k would move
at u[k] (m/s, upwards positive) after the step: u* of the lesson. Contact k is the one below ball k. After the
step no contact may close, none may pull, and one that opens gives nothing. So balls that would close in on each
other move on together, with the momentum that they have; a group may run into the next one; and the ground
stops what comes down. Take the balls from the ground up and keep a list of the groups.
"""


def answer(m, u):
    """The impulse of each contact (N s)."""
    groups = []  # mass, momentum, number of balls
    for k in range(len(m)):
        group = (m[k], m[k] * u[k], 1)
        while groups and groups[-1][1] / groups[-1][0] > group[1] / group[0]:
            below = groups.pop()
            group = tuple(a + b for a, b in zip(group, below))
        groups.append(group)
    speed = [max(0.0, momentum / mass) for mass, momentum, count in groups for _ in range(count)]
    # What contact k has given is what the balls above it have gained.
    return [sum(m[j] * (speed[j] - u[j]) for j in range(k, len(m))) for k in range(len(m))]
