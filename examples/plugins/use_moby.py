"""Drake's MobyLcpSolver, Lemke's method with regularization where it fails, as a plug-in."""
import numpy as np
from pydrake.solvers import MathematicalProgram, MobyLcpSolver

from boxes import is_plain, serve


def solve(A, b, lo, hi, tolerance):
    program = MathematicalProgram()
    x = program.NewContinuousVariables(len(b))
    program.AddLinearComplementarityConstraint(A, b, x)
    result = MobyLcpSolver().Solve(program)
    if not result.is_success():
        raise ValueError(result.get_solution_result())
    return np.maximum(result.GetSolution(x), 0)


serve(solve, takes=is_plain)
