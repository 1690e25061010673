//! Model 4: the circular friction cone.
//!
//! ```text
//! K  = { x : |x_t| ≤ μ x_n }         Coulomb's cone, which contains the impulse
//! K* = { w : w_n ≥ μ |w_t| }         its dual: all w with x·w ≥ 0 for every x in K
//!
//! 4a  K ∋ x ⟂ w ∈ K*                 w = A x + b
//! 4b  K ∋ x ⟂ ŵ ∈ K*                 ŵ = w + μ |w_t| n
//! ```
//!
//! For semidefinite A, 4a is the optimality condition of minimizing ½ xᵀAx + bᵀx over the cones: a
//! convex problem that cone programming and projected gradient methods solve reliably. When a
//! contact slides, x lies on the surface of K and w on that of K*: w_n = μ |w_t|. The bodies
//! *separate* as they slide, at the slope of the cone; in a time step dt they end up at a height of
//! dt μ |w_t|. Friction is opposite to the slip, and the model is isotropic. (In plasticity such a
//! flow rule is called associated.)
//!
//! De Saxcé & Feng (1991) remove that separation: with ŵ instead of w, sliding means ŵ_n = μ |w_t|,
//! hence w_n = 0, and 4b is Coulomb's law exactly. Now the shift μ |w_t| depends on x, and no
//! function is minimized: the problem is not convex. But with the shift *frozen* at some x it is a
//! 4a with another b_n ([`ConeProblem::frozen_at`]), and x solves 4b if and only if it solves the
//! 4a frozen at x. Freezing, solving and repeating therefore leads to Coulomb's law, just as it
//! leads from model 1 to model 2 (Acary, Cadoux, Lemaréchal & Malick 2011).
//!
//! The solutions of both are the fixed points of a projection; the residual measures the distance
//! of x from its projected step. The normal and the tangents have a scale and terms each, so that
//! the slip of a light body under a heavy load is compared with its own terms and not with the
//! load:
//!
//! ```text
//! 4a  x = Π_K(x − S⁻¹ w) in the metric of S = diag(s_n, s_t, s_t)
//! 4b  x_n = max(x_n − w_n/s_n, 0),   x_t = the point of the disk |x_t| ≤ μ x_n nearest to x_t − w_t/s_t
//!
//! r_n = |x_n − its step| s_n / terms_n,   r_t = |x_t − its step| s_t / terms_t
//! ```
//!
//! s_t is the scale of the tangential block of A, but at least terms_t / R, so that no step is
//! longer than the possible width of the disk, and exactly terms_t / R if both rows of A are 0. R =
//! μ max(x_n, terms_n / s_n), as for a row with bounds
//! ([`scaled_residual`](merit::scaled_residual)).

mod row_residuals;

use super::{Contact, FrictionProblem};
use crate::accurate;
use crate::merit::{self, RowResidual, RowTerms};
use crate::{Complementarity, Lcp};

/// The normal velocity of a sliding contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Law {
    /// 4a: the bodies separate, w_n = μ |w_t|; x minimizes ½ xᵀAx + bᵀx.
    Associated,
    /// 4b: the bodies stay in contact, w_n = 0; Coulomb's law.
    Coulomb,
}

/// A friction problem with circular cones.
///
/// ```
/// use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law};
/// use lcplab_lcp::merit::RowTerms;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // A point of 1 kg reaches the ground with 2 m/s and slides along t1 with 3 m/s: w = x + b.
/// let a = Matrix::from([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
/// let (b, free) = (vec![-2.0, -3.0, 0.0], f64::INFINITY);
/// let lcp = Lcp::new(a, b, vec![0.0, -free, -free], vec![free; 3])?;
/// let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
/// let contact = problem.contacts()[0];
/// let cone = ConeProblem::new(problem, Law::Coulomb);
/// assert_eq!((cone.law(), cone.scale(&contact)), (Law::Coulomb, 1.0));
///
/// // x = (2, 1, 0) stops the fall, and its friction is μ x_n; 2 m/s of slip remain. A projected
/// // step does not change it, and no residual remains.
/// let x = [2.0, 1.0, 0.0];
/// let w = [0.0, -2.0, 0.0];
/// assert_eq!(cone.step(&contact, x, w, 1.0), x);
/// let terms: Vec<_> = (0..3).map(|i| RowTerms::at(cone.friction().lcp(), i, &x)).collect();
/// assert_eq!(cone.residuals(&terms, &x), [0.0; 3]);
/// assert_eq!(cone.row_residuals(&terms, &x)[0].magnitude, 4.0); // |x_n| + |b_n|
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct ConeProblem {
    friction: FrictionProblem,
    law: Law,
}

