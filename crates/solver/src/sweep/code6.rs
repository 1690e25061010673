//! The chapter's iterative solver as printed: it clamps after the whole sweep. A specimen.
//!
//! ```text
//! y_i ← −(b_i + Σ_{j<i} a_ij y_j + Σ_{j>i} a_ij x_j) / a_ii,   i = 1 … n
//! x ← Π(y)
//! ```
//!
//! Where no bound is met this is Gauss-Seidel, and right. Otherwise later rows of the sweep have
//! seen values y that were never allowed, and the fixed point is another one: for
//! A = [1 ½; ½ 1], b = (1, −1) and x ≥ 0 it is (0, 2) in place of (0, 1). It can even diverge on a
//! symmetric positive definite A (n = 3 and up). The remedy is one line:
//! [`Pgs`](crate::Pgs) clamps each row as it is updated. K&M Code 6, E06.
//!
//! We add what the listing leaves to its caller: the start (the listing clears x), the sign of b
//! (the listing solves A x = b) and the stop test. So a wrong limit ends as `IterationLimit`, and
//! never as `Solved`. A zero diagonal, an assertion in print, is `ZeroDiagonal`.

use std::ops::ControlFlow;

use crate::iterate::iterate;
use crate::{Event, Observer, Settings, Solution, Solver, Start, Status};
use lcplab_problem::Lcp;

/// Code 6, a specimen.
#[derive(Debug, Clone, Default)]
pub struct Code6 {
    /// The common settings; an iteration is a sweep over all rows.
    pub settings: Settings,
}

impl Solver for Code6 {
    fn name(&self) -> &'static str {
        "code6"
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
