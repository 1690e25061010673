"""A solver of friction cones as a plug-in: projected Gauss-Seidel, one contact at a time, under Coulomb's law."""
import json
import sys
from math import hypot


def on_disc(radius, t1, t2):
    """The point of the disk that is nearest to (t1, t2)."""
    length = hypot(t1, t2)
    return (t1, t2) if length <= radius else (radius * t1 / length, radius * t2 / length)


def solve(A, b, lo, hi, contacts, tolerance, sweeps):
    """x with |x_t| <= mu x_n in each contact (n, t1, t2, mu), and whether it has converged."""
    x = [0.0] * len(b)
    tangents = {row for _, t1, t2, _ in contacts for row in (t1, t2)}

    def w(i):
        return sum(a * v for a, v in zip(A[i], x)) + b[i]

    def terms(i):
        return sum(abs(a * v) for a, v in zip(A[i], x)) + abs(b[i])

    def one_row(i):
        return min(max(x[i] - w(i) / A[i][i], lo[i]), hi[i])

    def friction(n, t1, t2, mu):
        s = max(A[t1][t1] + abs(A[t1][t2]), A[t2][t2] + abs(A[t2][t1]))
        return s, on_disc(mu * x[n], x[t1] - w(t1) / s, x[t2] - w(t2) / s)

    def residual():
        worst = 0.0
        for i in range(len(b)):
            if i not in tangents:
                worst = max(worst, abs(x[i] - one_row(i)) * A[i][i] / (terms(i) or 1.0))
        for n, t1, t2, mu in contacts:
            s, (y1, y2) = friction(n, t1, t2, mu)
            size = hypot(terms(t1), terms(t2)) or 1.0
            worst = max(worst, hypot(x[t1] - y1, x[t2] - y2) * s / size)
        return worst

    for sweep in range(sweeps):
        for i in range(len(b)):
            if i not in tangents:
                x[i] = one_row(i)
        for n, t1, t2, mu in contacts:
            x[t1], x[t2] = friction(n, t1, t2, mu)[1]
        if sweep % 10 == 9 and residual() <= tolerance / 10:
            return x, True
    return x, False


for line in sys.stdin:
    p = json.loads(line)
    n = len(p["b"])
    index, mu = p.get("friction_index", [-1] * n), p.get("mu", [0.0] * n)
    rows = {k: [i for i in range(n) if index[i] == k] for k in index if k >= 0}
    answer = {"status": "outside_class"}
    if not rows or p.get("model") == "coulomb-cone":
        contacts = [(k, t1, t2, mu[t1]) for k, (t1, t2) in rows.items()]
        lo, hi = ([float(v) for v in p[key]] for key in ("lo", "hi"))
        x, converged = solve(
            p["A"]["dense"], p["b"], lo, hi, contacts, p["tolerance"], p["max_iterations"]
        )
        answer = {"x": x, "status": "solved" if converged else "iteration_limit"}
    # The first answer says which friction cones this program takes; without the key it would get boxes only.
    print(json.dumps({**answer, "models": ["coulomb-cone"]}), flush=True)
