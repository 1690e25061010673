//! Residuals of contacts whose friction is a polygon, each contact in its own units.
//!
//! The unknowns z = (other rows, x_n, β, γ) of the polygon's LCP ([`Polyhedral`]) are computed from
//! x. A row of γ has its own residual, because it compares a speed, γ, with an impulse, μ x_n − Σ
//! β.
//!
//! ```text
//! r_β = |min(β, e w_β/T_β)| / e            e = min(T_β/s_β, R),   R = μ max(x_n, T_n/s_n)
//! r_γ = |min((μ x_n − Σ β)/R, γ/T_γ)|               T_γ = T_β of the β with the least |w_β|
//! ```
//!
//! Where x_n and T_n are 0, and R too, Σ β replaces it in r_γ, so that friction without a normal
//! force counts in full.
//!
//! γ is the candidate with the smallest residual: 0, the largest slip speed along any −d_j, or the
//! slip speed along the −d_j of a positive β.

use std::cmp::Ordering;

use lcplab_lcp::friction::{Polyhedral, Unknowns};

use super::{Residual, Row, Rows, Wide, friction_reach};

/// The unknowns z for x.
pub(crate) fn unknowns(polyhedral: &Polyhedral, x: &[f64]) -> Vec<f64> {
    let mut z = polyhedral.z_at_rest(x);
    let at_rest = Rows::at(polyhedral.lcp(), &z);
    let slides = polyhedral.unknowns().map(|contact| {
        let gamma = OnPolygon::of(&at_rest, &contact).best_gamma();
        (contact.gamma, gamma)
    });
    let slides: Vec<(usize, f64)> = slides.collect();
    for (unknown, gamma) in slides {
        z[unknown] = gamma;
    }
    z
}

/// The residuals of x with these unknowns, each with its row of x: t1 for a β, n for a γ.
pub(crate) fn residuals(polyhedral: &Polyhedral, x: &[f64], z: &[f64]) -> Vec<(usize, Residual)> {
    let at = Rows::at(polyhedral.lcp(), z);
    let first = polyhedral.friction().others().len() + polyhedral.friction().contacts().len();
    let others = (0..first).map(|unknown| (polyhedral.row(unknown), at.residual(unknown)));
    let friction = polyhedral.unknowns().flat_map(|contact| {
        let own = OnPolygon::of(&at, &contact).residuals(z[contact.gamma]);
        let rows = contact.beta.chain([contact.gamma]).map(|unknown| polyhedral.row(unknown));
        rows.zip(own).collect::<Vec<_>>()
    });
    others.chain(friction).chain(of_smooth(polyhedral, x)).collect()
}

/// The residuals of the x_t of contacts with μ = 0: they must be 0, and z does not contain them.
fn of_smooth(polyhedral: &Polyhedral, x: &[f64]) -> Vec<(usize, Residual)> {
    let contacts = polyhedral.friction().contacts();
    let smooth = contacts.iter().filter(|contact| contact.mu == 0.0);
    let tangents: Vec<usize> = smooth.flat_map(|contact| contact.rows[1..].to_vec()).collect();
    if tangents.iter().all(|&i| x[i] == 0.0) {
        return Vec::new();
    }
    let at = Rows::at(polyhedral.friction().lcp(), x);
    let relative = |i: usize| at.rows[i].residual(x[i], 0.0, 0.0, Wide::INFINITY).relative;
    let own = |i: usize| (i, Residual { step: Wide::ZERO, relative: relative(i) });
    tangents.into_iter().map(own).collect()
}

/// The friction of a contact at some z.
struct OnPolygon {
    beta: Vec<f64>,
    /// The rows of β.
    rows: Vec<Row>,
    /// μ x_n − Σ β.
    left: Wide,
    reach: Wide,
}

impl OnPolygon {
    fn of(at: &Rows<'_>, contact: &Unknowns) -> Self {
        let rounding = Wide::from(f64::EPSILON * at.x[contact.gamma]);
        let row = |row: &Row| match row.w.abs() <= rounding {
            // γ is the rounded speed of this β.
            true => Row { w: Wide::ZERO, ..*row },
            false => *row,
        };
        OnPolygon {
            beta: at.x[contact.beta.clone()].to_vec(),
            rows: at.rows[contact.beta.clone()].iter().map(row).collect(),
            left: at.rows[contact.gamma].w,
            reach: friction_reach(contact.mu, at.size(contact.normal)),
        }
    }

    /// The same friction with this γ instead of 0.
    fn sliding_at(&self, gamma: f64) -> Self {
        let gamma = Wide::from(gamma);
        let slides = |row: &Row| Row { w: row.w + gamma, terms: row.terms + gamma, ..*row };
        OnPolygon { beta: self.beta.clone(), rows: self.rows.iter().map(slides).collect(), ..*self }
    }

    /// The γ with the smallest residual; these rows were computed with γ = 0.
    fn best_gamma(&self) -> f64 {
        let speed = |row: &Row| (-row.w.value()).max(0.0);
        let fastest = self.rows.iter().map(speed).fold(0.0, f64::max);
        let pushing = self.beta.iter().zip(&self.rows).filter(|(beta, _)| **beta > 0.0);
        let speeds = [0.0, fastest].into_iter().chain(pushing.map(|(_, row)| speed(row)));
        let left = |gamma: f64| {
            let residuals = self.sliding_at(gamma).residuals(gamma);
            residuals.iter().map(|own| own.relative).fold(0.0, f64::max)
        };
        speeds.min_by(|a, b| left(*a).total_cmp(&left(*b))).unwrap_or(0.0)
    }

    /// The residuals of each β and of γ, which has no step.
    fn residuals(&self, gamma: f64) -> Vec<Residual> {
        let push = |(&beta, row): (&f64, &Row)| row.residual(beta, 0.0, f64::INFINITY, self.reach);
        // γ is the slip speed along the direction whose w it makes zero.
        let slipping = self.rows.iter().min_by(|a, b| nearest_to_zero(a.w, b.w));
        let slip = slipping.map_or(0.0, |row| Wide::from(gamma).relative_to(row.terms));
        let sum = || self.beta.iter().fold(Wide::ZERO, |sum, &beta| sum + beta.into());
        let left = match self.reach.is_finite() {
            true => (self.left / self.reach).value(),
            false => self.left.relative_to(sum()),
        };
        let of_gamma = Residual { step: Wide::ZERO, relative: left.min(slip).abs() };
        self.beta.iter().zip(&self.rows).map(push).chain([of_gamma]).collect()
    }
}

/// Which of two numbers is nearer to 0; NaN is far.
fn nearest_to_zero(a: Wide, b: Wide) -> Ordering {
    a.abs().partial_cmp(&b.abs()).unwrap_or(Ordering::Equal)
}
