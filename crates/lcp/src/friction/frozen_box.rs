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
    /// ```
    /// use lcplab_lcp::friction::{Contact, FrictionProblem};
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// // A point of 1 kg on the ground slides along t1: w = x + b.
    /// let (b, free) = (vec![-2.0, -3.0, 0.0], f64::INFINITY);
    /// let a = Matrix::from([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    /// let lcp = Lcp::new(a, b, vec![0.0, -free, -free], vec![free; 3])?;
    /// let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
    /// assert_eq!(problem.frozen_box(&[4.0]).bounds(1, &[2.0, 0.0, 0.0]), (-2.0, 2.0));
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
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
