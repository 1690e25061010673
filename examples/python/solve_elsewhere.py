"""A problem file of lcplab solved by SciPy, OSQP and quadprog, beside lcplab's own answer.

For symmetric A the problem is a quadratic program over a box,

    min  1/2 x' A x + b' x        lo <= x <= hi,

whose gradient is lcplab's w. Every answer is measured the same way: the natural residual
max |x - P(x - w)|, P the projection onto the box, and the distance to lcplab's x.
"""

import argparse
import json
import subprocess
import sys
import time

import numpy as np
import osqp
import quadprog
import scipy.optimize
import scipy.sparse


def read(path):
    """A, b, lo, hi of a problem file without friction rows and with symmetric A."""
    with open(path) as file:
        problem = json.load(file)
    if any(k >= 0 for k in problem.get("friction_index", [])):
        sys.exit(f"{path}: has friction rows, whose bounds depend on x: no quadratic program")
    b = np.array(problem["b"])
    if "dense" in problem["A"]:
        A = np.array(problem["A"]["dense"])
    else:
        rows, cols, values = zip(*problem["A"]["triplets"])
        A = scipy.sparse.coo_array((values, (rows, cols)), shape=(len(b), len(b))).toarray()
    if not np.array_equal(A, A.T):
        sys.exit(f"{path}: A is not symmetric: no quadratic program")
    bound = lambda key, default: np.array([float(v) for v in problem.get(key, [default] * len(b))])
    return A, b, bound("lo", 0.0), bound("hi", np.inf)


def l_bfgs_b(A, b, lo, hi):
    function = lambda x: (x @ A @ x / 2 + b @ x, A @ x + b)
    options = {"maxiter": 100_000, "maxfun": 1_000_000, "ftol": 0, "gtol": 1e-12, "maxcor": 50}
    start = np.clip(np.zeros(len(b)), lo, hi)
    return scipy.optimize.minimize(function, start, jac=True, bounds=list(zip(lo, hi)), options=options).x


def trust_constr(A, b, lo, hi):
    function, gradient = lambda x: x @ A @ x / 2 + b @ x, lambda x: A @ x + b
    bounds = scipy.optimize.Bounds(lo, hi)
    options = {"gtol": 1e-10, "xtol": 1e-12, "barrier_tol": 1e-10, "maxiter": 2000}
    start = np.clip(np.ones(len(b)), lo, hi)
    return scipy.optimize.minimize(
        function, start, method="trust-constr", jac=gradient, hess=lambda x: A, bounds=bounds, options=options
    ).x


def lsq_linear(A, b, lo, hi):
    """min |L' x + inv(L) b|^2 with A = L L': only for positive definite A."""
    L = np.linalg.cholesky(A)
    return scipy.optimize.lsq_linear(L.T, -np.linalg.solve(L, b), (lo, hi), method="bvls", tol=1e-14).x


def by_osqp(A, b, lo, hi):
    solver = osqp.OSQP()
    identity = scipy.sparse.identity(len(b), format="csc")
    settings = dict(eps_abs=1e-10, eps_rel=1e-10, max_iter=100_000, polishing=True, verbose=False)
    solver.setup(scipy.sparse.csc_matrix(np.triu(A)), b, identity, lo, hi, **settings)
    return solver.solve().x


def by_quadprog(A, b, lo, hi):
    """Goldfarb and Idnani's dual method: only for positive definite A."""
    identity, has_lo, has_hi = np.eye(len(b)), np.isfinite(lo), np.isfinite(hi)
    sides = np.hstack([identity[:, has_lo], -identity[:, has_hi]])
    return quadprog.solve_qp(A, -b, sides, np.hstack([lo[has_lo], -hi[has_hi]]))[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problem", help="a problem file")
    parser.add_argument("--answer", action="append", default=[], help="another answer: a JSON object with x")
    parser.add_argument("--lcplab", default="lcplab", help="lcplab's program")
    options = parser.parse_args()
    A, b, lo, hi = read(options.problem)

    def by_lcplab(*_):
        command = [options.lcplab, "solve", options.problem, "--json"]
        return np.array(json.loads(subprocess.run(command, capture_output=True, text=True).stdout)["x"])

    solvers = [("lcplab", by_lcplab), ("SciPy L-BFGS-B", l_bfgs_b), ("SciPy trust-constr", trust_constr),
               ("SciPy lsq_linear", lsq_linear), ("OSQP, polished", by_osqp), ("quadprog", by_quadprog)]
    for path in options.answer:
        with open(path) as file:
            answer = json.load(file)
        solvers.append((answer.get("solver", path), lambda *_, x=answer["x"]: np.array(x)))
    ours = None
    print(f"{options.problem}: {len(b)} rows\n{'solver':<20} {'residual':>10} {'|x - ours|':>10} {'objective':>16} {'ms':>8}")
    for name, solve in solvers:
        begin = time.perf_counter()
        try:
            x = solve(A, b, lo, hi)
        except (ValueError, np.linalg.LinAlgError, FileNotFoundError) as reason:
            print(f"{name:<20} {reason}")
            continue
        milliseconds = 1000 * (time.perf_counter() - begin)
        ours = x if ours is None else ours
        w = A @ x + b
        residual, objective = np.abs(x - np.clip(x - w, lo, hi)).max(), x @ A @ x / 2 + b @ x
        distance = np.abs(x - ours).max()
        print(f"{name:<20} {residual:>10.1e} {distance:>10.1e} {objective:>16.9f} {milliseconds:>8.1f}")
    if np.linalg.matrix_rank(A) < len(b):
        print("A is singular: several x are right, so compare objectives, not |x - ours|")


if __name__ == "__main__":
    main()
