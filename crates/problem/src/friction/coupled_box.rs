//! Model 2: a box that grows with the normal impulse.
//!
//! ```text
//! x_n ≥ 0,   −μ x_n ≤ x_t1, x_t2 ≤ μ x_n        as a pyramid over a square
//! ```
//!
//! Both tangents are treated as contacts of their own, each with Coulomb's law in one dimension. So
//! a contact that slides along t1 rubs rightly; one that slides at an angle is braked by both rows
//! in full, by √2 μ x_n in all, in the direction of a corner of the square and not against the
//! slip. Rotating the tangents changes the answer: the model has directions that nature has not.
//!
//! A solution is a fixed point of [`FrictionProblem::frozen_box`]: x̄_n in, x_n out. It need not be
//! unique, and freezing need not lead to it, when μ is large. Open Dynamics Engine's `findex` and
//! most game engines are this model.

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
