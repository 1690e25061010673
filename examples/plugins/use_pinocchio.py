"""ADMM of Pinocchio 4 (Carpentier et al. 2024), a solver for constraint impulses, as a plug-in."""
import numpy as np
import pinocchio

from boxes import is_convex, is_plain, serve


def solve(A, b, lo, hi, tolerance):
    rows, data = stops(len(b))
    settings = pinocchio.ADMMSolverSettings()
    settings.absolute_feasibility_tol = settings.absolute_complementarity_tol = tolerance / 10
    settings.relative_feasibility_tol = settings.relative_complementarity_tol = 0
    settings.max_iterations = 100_000
    result = pinocchio.ADMMSolverResult()
    solver = pinocchio.ADMMConstraintSolver()
    solver.solve(pinocchio.DelassusOperatorDense(A), b, rows, data, settings, result)
    if not result.converged:
        raise ValueError(f"not converged after {result.iterations} iterations")
    return result.retrieveConstraintImpulses()


def stops(n):
    """n sliders, each at its lower stop: an impulse x >= 0, a velocity w >= 0, and x w = 0."""
    model = pinocchio.Model()
    for k in range(n):
        model.addJoint(0, pinocchio.JointModelPX(), pinocchio.SE3.Identity(), str(k))
    joints = list(range(1, n + 1))
    limits = pinocchio.JointLimitConstraintModel(model, joints, np.zeros(n), np.full(n, np.inf))
    limits.makeSelectionMaximal()
    rows, data = pinocchio.StdVec_ConstraintModel(), pinocchio.StdVec_ConstraintData()
    rows.append(pinocchio.ConstraintModel(limits))
    data.append(rows[0].createData())
    return rows, data


def is_symmetric_and_plain(A, lo, hi):
    return is_convex(A, lo, hi) and is_plain(A, lo, hi)


serve(solve, takes=is_symmetric_and_plain)
