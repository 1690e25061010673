import json, sys
for line in sys.stdin:
    p = json.loads(line)
    A, b = p["A"]["dense"], p["b"]
    lo, hi = ([float(v) for v in p[key]] for key in ("lo", "hi"))
    rows = [i for i in range(len(b)) if A[i][i] != 0]  # a row with A_ii = 0 has no sweep
    x = [0.0] * len(b)
    for sweep in range(min(p["max_iterations"], 1000)):
        for i in rows:
            w = sum(a * v for a, v in zip(A[i], x)) + b[i]
            x[i] = min(max(x[i] - w / A[i][i], lo[i]), hi[i])
    answer = {"x": x} if len(rows) == len(b) else {"x": x, "status": "iteration_limit"}
    print(json.dumps(answer), flush=True)