impl ConeProblem {
    /// The problem under this law.
    pub fn new(friction: FrictionProblem, law: Law) -> Self {
        ConeProblem { friction, law }
    }

    /// The contacts and the other rows.
    pub fn friction(&self) -> &FrictionProblem {
        &self.friction
    }

    /// The law.
    pub fn law(&self) -> Law {
        self.law
    }

    /// The shift added to the w_n of a contact: μ |w_t| under Coulomb's law, otherwise 0.
    ///
    /// ```
    /// use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law};
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// // A point of 1 kg on the ground slides along t1: w = x + b.
    /// let (b, free) = (vec![-2.0, -3.0, 0.0], f64::INFINITY);
    /// let a = Matrix::from([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    /// let lcp = Lcp::new(a, b, vec![0.0, -free, -free], vec![free; 3])?;
    /// let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
    /// let contact = problem.contacts()[0];
    /// let cone = ConeProblem::new(problem, Law::Coulomb);
    /// assert_eq!(cone.shift(&contact, [0.0, 3.0, 4.0]), 2.5); // μ = 0.5, slip of 5 m/s
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn shift(&self, contact: &Contact, [_, w1, w2]: [f64; 3]) -> f64 {
        match self.law {
            Law::Associated => 0.0,
            Law::Coulomb => contact.mu * crate::hypot(w1, w2),
        }
    }

    /// Π_K(x − ŵ / s): the contact's x after a projected step. x is a solution if this step does
    /// not change it.
    pub fn step(&self, contact: &Contact, x: [f64; 3], w: [f64; 3], s: f64) -> [f64; 3] {
        let shifted = [w[0] + self.shift(contact, w), w[1], w[2]];
        project(contact.mu, std::array::from_fn(|i| x[i] - shifted[i] / s))
    }

    /// s: the largest absolute row sum of the contact's 3 × 3 block of A, an upper bound on its
    /// largest eigenvalue; 1 for a block of zeros.
    pub fn scale(&self, contact: &Contact) -> f64 {
        match merit::block_scale(self.friction.lcp.matrix(), &contact.rows) {
            0.0 => 1.0,
            s => s,
        }
    }

    /// The residual of each row, from the terms of all rows at x; both tangents of a contact have
    /// the residual of their plane.
    pub fn row_residuals(&self, terms: &[RowTerms], x: &[f64]) -> Vec<RowResidual> {
        let mut row_residuals: Vec<RowResidual> =
            (0..x.len()).map(|i| terms[i].row_residual(&self.friction.lcp, i, x)).collect();
        for contact in &self.friction.contacts {
            let rows = contact.rows.map(|i| terms[i]);
            let size = rows[0].size(&self.friction.lcp, contact.rows[0], x);
            let [normal, tangential] = match self.law {
                Law::Associated => self.associated(contact, rows, contact.of(x), size),
                Law::Coulomb => self.coulomb(contact, rows, contact.of(x), size),
            };
            let [n, t1, t2] = contact.rows;
            (row_residuals[n], row_residuals[t1], row_residuals[t2]) =
                (normal, tangential, tangential);
        }
        row_residuals
    }

    /// The scaled residual r_i of each row from the terms of all rows at x. NaN counts as ∞.
    pub fn residuals(&self, terms: &[RowTerms], x: &[f64]) -> Vec<f64> {
        self.row_residuals(terms, x).iter().map(|row_residual| row_residual.residual).collect()
    }

