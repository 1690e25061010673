"""OSQP (Stellato et al. 2020), a first-order method, as a plug-in."""
import numpy as np
import osqp
from scipy import sparse

from boxes import serve


def solve(A, b, lo, hi, tolerance):
    n = len(b)
    solver = osqp.OSQP()
    solver.setup(
        P=sparse.csc_matrix(np.triu(A)), q=b, A=sparse.identity(n, format="csc"), l=lo, u=hi,
        eps_abs=tolerance, eps_rel=tolerance, max_iter=100_000, polishing=True, verbose=False,
    )
    result = solver.solve()
    if result.info.status != "solved":
        raise ValueError(result.info.status)
    return np.clip(result.x, lo, hi)


serve(solve)
