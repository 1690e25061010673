"""The methods in their shortest form, in NumPy, with the symbols of the lessons.

These functions are for reading. They have no tolerances, no limits and no friction, and they return a wrong answer or none
for a matrix outside their class. To solve problems, use the solvers of the same names; on problems without ties both give
the same x.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def jacobi(A: Array, b: Array, lo: Array, hi: Array, damping: float, sweeps: int) -> Array:
    """Return x after a number of damped Jacobi sweeps from 0: each sweep updates all rows at once."""
    x = np.zeros(len(b))
    for _ in range(sweeps):
        w = A @ x + b  # with the x of the sweep before
        x = np.clip(x - damping * w / np.diag(A), lo, hi)
    return x


def gauss_seidel(A: Array, b: Array, lo: Array, hi: Array, sweeps: int) -> Array:
    """Return x after a number of sweeps from 0: each row in turn sets its w to 0, as far as its bounds allow."""
    x = np.zeros(len(b))
    for _ in range(sweeps):
        for i in range(len(b)):
            w = A[i] @ x + b[i]  # with the x of this sweep where there is one
            x[i] = min(max(x[i] - w / A[i, i], lo[i]), hi[i])
    return x


def point(A: Array, b: Array, F: NDArray[np.bool_]) -> Array:
    """The point of a set F of free rows: A_FF x_F = -b_F, and x = 0 elsewhere."""
    x = np.zeros(len(b))
    x[F] = np.linalg.solve(A[np.ix_(F, F)], -b[F])
    return x


def murty(A: Array, b: Array) -> Array:
    """Solve 0 <= x, w = A x + b >= 0, x_i w_i = 0 for a P-matrix A."""
    F = np.zeros(len(b), dtype=bool)
    while True:
        x = point(A, b, F)
        w = A @ x + b
        wrong = np.flatnonzero(np.where(F, x < 0, w < 0))
        if len(wrong) == 0:
            return x
        F[wrong[0]] ^= True  # the first wrong row changes sides


def lemke(A: Array, b: Array) -> Array | None:
    """Solve 0 <= x, w = A x + b >= 0, x_i w_i = 0; returns None if the path ends on a ray.

    The tableau says w = A x + z0 e + b. Variable i is w_i, n + i is x_i, 2n is the cover z0.
    """
    n = len(b)
    T = np.column_stack([np.eye(n), -A, -np.ones(n), b])
    basis = list(range(n))
    if (b >= 0).all():
        return np.zeros(n)  # nothing to cover
    row, entering = int(np.argmin(b)), 2 * n  # z0 enters with the least value that covers all
    while True:
        T[row] /= T[row, entering]
        for i in range(n):
            if i != row:
                T[i] -= T[i, entering] * T[row]
        leaving, basis[row] = basis[row], entering
        if leaving == 2 * n:
            break  # z0 is gone
        entering = leaving + n if leaving < n else leaving - n  # the partner
        falls = np.flatnonzero(T[:, entering] > 0)
        if len(falls) == 0:
            return None  # a ray
        row = int(falls[np.argmin(T[falls, -1] / T[falls, entering])])
    x = np.zeros(n)
    for i, variable in enumerate(basis):
        if variable >= n:
            x[variable - n] = T[i, -1]
    return x


def dantzig(A: Array, b: Array, lo: Array, hi: Array) -> Array:
    """Solve lo <= x <= hi, with w > 0 only if x = lo and w < 0 only if x = hi, for a symmetric definite A.

    Rows 0 .. k - 1 are satisfied and stay so while row k moves: free rows keep w = 0, the others keep x.
    """
    n = len(b)
    x = np.clip(np.zeros(n), lo, hi)
    w = A @ x + b
    F = np.zeros(n, dtype=bool)
    for k in range(n):
        while True:
            bound = lo[k] if w[k] > 0 else hi[k]
            if w[k] == 0 or x[k] == bound:
                F[k] = lo[k] < x[k] < hi[k]
                break  # row k is satisfied
            sign = np.sign(bound - x[k])
            d = point(A, sign * A[:, k], F)  # A_FF d_F = -A_Fk d_k
            d[k] = sign
            v = A @ d  # how fast w changes along d
            # How far until w_k is 0, or x_k at its bound, or a row before it at the end of its side?
            ends = [(-w[k] / v[k], k, True), ((bound - x[k]) / d[k], k, False)]
            for i in range(k):
                leaves_bound = v[i] < 0 if x[i] == lo[i] else v[i] > 0
                if F[i] and d[i] != 0:
                    ends.append(((hi[i] if d[i] > 0 else lo[i]) / d[i] - x[i] / d[i], i, False))
                elif not F[i] and lo[i] < hi[i] and leaves_bound:
                    ends.append((-w[i] / v[i], i, True))
            length, i, becomes_free = min(ends, key=lambda end: end[0])
            x, w = x + length * d, w + length * v
            F[i] = becomes_free
            if becomes_free:
                w[i] = 0.0
            else:
                x[i] = hi[i] if d[i] > 0 else lo[i]
    return x


def interior_point(A: Array, b: Array, steps: int) -> Array:
    """Return x after a number of steps toward 0 <= x, w = A x + b >= 0, x_i w_i = 0; A symmetric semidefinite."""
    n = len(b)
    x, w = np.ones(n), np.ones(n)

    def farthest(v: Array, dv: Array) -> float:
        falls = dv < 0
        return 0.99 * float(np.min(-v[falls] / dv[falls], initial=np.inf))

    for _ in range(steps):
        mu = 0.1 * (x @ w) / n  # a tenth of what it is now
        miss = A @ x + b - w
        # Newton's step on w = A x + b and x_i w_i = mu, without dw
        dx = np.asarray(np.linalg.solve(A + np.diag(w / x), -miss - w + mu / x), dtype=np.float64)
        dw = np.asarray(A @ dx + miss, dtype=np.float64)
        length = min(farthest(x, dx), farthest(w, dw), 1.0)
        x, w = x + length * dx, w + length * dw
    return x
