//! Whether an answer without a status may be the last iterate of a solver that ran out of sweeps.
//!
//! Many plug-ins do a fixed number of sweeps and return x. Such an x need not be a claim that it solves the problem, and a
//! search that counted every one as a false claim would find the hardest problem, not the bug. So an x without a
//! status counts as a false claim only where it is worse than what plain projected Gauss-Seidel has after *half* as
//! many sweeps: Jacobi needs about twice the sweeps of Gauss-Seidel (Varga 1962), and no usable method is worse. A
//! solver that does not say how many sweeps it did is taken to do ten, a typical engine budget.

use lcplab_judge::{Demand, judge_friction};
use lcplab_problem::friction::Posed;
use lcplab_solver::{ConePgs, Pgs, PolygonPgs, Settings, Solution, Solver, Start};

/// Sweeps of a solver that does not say how many it did.
const USUAL: usize = 10;

/// The scaled residual that plain projected Gauss-Seidel leaves after half as many sweeps as the solution took; that of
/// x = Π(0) where it cannot sweep.
pub(super) fn residual_left(posed: &Posed, solution: &Solution, tolerance: f64) -> f64 {
    let sweeps = if solution.iterations > 1 { solution.iterations } else { USUAL };
    let settings =
        Settings { tolerance, max_iterations: sweeps.div_ceil(2), ..Settings::default() };
    let start = Start::default();
    let swept = match posed {
        Posed::Boxed(lcp) => Pgs { settings, ..Pgs::default() }.solve(lcp, &start, &mut ()),
        Posed::Polyhedral(polygon) => PolygonPgs { settings }.solve(polygon, &start, &mut ()),
        Posed::Cone(cone) => {
            lcplab_solver::ConeSolver::solve(&ConePgs { settings }, cone, &start, &mut ())
        }
    };
    residual(posed, &swept.x)
}

/// The judge's scaled residual of x.
pub(super) fn residual(posed: &Posed, x: &[f64]) -> f64 {
    judge_friction(posed, x, &Demand { prove_up_to: 0, ..Demand::default() }).scaled_residual
}
