//! Model 1: a box of given size.
//!
//! ```text
//! x_n ≥ 0,   −μ x̄_n ≤ x_t1, x_t2 ≤ μ x̄_n        x̄_n given, say the last step's
//! ```
//!
//! With x̄_n from the last time step or the last sweep, friction is a boxed LCP with symmetric A,
//! hence a convex quadratic program: w is unique, and every boxed-LCP solver can solve it. The
//! price is a delay: a body that lands gets no friction in its first step, a body that lifts off
//! keeps some in its last, and x_t may lie outside the box of the computed x_n. Repeating the solve
//! with the computed x_n until nothing changes leads to [`FrictionProblem::coupled_box`].

use super::FrictionProblem;
use crate::Lcp;

impl FrictionProblem {
    /// Model 1, the boxed LCP with |x_t1|, |x_t2| ≤ μ max(x̄_n, 0), given the x̄_n of each contact.
    ///
    /// # Panics
    /// If there is not exactly one x̄_n for each contact.
    pub fn frozen_box(&self, normal: &[f64]) -> Lcp {
        assert_eq!(normal.len(), self.contacts().len(), "one normal impulse per contact");
        let mut x = vec![0.0; self.lcp().len()];
        for (contact, normal) in self.contacts().iter().zip(normal) {
            x[contact.rows[0]] = *normal;
        }
        self.coupled_box().frozen_at(&x)
    }
}
