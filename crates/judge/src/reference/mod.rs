//! Independent reference solutions, by methods that share no code with lcplab's solvers.
//!
//! [`box_qp`] lets clarabel, an interior-point code, minimize ½ xᵀAx + bᵀx over the box: the dual
//! program, in impulses. Newton's steps from there reach the bounds (up to 400 rows). [`gauss`]
//! computes the motion of least constraint: the primal program, in velocities, which never forms A.
//! [`cone_qp`] is the dual program with friction cones. [`farkas`] guesses a proof that there is no
//! solution.

mod box_qp;
mod cone_qp;
mod farkas;
mod gauss;
mod program;
mod refine;

pub use box_qp::{box_qp, box_qp_to, box_qp_within};
pub use cone_qp::{cone_qp, cone_qp_within};
pub use farkas::farkas;
pub use gauss::gauss;

use lcplab_lcp::Complementarity;
use lcplab_lcp::friction::Contact;

/// A reference solution.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// The minimizer: x for the box QP, u for Gauss's principle.
    pub point: Vec<f64>,
    /// The optimal value as clarabel reports it.
    pub objective: f64,
    /// Interior-point iterations.
    pub iterations: usize,
    /// Clarabel's own status.
    pub status: String,
    /// Whether clarabel reports success, at full or reduced accuracy.
    pub solved: bool,
}

impl Reference {
    /// With Newton's steps from clarabel's point, if clarabel reports success.
    fn refined(mut self, problem: &impl Complementarity, contacts: &[Contact]) -> Self {
        if self.solved {
            self.point = refine::refined(problem, contacts, self.point);
        }
        self
    }
}
