//! Solves problems whose bounds or offsets depend on x with a solver for fixed ones: freeze, solve,
//! repeat.
//!
//! ```text
//! x⁰ = start,   xᵏ⁺¹ = the solution of the problem frozen at xᵏ
//! ```
//!
//! A fixed point solves the original problem. For coupled rows the bounds ±μ max(x_n, 0) are frozen
//! (models 1 and 2), for cones under Coulomb's law the shift μ |w_t| (model 4). For one contact
//! with A = 1 and a cone, each round reduces the error by the factor μ²/(1 + μ²). In general the
//! map contracts for small μ. For large μ it may have no reachable fixed point; the status is then
//! `Stalled`, not `Solved`, usually as soon as an x repeats, because the sequence is then periodic
//! (Brent 1980), and after 200 rounds at the latest.

use super::{Observer, Settings, Solution, Status, StepDetail};
use lcplab_lcp::{Complementarity, Lcp};

/// Maximum number of frozen problems to solve.
const MAX_ROUNDS: usize = 200;

/// Solves a problem by a method for frozen problems, `method(problem, start, iterations so far)`.
pub(super) fn solve<P: Complementarity>(
    problem: &P,
    start: Vec<f64>,
    settings: &Settings,
    mut method: impl FnMut(&P, Vec<f64>, usize) -> Solution,
) -> Solution {
    if problem.is_frozen() {
        return method(problem, start, 0);
    }
    let (mut x, mut iterations, mut fallback) = (start, 0, None);
    let mut remembered = x.clone();
    for round in 1..=MAX_ROUNDS {
        let frozen = problem.frozen_at(&x);
        frozen.project_all(&mut x);
        let solution = method(&frozen, x, iterations);
        (x, iterations) = (solution.x, solution.iterations);
        fallback = fallback.or(solution.fallback);
        let status = match solution.status {
            Status::Solved
                if problem.scaled_residual(&x) > settings.tolerance
                    || !problem.improves_on_zero(&x, settings.tolerance) =>
            {
                if x == remembered {
                    break;
                }
                if round.is_power_of_two() {
                    remembered.clone_from(&x);
                }
                continue;
            }
            status => status,
        };
        return Solution::new(problem.lcp(), x, status, iterations).with_fallback(fallback);
    }
    Solution::new(problem.lcp(), x, Status::Stalled, iterations).with_fallback(fallback)
}

/// Reports to an observer of step details that `frozen` is solved instead of a problem whose bounds
/// depend on x.
pub(super) fn report(problem: &Lcp, frozen: &Lcp, observer: &mut dyn Observer) {
    if !problem.is_frozen() && observer.wants_details() {
        observer.part(&StepDetail::Frozen(frozen));
    }
}
