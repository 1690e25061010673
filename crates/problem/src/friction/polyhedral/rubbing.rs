//! How far impulses are from the friction of a polygon, each contact in its own units.

use std::ops::Range;

use super::Polyhedral;
use crate::Lcp;
use crate::merit::{RowTerms, reach_of_friction, relative};

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
    /// The worst residual of the friction, with its row of x. The LCP's own compares a β with the terms of a fast slip,
    /// and a γ, a speed, with impulses; here what is left of μ x_n is small beside μ x_n
    /// ([`RowTerms::reach`]), and a slip beside its terms. `terms` says how those of a row of the LCP at z are added up.
    pub fn rubbing(
        &self,
        z: &[f64],
        terms: impl Fn(&Lcp, usize, &[f64]) -> RowTerms,
    ) -> (usize, f64) {
        let at = |unknown: usize| terms(&self.lcp, unknown, z);
        let residuals = self.unknowns().flat_map(|Unknowns { normal, beta, gamma, mu }| {
            let reach = reach_of_friction(mu, at(normal).size(&self.lcp, normal, z));
            let push = beta.clone().map(|unknown| {
                let miss = at(unknown).miss_between(z[unknown], 0.0, f64::INFINITY, || reach);
                (self.row(unknown), miss.residual)
            });
            let slip = beta.clone().map(|unknown| {
                let terms = at(unknown);
                relative(libm::ldexp(z[gamma], -terms.exponent), terms.magnitude)
            });
            let left = at(gamma).w() / reach; // of μ x_n
            let slips = slip.fold(f64::INFINITY, f64::min);
            push.chain([(self.row(gamma), left.min(slips).abs())]).collect::<Vec<_>>()
        });
        residuals.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0))
    }

    /// The unknowns of the contacts with friction.
    pub fn unknowns(&self) -> impl Iterator<Item = Unknowns> + '_ {
        let k = self.directions;
        let contacts = self.friction.contacts();
        let normals = (self.friction.others().len()..).zip(contacts);
        let rubbing = normals.filter(|(_, contact)| contact.mu > 0.0);
        let first = self.friction.others().len() + contacts.len();
        rubbing.enumerate().map(move |(c, (normal, contact))| Unknowns {
            normal,
            beta: first + c * k..first + (c + 1) * k,
            gamma: self.impulses.len() + c,
            mu: contact.mu,
        })
    }
}
