//! Residuals of contacts with friction cones, under either law.
//!
//! The normal and the tangents have their own scale and terms, so that the slip of a light body
//! under a heavy load is compared with its own terms:
//!
//! ```text
//! associated  x = Π_K(x − S⁻¹ w) in the metric of S = diag(s_n, c, c),   K = { |x_t| ≤ μ x_n }
//! Coulomb     x_n = max(x_n − w_n/s_n, 0),   x_t = the point of the disk |x_t| ≤ μ x_n nearest to x_t − w_t/c
//!
//! r_n = |x_n − its step| s_n / T_n,   r_t = |x_t − its step| c / T_t,   T_t = |(T_t1, T_t2)|
//! ```
//!
//! c is s_t, the scale of the tangential block of A, or T_t / R if that is larger, with R = μ
//! max(x_n, e_n): no step is longer than the possible width of the disk.

use lcplab_lcp::Lcp;
use lcplab_lcp::friction::{ConeProblem, Contact, Law};

use super::{Residual, Row, Rows, Wide, friction_reach};

/// The residuals of all rows; both tangents of a contact have the residual of their plane.
pub(crate) fn residuals(problem: &ConeProblem, x: &[f64]) -> (Vec<f64>, Vec<Residual>) {
    let at = Rows::at(problem.friction().lcp(), x);
    let mut residuals: Vec<Residual> = at.residuals();
    for contact in problem.friction().contacts() {
        let own = OnCone::of(&at, contact);
        let [normal, tangential] = match problem.law() {
            Law::Associated => own.associated(),
            Law::Coulomb => own.coulomb(),
        };
        let [n, t1, t2] = contact.rows;
        (residuals[n], residuals[t1], residuals[t2]) = (normal, tangential, tangential);
    }
    (at.w(), residuals)
}

/// A contact at some x.
struct OnCone {
    mu: Wide,
    normal: Row,
    w_t: [Wide; 2],
    x: [Wide; 3],
    /// T_t.
    terms: Wide,
    /// s_t; `None` if both rows of A are 0.
    scale: Option<Wide>,
    /// R.
    reach: Wide,
}

impl OnCone {
    fn of(at: &Rows<'_>, contact: &Contact) -> Self {
        let [normal, t1, t2] = contact.rows.map(|i| at.rows[i]);
        OnCone {
            mu: contact.mu.into(),
            normal,
            w_t: [t1.w, t2.w],
            x: contact.of(at.x).map(Wide::from),
            terms: t1.terms.hypot(t2.terms),
            scale: tangential_scale(at.lcp, contact),
            reach: friction_reach(contact.mu, at.size(contact.rows[0])),
        }
    }

    /// s_t (or 1), and the unit c of the residual.
    fn units(&self) -> [Wide; 2] {
        let scale = self.scale.unwrap_or(1.0.into());
        let is_felt = !self.terms.is_zero() && self.reach.is_finite();
        let is_narrow = self.scale.is_none_or(|scale| scale * self.reach < self.terms);
        [scale, if is_felt && is_narrow { self.terms / self.reach } else { scale }]
    }

    fn coulomb(&self) -> [Residual; 2] {
        let normal = self.normal.residual(self.x[0].value(), 0.0, f64::INFINITY, Wide::INFINITY);
        let [of_scale, of_unit] = self.units().map(|unit| {
            let p = [self.x[1] * unit, self.x[2] * unit];
            let radius = self.mu * unit * self.x[0].max(Wide::ZERO);
            let [d1, d2] = in_disc(radius, [p[0] - self.w_t[0], p[1] - self.w_t[1]]);
            (p[0] - d1).hypot(p[1] - d2)
        });
        [normal, self.tangential(of_scale, of_unit)]
    }

    /// The associated law, in coordinates in which both scales are c: p = (s_n x_n ρ, c x_t), ρ =
    /// √(c/s_n).
    fn associated(&self) -> [Residual; 2] {
        let p_n = self.normal.scale * self.x[0];
        let [of_scale, of_unit] = self.units().map(|unit| {
            let rho = (unit / self.normal.scale).sqrt();
            let p = [self.x[1] * unit, self.x[2] * unit];
            let w = [rho * self.normal.w, self.w_t[0], self.w_t[1]];
            let [n, t1, t2] = step(self.mu * rho, [rho * p_n, p[0], p[1]], w);
            [(n / rho).abs(), t1.hypot(t2)]
        });
        let relative = of_unit[0].relative_to(self.normal.terms);
        let normal = Residual { step: length(of_scale[0], self.normal.scale), relative };
        [normal, self.tangential(of_scale[1], of_unit[1])]
    }

    fn tangential(&self, of_scale: Wide, of_unit: Wide) -> Residual {
        let [scale, _] = self.units();
        Residual { step: length(of_scale, scale), relative: of_unit.relative_to(self.terms) }
    }
}

fn length(size: Wide, scale: Wide) -> Wide {
    if size.is_zero() { Wide::ZERO } else { size / scale.sqrt() }
}

/// s_t: the largest absolute row sum of the contact's 2 × 2 tangential block; if that is 0, the
/// largest |a_ij| of both rows; `None` if all entries are 0.
pub(crate) fn tangential_scale(lcp: &Lcp, contact: &Contact) -> Option<Wide> {
    let a = lcp.matrix();
    let tangents = [contact.rows[1], contact.rows[2]];
    let row_sum = |&i: &usize| tangents.iter().map(|&j| a.entry(i, j).abs()).sum();
    let entries = || tangents.into_iter().flat_map(|i| a.row(i).iter().map(|(_, a)| a.abs()));
    match tangents.iter().map(row_sum).fold(0.0, f64::max) {
        0.0 => Some(entries().fold(0.0, f64::max)).filter(|&s| s > 0.0).map(Wide::from),
        s => Some(s.into()),
    }
}

/// The point of the disk nearest to t.
fn in_disc(radius: Wide, [t1, t2]: [Wide; 2]) -> [Wide; 2] {
    match t1.hypot(t2) {
        length if length <= radius => [t1, t2],
        length => [radius * (t1 / length), radius * (t2 / length)],
    }
}

/// v_n may exceed −μ |v_t| by this fraction of μ |v_t| because of rounding.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// p − Π_K(p − w), with the nearest point Π_K of the cone |v_t| ≤ μ v_n. A w that is small beside p
/// is not lost in the difference. If p − w is outside the opposite cone only by rounding, the
/// nearest point is the tip: a sliding contact without load has the impulse 0, not 10⁻¹⁷.
fn step(mu: Wide, p: [Wide; 3], w: [Wide; 3]) -> [Wide; 3] {
    let [n, t1, t2] = [0, 1, 2].map(|k| p[k] - w[k]);
    let t = t1.hypot(t2);
    if n + mu * t <= Wide::from(ROUNDING) * (mu * t) {
        return p;
    }
    if t <= mu * n {
        return w;
    }
    let slope = Wide::from(1.0) + mu * mu;
    let radius = mu * (n + mu * t) / slope;
    [w[0] - mu * (t - mu * n) / slope, p[1] - radius * (t1 / t), p[2] - radius * (t2 / t)]
}
