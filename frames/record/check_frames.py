"""Checks recorded frames, and solves each without lcplab.

For each frame: sizes, finite numbers, M positive definite, A symmetric and positive semidefinite, b as stated. Then the
problem under the frame's own law is solved: boxes and associated cones are one convex program (clarabel); for
Coulomb's law it is solved again and again with b_n + mu |w_t| (De Saxce), and Newton's method on x - P(x - w / s)
polishes the answer to 1e-12. What is left above the tolerance is begun again by Gauss-Seidel, contact by
contact. A line says how hard that was. With two folders more, the frame is also written as a
problem file and its answer as an answer file.

    python check_frames.py FRAMES [PROBLEMS ANSWERS]
"""

import json
import pathlib
import sys
import time

import clarabel
import numba
import numpy as np
import scipy.sparse as sp

from frames import Frame

TOLERANCE = 1e-8
GOAL = 1e-12  # what Newton aims at


def check(frame):
    """Raises unless the arrays of a frame agree with each other."""
    n, k = frame.J.shape
    assert all(len(a) == n for a in (frame.R, frame.bias, frame.lo, frame.hi, frame.friction_index, frame.mu))
    assert frame.M.shape == (k, k) and len(frame.u_star) == k
    for array in (frame.J.data, frame.M.data, frame.R, frame.bias, frame.u_star, frame.mu):
        assert np.isfinite(array).all()
    assert (frame.M != frame.M.T).nnz == 0
    assert np.linalg.eigvalsh(frame.M.toarray())[0] > 0
    assert (frame.R >= 0).all() and (frame.lo <= frame.hi).all() and (frame.mu >= 0).all()
    assert np.linalg.eigvalsh(frame.A)[0] > -1e-10 * np.abs(frame.A).max()
    for i in np.flatnonzero(frame.friction_index >= 0):
        normal = frame.friction_index[i]
        assert normal in (i - 1, i - 2) and frame.lo[normal] == 0 and frame.hi[normal] == np.inf
        assert frame.lo[i] == -np.inf and frame.hi[i] == np.inf
    assert (np.abs(frame.J).sum(axis=1) > 0).all()


def normals(frame):
    """The rows of the contacts' normals, and their coefficients."""
    rows = np.unique(frame.friction_index[frame.friction_index >= 0]).astype(np.int64)
    return rows, frame.mu[rows + 1] if len(rows) else np.zeros(0)


@numba.njit
def project(y, mu):
    """The nearest point with |y_t| <= mu y_n."""
    t = np.sqrt(y[1] ** 2 + y[2] ** 2)
    if t <= mu * y[0]:
        return y.copy()
    if mu * t <= -y[0]:
        return np.zeros(3)
    n = (y[0] + mu * t) / (1 + mu**2)
    return np.array([n, mu * n * y[1] / t, mu * n * y[2] / t])


def slope(y, mu):
    """The derivative of `project` at y."""
    t = np.hypot(y[1], y[2])
    if t <= mu * y[0]:
        return np.eye(3)
    if mu * t <= -y[0]:
        return np.zeros((3, 3))
    d = y[1:] / t
    along = np.array([1, mu * d[0], mu * d[1]])
    D = np.outer(along, along) / (1 + mu**2)
    D[1:, 1:] += (y[0] + mu * t) / (1 + mu**2) * mu / t * (np.eye(2) - np.outer(d, d))
    return D


def natural(law, x):
    """x - P(x - w / s), its largest part in units of each row's terms, and its derivative."""
    A, b, lo, hi, rows, mu, is_coulomb, scale = law
    w = A @ x + b
    terms = np.abs(A) @ np.abs(x) + np.abs(b)
    s = np.diag(A).copy()
    s[s == 0] = 1
    for r in rows:
        s[r : r + 3] = s[r : r + 3].max()
        terms[r + 1 : r + 3] = terms[r + 1 : r + 3].max()
    V, v = A.copy(), w.copy()
    if is_coulomb:
        for r, m in zip(rows, mu):
            t = np.hypot(w[r + 1], w[r + 2])
            v[r] += m * t
            if t > 0:
                V[r] += m * (w[r + 1] * A[r + 1] + w[r + 2] * A[r + 2]) / t
    y = x - v / s
    Y = np.eye(len(b)) - V / s[:, None]
    moved = np.clip(y, lo, hi)
    D = Y * ((y > lo) & (y < hi))[:, None]
    for r, m in zip(rows, mu):
        part = slice(r, r + 3)
        moved[part] = project(y[part], m)
        D[part] = slope(y[part], m) @ Y[part]
    F = x - moved
    return F, np.max(np.abs(F) * s / np.maximum(terms, s * scale)), np.eye(len(b)) - D


def newton(law, x, steps=25):
    """Semismooth Newton steps of least length, halved until |F| falls; the best x and its residual."""
    F, size, D = natural(law, x)
    best, count = (size, x), 0
    for count in range(1, steps + 1):
        change = np.linalg.lstsq(D, -F, rcond=1e-12)[0]
        for length in (1, 0.5, 0.25, 0.125, 0.05, 0.01):
            trial = natural(law, x + length * change)
            if np.linalg.norm(trial[0]) < np.linalg.norm(F):
                break
        x, (F, size, D) = x + length * change, trial
        best = min(best, (size, x), key=lambda pair: pair[0])
        if size <= GOAL:
            break
    return best[1], best[0], count


