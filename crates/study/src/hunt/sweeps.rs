//! Whether an answer without a status may be the last iterate of a solver that ran out of sweeps.
//!
//! Many plug-ins do a fixed number of sweeps and return x. Such an x need not be a claim that it
//! solves the problem, and a search that counted every one as a false claim would find the hardest
//! problem, not the bug. So an x without a status counts as a false claim only where plain
//! projected Gauss-Seidel comes twice as near, both after as many sweeps and after half as many, in
//! whichever order the rows are swept: forward, backward, both, or at random. With friction sweeps
//! may go round in circles, so all iterates between the two are looked at. A method that is slower
//! than that, as Jacobi's is where A is not diagonally dominant, is named. A solver that does not
//! say how many sweeps it did is taken to do four.

use std::ops::ControlFlow;

use lcplab_judge::{Demand, judge_friction};
use lcplab_problem::friction::Posed;
use lcplab_solver::{
    ConePgs, Iterate, Observer, Order, Pgs, PolygonPgs, Settings, Solution, Solver, Start,
};

/// Sweeps of a solver that does not say how many it did.
const USUAL: usize = 4;
/// More sweeps are not repeated.
const MOST: usize = 10_000;
/// So many random orders are tried.
const SHUFFLES: u64 = 4;
/// So many iterates are looked at on the way.
const LOOKS: usize = 8;
/// The same sweeps from another start differ by less than this factor.
const LIKE: f64 = 2.0;

/// The largest scaled residual that plain projected Gauss-Seidel leaves from half as many sweeps as
/// the solution took up to as many, in any of several orders, times two; that of x = Π(0) where it
/// cannot sweep.
pub(super) fn residual_left(posed: &Posed, solution: &Solution, tolerance: f64) -> f64 {
    let sweeps = if solution.iterations > 1 { solution.iterations.min(MOST) } else { USUAL };
    let stride = (sweeps / 2).div_ceil(LOOKS).max(1);
    let left = |order: Order| {
        let mut kept = Kept { from: sweeps.div_ceil(2), stride, x: Vec::new() };
        let last = swept(posed, sweeps, tolerance, order, &mut kept);
        let residuals = kept.x.iter().chain([&last]).map(|x| residual(posed, x));
        residuals.fold(0.0, f64::max)
    };
    let shuffled = (1..=SHUFFLES).map(|seed| Order::Shuffled { seed });
    let orders = [Order::Natural, Order::Reverse, Order::Symmetric].into_iter().chain(shuffled);
    LIKE * orders.map(left).fold(0.0, f64::max)
}

/// Keeps every so manieth iterate from one on.
struct Kept {
    from: usize,
    stride: usize,
    x: Vec<Vec<f64>>,
}

impl Observer for Kept {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        let k = iterate.iteration;
        if k >= self.from && (k - self.from).is_multiple_of(self.stride) {
            self.x.push(iterate.x.to_vec());
        }
        ControlFlow::Continue(())
    }
}

/// x after so many sweeps of plain projected Gauss-Seidel; polygons and cones have one order.
fn swept(
    posed: &Posed,
    sweeps: usize,
    tolerance: f64,
    order: Order,
    observer: &mut dyn Observer,
) -> Vec<f64> {
    let settings = Settings { tolerance, max_iterations: sweeps, ..Settings::default() };
    let start = Start::default();
    let swept = match posed {
        Posed::Boxed(lcp) => Pgs { settings, order, ..Pgs::default() }.solve(lcp, &start, observer),
        Posed::Polyhedral(polygon) => PolygonPgs { settings }.solve(polygon, &start, observer),
        Posed::Cone(cone) => {
            lcplab_solver::ConeSolver::solve(&ConePgs { settings }, cone, &start, observer)
        }
    };
    swept.x
}

/// The judge's scaled residual of x.
pub(super) fn residual(posed: &Posed, x: &[f64]) -> f64 {
    judge_friction(posed, x, &Demand { prove_up_to: 0, ..Demand::default() }).scaled_residual
}
