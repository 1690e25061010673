"""Exercise 15.2: a leaning tower.

Boxes 1 m wide lie on each other, seen from the front; x[k] (m, to the right) is the middle of box k and m[k]
(kg) its mass, evenly spread. Box 0 lies on the ground. Layer 0 is below it and presses at its two ends. Layer k
lies between the boxes k - 1 and k, which touch where they overlap, and presses at the left and the right end of
the overlap. Find the impulses in a step of dt (s) in which nothing moves or turns. No layer can pull. g = 9.81
m/s².
"""


def answer(x, m, dt):
    """The impulses of each layer at its left and right end (N s); None if the tower falls."""
    layers = []
    for k in range(len(x)):
        below = x[k - 1] if k else x[0]
        left, right = max(x[k], below) - 0.5, min(x[k], below) + 0.5
        # The layer carries all that is above it, where the center of mass of all that is.
        mass = m[k:].sum()
        part = (m[k:] @ x[k:] / mass - left) / (right - left)  # at the right end
        if not 0 <= part <= 1:
            return None
        load = mass * 9.81 * dt
        layers.append(((1 - part) * load, part * load))
    return layers
