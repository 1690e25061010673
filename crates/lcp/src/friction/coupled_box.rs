//! Model 2: a box whose size is proportional to the normal impulse.
//!
//! ```text
//! x_n ≥ 0,   −μ x_n ≤ x_t1, x_t2 ≤ μ x_n        as a pyramid over a square
//! ```
//!
//! Each tangent obeys Coulomb's law in one dimension, independently of the other. Friction is
//! therefore correct for a contact that slides along t1; for an oblique slip both rows apply their
//! full force, √2 μ x_n together, toward a corner of the square and not against the slip. Rotating
//! the tangents changes the answer: the model is anisotropic, unlike Coulomb friction.
//!
//! A solution is a fixed point of [`FrictionProblem::frozen_box`], which maps x̄_n to x_n. If μ is
//! large, it need not be unique, and repeated freezing need not converge to it. Open Dynamics
//! Engine's `findex` and most game engines use this model.

use super::FrictionProblem;
use crate::{Coupling, Lcp};

impl FrictionProblem {
    /// Model 2, the LCP with |x_t1|, |x_t2| ≤ μ x_n.
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
    /// assert_eq!(problem.coupled_box().bounds(1, &[2.0, 0.0, 0.0]), (-1.0, 1.0));
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn coupled_box(&self) -> Lcp {
        let has_contacts = !self.contacts.is_empty();
        let coupling = || Coupling::of_contacts(self.lcp.len(), self.contacts.clone());
        Lcp { coupling: has_contacts.then(coupling), ..self.lcp.clone() }
    }
}
