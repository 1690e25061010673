//! The error of an x: the difference from a reference solution, as a fraction of the constraints'
//! effect.
//!
//! ```text
//! missing = ‖x − x*‖_A / max(‖Π(0) − x*‖_A, |M⁻¹F|_M, ‖x_D‖_A, ρ),   ‖e‖_A² = eᵀ A e = |M⁻¹ Jᵀ e|_M²
//! ```
//!
//! with a solution x* that the judge accepts and the weights F. It compares motions: forces that
//! redundant rows share in different ways count as equal. If bodies rest, doing nothing has an
//! error of 1; if the constraints have almost nothing to do, an error is compared with the effect
//! of gravity.
//!
//! Forces may cancel: a motor that presses a block against a wall changes no motion, nor does
//! Π(0) − x*. Therefore the effect of motors at their limits and of springs alone, x_D, counts too,
//! and the remaining effect is compared with its rounding
//!
//! ```text
//! ρ = 2²⁰ ε (|(Σ_j |a_ij x*_j| + |b_i| + Σ_j |J_ij u*_j| + |bias_i|) / √a_ii| + √m |p|/dt)
//! ```
//!
//! with the distance |p| of the farthest body from the origin, so that the error is one percent if
//! the terms of a row are wrong by ten thousand units in the last place.

use std::ops::ControlFlow;

use lcplab_judge::{Demand, judge};
use lcplab_lcp::Lcp;
use lcplab_solver::{
    AndersonPgs, BlockPivoting, Dantzig, Iterate, Newton, Observer, Options, Registry, Settings,
    Solver, Start,
};

use super::frame::Frame;
use super::thresholds::HEALTHY;

/// The scaled residual of a reference solution.
const TOLERANCE: f64 = 1e-8;

/// The solvers that compute it, with their iteration limits.
const EFFORTS: [(&str, usize); 4] = [
    (BlockPivoting::NAME, 300),
    (Dantzig::NAME, 2_000),
    (Newton::NAME, 50),
    (AndersonPgs::NAME, 1_000),
];

/// A row counts as free if |w| is at most this fraction of the sum of its terms.
const FREE: f64 = 1e-7;

/// An error of this number of units in the last place of the terms counts as 1, if forces cancel.
const ULPS: f64 = 1_048_576.0;

/// A problem with a reference solution.
#[derive(Debug, Clone)]
pub struct ReferenceSolution<'a> {
    lcp: &'a Lcp,
    /// x*.
    pub exact: Vec<f64>,
    size: f64,
    is_needed: bool,
}

impl<'a> ReferenceSolution<'a> {
    /// The reference for a problem with symmetric A, with the effect of gravity `weight`; `None` if
    /// no solution was found that the judge accepts.
    pub fn new(lcp: &'a Lcp, weight: f64) -> Option<Self> {
        let none = vec![0.0; lcp.len()];
        ReferenceSolution::with_compliances(lcp, weight, &none, &none, 0.0)
    }

    /// The reference for a frame.
    pub(crate) fn of(frame: &'a Frame) -> Option<Self> {
        let terms = frame.offset_terms();
        let weight = frame.weight(|_| 1.0);
        ReferenceSolution::with_compliances(
            &frame.lcp,
            weight,
            &frame.compliances(),
            &terms,
            frame.rounding(),
        )
    }

    /// The same with compliance γ, these terms of b, and this additional rounding.
    fn with_compliances(
        lcp: &'a Lcp,
        weight: f64,
        compliances: &[f64],
        terms: &[f64],
        rounding: f64,
    ) -> Option<Self> {
        if !lcp.matrix().is_nearly_symmetric() {
            return None;
        }
        let exact = solution(lcp)?;
        let reference = ReferenceSolution { lcp, exact, size: 1.0, is_needed: true };
        let origin = vec![0.0; lcp.len()];
        let loads = weight.max(reference.apart_in_full(&reference.driving(compliances), &origin));
        let needed = reference.apart_in_full(&start(lcp), &reference.exact).max(loads);
        let rounding = ULPS * (f64::EPSILON * reference.terms(terms) + rounding);
        Some(ReferenceSolution {
            size: needed.max(rounding),
            is_needed: needed > rounding,
            ..reference
        })
    }

