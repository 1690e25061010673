//! The reference code clarabel as an additional method in comparisons.
//!
//! Solvers must be independent of the reference that checks them, so clarabel is not in their
//! registry; this crate, which knows both, gives it a similar entry. Its result is `Solved` only if
//! the scaled residual of its point is also within the tolerance: clarabel stops on a different
//! quantity, and Newton's steps from its point need not converge. It uses no start, and its final
//! point is the only iterate reported.

use super::methods::REFERENCE;
use lcplab_judge::reference::{Reference, box_qp_within, cone_qp_within};
use lcplab_lcp::friction::{ConeProblem, Law};
use lcplab_lcp::memory::Memory;
use lcplab_lcp::{Complementarity, Lcp};
use lcplab_solver::{
    Class, ConeEntry, ConeSolver, Cost, Entry, Event, Group, Iterate, MatrixClass, Observer,
    Settings, Solution, Solver, Start, Status,
};

const SOURCE: &str = "Goulart & Chen 2024";

/// Clarabel on ½ xᵀAx + bᵀx over a box.
pub(crate) fn box_qp() -> Entry {
    let mut entry =
        Entry::new(REFERENCE, |options| Box::new(Clarabel { settings: options.settings.clone() }));
    entry.method = "reference: clarabel's interior-point method for the box QP, then Newton's method, iterative";
    entry.class = Class { coupling: false, ..Class::of(MatrixClass::Semidefinite) };
    entry.group = Group::Newton;
    entry.cost =
        Cost::each("n³/6 + 2 n² + s", |i| i.n.powi(3) / 6.0 + 2.0 * i.n * i.n + i.stored);
    entry.source = SOURCE;
    entry
}

/// Clarabel on the same objective over friction cones.
pub(crate) fn cone_qp() -> ConeEntry {
    let mut entry = ConeEntry::new(REFERENCE, &[Law::Associated], |settings| {
        Box::new(Clarabel { settings: settings.clone() })
    });
    entry.method = "reference: clarabel's interior-point method for the cone QP, then Newton's method, iterative";
    entry.class = Class::of(MatrixClass::Semidefinite);
    entry.group = Group::Newton;
    entry.source = SOURCE;
    entry
}

/// Clarabel with the solver traits.
#[derive(Debug, Clone)]
struct Clarabel {
    /// The tolerance for `Solved` (clarabel's own tolerance is that of the reference), and its
    /// iteration limit.
    settings: Settings,
}

impl Solver for Clarabel {
    fn name(&self) -> &str {
        REFERENCE
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        self.solution(lcp, |most| box_qp_within(lcp, most), start, observer)
    }
}

impl ConeSolver for Clarabel {
    fn name(&self) -> &str {
        REFERENCE
    }

    fn solve(
        &self,
        problem: &ConeProblem,
        start: &Start<'_>,
        observer: &mut dyn Observer,
    ) -> Solution {
        self.solution(problem, |most| cone_qp_within(problem, most), start, observer)
    }
}

impl Clarabel {
    /// The reference's answer as a solution with a status.
    fn solution(
        &self,
        problem: &impl Complementarity,
        ask: impl Fn(usize) -> Option<Reference>,
        start: &Start<'_>,
        observer: &mut dyn Observer,
    ) -> Solution {
        let lcp = problem.lcp();
        let nothing =
            |status, iterations| Solution::new(lcp, start.point(problem), status, iterations);
        let outside = |reason| nothing(Status::OutsideClass { reason }, 0);
        if (0..lcp.len()).any(|i| lcp.matrix().diagonal(i) < 0.0) {
            return outside("the matrix is not positive semidefinite");
        }
        if !problem.is_frozen() {
            return outside("bounds or w depend on x, so the problem is not a quadratic program");
        }
        if lcp.is_empty() {
            // clarabel does not accept an empty problem.
            return nothing(Status::Solved, 0);
        }
        if let Some(status) = self.settings.refusal(needs(lcp)) {
            return nothing(status, 0);
        }
        let Some(Reference { point: x, iterations, status, .. }) =
            ask(self.settings.max_iterations)
        else {
            return outside("the matrix is not symmetric");
        };
        if x.iter().any(|x| !x.is_finite()) {
            return nothing(Status::NotFinite, iterations);
        }
        let iterate = Iterate { iteration: iterations, x: &x, event: Event::Step };
        if observer.observe(&iterate).is_break() {
            return Solution::new(lcp, x, Status::Stopped, iterations);
        }
        let is_solved = problem.scaled_residual(&x) <= self.settings.tolerance
            && problem.improves_on_zero(&x, self.settings.tolerance);
        let status = match status.as_str() {
            // Regardless of clarabel's status: the judge checks x.
            _ if is_solved => Status::Solved,
            "Solved" | "AlmostSolved" => Status::Inaccurate,
            "MaxIterations" => Status::IterationLimit,
            // clarabel does not report its ray.
            "PrimalInfeasible" | "DualInfeasible" => Status::Diverged,
            _ => Status::Stalled,
        };
        Solution::new(lcp, x, status, iterations)
    }
}

/// Memory for the upper half of A as a list, in clarabel's columns, in its equations and in their
/// factor without fill: a dozen numbers per entry.
fn needs(lcp: &Lcp) -> Memory {
    Memory::numbers(lcp.matrix().stored()).times(6)
}
