import json, sys
for line in sys.stdin:
    p = json.loads(line)
    A, b = p["A"]["dense"], p["b"]
    lo, hi = ([float(v) for v in p[key]] for key in ("lo", "hi"))
    x = [0.0] * len(b)
    for sweep in range(min(p["max_iterations"], 1000)):
        for i in range(len(b)):
            w = sum(a * v for a, v in zip(A[i], x)) + b[i]
            x[i] = min(max(x[i] - w / A[i][i], lo[i]), hi[i])
    print(json.dumps({"x": x}), flush=True)
