"""SciPy's lsq_linear (Stark & Parker 1995), bounded least squares, as a plug-in: A = RᵀR, and R x is to be near −R⁻ᵀ b."""
import numpy as np
from scipy.optimize import lsq_linear

from boxes import serve


def solve(A, b, lo, hi, tolerance):
    values, vectors = np.linalg.eigh(A)
    kept = values > 1e-13 * max(values.max(), 0.0)
    roots, vectors = np.sqrt(values[kept]), vectors[:, kept]
    R, c = roots[:, None] * vectors.T, -(vectors.T @ b) / roots
    result = lsq_linear(R, c, bounds=(lo, hi), method="bvls", tol=tolerance**2, max_iter=10_000)
    return np.clip(result.x, lo, hi)


serve(solve)
