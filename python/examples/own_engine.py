"""Receipts of an engine of one's own: balls above each other fall on a floor, and an adapter of ten lines."""

import numpy as np

import lcplab

GRAVITY, DT, COMPLIANCE = 9.81, 0.01, 1e-4


class Balls:
    """Balls of 1, 2, 3 ... kg on a vertical line, solved by Gauss-Seidel sweeps."""

    def __init__(self, count, sweeps=400):
        self.mass = np.arange(1.0, count + 1)
        self.rows = np.eye(count) - np.eye(count, k=-1)  # each ball against the one below it, or the floor
        self.heights, self.speeds = np.arange(count) * 1.0, np.zeros(count)
        self.sweeps = sweeps

    def step(self):
        """One step of semi-implicit Euler."""
        self.free = self.speeds - GRAVITY * DT
        self.gaps = (self.rows @ self.heights - np.append(0.0, np.ones(len(self.mass) - 1))) / DT
        matrix = self.rows @ np.diag(1 / self.mass) @ self.rows.T + COMPLIANCE * np.eye(len(self.mass))
        offset = self.rows @ self.free + self.gaps
        self.impulses = np.zeros(len(self.mass))
        for _ in range(self.sweeps):
            for row in range(len(self.mass)):
                left = matrix[row] @ self.impulses + offset[row]
                self.impulses[row] = max(0.0, self.impulses[row] - left / matrix[row, row])
        self.speeds = self.free + self.rows.T @ self.impulses / self.mass
        self.heights = self.heights + DT * self.speeds


class Adapter:
    """What the engine posed in its last step, and its answer."""

    def problem(self, engine, _):
        """w = J v + gap / dt + compliance x."""
        return lcplab.EngineStep.of(
            "balls", mass=np.diag(engine.mass), jacobian=engine.rows, bias=engine.gaps, compliance=COMPLIANCE,
            target=engine.free, forces=engine.impulses, motion=engine.speeds, method="pgs", gravity=GRAVITY * DT,
        )


def run(engine, steps=50):
    """The receipts of a run."""

    def frames():
        for _ in range(steps):
            engine.step()
            yield engine, None

    return lcplab.receipts(frames(), adapter=Adapter())


def main():
    good, hasty = run(Balls(4)), run(Balls(4, sweeps=2))
    print(good)
    print(hasty)
    return good, hasty


if __name__ == "__main__":
    main()
