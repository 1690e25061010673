//! The chapter's iterative solver as printed, which clamps after the whole sweep: a known-wrong
//! variant.
//!
//! ```text
//! y_i ← −(b_i + Σ_{j<i} a_ij y_j + Σ_{j>i} a_ij x_j) / a_ii,   i = 1 … n
//! x ← Π(y)
//! ```
//!
//! If no bound is reached this is Gauss-Seidel and correct. Otherwise later rows of the sweep use
//! values y outside the bounds, and the fixed point is different: for A = [1 ½; ½ 1], b = (1, −1)
//! and x ≥ 0 it is (0, 2) instead of (0, 1). It can even diverge for a symmetric positive definite
//! A (n ≥ 3). The fix is one line: [`Pgs`](crate::Pgs) clamps each row as it is updated. K&M Code
//! 6, E06.
//!
//! This code adds what the listing leaves to its caller: the start (the listing clears x), the sign
//! of b (the listing solves A x = b) and the stop test. A wrong limit therefore ends as
//! `IterationLimit`, never as `Solved`. A zero diagonal, an assertion in the listing, gives
//! `ZeroDiagonal`.

use std::ops::ControlFlow;

use crate::iterate::iterate;
use crate::{Event, Observer, Settings, Solution, Solver, Start, Status};
use lcplab_lcp::Lcp;

/// Code 6, a known-wrong variant.
#[derive(Debug, Clone, Default)]
pub struct Code6 {
    /// The common settings; an iteration is a sweep over all rows.
    pub settings: Settings,
}

impl Code6 {
    /// Its name in the registry.
    pub const NAME: &'static str = "code6";
}

impl Solver for Code6 {
    fn name(&self) -> &str {
        Code6::NAME
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let (n, a) = (lcp.len(), lcp.matrix());
        let x = start.point(lcp);
        if let Some(row) = (0..n).find(|&i| a.diagonal(i) == 0.0) {
            return Solution::new(lcp, x, Status::ZeroDiagonal { row }, 0);
        }
        iterate(lcp, x, 0, &self.settings, observer, |x| {
            for i in 0..n {
                let mut sum = -lcp.b()[i];
                for (j, a) in a.row(i).iter().filter(|&(j, _)| j != i) {
                    sum -= a * x[j];
                }
                x[i] = sum / a.diagonal(i);
            }
            lcp.project_all(x);
            ControlFlow::Continue(Event::Sweep)
        })
    }
}
