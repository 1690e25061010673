//! Decides whether an answer without a status may be the last iterate of a solver that ran out of
//! sweeps.
//!
//! Many plug-ins do a fixed number of sweeps and return x. Such an x need not be a claim to have
//! solved the problem, and a search that counted every one as a false claim would find the hardest
//! problem, not the bug. Therefore an x without a status counts as a false claim only if plain
//! projected Gauss-Seidel comes twice as near, both after the same number of sweeps and after half
//! of it, in every tested order of the rows: forward, backward, symmetric, or random. With
//! friction, sweeps may cycle, so all iterates between the two are tested. A slower method, such as
//! Jacobi if A is not diagonally dominant, is still reported. A solver that does not report its
//! number of sweeps is assumed to do four.

use std::ops::ControlFlow;

use lcplab_judge::{Demand, judge_friction};
use lcplab_lcp::friction::ProblemForm;
use lcplab_solver::{
    ConePgs, Iterate, Observer, Order, Pgs, PolygonPgs, Settings, Solution, Solver, Start,
};

/// The assumed number of sweeps of a solver that does not report it.
const USUAL: usize = 4;
/// Maximum number of sweeps that are repeated.
const MOST: usize = 10_000;
/// Number of random orders that are tried.
const SHUFFLES: u64 = 4;
/// Number of intermediate iterates that are tested.
const LOOKS: usize = 8;
/// The same sweeps from another start differ by less than this factor.
const LIKE: f64 = 2.0;

/// The largest scaled residual of plain projected Gauss-Seidel between half the sweeps of the
/// solution and all of them, in any of several orders, times two; that of x = Π(0) if Gauss-Seidel
/// cannot sweep.
pub(super) fn residual_left(posed: &ProblemForm, solution: &Solution, tolerance: f64) -> f64 {
    let sweeps = if solution.iterations > 1 { solution.iterations.min(MOST) } else { USUAL };
    let stride = (sweeps / 2).div_ceil(LOOKS).max(1);
    let left = |order: Order| {
        let mut kept = IterateSample { from: sweeps.div_ceil(2), stride, x: Vec::new() };
        let last = swept(posed, sweeps, tolerance, order, &mut kept);
        let residuals = kept.x.iter().chain([&last]).map(|x| residual(posed, x));
        residuals.fold(0.0, f64::max)
    };
    let shuffled = (1..=SHUFFLES).map(|seed| Order::Shuffled { seed });
    let orders = [Order::Natural, Order::Reverse, Order::Symmetric].into_iter().chain(shuffled);
    LIKE * orders.map(left).fold(0.0, f64::max)
}

/// An observer that keeps iterates at a fixed interval from a given one on.
struct IterateSample {
    from: usize,
    stride: usize,
    x: Vec<Vec<f64>>,
}

impl Observer for IterateSample {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        let k = iterate.iteration;
        if k >= self.from && (k - self.from).is_multiple_of(self.stride) {
            self.x.push(iterate.x.to_vec());
        }
        ControlFlow::Continue(())
    }
}

/// x after this number of sweeps of plain projected Gauss-Seidel; polygons and cones have only one
/// order.
fn swept(
    posed: &ProblemForm,
    sweeps: usize,
    tolerance: f64,
    order: Order,
    observer: &mut dyn Observer,
) -> Vec<f64> {
    let settings = Settings::default().with_tolerance(tolerance).with_max_iterations(sweeps);
    let start = Start::default();
    let swept = match posed {
        ProblemForm::Boxed(lcp) => {
            Pgs { settings, order, ..Pgs::default() }.solve(lcp, &start, observer)
        }
        ProblemForm::Polyhedral(polygon) => {
            PolygonPgs { settings }.solve(polygon, &start, observer)
        }
        ProblemForm::Cone(cone) => {
            lcplab_solver::ConeSolver::solve(&ConePgs { settings }, cone, &start, observer)
        }
    };
    swept.x
}

/// The judge's scaled residual of x.
pub(super) fn residual(posed: &ProblemForm, x: &[f64]) -> f64 {
    judge_friction(posed, x, &Demand { prove_up_to: 0, ..Demand::default() }).scaled_residual
}
