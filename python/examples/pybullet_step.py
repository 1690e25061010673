"""Receipts of PyBullet: an adapter for free boxes with friction.

PyBullet reports the contact points of a step, with their normals and impulses, and masses and poses. It does not report
the velocity before the step, damping, external forces, and how a step corrects penetrations. So this adapter keeps the
velocities and poses from before each step, sets damping to zero, and takes the correction from PyBullet's source code.
"""

import numpy as np
import pybullet

import lcplab

#: Values of PyBullet 3.2.7 that its functions do not report: the fraction of a penetration that a step corrects, and
#: the distance (m) that PyBullet adds to each gap.
CORRECTION, SLOP = 0.08, 1e-5


class World:
    """Boxes on a floor, without damping, restitution and external forces."""

    def __init__(self, masses, friction=0.5, iterations=50):
        self.dt, self.gravity, self.before = 1 / 240, np.array([0.0, 0.0, -9.81]), []
        self.friction = friction
        self.at = {"physicsClientId": pybullet.connect(pybullet.DIRECT)}
        pybullet.setGravity(*self.gravity, **self.at)
        pybullet.setTimeStep(self.dt, **self.at)
        pybullet.setPhysicsEngineParameter(numSolverIterations=iterations, solverResidualThreshold=0, **self.at)
        self.floor = self.add(0.0, [5.0, 5.0, 1.0], [0.0, 0.0, -1.0])
        self.bodies = [self.add(mass, [0.1] * 3, [0.02 * k, 0.0, 0.1 + 0.2 * k]) for k, mass in enumerate(masses)]

    def add(self, mass, half, place):
        """A box."""
        shape = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=half, **self.at)
        body = pybullet.createMultiBody(mass, shape, -1, place, **self.at)
        # PyBullet multiplies the friction coefficients of two bodies.
        settings = {"lateralFriction": np.sqrt(self.friction), "linearDamping": 0, "angularDamping": 0}
        pybullet.changeDynamics(body, -1, **settings, **self.at)
        return body

    def velocities(self):
        """[v, ω] of each body."""
        return np.array([np.concatenate(pybullet.getBaseVelocity(body, **self.at)) for body in self.bodies])

    def poses(self):
        """Centers, and axes as columns."""
        found = [pybullet.getBasePositionAndOrientation(body, **self.at) for body in self.bodies]
        return [(np.array(at), np.reshape(pybullet.getMatrixFromQuaternion(turn), (3, 3))) for at, turn in found]

    def step(self):
        """Keep what PyBullet does not report later, and take a step."""
        self.before = self.velocities(), self.poses()
        pybullet.stepSimulation(**self.at)

    def close(self):
        pybullet.disconnect(**self.at)


class Adapter:
    """The problem of the last step: impulses (N s) and velocities (m/s)."""

    def problem(self, world, data):
        velocities, poses = world.before
        mass, target = np.zeros((velocities.size, velocities.size)), velocities.copy()
        for k, (body, (_, axes)) in enumerate(zip(world.bodies, poses)):
            dynamics = pybullet.getDynamicsInfo(body, -1, **world.at)
            inertia, spin = axes @ np.diag(dynamics[2]) @ axes.T, velocities[k, 3:]
            own = slice(6 * k, 6 * k + 3), slice(6 * k + 3, 6 * k + 6)
            mass[own[0], own[0]], mass[own[1], own[1]] = dynamics[0] * np.eye(3), inertia
            target[k, :3] += world.dt * world.gravity
            target[k, 3:] -= world.dt * np.linalg.solve(inertia, np.cross(spin, inertia @ spin))
        jacobian, bias, forces, rows = [], [], [], []
        for contact in pybullet.getContactPoints(**world.at):
            lines = np.zeros((3, velocities.size))
            axes = np.array([contact[7], contact[11], contact[13]])  # normal and tangents, from the second to the first
            for body, place, sign in ((contact[1], contact[5], 1), (contact[2], contact[6], -1)):
                if body in world.bodies:
                    k = world.bodies.index(body)
                    lines[:, 6 * k : 6 * k + 6] = sign * np.hstack([axes, np.cross(place - poses[k][0], axes)])
            gap = contact[8] + SLOP
            jacobian.append(lines)
            bias += [gap * (1 if gap > 0 else CORRECTION) / world.dt, 0.0, 0.0]
            forces += [world.dt * contact[9], world.dt * contact[10], world.dt * contact[12]]
            names = tuple("floor" if body == world.floor else f"body {body}" for body in contact[1:3])
            rows += [lcplab.EngineRow(f"{kind}: {', '.join(names)}", kind, names)
                     for kind in ("normal", "friction", "friction")]
        count = len(rows) // 3
        return lcplab.EngineStep.of(
            "PyBullet", mass, np.reshape(jacobian, (-1, velocities.size)), bias, target.ravel(), forces,
            world.velocities().ravel(), lo=np.tile([0.0, -np.inf, -np.inf], count),
            friction_index=np.array([row for k in range(count) for row in (-1, 3 * k, 3 * k)], dtype=int),
            mu=np.tile([0.0, world.friction, world.friction], count), model="coulomb-cone",
            rows=rows, method="pgs",
            gravity=float(world.dt * np.linalg.norm(world.gravity) * np.sqrt(np.trace(mass[::6, ::6]))),
            not_checked=["assembly: PyBullet does not report its correction of penetrations and its slop"],
        )


def run(world, steps=100):
    """The receipts of a run."""

    def frames():
        for _ in range(steps):
            world.step()
            yield world, None

    return lcplab.receipts(frames(), adapter=Adapter())


def main():
    world = World([2.0, 1.0, 0.5])
    done = run(world)
    world.close()
    print(done)
    print(list(done.receipts.values())[-1])
    return done


if __name__ == "__main__":
    main()
