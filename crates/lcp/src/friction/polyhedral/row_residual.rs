//! Residuals of polygonal friction, each contact in its own units.
//!
//! A row of γ has its own residual, because it compares a speed, γ, with an impulse, μ x_n − Σ β. A
//! contact may use less than μ x_n or slip, but not both: the residual is the smaller of the two,
//! each relative to its terms.

use std::ops::Range;

use super::Polyhedral;
use crate::accurate;
use crate::merit::{RowResidual, RowTerms, is_better, reach_of_friction, relative};

/// The positions of a contact's unknowns in the LCP, and its μ. Only for contacts with μ > 0.
#[derive(Debug, Clone)]
pub struct Unknowns {
    /// x_n.
    pub normal: usize,
    /// The k impulses β.
    pub beta: Range<usize>,
    /// γ.
    pub gamma: usize,
    /// The coefficient of friction, above 0.
    pub mu: f64,
}

impl Polyhedral {
    /// The unknowns of the contacts with friction.
    pub fn unknowns(&self) -> impl Iterator<Item = Unknowns> + '_ {
        let k = self.directions;
        let contacts = self.friction.contacts();
        let normals = (self.friction.others().len()..).zip(contacts);
        let rubbing = normals.filter(|(_, contact)| contact.mu > 0.0);
        let first = self.first_beta();
        rubbing.enumerate().map(move |(c, (normal, contact))| Unknowns {
            normal,
            beta: first + c * k..first + (c + 1) * k,
            gamma: self.impulses.len() + c,
            mu: contact.mu,
        })
    }

    /// Whether x counts as a solution: no residual of its z is above the tolerance, and x is ten
    /// times closer to a solution than Π(0).
    pub fn is_solution(&self, x: &[f64], tolerance: f64) -> bool {
        let row_residuals = self.row_residuals(&self.z(x));
        let nothing = || {
            let mut nothing = vec![0.0; self.lcp.len()];
            self.lcp.project_all(&mut nothing);
            self.row_residuals(&self.z(&self.x(&nothing)))
        };
        row_residuals.iter().all(|row_residual| row_residual.residual <= tolerance)
            && is_better(&row_residuals, nothing().into_iter(), tolerance)
    }

    /// The residuals of the rows of z; those of γ have no step size.
    fn row_residuals(&self, z: &[f64]) -> Vec<RowResidual> {
        let at = |unknown: usize| RowTerms::summed::<accurate::Sum>(&self.lcp, unknown, z);
        let others = (0..self.first_beta()).map(|i| at(i).row_residual(&self.lcp, i, z));
        let friction = self.unknowns().flat_map(|contact| {
            let friction = ContactFriction::of(self, &contact, z, at);
            friction.row_residuals(z[contact.gamma])
        });
        others.chain(friction).collect()
    }

    /// The γ of a contact with the smallest residual: 0, the largest slip speed along any −d_j, or
    /// the slip speed along the −d_j of a positive β. z has γ = 0 for this contact.
    pub(super) fn best_gamma(&self, contact: &Unknowns, z: &[f64]) -> f64 {
        let friction =
            ContactFriction::of(self, contact, z, |unknown| RowTerms::at(&self.lcp, unknown, z));
        let speed = |row: &RowTerms| (-row.w()).max(0.0);
        let fastest = friction.rows.iter().map(speed).fold(0.0, f64::max);
        let pushing = friction.beta.iter().zip(&friction.rows).filter(|(beta, _)| **beta > 0.0);
        let left = |gamma: f64| {
            let row_residuals = friction.sliding_at(gamma).row_residuals(gamma);
            row_residuals.iter().map(|row_residual| row_residual.residual).fold(0.0, f64::max)
        };
        let speeds = [0.0, fastest].into_iter().chain(pushing.map(|(_, row)| speed(row)));
        speeds.min_by(|a, b| left(*a).total_cmp(&left(*b))).unwrap_or(0.0)
    }
}

/// The friction of one contact at a z.
struct ContactFriction<'a> {
    beta: &'a [f64],
    /// The terms of the rows of β.
    rows: Vec<RowTerms>,
    /// μ x_n − Σ β.
    left: f64,
    /// The largest possible β, [`reach_of_friction`].
    reach: f64,
}

impl<'a> ContactFriction<'a> {
    fn of(
        polyhedral: &Polyhedral,
        contact: &Unknowns,
        z: &'a [f64],
        at: impl Fn(usize) -> RowTerms,
    ) -> Self {
        let normal = at(contact.normal).size(&polyhedral.lcp, contact.normal, z);
        let rounding = f64::EPSILON * z[contact.gamma];
        let row = |unknown: usize| match at(unknown) {
            // γ is its speed.
            row if row.w().abs() <= rounding => RowTerms { w: 0.0, ..row },
            row => row,
        };
        ContactFriction {
            beta: &z[contact.beta.clone()],
            rows: contact.beta.clone().map(row).collect(),
            left: at(contact.gamma).w(),
            reach: reach_of_friction(contact.mu, normal),
        }
    }

    /// The same friction with this γ instead of 0.
    fn sliding_at(&self, gamma: f64) -> Self {
        ContactFriction { rows: self.rows.iter().map(|row| row.plus(gamma)).collect(), ..*self }
    }

    /// The residuals of each β and of γ.
    fn row_residuals(&self, gamma: f64) -> Vec<RowResidual> {
        let push = |(&beta, row): (&f64, &RowTerms)| {
            row.row_residual_between(beta, 0.0, f64::INFINITY, || self.reach)
        };
        // γ is the slip speed along the direction whose w it makes zero.
        let slipping = self.rows.iter().min_by(|a, b| a.w().abs().total_cmp(&b.w().abs()));
        let slip = |row: &RowTerms| relative(libm::ldexp(gamma, -row.exponent), row.magnitude);
        let slip = slipping.map_or(0.0, slip);
        let left = match self.reach.is_finite() {
            true => self.left / self.reach,
            false => relative(self.left, self.beta.iter().sum()),
        };
        let of_gamma = RowResidual::of_residual(left.min(slip).abs());
        self.beta.iter().zip(&self.rows).map(push).chain([of_gamma]).collect()
    }
}