    /// The residuals of all rows, their terms summed by S.
    fn all_row_residuals<S: merit::Sum>(&self, x: &[f64]) -> Vec<RowResidual> {
        let lcp = &self.friction.lcp;
        let terms: Vec<_> = (0..x.len()).map(|i| RowTerms::summed::<S>(lcp, i, x)).collect();
        self.row_residuals(&terms, x)
    }
}

impl Complementarity for ConeProblem {
    fn lcp(&self) -> &Lcp {
        &self.friction.lcp
    }

    fn project_all(&self, x: &mut [f64]) {
        for &i in &self.friction.others {
            x[i] = self.friction.lcp.project(i, x[i], &[]);
        }
        for contact in &self.friction.contacts {
            contact.put(project(contact.mu, contact.of(x)), x);
        }
    }

    fn scaled_residual(&self, x: &[f64]) -> f64 {
        self.all_row_residuals::<f64>(x)
            .iter()
            .map(|row_residual| row_residual.residual)
            .fold(0.0, f64::max)
    }

    fn is_within(&self, x: &[f64], tolerance: f64, _first: &mut usize) -> bool {
        let exactly = || self.all_row_residuals::<accurate::Sum>(x);
        self.scaled_residual(x) <= tolerance
            && exactly().iter().all(|row_residual| row_residual.residual <= tolerance)
    }

    fn improves_on_zero(&self, x: &[f64], tolerance: f64) -> bool {
        let nothing = {
            let mut x = vec![0.0; x.len()];
            self.project_all(&mut x);
            x
        };
        let row_residuals = |x: &[f64]| self.all_row_residuals::<accurate::Sum>(x);
        merit::is_better(&row_residuals(x), row_residuals(&nothing).into_iter(), tolerance)
    }

    fn is_frozen(&self) -> bool {
        self.law == Law::Associated
    }

    fn frozen_at(&self, x: &[f64]) -> Self {
        let mut friction = self.friction.clone();
        let w = friction.lcp.w(x);
        for contact in &self.friction.contacts {
            friction.lcp.b[contact.rows[0]] += self.shift(contact, contact.of(&w));
        }
        ConeProblem { friction, law: Law::Associated }
    }

    fn recedes(&self, d: &[f64]) -> bool {
        let is_in_cone = |contact: &Contact| {
            let [n, t1, t2] = contact.of(d);
            crate::hypot(t1, t2) <= contact.mu * n
        };
        self.is_frozen()
            && self.friction.lcp.recedes(d)
            && self.friction.contacts.iter().all(is_in_cone)
    }
}

/// v_n may exceed −μ |v_t| by this fraction of μ |v_t| because of rounding.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Π_K(v): the nearest point of the cone |v_t| ≤ μ v_n, for v = (n, t1, t2).
///
/// v itself inside the cone, the tip in the opposite cone μ |v_t| ≤ −v_n, otherwise the nearest
/// point of the side that faces v. A v that is outside the opposite cone only by rounding counts as
/// inside it, so that a sliding contact without load has the impulse 0, not 10⁻¹⁷.
///
/// ```
/// use lcplab_lcp::friction::project;
///
/// assert_eq!(project(0.75, [4.0, 0.0, 3.0]), [4.0, 0.0, 3.0]);
/// assert_eq!(project(0.75, [-3.0, 0.0, 4.0]), [0.0; 3]);
/// assert_eq!(project(0.75, [0.0, 0.0, 6.25]), [3.0, 0.0, 2.25]);
/// ```
pub fn project(mu: f64, [n, t1, t2]: [f64; 3]) -> [f64; 3] {
    let t = crate::hypot(t1, t2);
    if n + mu * t <= ROUNDING * mu * t {
        return [0.0; 3];
    }
    if t <= mu * n {
        return [n, t1, t2];
    }
    let n = (n + mu * t) / (1.0 + mu * mu);
    [n, mu * n * (t1 / t), mu * n * (t2 / t)]
}
