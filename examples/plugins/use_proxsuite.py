"""ProxQP (Bambade et al. 2022), a proximal augmented Lagrangian method, as a plug-in."""
import numpy as np
import proxsuite

from boxes import serve


def solve(A, b, lo, hi, tolerance):
    n = len(b)
    qp = proxsuite.proxqp.dense.QP(n, 0, n)
    qp.settings.eps_abs = tolerance / 10
    qp.init(A, b, None, None, np.eye(n), np.maximum(lo, -1e20), np.minimum(hi, 1e20))
    qp.solve()
    if qp.results.info.status != proxsuite.proxqp.QPSolverOutput.PROXQP_SOLVED:
        raise ValueError(str(qp.results.info.status))
    return np.clip(qp.results.x, lo, hi)


serve(solve)
