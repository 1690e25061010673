"""Lemke's method of QuantEcon, with lexicographic ties, as a plug-in."""
import numpy as np
from quantecon.optimize import lcp_lemke

from boxes import is_plain, serve


def solve(A, b, lo, hi, tolerance):
    result = lcp_lemke(np.ascontiguousarray(A, dtype=float), np.asarray(b, dtype=float))
    if not result.success:
        raise ValueError(f"lcp_lemke returns {result.status}")
    return result.z


solve(np.eye(1), -np.ones(1), None, None, None)  # compiles it, before a time is taken
serve(solve, takes=is_plain)
