//! Model 2: a box that grows with the normal impulse.
//!
//! ```text
//! x_n ≥ 0,   −μ x_n ≤ x_t1, x_t2 ≤ μ x_n        as a pyramid over a square
//! ```
//!
//! Both tangents are treated as contacts of their own, each with Coulomb's law in one dimension. So
//! a contact that slides along t1 rubs rightly; one that slides at an angle is braked by both rows in
//! full, by √2 μ x_n in all, in the direction of a corner of the square and not against the slip.
//! Rotating the tangents changes the answer: the model has directions that nature has not.
//!
//! A solution is a fixed point of [`FrictionProblem::frozen_box`]: x̄_n in, x_n out. It need not be
//! unique, and freezing need not lead to it, when μ is large. Open Dynamics Engine's `findex` and most
//! game engines are this model. `math §5`, model 2.

use super::FrictionProblem;
use crate::{Coupling, Lcp};

impl FrictionProblem {
    /// Model 2, the LCP with |x_t1|, |x_t2| ≤ μ x_n.
    pub fn coupled_box(&self) -> Lcp {
        let n = self.lcp().len();
        let (mut index, mut mu) = (vec![None; n], vec![0.0; n]);
        for contact in self.contacts() {
            let [normal, tangents @ ..] = contact.rows;
            for t in tangents {
                (index[t], mu[t]) = (Some(normal), contact.mu);
            }
        }
        let coupling = Coupling::new(index, mu).expect("contacts are valid");
        self.lcp().clone().with_coupling(coupling).expect("contacts are valid")
    }
}
