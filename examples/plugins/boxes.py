"""What the adapters share: problems in, answers out. An adapter has a function of A, b, lo, hi and the tolerance."""
import json
import os
import sys

import numpy as np


def matrix(p):
    if "dense" in p:
        return np.array(p["dense"], dtype=float)
    A = np.zeros((p["rows"], p["cols"]))
    for i, j, a in p["triplets"]:
        A[i, j] += a
    return A


def is_convex(A, lo, hi):
    """Whether the LCP is the minimum of ½ xᵀAx + bᵀx over the box, if A is semidefinite too."""
    return (A == A.T).all()


def is_plain(A, lo, hi):
    """Whether the bounds are 0 and ∞, all that most solvers of LCPs know."""
    return (lo == 0).all() and np.isposinf(hi).all()


def serve(solve, takes=is_convex):
    """Answers what `solve` is made for: problems without friction that it `takes`; claims nothing of others."""
    out = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what a library prints goes to the standard error
    for line in sys.stdin:
        p = json.loads(line)
        A, b = matrix(p["A"]), np.array(p["b"], dtype=float)
        lo, hi = (np.array([float(v) for v in p[key]]) for key in ("lo", "hi"))
        answer = {"status": "outside_class"}
        if "friction_index" not in p and takes(A, lo, hi):
            try:
                answer = {"x": [float(v) for v in solve(A, b, lo, hi, p["tolerance"])]}
            except Exception as error:
                answer = {"status": f"{type(error).__name__}: {error}"}
        print(json.dumps(answer), file=out, flush=True)
