//! Residuals of contacts whose friction is a polygon, each contact in its own units.
//!
//! The LCP of a polygon compares a β with the terms of a fast slip, and a γ, which is a speed, with
//! impulses. Here what is left of μ x_n is compared with μ x_n, and a slip with its own terms.

use lcplab_problem::friction::Polyhedral;

use super::{Rows, Wide, friction_reach, worst};

/// The largest residual of the friction of z, with its row of x.
pub(crate) fn friction_residual(polyhedral: &Polyhedral, z: &[f64]) -> (usize, f64) {
    let at = Rows::at(polyhedral.lcp(), z);
    let mut residuals = Vec::new();
    for contact in polyhedral.unknowns() {
        let reach = friction_reach(contact.mu, at.size(contact.normal));
        for unknown in contact.beta.clone() {
            let push = at.rows[unknown].residual(z[unknown], 0.0, f64::INFINITY, reach);
            residuals.push((polyhedral.row(unknown), push.relative));
        }
        let slip =
            |unknown: usize| Wide::from(z[contact.gamma]).relative_to(at.rows[unknown].terms);
        let slips = contact.beta.map(slip).fold(f64::INFINITY, f64::min);
        let left = (at.rows[contact.gamma].w / reach).value(); // of μ x_n
        residuals.push((polyhedral.row(contact.gamma), left.min(slips).abs()));
    }
    let (k, largest) = worst(residuals.iter().map(|(_, residual)| *residual));
    (residuals.get(k).map_or(0, |(row, _)| *row), largest)
}