    /// Why there is no reference for a problem.
    pub(crate) fn absence(lcp: &Lcp) -> &'static str {
        match lcp.matrix().is_nearly_symmetric() {
            true => "no method found an answer that the judge accepts",
            false => "A is not symmetric",
        }
    }

    /// The forces of motors at their limits and of springs, 0 in all other rows: for the other rows
    /// they are loads.
    fn driving(&self, compliances: &[f64]) -> Vec<f64> {
        let motors = self.motors_at_limits();
        let is_spring = |i: usize| {
            let is_free = self.lcp.lo()[i].is_infinite() && self.lcp.hi()[i].is_infinite();
            compliances[i] > 0.0 && is_free && !self.lcp.is_coupled(i)
        };
        let drives = |i: usize| motors.contains(&i) || is_spring(i);
        (0..self.exact.len()).map(|i| if drives(i) { self.exact[i] } else { 0.0 }).collect()
    }

    /// The rows with limits on both sides that are at a limit.
    pub(crate) fn motors_at_limits(&self) -> Vec<usize> {
        let is_at_limit = |&i: &usize| {
            let (lo, hi, x) = (self.lcp.lo()[i], self.lcp.hi()[i], self.exact[i]);
            let is_limited = lo < 0.0 && hi > 0.0 && lo.is_finite() && hi.is_finite();
            !self.lcp.is_coupled(i) && is_limited && (x == lo || x == hi)
        };
        (0..self.exact.len()).filter(is_at_limit).collect()
    }

    /// The size of the sums of terms in the rows at x*, as a motion.
    fn terms(&self, of_offsets: &[f64]) -> f64 {
        let term = |i: usize| {
            let row = self.lcp.matrix().row(i);
            let own: f64 = row.iter().map(|(j, a)| (a * self.exact[j]).abs()).sum();
            let size = own + self.lcp.b()[i].abs() + of_offsets[i];
            let a = self.lcp.matrix().diagonal(i);
            if a > 0.0 { size * size / a } else { 0.0 }
        };
        (0..self.exact.len()).map(term).sum::<f64>().sqrt()
    }

    /// Whether the judge accepts x; its error is then negligible.
    pub(crate) fn is_accepted(&self, x: &[f64]) -> bool {
        is_accepted(self.lcp, x)
    }

    /// Whether the constraints have an effect.
    pub(crate) fn is_needed(&self) -> bool {
        self.is_needed
    }

    /// The error of x, as a fraction of the constraints' effect.
    pub fn missing(&self, x: &[f64]) -> f64 {
        self.apart(x, &self.exact)
    }

    /// The same for an answer to the problem: 0 if the judge accepts it.
    pub(crate) fn missing_in_answer(&self, x: &[f64]) -> f64 {
        let missing = self.missing(x);
        if missing > HEALTHY && self.is_accepted(x) { 0.0 } else { missing }
    }

    /// The distance of two x on the same scale.
    pub(crate) fn apart(&self, x: &[f64], y: &[f64]) -> f64 {
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

    /// The error after each sweep from `x`, until it is `target`, for at most `most` sweeps.
    pub(crate) fn error_history(&self, solver: &dyn Solver, x: &[f64], target: f64) -> Vec<f64> {
        let mut error_history =
            ErrorObserver { reference: self, target, missing: vec![self.missing(x)] };
        solver.solve(self.lcp, &Start::at(x), &mut error_history);
        error_history.missing
    }

    /// The rows whose w is 0: between their bounds, or at a bound without a force.
    pub(crate) fn free_rows(&self) -> Vec<bool> {
        let w = self.lcp.w(&self.exact);
        let size = |i: usize| {
            let row = self.lcp.matrix().row(i);
            row.iter().map(|(j, a)| (a * self.exact[j]).abs()).sum::<f64>() + self.lcp.b()[i].abs()
        };
        (0..w.len()).map(|i| w[i].abs() <= FREE * size(i)).collect()
    }
}

/// The start of sweeps without information: Π(0).
pub fn start(lcp: &Lcp) -> Vec<f64> {
    let mut x = vec![0.0; lcp.len()];
    lcp.project_all(&mut x);
    x
}

/// A solution that the judge accepts, by the first method that finds one with moderate effort; some
/// problems with friction resist all methods.
fn solution(lcp: &Lcp) -> Option<Vec<f64>> {
    EFFORTS.into_iter().find_map(|(name, max_iterations)| {
        let settings =
            Settings::default().with_tolerance(TOLERANCE).with_max_iterations(max_iterations);
        let entry = Registry::standard().entry(name).ok()?;
        let solver = entry.build(&Options::default().with_settings(settings));
        let x = solver.solve(lcp, &Start::default(), &mut ()).x;
        is_accepted(lcp, &x).then_some(x)
    })
}

/// Whether the judge accepts x, without a proof.
pub(super) fn is_accepted(lcp: &Lcp, x: &[f64]) -> bool {
    let demand = Demand { tolerance: TOLERANCE, prove_up_to: 0 };
    judge(lcp, x, &demand).verdict.is_solution()
}

/// An observer that records the error.
struct ErrorObserver<'a, 'b> {
    reference: &'a ReferenceSolution<'b>,
    target: f64,
    missing: Vec<f64>,
}

impl Observer for ErrorObserver<'_, '_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        if iterate.iteration == 0 {
            return ControlFlow::Continue(());
        }
        let missing = self.reference.missing(iterate.x);
        self.missing.push(missing);
        if missing <= self.target { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}
