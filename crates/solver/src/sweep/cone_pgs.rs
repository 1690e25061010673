//! Projected Gauss-Seidel for cones: one contact at a time, its three rows together.
//!
//! ```text
//! for each contact:     x_c ← Π_K(x_c − ŵ_c / s_c)      ŵ = w, or w + μ |w_t| n under Coulomb's law
//! for each other row:   x_i ← Π(x_i − w_i / a_ii)
//! ```
//!
//! [`Pgs`](crate::Pgs) with a cone instead of an interval; s_c, an upper bound on the largest
//! eigenvalue of the contact's block of A, replaces a_ii. Each update uses the newest x.
//!
//! Under the associated law and for symmetric positive semidefinite A no update raises ½
//! xᵀAx + bᵀx, and x converges to a minimum (Tasora & Anitescu 2011). Under Coulomb's law the same
//! update with ŵ is the projection of De Saxcé & Feng (1991): each update uses the current shift,
//! whereas [`frozen`](crate) solves the frozen problem completely before it updates the shift.
//! Convergence is then not guaranteed but usual as long as μ is not large. For a single contact
//! with A = 1 each sweep reduces the error by μ²/(1 + μ²) under Coulomb's law; under the associated
//! law one update solves it. Like all sweep methods it is slow if forces pass through many bodies,
//! and at contacts that barely slide, because the surface of the cone is curved.
//!
//! A sweep costs one product A x. If a contact's block of A is not positive: `ZeroDiagonal`.

use std::ops::ControlFlow;

use crate::ConeSolver;
use crate::iterate::iterate;
use crate::{Event, Observer, Settings, Solution, Start, Status};
use lcplab_lcp::Complementarity;
use lcplab_lcp::friction::{ConeProblem, Contact};

/// Projected Gauss-Seidel for cones.
#[derive(Debug, Clone, Default)]
pub struct ConePgs {
    /// The common settings; an iteration is a sweep over all contacts and other rows.
    pub settings: Settings,
}

impl ConePgs {
    /// Its name in the registry.
    pub const NAME: &'static str = "cone-pgs";
}

impl ConeSolver for ConePgs {
    fn name(&self) -> &str {
        ConePgs::NAME
    }

    fn solve(
        &self,
        problem: &ConeProblem,
        start: &Start<'_>,
        observer: &mut dyn Observer,
    ) -> Solution {
        let (lcp, friction) = (problem.lcp(), problem.friction());
        let x = start.point(problem);
        if let Some(row) = immovable(problem) {
            let status = Status::ZeroDiagonal { row };
            return Solution::outside_class(problem, x, status, 0, &self.settings);
        }
        let scales: Vec<f64> = friction.contacts().iter().map(|c| problem.scale(c)).collect();
        iterate(problem, x, 0, &self.settings, observer, |x| {
            for &i in friction.others() {
                if lcp.lo()[i] < lcp.hi()[i] {
                    x[i] = lcp.project(i, x[i] - lcp.row_w(i, x) / lcp.matrix().diagonal(i), x);
                }
            }
            for (contact, &s) in friction.contacts().iter().zip(&scales) {
                let w = contact.rows.map(|i| lcp.row_w(i, x));
                contact.put(problem.step(contact, contact.of(x), w, s), x);
            }
            ControlFlow::Continue(Event::Sweep)
        })
    }
}

/// A row whose w should grow with its own x but does not.
fn immovable(problem: &ConeProblem) -> Option<usize> {
    let (lcp, friction) = (problem.lcp(), problem.friction());
    let is_movable = |i: &usize| lcp.matrix().diagonal(*i) > 0.0;
    let is_pinned = |i: &usize| lcp.lo()[*i] == lcp.hi()[*i];
    let mut others = friction.others().iter().copied();
    let mut normals = friction.contacts().iter().map(|Contact { rows, .. }| rows[0]);
    others.find(|i| !is_movable(i) && !is_pinned(i)).or_else(|| normals.find(|i| !is_movable(i)))
}
