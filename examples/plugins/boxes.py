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


def serve(solve):
    """Minimises ½ xᵀAx + bᵀx over the box, which is the LCP where A is symmetric and semidefinite; claims nothing else."""
    out = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what a library prints goes to the standard error
    for line in sys.stdin:
        p = json.loads(line)
        A, b = matrix(p["A"]), np.array(p["b"], dtype=float)
        lo, hi = (np.array([float(v) for v in p[key]]) for key in ("lo", "hi"))
        answer = {"status": "outside_class"}
        if "friction_index" not in p and (A == A.T).all():
            try:
                answer = {"x": [float(v) for v in solve(A, b, lo, hi, p["tolerance"])]}
            except Exception as error:
                answer = {"status": f"{type(error).__name__}: {error}"}
        print(json.dumps(answer), file=out, flush=True)
