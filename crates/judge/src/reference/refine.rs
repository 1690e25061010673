//! Newton's method from an interior point, which ends near the bounds and not on them.
//!
//! An interior-point method stops at a small duality gap, and the residual is about its square
//! root. These steps solve the equation of a fixed point instead, in coordinates in which A has a
//! diagonal of 1 and a cone stays a cone:
//!
//! ```text
//! F(y) = y − Π(y − Â y − b̂) = 0        y = S^½ x,   Â = S^−½ A S^−½,   b̂ = S^−½ b
//! (PᵀP + λ) d = −Pᵀ F                  P = I − D + D Â,   D: a derivative of Π
//! ```
//!
//! S is the diagonal of A, equal for both tangents of a contact. A may be singular, so λ is a tiny
//! multiple of the mean eigenvalue of PᵀP (Levenberg and Marquardt). The method converges
//! quadratically near a solution (Qi & Sun 1993); far from one it may not converge, so the best
//! point is kept.

use faer::linalg::solvers::Solve;
use faer::{Col, Mat};
use lcplab_lcp::friction::Contact;
use lcplab_lcp::{Complementarity, Lcp};

use crate::residual::{Rows, cone};

/// P and PᵀP are dense: with more rows the point stays as it is.
const MOST_ROWS: usize = 400;
const MOST_STEPS: usize = 20;
/// A scaled residual that is rounding.
const ROUNDING: f64 = 1e-15;
/// λ as a fraction of the mean eigenvalue of PᵀP.
const DAMPING: f64 = 1e-14;

/// The point with the least scaled residual among x and those of Newton's steps from there.
///
/// `contacts` are those with a cone; every other row lies between its bounds.
pub(super) fn refined(
    problem: &impl Complementarity,
    contacts: &[Contact],
    x: Vec<f64>,
) -> Vec<f64> {
    if x.len() > MOST_ROWS || x.iter().any(|x| !x.is_finite()) {
        return x;
    }
    let equation = Equation::new(problem.lcp(), contacts, &x);
    let mut best = (problem.scaled_residual(&x), x.clone());
    let mut x = x;
    for _ in 0..MOST_STEPS {
        let (projected, p) = equation.linearized(&x);
        let next = equation.next(&x, &projected, &p);
        let residual = problem.scaled_residual(&projected);
        if residual < best.0 {
            best = (residual, projected);
        }
        match next {
            Some(next) if best.0 > ROUNDING => x = next,
            _ => break,
        }
    }
    best.1
}

/// F(y) = 0.
struct Equation<'a> {
    lcp: &'a Lcp,
    contacts: &'a [Contact],
    /// Whether a row belongs to a contact.
    is_of_contact: Vec<bool>,
    /// S^½.
    root: Vec<f64>,
    /// Â.
    a: Mat<f64>,
}

impl<'a> Equation<'a> {
    fn new(lcp: &'a Lcp, contacts: &'a [Contact], x: &[f64]) -> Self {
        let n = x.len();
        let mut scale: Vec<f64> =
            Rows::at(lcp, x).rows.iter().map(|row| row.scale.value()).collect();
        let mut is_of_contact = vec![false; n];
        for contact in contacts {
            let of_tangents = cone::tangential_scale(lcp, contact).map_or(1.0, |c| c.value());
            contact.rows[1..].iter().for_each(|&i| scale[i] = of_tangents);
            contact.rows.iter().for_each(|&i| is_of_contact[i] = true);
        }
        let root: Vec<f64> = scale.into_iter().map(f64::sqrt).collect();
        let mut a = Mat::zeros(n, n);
        for i in 0..n {
            lcp.matrix().row(i).iter().for_each(|(j, own)| a[(i, j)] = own / (root[i] * root[j]));
        }
        Equation { lcp, contacts, is_of_contact, root, a }
    }

    /// Π(y − Â y − b̂) as x, which lies on the bounds that it is pushed to, and P.
    fn linearized(&self, x: &[f64]) -> (Vec<f64>, Mat<f64>) {
        let (n, w) = (x.len(), self.lcp.w(x));
        let (mut projected, mut p) = (x.to_vec(), Mat::<f64>::identity(n, n));
        for i in (0..n).filter(|&i| !self.is_of_contact[i]) {
            let target = x[i] - w[i] / (self.root[i] * self.root[i]);
            let (lo, hi) = (self.lcp.lo()[i], self.lcp.hi()[i]);
            projected[i] = target.max(lo).min(hi);
            if lo < target && target < hi {
                (0..n).for_each(|j| p[(i, j)] = self.a[(i, j)]);
            }
        }
        for contact in self.contacts {
            let rows = contact.rows;
            let target = rows.map(|i| x[i] * self.root[i] - w[i] / self.root[i]);
            let mu = contact.mu * self.root[rows[1]] / self.root[rows[0]];
            let (nearest, d) = project(mu, target);
            for (k, &i) in rows.iter().enumerate() {
                projected[i] = nearest[k] / self.root[i];
                for j in 0..n {
                    p[(i, j)] = (0..3).map(|l| d[k][l] * self.a[(rows[l], j)]).sum();
                }
                p[(i, i)] += 1.0;
                rows.iter().enumerate().for_each(|(l, &j)| p[(i, j)] -= d[k][l]);
            }
        }
        (projected, p)
    }

    /// The next x of Newton's method; `None` if it is not finite.
    fn next(&self, x: &[f64], projected: &[f64], p: &Mat<f64>) -> Option<Vec<f64>> {
        let n = x.len();
        let f = Col::from_fn(n, |i| (x[i] - projected[i]) * self.root[i]);
        let mut normal = p.transpose() * p;
        let mean = (0..n).map(|i| normal[(i, i)]).sum::<f64>() / n as f64;
        (0..n).for_each(|i| normal[(i, i)] += DAMPING * mean);
        let d = normal.partial_piv_lu().solve(p.transpose() * f);
        let next: Vec<f64> = (0..n).map(|i| x[i] - d[i] / self.root[i]).collect();
        next.iter().all(|x| x.is_finite()).then_some(next)
    }
}

/// The point of the cone |v_t| ≤ μ v_n nearest to v, and the derivative there, from one side if
/// there are two.
fn project(mu: f64, [n, t1, t2]: [f64; 3]) -> ([f64; 3], [[f64; 3]; 3]) {
    let t = t1.hypot(t2);
    if t <= mu * n {
        return ([n, t1, t2], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    }
    // The opposite cone, up to rounding: a contact without load slides with the impulse 0.
    if n + mu * t <= 4.0 * f64::EPSILON * mu * t {
        return ([0.0; 3], [[0.0; 3]; 3]);
    }
    let (u1, u2, part) = (t1 / t, t2 / t, 1.0 / (1.0 + mu * mu));
    let normal = (n + mu * t) * part;
    // Along the slip the cone is a line, across it a circle of radius μ times `normal`.
    let (along, across) = (mu * mu * part, mu * normal / t);
    let tangents = |a: f64, b: f64| a * b * (along - across);
    (
        [normal, mu * normal * u1, mu * normal * u2],
        [
            [part, mu * part * u1, mu * part * u2],
            [mu * part * u1, tangents(u1, u1) + across, tangents(u1, u2)],
            [mu * part * u2, tangents(u1, u2), tangents(u2, u2) + across],
        ],
    )
}
