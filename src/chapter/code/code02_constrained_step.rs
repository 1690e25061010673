//! Code 2: the step with the constraint forces x.
//!
//! ```text
//! Code 2      u⁺ = u + dt M⁻¹ F −    M⁻¹ Jᵀ x     x an impulse of A x = J u* (Code 4)
//! K&M (23)    u⁺ = u + dt M⁻¹ F − dt M⁻¹ Jᵀ x     x a force of dt A x = J u*
//! corrected   u⁺ = u + dt M⁻¹ F +    M⁻¹ Jᵀ x     x an impulse of A x = −J u*
//! ```
//!
//! Listing and equation differ by dt, and each is right only with its own x (E28). Both subtract x
//! where the library adds it, so that x ≥ 0 pulls if J is the derivative of a gap (E30). The
//! listing's comment still calls this the step without constraints (E60).
#![allow(non_snake_case)]

use nalgebra::{DMatrix, DVector};

use super::Listing;
use super::code01_unconstrained_step::Blocks;

pub(in crate::chapter) const LISTING: Listing = Listing {
    id: "Code 2",
    title: "a step with the constraints' x",
    printed: "u⁺ = u + dt M⁻¹ F − M⁻¹ Jᵀ x; next to it (23), with dt M⁻¹ Jᵀ x",
    corrected: "u⁺ = u + dt M⁻¹ F + M⁻¹ Jᵀ x, x an impulse that pushes where it is positive",
    errata: &["E28", "E30", "E60"],
};

/// The listing: u⁺ and s⁺ with an impulse x (N s) that is subtracted.
pub fn printed(
    blocks: &Blocks,
    J: &DMatrix<f64>,
    x: &DVector<f64>,
    dt: f64,
) -> (DVector<f64>, DVector<f64>) {
    let u_next = blocks.unconstrained(dt) - &blocks.M_inv * J.transpose() * x;
    let s_next = blocks.moved(&u_next, dt);
    (u_next, s_next)
}

/// K&M (23) and (24): u⁺ and s⁺ with a force x (N) that is subtracted.
pub fn equation(
    blocks: &Blocks,
    J: &DMatrix<f64>,
    x: &DVector<f64>,
    dt: f64,
) -> (DVector<f64>, DVector<f64>) {
    printed(blocks, J, &(x * dt), dt)
}

/// u⁺ and s⁺ with an impulse x (N s) that is added.
pub fn corrected(
    blocks: &Blocks,
    J: &DMatrix<f64>,
    x: &DVector<f64>,
    dt: f64,
) -> (DVector<f64>, DVector<f64>) {
    printed(blocks, J, &-x, dt)
}
