"""A small physics engine: balls that roll, slide and collide on a floor, with friction.

It solves each step as many engines do: contacts with a little compliance, friction cones, and sweeps over the
contacts, each of which is projected onto its cone (projected block Gauss-Seidel).
"""

import numpy as np

GRAVITY = np.array([0.0, 0.0, -9.81])  # m/s²
DT = 0.005  # s
COMPLIANCE = 0.05  # m/s per N s
CORRECTION = 0.2  # the fraction of a penetration that one step corrects


class Ball:
    """A solid ball; its velocity is that of its center (m/s), then its angular velocity (rad/s)."""

    def __init__(self, name, mass, radius, position, velocity=(0, 0, 0, 0, 0, 0)):
        self.name, self.mass, self.radius = name, mass, radius
        self.position, self.velocity = np.array(position, float), np.array(velocity, float)
        self.inertia = np.repeat([mass, 0.4 * mass * radius**2], 3)


class Contact:
    """Two bodies that touch, or a ball and the floor (second is None)."""

    def __init__(self, first, second, point, normal, gap):
        self.first, self.second, self.point, self.normal, self.gap = first, second, point, normal, gap


class World:
    """Balls above the floor z = 0, with one friction coefficient."""

    def __init__(self, balls, friction=0.5, sweeps=1000):
        self.balls, self.friction, self.sweeps = balls, friction, sweeps
        self.mass = np.concatenate([ball.inertia for ball in balls])
        self.contacts, self.impulses = [], np.zeros(0)

    def step(self):
        """Advance the world by DT."""
        self.contacts = self.find_contacts()
        self.jacobian = self.find_jacobian()
        self.bias = np.zeros(3 * len(self.contacts))
        self.bias[0::3] = [(c.gap if c.gap > 0 else CORRECTION * c.gap) / DT for c in self.contacts]
        start = np.concatenate([ball.velocity for ball in self.balls])
        self.free = start + DT * np.tile(np.concatenate([GRAVITY, np.zeros(3)]), len(self.balls))
        self.impulses = self.solve()
        self.velocity = self.free + self.jacobian.T @ self.impulses / self.mass
        for ball, velocity in zip(self.balls, self.velocity.reshape(-1, 6)):
            ball.velocity = velocity.copy()
            ball.position += DT * velocity[:3]

    def find_contacts(self):
        """Balls within 1 cm of the floor or of each other."""
        found = []
        for number, ball in enumerate(self.balls):
            gap = ball.position[2] - ball.radius
            if gap < 0.01:
                found.append(Contact(number, None, ball.position * [1, 1, 0], np.array([0.0, 0.0, 1.0]), gap))
            for other, lower in enumerate(self.balls[:number]):
                between = ball.position - lower.position
                distance = np.linalg.norm(between)
                gap = distance - ball.radius - lower.radius
                if gap < 0.01:
                    normal = between / distance
                    found.append(Contact(number, other, lower.position + lower.radius * normal, normal, gap))
        return found

    def find_jacobian(self):
        """Three rows for each contact, a normal and two tangents: the velocity of the first body less the second."""
        jacobian = np.zeros((3 * len(self.contacts), 6 * len(self.balls)))
        for number, contact in enumerate(self.contacts):
            rows = slice(3 * number, 3 * number + 3)
            axes = frame(contact.normal)
            for body, sign in ((contact.first, 1.0), (contact.second, -1.0)):
                if body is not None:
                    arm = contact.point - self.balls[body].position
                    jacobian[rows, 6 * body : 6 * body + 3] = sign * axes
                    jacobian[rows, 6 * body + 3 : 6 * body + 6] = sign * np.cross(arm, axes)
        return jacobian

    def solve(self):
        """The impulses of the contacts (N s)."""
        impulses = np.zeros(len(self.bias))
        matrix = self.jacobian / self.mass @ self.jacobian.T + COMPLIANCE * np.eye(len(self.bias))
        offset = self.jacobian @ self.free + self.bias
        blocks = [slice(first, first + 3) for first in range(0, len(offset), 3)]
        steepest = [np.linalg.eigvalsh(matrix[rows, rows])[-1] for rows in blocks]
        for _ in range(self.sweeps):
            before = impulses.copy()
            for rows, slope in zip(blocks, steepest):
                velocity = matrix[rows] @ impulses + offset[rows]
                wanted = impulses[rows] - velocity / slope
                impulses[rows] = onto_cone(wanted, self.friction)
            if np.abs(impulses - before).max(initial=0.0) <= 1e-10 * np.abs(impulses).max(initial=1e-300):
                break
        return impulses


def frame(normal):
    """The normal and two tangents, as rows."""
    side = np.cross(normal, [0.0, 1.0, 0.0] if abs(normal[0]) > 0.5 else [1.0, 0.0, 0.0])
    side /= np.linalg.norm(side)
    return np.array([normal, side, np.cross(normal, side)])


def onto_cone(impulse, friction):
    """The nearest impulse in the friction cone |tangential| <= friction * normal."""
    normal, sliding = impulse[0], np.linalg.norm(impulse[1:])
    if sliding <= friction * normal:
        return impulse
    if friction * sliding <= -normal:
        return np.zeros(3)
    reduced = (normal + friction * sliding) / (1 + friction**2)
    return np.concatenate([[reduced], friction * reduced * impulse[1:] / sliding])
