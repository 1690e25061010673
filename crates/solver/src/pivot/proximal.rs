//! Proximal steps: solve a singular problem as a few regular ones.
//!
//! ```text
//! xᵏ⁺¹ solves   w = A x + b + ρ D (x − xᵏ),   lo ≤ x ≤ hi,   D = diag(A)
//! ```
//!
//! that is, it minimizes ½ xᵀA x + bᵀx + ρ/2 |x − xᵏ|²_D in the box (Rockafellar 1976). For
//! semidefinite A, A + ρ D is positive definite, so block pivoting solves each step, starting from
//! the active set of the last one. This adds no compliance: at a fixed point the added term is
//! zero, and the stop test uses the residual of the original problem.
//!
//! Along an eigenvector of D⁻¹A with eigenvalue λ a step multiplies the error by ρ/(ρ + λ); for
//! λ = 0 there is nothing to correct, since x does not affect w there. With ρ = 2⁻²⁸ two or three
//! steps are enough, and those after the first cost only two triangular solves if their active set
//! is the same. But the smaller ρ is, the farther x moves in a wrong active set, and block
//! exchanges may not converge. Such a step is repeated with a larger ρ, a better conditioned
//! problem; then ρ decreases again, with strides that are halved after each failure. From ρ = 1 on
//! Murty's rule ends every step.
//!
//! Each step is finite because A + ρ D is a P-matrix. Their number has no a-priori bound: x
//! converges to a solution if one exists, linearly for any ρ and any A (the problem is polyhedral:
//! Luque 1984), and the iteration stops when the residual is at rounding level or no longer
//! decreases. If there is no solution, x diverges along a ray, A d = 0 and bᵀd < 0, and the status
//! reports it.

use std::ops::ControlFlow;

use super::active_set::ActiveSet;
use super::block_pivoting::rule;
use super::free_rows::FreeRows;
use super::principal::{Change, Point, Search};
use crate::tolerances::{IMPROVEMENT, NEARER_THAN_ZERO, RESIDUAL_ROUNDING};
use crate::{Event, Fallback, Settings, Solution, Start, Status, iterate};
use lcplab_lcp::Lcp;

/// The least ρ is 2 to this power; in the null space of A it costs half of all digits.
const LEAST: i32 = -28;
/// Murty's rule is used from ρ = 2⁰ on.
const SAFE: i32 = 0;
/// Number of block exchanges without progress before a step is given up.
const PATIENCE: usize = 4;
/// Exponents of 2: ρ initially decreases by the first, and increases by at least the second.
const STRIDES: [i32; 2] = [12, 4];
/// Number of steps with the least ρ that need not improve the residual.
const IDLE: usize = 3;

/// ρ = 2^exponent.
pub(crate) struct Rho {
    exponent: i32,
    stride: i32,
}

impl Rho {
    /// The initial ρ.
    pub(crate) fn least() -> Self {
        Rho { exponent: LEAST, stride: STRIDES[0] }
    }

    /// Whether it need not increase further.
    pub(crate) fn is_safe(&self) -> bool {
        self.exponent >= SAFE
    }

    /// ρ.
    pub(crate) fn value(&self) -> f64 {
        2f64.powi(self.exponent)
    }

    /// Increases ρ after a failed step.
    pub(crate) fn rise(&mut self) {
        self.exponent += self.stride.max(STRIDES[1]);
        self.stride = (self.stride / 2).max(1);
    }

    /// Decreases ρ after an accepted step.
    pub(crate) fn fall(&mut self, set_is_same: bool) {
        self.exponent = (self.exponent - self.stride).max(LEAST);
        if set_is_same {
            self.stride = (2 * self.stride).min(STRIDES[0]);
        }
    }
}

