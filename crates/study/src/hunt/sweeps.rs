//! Whether an answer without a status may be the last iterate of a solver that ran out of sweeps.
//!
//! Many plug-ins do a fixed number of sweeps and return x. Such an x need not be a claim that it solves the problem, and a
//! search that counted every one as a false claim would find the hardest problem, not the bug. So an x without a
//! status counts as a false claim only where plain projected Gauss-Seidel comes twice as near, both after as many sweeps
//! and after half as many: sweeps in another order may be slower than its own, and with friction sweeps may go round in
//! circles. A method that is slower than that, as Jacobi's is where A is not diagonally dominant, is named. A solver
//! that does not say how many sweeps it did is taken to do ten, a typical engine budget.

use lcplab_judge::{Demand, judge_friction};
use lcplab_problem::friction::Posed;
use lcplab_solver::{ConePgs, Pgs, PolygonPgs, Settings, Solution, Solver, Start};

/// Sweeps of a solver that does not say how many it did.
const USUAL: usize = 10;
/// The same sweeps from another start differ by less than this factor.
const LIKE: f64 = 2.0;

/// The scaled residual that plain projected Gauss-Seidel leaves after as many sweeps as the solution took or after half
/// as many, whichever is larger, times two; that of x = Π(0) where it cannot sweep.
pub(super) fn residual_left(posed: &Posed, solution: &Solution, tolerance: f64) -> f64 {
    let sweeps = if solution.iterations > 1 { solution.iterations } else { USUAL };
    let left = |sweeps| residual(posed, &swept(posed, sweeps, tolerance));
    LIKE * left(sweeps).max(left(sweeps.div_ceil(2)))
}

/// x after so many sweeps of plain projected Gauss-Seidel.
fn swept(posed: &Posed, sweeps: usize, tolerance: f64) -> Vec<f64> {
    let settings = Settings { tolerance, max_iterations: sweeps, ..Settings::default() };
    let start = Start::default();
    let swept = match posed {
        Posed::Boxed(lcp) => Pgs { settings, ..Pgs::default() }.solve(lcp, &start, &mut ()),
        Posed::Polyhedral(polygon) => PolygonPgs { settings }.solve(polygon, &start, &mut ()),
        Posed::Cone(cone) => {
            lcplab_solver::ConeSolver::solve(&ConePgs { settings }, cone, &start, &mut ())
        }
    };
    swept.x
}

/// The judge's scaled residual of x.
pub(super) fn residual(posed: &Posed, x: &[f64]) -> f64 {
    judge_friction(posed, x, &Demand { prove_up_to: 0, ..Demand::default() }).scaled_residual
}
