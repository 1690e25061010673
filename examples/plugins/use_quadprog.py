"""quadprog (Goldfarb & Idnani 1983), an active-set method for definite A, as a plug-in."""
import numpy as np
import quadprog

from boxes import serve


def solve(A, b, lo, hi, tolerance):
    n, low, high = len(b), np.isfinite(lo), np.isfinite(hi)
    sides = np.hstack([np.eye(n)[:, low], -np.eye(n)[:, high]])
    limits = np.concatenate([lo[low], -hi[high]])
    if sides.size == 0:
        return np.linalg.solve(A, -b)
    return np.clip(quadprog.solve_qp(A, -b, sides, limits)[0], lo, hi)


serve(solve)
