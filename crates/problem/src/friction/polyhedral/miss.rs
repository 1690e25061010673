//! How far impulses are from the friction of a polygon, each contact in its own units.
//!
//! The rows of the LCP that have a γ are not measured as the others are: γ is a speed, and what is left of μ x_n is an
//! impulse. A contact may have something left of μ x_n, beside μ x_n, or slip, beside the terms of its slips; that it has
//! both is its miss.

use std::ops::Range;

use super::Polyhedral;
use crate::accurate;
use crate::merit::{Miss, RowTerms, is_better, reach_of_friction, relative};

/// Where the unknowns of a contact with friction are among those of the LCP, and its μ.
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

    /// Whether impulses x may be called a solution: no row of their z misses by more than the tolerance, and x is ten
    /// times nearer to a solution than x = Π(0).
    pub fn is_solution(&self, x: &[f64], tolerance: f64) -> bool {
        let misses = self.misses(&self.z(x));
        let nothing = || {
            let mut nothing = vec![0.0; self.lcp.len()];
            self.lcp.project_all(&mut nothing);
            self.misses(&self.z(&self.x(&nothing)))
        };
        misses.iter().all(|miss| miss.residual <= tolerance)
            && is_better(&misses, nothing().into_iter(), tolerance)
    }

    /// The misses of the rows of z; those of γ have a residual only.
    fn misses(&self, z: &[f64]) -> Vec<Miss> {
        let at = |unknown: usize| RowTerms::summed::<accurate::Sum>(&self.lcp, unknown, z);
        let others = (0..self.first_beta()).map(|i| at(i).miss(&self.lcp, i, z));
        let friction = self.unknowns().flat_map(|contact| {
            let rubs = Rubs::of(self, &contact, z, at);
            rubs.misses(z[contact.gamma])
        });
        others.chain(friction).collect()
    }

    /// The γ of a contact that leaves least, where z has 0 for it: 0, the largest speed of slip along a −d_j, or that
    /// along the −d_j of a β that pushes.
    pub(super) fn best_gamma(&self, contact: &Unknowns, z: &[f64]) -> f64 {
        let rubs = Rubs::of(self, contact, z, |unknown| RowTerms::at(&self.lcp, unknown, z));
        let speed = |row: &RowTerms| (-row.w()).max(0.0);
        let fastest = rubs.rows.iter().map(speed).fold(0.0, f64::max);
        let pushing = rubs.beta.iter().zip(&rubs.rows).filter(|(beta, _)| **beta > 0.0);
        let left = |gamma: f64| {
            let misses = rubs.sliding_at(gamma).misses(gamma);
            misses.iter().map(|miss| miss.residual).fold(0.0, f64::max)
        };
        let speeds = [0.0, fastest].into_iter().chain(pushing.map(|(_, row)| speed(row)));
        speeds.min_by(|a, b| left(*a).total_cmp(&left(*b))).unwrap_or(0.0)
    }
}

/// The friction of one contact at a z.
struct Rubs<'a> {
    beta: &'a [f64],
    /// Those of β.
    rows: Vec<RowTerms>,
    /// μ x_n − Σ β.
    left: f64,
    /// The largest β that is known to be possible, [`reach_of_friction`].
    reach: f64,
}

impl<'a> Rubs<'a> {
    fn of(
        polyhedral: &Polyhedral,
        contact: &Unknowns,
        z: &'a [f64],
        at: impl Fn(usize) -> RowTerms,
    ) -> Self {
        let normal = at(contact.normal).size(&polyhedral.lcp, contact.normal, z);
        let rounding = f64::EPSILON * z[contact.gamma];
        let row = |unknown: usize| match at(unknown) {
            row if row.w().abs() <= rounding => RowTerms { w: 0.0, ..row }, // γ is its speed, rounded
            row => row,
        };
        Rubs {
            beta: &z[contact.beta.clone()],
            rows: contact.beta.clone().map(row).collect(),
            left: at(contact.gamma).w(),
            reach: reach_of_friction(contact.mu, normal),
        }
    }

    /// The same where γ is this and not 0.
    fn sliding_at(&self, gamma: f64) -> Self {
        Rubs { rows: self.rows.iter().map(|row| row.plus(gamma)).collect(), ..*self }
    }

    /// The misses of each β and of γ.
    fn misses(&self, gamma: f64) -> Vec<Miss> {
        let push = |(&beta, row): (&f64, &RowTerms)| {
            row.miss_between(beta, 0.0, f64::INFINITY, || self.reach)
        };
        let slip = |row: &RowTerms| relative(libm::ldexp(gamma, -row.exponent), row.magnitude);
        let slips = self.rows.iter().map(slip).fold(f64::INFINITY, f64::min);
        let of_gamma = Miss::of_residual((self.left / self.reach).min(slips).abs());
        self.beta.iter().zip(&self.rows).map(push).chain([of_gamma]).collect()
    }
}
