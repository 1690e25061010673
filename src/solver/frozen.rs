//! Coupled rows for a solver of boxed problems: freeze the bounds, solve, repeat.
//!
//! ```text
//! x⁰ = start,   xᵏ⁺¹ = the solution with the bounds ±μ max(x_kⁿ, 0) frozen at xᵏ
//! ```
//!
//! A fixed point solves the coupled problem. The map contracts for small μ; for large μ a fixed
//! point need not be reached, and then the answer is `Stalled`, not `Solved`. `math §5`, models 1
//! and 2.

use super::{Settings, Solution, Status};
use crate::lcp::{Lcp, merit};

/// Boxed problems solved before giving up.
const MAX_ROUNDS: usize = 200;

/// Solves a problem by a method for boxed ones, `boxed(problem, start, iterations so far)`.
pub(super) fn solve(
    lcp: &Lcp,
    start: Vec<f64>,
    settings: &Settings,
    mut boxed: impl FnMut(&Lcp, Vec<f64>, usize) -> Solution,
) -> Solution {
    if lcp.coupling().is_none() {
        return boxed(lcp, start, 0);
    }
    let (mut x, mut iterations) = (start, 0);
    for _ in 0..MAX_ROUNDS {
        let frozen = lcp.frozen_at(&x);
        for i in 0..x.len() {
            x[i] = frozen.project(i, x[i], &[]);
        }
        let solution = boxed(&frozen, x, iterations);
        (x, iterations) = (solution.x, solution.iterations);
        if solution.status != Status::Solved {
            return Solution::new(lcp, x, solution.status, iterations);
        }
        if merit::scaled_residual(lcp, &x) <= settings.tolerance {
            return Solution::new(lcp, x, Status::Solved, iterations);
        }
    }
    Solution::new(lcp, x, Status::Stalled, iterations)
}
