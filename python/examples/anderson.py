"""A new solver beside others: projected Gauss-Seidel with Anderson acceleration, compared and profiled."""

import numpy as np

import lcplab

MEMORY = 5


def residual(A, b, lo, hi, x):
    terms = np.abs(A) @ np.abs(x) + np.abs(b)
    miss = np.abs(x - np.clip(x - (A @ x + b) / np.diag(A), lo, hi)) * np.diag(A)
    return np.max(miss[terms > 0] / terms[terms > 0], initial=0.0)


def anderson(A, b, lo, hi, tolerance, max_iterations, **settings):
    """Each sweep g(x) is mixed with those before so that the steps g(x) - x cancel, if that lowers the objective."""
    if not np.allclose(A, A.T) or (np.diag(A) <= 0).any():
        raise ValueError("A is not symmetric, or a row has no mass")

    def sweep(x):
        x = x.copy()
        for i in range(len(b)):
            x[i] = min(max(x[i] - (A[i] @ x + b[i]) / A[i, i], lo[i]), hi[i])
        return x

    def objective(x):
        return 0.5 * x @ A @ x + b @ x

    x = np.clip(np.zeros(len(b)), lo, hi)
    ends, steps = [], []
    for _ in range(max_iterations):
        end = sweep(x)
        ends, steps = (ends + [end])[-MEMORY:], (steps + [end - x])[-MEMORY:]
        x = end
        if len(steps) > 1:
            S, last = np.diff(steps, axis=0).T, steps[-1]
            weights = np.linalg.lstsq(S, last, rcond=None)[0]
            mixed = np.clip(end - np.diff(ends, axis=0).T @ weights, lo, hi)
            x = mixed if objective(mixed) < objective(end) else end
        yield x
        if residual(A, b, lo, hi, x) <= tolerance:
            return


def main():
    stacks = {f"stack of {n}": lcplab.Problem.generate("stack", n=n) for n in (5, 10, 20)}
    heavy = {f"mass ratio {r}": lcplab.Problem.generate("stack", n=8, ratio=r) for r in (1, 10, 100)}
    table = lcplab.compare(stacks | heavy, [anderson, "pgs", "nncg", "dantzig"])
    print(table)
    return table


if __name__ == "__main__":
    main()
