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
    pub fn coupled_box(&self) -> Lcp {
        let has_contacts = !self.contacts.is_empty();
        let coupling = || Coupling::of_contacts(self.lcp.len(), self.contacts.clone());
        Lcp { coupling: has_contacts.then(coupling), ..self.lcp.clone() }
    }
}
