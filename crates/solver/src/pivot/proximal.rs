//! Proximal steps: a singular problem as a few regular ones.
//!
//! ```text
//! xᵏ⁺¹ solves   w = A x + b + ρ D (x − xᵏ),   lo ≤ x ≤ hi,   D = diag(A)
//! ```
//!
//! that is, it minimises ½ xᵀA x + bᵀx + ρ/2 |x − xᵏ|²_D in the box (Rockafellar 1976). A + ρ D is
//! positive definite where A is semidefinite, so block pivoting solves each step, from the active
//! set of the last one. This softens nothing: where x stays, the added term is zero, and what ends
//! the steps is the residual of the problem as it was posed.
//!
//! Along an eigenvector of D⁻¹A with the eigenvalue λ a step leaves the part ρ/(ρ + λ) of the
//! error; for λ = 0 nothing is left to do, as x does not move w there. So with ρ = 2⁻²⁸ two or
//! three steps are enough, and those after the first cost two triangular solves if their active set
//! is the same. But the smaller ρ, the farther x runs in a wrong active set, and exchanges of
//! blocks may not settle. Such a step is taken again with a larger ρ, a well-conditioned problem;
//! then ρ falls again, in strides that halve after each failure. From ρ = 1 on Murty's rule ends
//! every step.
//!
//! Each step is finite, for A + ρ D is a P-matrix. Their number is not bounded beforehand: x
//! converges to a solution if there is one, linearly for any ρ and any A (the problem is
//! polyhedral: Luque 1984), and stops with the residual at rounding, or where it falls no more. If
//! there is no solution x runs off along a ray, A d = 0 and bᵀd < 0, and the status says so.

use std::ops::ControlFlow;

use super::active_set::{ActiveSet, ROUNDING};
use super::block_pivoting::rule;
use super::free_rows::FreeRows;
use super::principal::{Change, Point, Search};
use crate::{Event, Fallback, Settings, Solution, Start, Status, iterate};
use lcplab_problem::Lcp;

/// The least ρ is 2 to this power: the null space of A costs half of all digits there.
const LEAST: i32 = -28;
/// Murty's rule from ρ = 2⁰ on.
const SAFE: i32 = 0;
/// Block exchanges without progress before a step is given up.
const PATIENCE: usize = 4;
/// ρ falls by 2 to this power at first, and rises by at least 2 to that.
const STRIDES: [i32; 2] = [12, 4];
/// Steps with the least ρ that need not better the residual.
const IDLE: usize = 3;
/// Rows that depend on each other and miss by more than this part contradict each other. What is
/// less may be drift and rounding of redundant joints.
pub(crate) const NEARLY: f64 = 1e-3;
/// What counts as better.
const BETTER: f64 = 0.9;

/// ρ = 2^exponent.
pub(crate) struct Rho {
    exponent: i32,
    stride: i32,
}

impl Rho {
    /// The one to begin with.
    pub(crate) fn least() -> Self {
        Rho { exponent: LEAST, stride: STRIDES[0] }
    }

    /// Whether it need not rise any more.
    pub(crate) fn is_safe(&self) -> bool {
        self.exponent >= SAFE
    }

    /// ρ.
    pub(crate) fn value(&self) -> f64 {
        2f64.powi(self.exponent)
    }

    /// After a step that failed.
    pub(crate) fn rise(&mut self) {
        self.exponent += self.stride.max(STRIDES[1]);
        self.stride = (self.stride / 2).max(1);
    }

    /// After a step that was taken.
    pub(crate) fn fall(&mut self, set_is_same: bool) {
        self.exponent = (self.exponent - self.stride).max(LEAST);
        if set_is_same {
            self.stride = (2 * self.stride).min(STRIDES[0]);
        }
    }
}

