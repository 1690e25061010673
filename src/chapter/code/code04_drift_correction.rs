//! Code 4: A and b with feedback of position errors, and the solve.
//!
//! ```text
//! printed     A x = J u* + β c          u⁺ by Code 2 then has J u⁺ = −β c
//! corrected   A x = −(J u* + β/dt c)    u⁺ by its corrected form has J u⁺ = −β/dt c
//! ```
//!
//! β should be the fraction of the error that is corrected per step; without 1/dt it is a rate in
//! 1/s, and 60 times weaker at 60 steps a second (E34). And c must have the sign of J (E35). The
//! listing has only equations, no bounds.
#![allow(non_snake_case)]

use nalgebra::{DMatrix, DVector};

use super::Listing;
use super::code01_unconstrained_step::Blocks;
use super::code06_solver;
use crate::error::Result;

pub(in crate::chapter) const LISTING: Listing = Listing {
    id: "Code 4",
    title: "feedback of position errors",
    printed: "A x = J (u + dt M⁻¹ F) + β c with β = 0.1",
    corrected: "A x = −(J (u + dt M⁻¹ F) + β/dt c), so that the part β of c goes in a step",
    errata: &["E28", "E29", "E34", "E35"],
};

/// The listing's β.
pub const BETA: f64 = 0.1;

/// A = J M⁻¹ Jᵀ.
pub fn matrix(blocks: &Blocks, J: &DMatrix<f64>) -> DMatrix<f64> {
    J * &blocks.M_inv * J.transpose()
}

/// The listing's x for [Code 2](super::code02_constrained_step::printed) after this number of
/// sweeps, with the errors c (m), one per row.
///
/// # Errors
/// If a number is not finite.
pub fn printed(
    blocks: &Blocks,
    J: &DMatrix<f64>,
    c: &DVector<f64>,
    dt: f64,
    sweeps: usize,
) -> Result<DVector<f64>> {
    let b = J * blocks.unconstrained(dt) + c * BETA;
    code06_solver::printed(&matrix(blocks, J), &b, None, None, sweeps)
}

/// x that pushes if positive, for [the corrected step](super::code02_constrained_step::corrected).
///
/// # Errors
/// If a number is not finite.
pub fn corrected(
    blocks: &Blocks,
    J: &DMatrix<f64>,
    c: &DVector<f64>,
    dt: f64,
    sweeps: usize,
) -> Result<DVector<f64>> {
    let b = J * blocks.unconstrained(dt) + c * (BETA / dt);
    code06_solver::corrected(&matrix(blocks, J), &b, None, None, sweeps)
}
