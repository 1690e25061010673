import json, sys
for line in sys.stdin:
    p = json.loads(line)
    A, b = p["A"]["dense"], p["b"]
    lo, hi = ([float(v) for v in p[key]] for key in ("lo", "hi"))
    rows = [i for i in range(len(b)) if A[i][i] != 0]  # a row with A_ii = 0 has no sweep
    x, status = [0.0] * len(b), "iteration_limit"
    for sweep in range(min(p["max_iterations"], 1000)):
        old = list(x)
        for i in rows:
            w = sum(a * v for a, v in zip(A[i], x)) + b[i]
            x[i] = min(max(x[i] - w / A[i][i], lo[i]), hi[i])
        change = sum(abs(new - was) for new, was in zip(x, old))
        if len(rows) == len(b) and change <= 1e-14 * sum(map(abs, x)):
            status = "solved"
            break
    print(json.dumps({"x": x, "status": status}), flush=True)
