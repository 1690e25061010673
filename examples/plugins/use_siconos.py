"""Lemke's method of Siconos as a plug-in."""
import numpy as np
import siconos.numerics as numerics

from boxes import is_plain, serve


def solve(A, b, lo, hi, tolerance):
    x, w = np.zeros(len(b)), np.zeros(len(b))
    options = numerics.SolverOptions(numerics.SICONOS_LCP_LEMKE)
    failure = numerics.linearComplementarity_driver(numerics.LCP(A, b), x, w, options)
    if failure:
        raise ValueError(f"linearComplementarity_driver returns {failure}")
    return np.maximum(x, 0)


serve(solve, takes=is_plain)