/// Solves a problem with symmetric A by proximal steps from the start and set of the search.
pub(crate) fn solve(lcp: &Lcp, search: &mut Search<'_>) -> Solution {
    search.fallback = Some(Fallback::Proximal);
    let mut steps = Steps { lcp, rho: Rho::least(), soft: None };
    let mut center = search.start.clone();
    let (mut best, mut least, mut idle) = (search.last(lcp).into_owned(), f64::INFINITY, 0);
    loop {
        let first = search.count + 1;
        match steps.step(search, &center) {
            ControlFlow::Continue(()) => {}
            ControlFlow::Break(Status::Stalled | Status::Singular { .. })
                if !steps.rho.is_safe() =>
            {
                steps.rho.rise();
                continue;
            }
            ControlFlow::Break(status) => return search.solution(lcp, status),
        }
        let point = search.last(lcp);
        let before = std::mem::replace(&mut center, point.x.clone());
        let residual = point.largest_residual();
        if residual < IMPROVEMENT * least {
            (best, least, idle) = (point.into_owned(), residual, 0);
        } else if steps.rho.exponent == LEAST {
            idle += 1;
        }
        if residual <= RESIDUAL_ROUNDING || idle == IDLE {
            let (status, count) = (Status::Inaccurate, search.count);
            let solution = iterate::finish(lcp, [&before, &search.start], center, status, count);
            if is_solved(lcp, &best, search.settings.tolerance) {
                search.point = Some(best);
                return search.solution(lcp, Status::Solved);
            }
            return solution.with_fallback(search.fallback);
        }
        steps.rho.fall(search.count == first);
    }
}

/// Whether x solves the problem and is a thousand times nearer to a solution than Π(0). If rows
/// contradict each other, the residual becomes small relative to a diverging x, but x comes no
/// nearer to a solution.
fn is_solved(lcp: &Lcp, point: &Point, tolerance: f64) -> bool {
    let nothing = Point::at(lcp, Start::default().point(lcp));
    let is_nearer = point.largest_miss() <= NEARER_THAN_ZERO * nothing.largest_miss();
    point.is_solution(lcp, tolerance) && (is_nearer || nothing.is_solution(lcp, tolerance))
}

/// Applies proximal steps to a problem with symmetric A on which a pivoting method failed; returns
/// their solution, or the failed one. Rows of redundant joints that have drifted apart are so
/// nearly dependent that a single pivot cannot decide; along them A is small but not zero.
pub(crate) fn after(lcp: &Lcp, failed: Solution, settings: &Settings) -> Solution {
    use Status::{Inaccurate, Ray, Singular, Stalled};
    let is_given_up = matches!(failed.status, Ray { .. } | Inaccurate | Singular { .. } | Stalled);
    let is_positive = |i: usize| lcp.matrix().diagonal(i) > 0.0 || lcp.lo()[i] == lcp.hi()[i];
    if !is_given_up || !(0..lcp.len()).all(is_positive) {
        return failed;
    }
    let start = Start::default();
    // A warm start may be large in directions that the rows do not determine.
    let x = start.point(lcp);
    let set = ActiveSet::initial(lcp, &start, &x);
    // The observer watches another method, so it does not receive these iterates.
    let observer = &mut ();
    let mut search = Search::new(set, x, failed.iterations, settings, observer);
    let solution = solve(lcp, &mut search);
    match solution.status {
        Status::Solved | Status::Stopped => solution,
        _ => failed,
    }
}

struct Steps<'a> {
    lcp: &'a Lcp,
    rho: Rho,
    /// The problem with A + ρ D and its equations, for the last exponent.
    soft: Option<(i32, Lcp, FreeRows)>,
}

impl Steps<'_> {
    /// One step; the point of the search then refers to the original problem.
    fn step(&mut self, search: &mut Search<'_>, center: &[f64]) -> ControlFlow<Status> {
        let not_finite = |_| ControlFlow::Break(Status::NotFinite);
        let Steps { lcp, rho, soft } = self;
        let (rho, exponent) = (rho.value(), rho.exponent);
        let (_, soft, equations) = match soft.take().filter(|soft| soft.0 == exponent) {
            Some(same) => soft.insert(same),
            None => {
                let problem = match lcp.softened(rho) {
                    Ok(p) => p,
                    Err(e) => return not_finite(e),
                };
                let equations = FreeRows::of(&problem);
                soft.insert((exponent, problem, equations))
            }
        };
        let b = |i: usize| lcp.b()[i] - rho * lcp.matrix().diagonal(i) * center[i];
        let problem = match soft.with_b((0..lcp.len()).map(b).collect()) {
            Ok(p) => p,
            Err(e) => return not_finite(e),
        };
        search.count_change()?;
        let then = if exponent < SAFE { Change::None } else { Change::Least };
        let (set, rule) = (search.set.clone(), rule(PATIENCE, then));
        let end =
            search.run(&problem, |set| equations.point(&problem, set), rule, Some(Event::Step));
        search.point = Some(Point::at(lcp, search.last(lcp).x.clone()));
        if let ControlFlow::Break(Status::Stalled | Status::Singular { .. }) = end {
            search.set = set;
        }
        end
    }
}