/// Solves a problem with symmetric A by proximal steps from x, beginning with the active set of the
/// search.
pub(crate) fn solve(lcp: &Lcp, search: &mut Search<'_>, x: Vec<f64>) -> Solution {
    search.fallback = Some(Fallback::Proximal);
    let mut steps = Steps { lcp, rho: Rho::least(), soft: None };
    let mut centre = x.clone();
    let (mut best, mut least, mut idle) = (search.point.clone(), f64::INFINITY, 0);
    loop {
        let first = search.count + 1;
        match steps.step(search, &centre) {
            ControlFlow::Continue(()) => {}
            ControlFlow::Break(Status::Stalled | Status::Singular { .. })
                if !steps.rho.is_safe() =>
            {
                steps.rho.rise();
                continue;
            }
            ControlFlow::Break(status) => return search.solution(status),
        }
        let before = std::mem::replace(&mut centre, search.point.x.clone());
        let residual = search.point.largest_residual();
        if residual < BETTER * least {
            (best, least, idle) = (search.point.clone(), residual, 0);
        } else if steps.rho.exponent == LEAST {
            idle += 1;
        }
        if residual <= ROUNDING || idle == IDLE {
            let (status, count) = (Status::Inaccurate, search.count);
            let solution = iterate::finish(lcp, [&before, &x], centre, status, count);
            if is_solved(lcp, &best, search.settings.tolerance) {
                search.point = best;
                return search.solution(Status::Solved);
            }
            return solution.with_fallback(search.fallback);
        }
        steps.rho.fall(search.count == first);
    }
}

/// Whether x solves the problem and is a thousand times nearer to a solution than Π(0). Where rows
/// contradict each other the residual becomes small beside x as x runs off, but x comes no nearer.
fn is_solved(lcp: &Lcp, point: &Point, tolerance: f64) -> bool {
    let nothing = Point::at(lcp, Start::default().point(lcp));
    let is_nearer = point.largest_miss() <= NEARLY * nothing.largest_miss();
    point.is_solution(lcp, tolerance) && (is_nearer || nothing.is_solution(lcp, tolerance))
}

/// What proximal steps make of a problem with symmetric A that a method of pivots has given up:
/// their solution, or the failed one. Rows of redundant joints that have drifted apart depend on
/// each other so nearly that a single pivot cannot tell; along them A is small, not zero.
pub(crate) fn after(lcp: &Lcp, failed: Solution, settings: &Settings) -> Solution {
    use Status::{Inaccurate, Ray, Singular, Stalled};
    let is_given_up = matches!(failed.status, Ray { .. } | Inaccurate | Singular { .. } | Stalled);
    let is_positive = |i: usize| lcp.matrix().diagonal(i) > 0.0 || lcp.lo()[i] == lcp.hi()[i];
    if !is_given_up || !(0..lcp.len()).all(is_positive) {
        return failed;
    }
    let start = Start::default();
    let x = start.point(lcp); // a warm start may lie far out along what the rows leave open
    let set = ActiveSet::initial(lcp, &start, &x);
    let (point, count) = (Point::at(lcp, x.clone()), failed.iterations);
    let observer = &mut (); // the way of another method is not that of the one that is watched
    let mut search =
        Search { settings, observer, set, point, count, fallback: None, safeguard: None };
    let solution = solve(lcp, &mut search, x);
    match solution.status {
        Status::Solved | Status::Stopped => solution,
        _ => failed,
    }
}

struct Steps<'a> {
    lcp: &'a Lcp,
    rho: Rho,
    /// The problem with A + ρ D, and its equations, for the last exponent.
    soft: Option<(i32, Lcp, FreeRows)>,
}

impl Steps<'_> {
    /// One step; the point of the search is then one of the problem itself.
    fn step(&mut self, search: &mut Search<'_>, centre: &[f64]) -> ControlFlow<Status> {
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
        let b = |i: usize| lcp.b()[i] - rho * lcp.matrix().diagonal(i) * centre[i];
        let problem = match soft.with_b((0..lcp.len()).map(b).collect()) {
            Ok(p) => p,
            Err(e) => return not_finite(e),
        };
        search.count_change()?;
        let then = if exponent < SAFE { Change::None } else { Change::Least };
        let (set, rule) = (search.set.clone(), rule(PATIENCE, then));
        let end =
            search.run(&problem, |set| equations.point(&problem, set), rule, Some(Event::Step));
        search.point = Point::at(lcp, std::mem::take(&mut search.point.x));
        if let ControlFlow::Break(Status::Stalled | Status::Singular { .. }) = end {
            search.set = set;
        }
        end
    }
}
