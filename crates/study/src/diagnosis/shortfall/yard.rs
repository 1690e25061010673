//! How much of what the constraints have to do is missing in an x.
//!
//! ```text
//! missing = ‖x − x*‖_A / max(‖Π(0) − x*‖_A, |M⁻¹F|_M),   ‖e‖_A² = eᵀ A e = |M⁻¹ Jᵀ e|_M²
//! ```
//!
//! with a solution x* and the weights F. It compares motions: forces that redundant rows share in one way or another count as
//! one. Doing nothing misses all of it, 1, where bodies rest; where next to nothing is to be done, an error is beside what
//! gravity does.

use std::ops::ControlFlow;

use lcplab_problem::{Lcp, merit};
use lcplab_solver::{Iterate, Observer, Options, Settings, Solver, Start, Status, by_name};

/// A solution that is to serve as a yardstick has this scaled residual.
const TOLERANCE: f64 = 1e-8;

/// Who looks for it, and with how many iterations.
const EFFORTS: [(&str, usize); 4] =
    [("block-pivoting", 300), ("dantzig", 2_000), ("newton", 50), ("anderson-pgs", 1_000)];

/// The part of the diagonal's step below which a row that should be free is.
const FREE: f64 = 1e-7;

/// A problem with a solution of it.
#[derive(Debug, Clone)]
pub struct Yard<'a> {
    lcp: &'a Lcp,
    /// x*.
    pub exact: Vec<f64>,
    size: f64,
}

impl<'a> Yard<'a> {
    /// The yardstick of a problem with a symmetric A, where gravity does `weight`; `None` if no solution was found.
    pub fn new(lcp: &'a Lcp, weight: f64) -> Option<Self> {
        if !lcp.matrix().is_nearly_symmetric() {
            return None;
        }
        let exact = solution(lcp)?;
        let yard = Yard { lcp, exact, size: 1.0 };
        let size = yard.apart_in_full(&start(lcp), &yard.exact);
        Some(Yard { size: if size > 0.0 { size.max(weight) } else { 0.0 }, ..yard })
    }

    /// Whether the constraints have something to do.
    pub fn is_needed(&self) -> bool {
        self.size > 0.0
    }

    /// What is missing in x, as a part of what was to be done.
    pub fn missing(&self, x: &[f64]) -> f64 {
        self.apart(x, &self.exact)
    }

    /// How far two x are apart, on the same scale.
    pub fn apart(&self, x: &[f64], y: &[f64]) -> f64 {
        if self.size > 0.0 { self.apart_in_full(x, y) / self.size } else { 0.0 }
    }

    /// ‖x − y‖_A.
    fn apart_in_full(&self, x: &[f64], y: &[f64]) -> f64 {
        let error: Vec<f64> = x.iter().zip(y).map(|(x, y)| x - y).collect();
        let product = |i: usize| {
            let row = self.lcp.matrix().row(i);
            row.iter().map(|(j, a)| a * error[j]).sum::<f64>() * error[i]
        };
        (0..error.len()).map(product).sum::<f64>().max(0.0).sqrt()
    }

    /// What is missing after each sweep, from `x` on, as many as it takes to `target` but at most `most`.
    pub fn course(&self, solver: &dyn Solver, x: &[f64], target: f64) -> Vec<f64> {
        let mut course = Course { yard: self, target, missing: vec![self.missing(x)] };
        solver.solve(self.lcp, &Start::at(x), &mut course);
        course.missing
    }

    /// The rows whose w is 0: between their bounds, or at one that does not hold them.
    pub fn free_rows(&self) -> Vec<bool> {
        let w = self.lcp.w(&self.exact);
        let size = |i: usize| {
            let row = self.lcp.matrix().row(i);
            row.iter().map(|(j, a)| (a * self.exact[j]).abs()).sum::<f64>() + self.lcp.b()[i].abs()
        };
        (0..w.len()).map(|i| w[i].abs() <= FREE * size(i)).collect()
    }
}

/// Where sweeps start that know nothing: Π(0).
pub fn start(lcp: &Lcp) -> Vec<f64> {
    let mut x = vec![0.0; lcp.len()];
    lcp.project_all(&mut x);
    x
}

/// A solution, by whoever finds one with moderate effort: with friction some problems resist all of them.
fn solution(lcp: &Lcp) -> Option<Vec<f64>> {
    EFFORTS.into_iter().find_map(|(name, max_iterations)| {
        let settings = Settings { tolerance: TOLERANCE, max_iterations, ..Settings::default() };
        let solver = by_name(name, &Options { settings, ..Options::default() }).ok()?;
        let solution = solver.solve(lcp, &Start::default(), &mut ());
        let is_one = solution.status == Status::Solved
            && merit::scaled_residual(lcp, &solution.x) <= TOLERANCE;
        is_one.then_some(solution.x)
    })
}

/// Watches what is missing fall.
struct Course<'a, 'b> {
    yard: &'a Yard<'b>,
    target: f64,
    missing: Vec<f64>,
}

impl Observer for Course<'_, '_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        if iterate.iteration == 0 {
            return ControlFlow::Continue(());
        }
        let missing = self.yard.missing(iterate.x);
        self.missing.push(missing);
        if missing <= self.target { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}
