//! Bounds or offsets that depend on x, for a solver of problems where they do not: freeze, solve,
//! repeat.
//!
//! ```text
//! x⁰ = start,   xᵏ⁺¹ = the solution of the problem frozen at xᵏ
//! ```
//!
//! A fixed point solves the problem itself. Of coupled rows the bounds ±μ max(x_n, 0) are frozen
//! (models 1 and 2), of cones under Coulomb's law the shift μ |w_t| (model 4). One contact with A =
//! 1 and cones contracts by μ²/(1 + μ²) a round. In general the map contracts for small μ; for
//! large μ a fixed point need not be reached, and then the answer is `Stalled`, not `Solved`: in
//! most cases as soon as an x comes back, because all that follows would come back too (Brent
//! 1980), and at the latest after 200 rounds.

use super::{Observer, Part, Settings, Solution, Status};
use lcplab_problem::{Complementarity, Lcp};

/// Frozen problems solved before giving up.
const MAX_ROUNDS: usize = 200;

/// Solves a problem by a method for frozen ones, `method(problem, start, iterations so far)`.
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
                    || !problem.is_worth_something(&x, settings.tolerance) =>
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

/// Tells an observer of parts that this problem is solved for one whose bounds depend on x.
pub(super) fn tell(problem: &Lcp, frozen: &Lcp, observer: &mut dyn Observer) {
    if !problem.is_frozen() && observer.asks_for_parts() {
        observer.part(&Part::Frozen(frozen));
    }
}
