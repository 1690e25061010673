"""How lcplab reads a step of engine.py. As a program it writes steps as files: python adapter.py frames"""

import sys
from pathlib import Path

import numpy as np

import lcplab
from engine import COMPLIANCE, DT, GRAVITY, Ball, World, frame


class Adapter:
    """The problem that the engine posed in its last step, and its answer."""

    def problem(self, world, data):
        contacts = range(len(world.contacts))
        return lcplab.EngineStep.of(
            "balls",
            mass=np.diag(world.mass),
            jacobian=world.jacobian,
            expected_jacobian=self.jacobian(world),
            bias=world.bias,
            compliance=COMPLIANCE,
            target=world.free,  # the velocity without contacts
            forces=world.impulses,
            motion=np.concatenate([ball.velocity for ball in world.balls]),
            lo=np.tile([0.0, -np.inf, -np.inf], len(contacts)),
            friction_index=np.array([row for c in contacts for row in (-1, 3 * c, 3 * c)], dtype=int),
            mu=np.tile([0.0, world.friction, world.friction], len(contacts)),
            rows=[row for contact in world.contacts for row in self.rows(world, contact)],
            method="pgs",  # the kind of solver: its limit is 1e-3
            gravity=DT * np.linalg.norm(GRAVITY) * np.sqrt(sum(ball.mass for ball in world.balls)),
        )

    def jacobian(self, world):
        """J computed independently of the engine: how fast the two material points of a contact leave each other, for each
        unit velocity of a ball, at the positions before the step."""
        rows = np.zeros((3 * len(world.contacts), 6 * len(world.balls)))
        for number, contact in enumerate(world.contacts):
            for column in range(rows.shape[1]):
                unit = np.zeros(rows.shape[1])
                unit[column] = 1.0
                first, second = (self.speed(world, body, contact.point, unit) for body in (contact.first, contact.second))
                rows[3 * number : 3 * number + 3, column] = frame(contact.normal) @ (first - second)
        return rows

    def speed(self, world, body, point, velocities):
        """The velocity of the material point of a body; the floor rests."""
        if body is None:
            return np.zeros(3)
        ball, (linear, angular) = world.balls[body], velocities[6 * body : 6 * body + 6].reshape(2, 3)
        start = ball.position - DT * world.velocity[6 * body : 6 * body + 3]
        return linear + np.cross(angular, point - start)

    def rows(self, world, contact):
        """Names for messages."""
        second = "floor" if contact.second is None else world.balls[contact.second].name
        bodies = (world.balls[contact.first].name, second)
        return [lcplab.EngineRow(f"{kind}: {', '.join(bodies)}", kind, bodies)
                for kind in ("normal", "friction", "friction")]


def sliding():
    """A ball that slides before it rolls."""
    return World([Ball("ball", 1.0, 0.1, (0, 0, 0.1), (3, 0, 0, 0, 0, 0))])


def pile():
    """A ball of 5 kg falls between two of 1 kg."""
    return World([Ball("left", 1.0, 0.1, (-0.1, 0, 0.1)), Ball("right", 1.0, 0.1, (0.1, 0.02, 0.1)),
                  Ball("top", 5.0, 0.1, (0, 0, 0.3))])


def main(folder):
    """Write every tenth step of both scenes."""
    Path(folder).mkdir(parents=True, exist_ok=True)
    for scene in (sliding, pile):
        world = scene()
        for number in range(60):
            world.step()
            if number % 10 == 0 and world.contacts:
                name = f"{folder}/{scene.__name__}-{number:02}"
                lcplab.receipt(world, adapter=Adapter()).write(f"{name}.json", f"{name}.x.json")


if __name__ == "__main__":
    main(sys.argv[1])