def convex(frame, b, rows, mu):
    """min 1/2 |z|^2 + 1/2 x' R x + b' x, z = inv(L) J' x with M = L L', over boxes and cones, by clarabel.

    A, which is singular, is not formed; each contact and row is scaled to a unit diagonal."""
    n, k = frame.J.shape
    d = 1 / np.sqrt(np.where(np.diag(frame.A) > 0, np.diag(frame.A), 1))
    for r in rows:
        d[r : r + 3] = d[r : r + 3].min()
    size = max(np.abs(b * d).max(), 1e-300)
    half = np.linalg.solve(np.linalg.cholesky(frame.M.toarray()), frame.J.toarray().T) * d  # k x n
    G, h, cones = [sp.hstack([sp.csr_array(half), -sp.eye_array(k)])], [np.zeros(k)], [clarabel.ZeroConeT(k)]
    plain = np.setdiff1d(np.arange(n), np.concatenate([rows, rows + 1, rows + 2]) if len(rows) else [])
    for sign, bound in ((1, frame.hi), (-1, frame.lo)):
        for i in plain[np.isfinite(bound[plain])]:
            G.append(sp.csr_array(([float(sign)], ([0], [i])), shape=(1, n + k)))
            h.append([sign * bound[i] / d[i] / size])
            cones.append(clarabel.NonnegativeConeT(1))
    for r, m in zip(rows, mu):
        G.append(sp.csr_array(([-m, -1, -1], ([0, 1, 2], [r, r + 1, r + 2])), shape=(3, n + k)))
        h.append(np.zeros(3))
        cones.append(clarabel.SecondOrderConeT(3))
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = 1e-13
    settings.max_iter = 300
    P = sp.diags_array(np.concatenate([frame.R * d**2, np.ones(k)]))
    q = np.concatenate([b * d / size, np.zeros(k)])
    solver = clarabel.DefaultSolver(
        sp.csc_matrix(P), q, sp.csc_matrix(sp.vstack(G)), np.concatenate(h), cones, settings
    )
    return np.array(solver.solve().x)[:n] * d * size


@numba.njit
def sweep(A, b, rows, mu, is_coulomb, x, count):
    """Blockwise projected Gauss-Seidel over contacts."""
    for _ in range(count):
        for c in range(len(rows)):
            part = slice(rows[c], rows[c] + 3)
            block = A[part, part].copy()
            old, step = x[part].copy(), 1 / np.trace(block)
            free = A[part] @ x + b[part]
            y, w = old.copy(), free.copy()
            for _ in range(40):
                if is_coulomb:
                    w[0] += mu[c] * np.sqrt(w[1] ** 2 + w[2] ** 2)
                y = project(y - step * w, mu[c])
                w = free + block @ (y - old)
            x[part] = y


def solve(frame):
    """x, its residual, and how hard it was: convex programs, Newton steps."""
    A, b, lo, hi = frame.A, frame.b, frame.lo, frame.hi
    rows, mu = normals(frame)
    law = (A, b, lo, hi, rows, mu, frame.cone == "coulomb-cone", frame.scale)
    shift, best, steps = b.copy(), (np.inf, np.zeros(len(b))), 0
    for programs in range(1, 61):
        x = convex(frame, shift, rows, mu)
        if not np.isfinite(x).all():
            x = best[1]
        best = min(best, (natural(law, x)[1], x), key=lambda pair: pair[0])
        if programs in (1, 3) or programs % 10 == 0:
            polished, size, count = newton(law, x)
            steps += count
            best = min(best, (size, polished), key=lambda pair: pair[0])
            if best[0] <= (GOAL if programs < 30 else TOLERANCE / 10):
                break
        w = A @ x + b
        shift = b.copy()
        shift[rows] += mu * np.hypot(w[rows + 1], w[rows + 2]) if law[6] else 0
    effort = f"{programs} programs, {steps} Newton steps"
    if best[0] > TOLERANCE and 3 * len(rows) == len(b):
        x = np.zeros(len(b))
        for sweeps in (10_000, 20_000, 30_000, 40_000):
            sweep(A, b, rows, mu, law[6], x, 10_000)
            polished, size, _ = newton(law, x)
            best = min(best, (natural(law, x)[1], x.copy()), (size, polished), key=lambda pair: pair[0])
            if best[0] <= TOLERANCE:
                break
        effort += f", {sweeps} sweeps"
    return best[1], best[0], effort


def describe(frame):
    """Rank, condition and smallest nonzero eigenvalue of J inv(M) J'."""
    values = np.linalg.eigvalsh(frame.bare)
    positive = values[values > 1e-14 * len(values) * values[-1]]
    return len(positive), positive[-1] / positive[0], positive[0]


def main(folder, problems=None, answers=None):
    total, table = 0, []
    for path in sorted(pathlib.Path(folder).glob("*.npz")):
        frame = Frame(path)
        total += path.stat().st_size
        check(frame)
        if problems:
            (pathlib.Path(problems) / f"{frame.name}.json").write_text(json.dumps(frame.problem()))
        start = time.perf_counter()
        x, size, effort = solve(frame)
        seconds = time.perf_counter() - start
        rank, condition, smallest = describe(frame)
        table.append((frame, rank, condition, smallest, size, effort))
        print(
            f"{frame.name:34} {len(frame.b):4} rows, rank {rank:3}: {frame.cone}, {size:.1e}, {effort}, {seconds:.1f} s",
            flush=True,
        )
        if answers:
            (pathlib.Path(answers) / f"{frame.name}.json").write_text(json.dumps({"x": x.tolist()}))
    print(f"{len(table)} frames, {total} bytes, {sum(row[4] <= TOLERANCE for row in table)} solved to {TOLERANCE}")
    return table


if __name__ == "__main__":
    main(*sys.argv[1:])
