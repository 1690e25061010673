//! Independent answers to the same problem, by methods that share no code with our solvers.
//!
//! [`box_qp`] asks clarabel, an interior-point code, for the minimum of ½ xᵀAx + bᵀx over the box:
//! the dual view, in impulses. [`gauss`] asks it for the motion of least constraint: the primal
//! view, in velocities, in which A is never formed. [`cone_qp`] is the dual view with friction
//! cones, [`velocity_qp_to`] the dual view with A in factors. [`farkas`] asks why there is no
//! solution.

mod box_qp;
mod cone_qp;
mod farkas;
mod gauss;
mod program;
mod velocity_qp;

pub use box_qp::{box_qp, box_qp_to, box_qp_within};
pub use cone_qp::{cone_qp, cone_qp_within};
pub use farkas::farkas;
pub use gauss::gauss;
pub use velocity_qp::velocity_qp_to;

/// A reference answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// The minimiser: x for the box QP, u for Gauss's principle.
    pub point: Vec<f64>,
    /// The optimal value as clarabel gives it.
    pub objective: f64,
    /// Interior-point iterations.
    pub iterations: usize,
    /// Clarabel's own status.
    pub status: String,
    /// Whether clarabel calls it solved, to full or reduced accuracy.
    pub solved: bool,
}
