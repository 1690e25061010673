//! Code 1: a step without constraints, in block matrices.
//!
//! ```text
//! u⁺ = u + dt M⁻¹ F,   s⁺ = s + dt S u⁺        K&M (21), (22)
//! ```
//!
//! The new velocity moves the positions: semi-implicit Euler. The listing is correct; the
//! gyroscopic torque that its F lacks (E26) is left to its caller.
#![allow(non_snake_case)]

use nalgebra::{DMatrix, DVector};

use super::Listing;

pub(in crate::chapter) const LISTING: Listing = Listing {
    id: "Code 1",
    title: "a step without constraints",
    printed: "u⁺ = u + dt M⁻¹ F, s⁺ = s + dt S u⁺",
    corrected: "The same: the listing is correct.",
    errata: &["E26"],
};

/// The block matrices of m bodies at one instant, as in the chapter's Figure 5.
#[derive(Debug, Clone, PartialEq)]
pub struct Blocks {
    /// Linear and angular velocities, a column of 6m (m/s, rad/s).
    pub u: DVector<f64>,
    /// Positions and quaternions (w, x, y, z), a column of 7m (m, 1).
    pub s: DVector<f64>,
    /// The matrix that maps velocities to rates of s, 7m × 6m.
    pub S: DMatrix<f64>,
    /// The inverse masses and inertias, 6m × 6m.
    pub M_inv: DMatrix<f64>,
    /// External forces and torques, a column of 6m (N, N m).
    pub F: DVector<f64>,
}

impl Blocks {
    /// Point masses on a line, one row and column each: velocities (m/s), inverse masses (1/kg) and
    /// forces (N); all start at 0.
    pub fn on_a_line(u: &[f64], inverse_masses: &[f64], forces: &[f64]) -> Self {
        let m = u.len();
        Blocks {
            u: DVector::from_column_slice(u),
            s: DVector::zeros(m),
            S: DMatrix::identity(m, m),
            M_inv: DMatrix::from_diagonal(&DVector::from_column_slice(inverse_masses)),
            F: DVector::from_column_slice(forces),
        }
    }

    /// u* = u + dt M⁻¹ F: the velocities without constraints.
    pub fn unconstrained(&self, dt: f64) -> DVector<f64> {
        &self.u + &self.M_inv * &self.F * dt
    }

    /// s⁺ = s + dt S u⁺.
    pub(crate) fn moved(&self, u_next: &DVector<f64>, dt: f64) -> DVector<f64> {
        &self.s + &self.S * u_next * dt
    }
}

/// The listing: u⁺ and s⁺ after dt (s).
pub fn printed(blocks: &Blocks, dt: f64) -> (DVector<f64>, DVector<f64>) {
    let u_next = blocks.unconstrained(dt);
    let s_next = blocks.moved(&u_next, dt);
    (u_next, s_next)
}

/// There is nothing to correct.
pub use self::printed as corrected;
