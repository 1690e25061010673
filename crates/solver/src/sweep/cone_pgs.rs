//! Projected Gauss-Seidel for cones: a contact at a time, its three rows at once.
//!
//! ```text
//! for each contact:     x_c ← Π_K(x_c − ŵ_c / s_c)      ŵ = w, or w + μ |w_t| n under Coulomb's law
//! for each other row:   x_i ← Π(x_i − w_i / a_ii)
//! ```
//!
//! [`Pgs`](crate::Pgs) with a cone in place of an interval; s_c, a bound on the largest
//! eigenvalue of the contact's block of A, is in place of a_ii. Each update uses the newest x.
//!
//! Under the associated law and for symmetric positive semidefinite A no update raises ½ xᵀAx +
//! bᵀx, and x converges to a minimum (Tasora & Anitescu 2011). Under Coulomb's law the same line
//! with ŵ is the projection of De Saxcé & Feng (1991): one sweep solves and freezes at once, where
//! [`frozen`](crate) solves to the end before it freezes again. Nothing is guaranteed then, and
//! little goes wrong as long as μ is not large. A contact on its own with A = 1 contracts by
//! μ²/(1 + μ²) a sweep under Coulomb's law, and is solved by one update under the other. Like all
//! sweeps it is slow where forces pass through many bodies, and where a contact is about to slide
//! but hardly does: the surface of the cone is curved there, which intervals are not.
//!
//! A sweep costs one product A x. A contact whose block of A is not positive: `ZeroDiagonal`.

use std::ops::ControlFlow;

use crate::ConeSolver;
use crate::iterate::iterate;
use crate::{Event, Observer, Settings, Solution, Start, Status};
use lcplab_problem::Complementarity;
use lcplab_problem::friction::{ConeProblem, Contact};

/// Projected Gauss-Seidel for cones.
#[derive(Debug, Clone, Default)]
pub struct ConePgs {
    /// The common settings; an iteration is a sweep over all contacts and other rows.
    pub settings: Settings,
}

impl ConeSolver for ConePgs {
    fn name(&self) -> &'static str {
        "cone-pgs"
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
            return Solution::new(lcp, x, Status::ZeroDiagonal { row }, 0);
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

/// A row whose w does not grow with its own x, though it should.
fn immovable(problem: &ConeProblem) -> Option<usize> {
    let (lcp, friction) = (problem.lcp(), problem.friction());
    let is_movable = |i: &usize| lcp.matrix().diagonal(*i) > 0.0;
    let is_pinned = |i: &usize| lcp.lo()[*i] == lcp.hi()[*i];
    let mut others = friction.others().iter().copied();
    let mut normals = friction.contacts().iter().map(|Contact { rows, .. }| rows[0]);
    others.find(|i| !is_movable(i) && !is_pinned(i)).or_else(|| normals.find(|i| !is_movable(i)))
}
