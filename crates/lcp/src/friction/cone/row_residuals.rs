//! Residuals of a contact under either cone law.

use super::{ConeProblem, project};
use crate::friction::Contact;
use crate::friction::tangents::Tangents;
use crate::merit::{self, RowResidual, RowTerms};

impl ConeProblem {
    /// Coulomb's law: the normal as a contact without friction, the tangents with their disk.
    pub(super) fn coulomb(
        &self,
        contact: &Contact,
        rows: [RowTerms; 3],
        x: [f64; 3],
        size: f64,
    ) -> [RowResidual; 2] {
        let [n, t1, t2] = rows;
        let exponent = common_exponent(&[t1, t2]);
        let scale = self.tangential_scale(contact);
        let tangents = Tangents::new([t1, t2], scale, contact.mu, size, exponent);
        let ([w1, w2], scale) = (tangents.w, tangents.scale);
        let [of_scale, of_reach] = tangents.measured(|unit| {
            let [p1, p2] = [x[1], x[2]].map(|x| unit.of(x));
            let radius = contact.mu * unit.of(x[0].max(0.0));
            let [d1, d2] = in_disc(radius, [p1 - w1, p2 - w2]);
            crate::hypot(p1 - d1, p2 - d2)
        });
        let residual = merit::relative(of_reach, tangents.magnitude);
        let normal = n.row_residual_between(x[0], 0.0, f64::INFINITY, || f64::INFINITY);
        let magnitude = tangents.magnitude;
        [normal, RowResidual { size: of_scale, scale, magnitude, exponent, residual }]
    }

    /// The associated law, in coordinates in which both scales are s_t: p = (s_n x_n ρ, s_t x_t), ρ
    /// = √(s_t/s_n).
    pub(super) fn associated(
        &self,
        contact: &Contact,
        rows: [RowTerms; 3],
        x: [f64; 3],
        size: f64,
    ) -> [RowResidual; 2] {
        let [n, t1, t2] = rows;
        let exponent = common_exponent(&rows);
        let (of_normal, scale) = (n.positive_scale(), self.tangential_scale(contact));
        let tangents = Tangents::new([t1, t2], scale, contact.mu, size, exponent);
        let ([w1, w2], scale) = (tangents.w, tangents.scale);
        let [w_n, load] = [n.w, n.magnitude].map(|v| libm::ldexp(v, n.exponent - exponent));
        let p_n = merit::product(of_normal, x[0], -exponent);
        let [of_scale, of_reach] = tangents.measured(|unit| {
            let rho = (unit.value() / of_normal).sqrt();
            let [p1, p2] = [x[1], x[2]].map(|x| unit.of(x));
            let [n, t1, t2] = step(contact.mu * rho, [rho * p_n, p1, p2], [rho * w_n, w1, w2]);
            [(n / rho).abs(), crate::hypot(t1, t2)]
        });
        let row_residual = |k: usize, scale, terms| {
            let residual = merit::relative(of_reach[k], terms);
            RowResidual { size: of_scale[k], scale, magnitude: terms, exponent, residual }
        };
        [row_residual(0, of_normal, load), row_residual(1, scale, tangents.magnitude)]
    }

    /// s_t: the largest absolute row sum of the contact's 2 × 2 tangential block; if that is 0, the
    /// largest |a_ij| of both rows; `None` if all entries are 0.
    fn tangential_scale(&self, contact: &Contact) -> Option<f64> {
        let a = self.friction.lcp.matrix();
        let [_, t1, t2] = contact.rows;
        let entries = || [t1, t2].into_iter().flat_map(|i| a.row(i).iter().map(|(_, a)| a.abs()));
        match merit::block_scale(a, &[t1, t2]) {
            0.0 => Some(entries().fold(0.0, f64::max)).filter(|&s| s > 0.0),
            s => Some(s),
        }
    }
}

/// p − Π_K(p − w), where Π_K is [`project`]: a w that is small beside p is not lost in it.
fn step(mu: f64, p: [f64; 3], w: [f64; 3]) -> [f64; 3] {
    let v: [f64; 3] = std::array::from_fn(|k| p[k] - w[k]);
    let [q, q1, q2] = project(mu, v);
    if [q, q1, q2] == v {
        return w;
    }
    let outside = crate::hypot(v[1], v[2]) - mu * v[0];
    let normal = if q == 0.0 { p[0] } else { w[0] - mu * outside / (1.0 + mu * mu) };
    [normal, p[1] - q1, p[2] - q2]
}

/// The point of the disk nearest to t.
fn in_disc(radius: f64, [t1, t2]: [f64; 2]) -> [f64; 2] {
    match crate::hypot(t1, t2) {
        length if length <= radius => [t1, t2],
        length => [radius * (t1 / length), radius * (t2 / length)],
    }
}

/// The exponent of a common unit 2^exponent in which none of these rows overflows; rows of zeros
/// are skipped.
fn common_exponent(rows: &[RowTerms]) -> i32 {
    let rows = rows.iter().filter(|row| row.magnitude > 0.0);
    rows.map(|row| row.exponent).max().unwrap_or(0)
}
