"""A function of yours as a plug-in: here projected Gauss-Seidel with friction. Replace solve()."""
import json
import sys


def solve(A, b, lo, hi, index, mu, tolerance, sweeps):
    """x, and whether it has converged."""
    x = [0.0] * len(b)
    for sweep in range(sweeps):
        for i in range(len(b)):
            if index[i] >= 0:  # friction: between ∓mu times the normal impulse
                hi[i] = mu[i] * max(x[index[i]], 0.0)
                lo[i] = -hi[i]
            w = sum(a * v for a, v in zip(A[i], x)) + b[i]
            x[i] = min(max(x[i] - w / A[i][i], lo[i]), hi[i])
        if sweep % 10 == 9 and residual(A, b, lo, hi, x) <= tolerance:
            return x, True
    return x, False


def residual(A, b, lo, hi, x):
    worst = 0.0
    for i in range(len(b)):
        terms = [a * v for a, v in zip(A[i], x)] + [b[i]]
        step = sum(terms) / A[i][i]
        miss = abs(x[i] - min(max(x[i] - step, lo[i]), hi[i])) * A[i][i]
        worst = max(worst, miss / (sum(map(abs, terms)) or 1.0))
    return worst


for line in sys.stdin:
    p = json.loads(line)
    n = len(p["b"])
    lo, hi = ([float(v) for v in p[key]] for key in ("lo", "hi"))
    x, converged = solve(
        p["A"]["dense"], p["b"], lo, hi, p.get("friction_index", [-1] * n), p.get("mu", [0.0] * n),
        p["tolerance"], p["max_iterations"],
    )
    print(json.dumps({"x": x, "status": "solved" if converged else "iteration_limit"}), flush=True)
