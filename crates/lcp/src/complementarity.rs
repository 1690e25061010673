//! The common interface of boxed LCPs and cone problems.

use super::{Lcp, merit};

/// Find x in K such that w = A x + b satisfies w·(y − x) ≥ 0 for all y in K.
///
/// K is a box for an [`Lcp`], and a product of cones and intervals for a
/// [`ConeProblem`](super::friction::ConeProblem). K may depend on x (coupled rows), or w may have a
/// shift that depends on x (Coulomb's law); in the problem *frozen* at an x, both are constant.
///
/// ```
/// use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law};
/// use lcplab_lcp::{Complementarity, Lcp, Matrix};
///
/// /// Projected steps x ← Π(x − w), for a problem of any kind with a unit diagonal of A.
/// fn iterate(problem: &impl Complementarity, x: &mut Vec<f64>) {
///     let w = problem.lcp().w(x);
///     x.iter_mut().zip(&w).for_each(|(x, w)| *x -= w);
///     problem.project_all(x);
/// }
///
/// // A point of 1 kg reaches the ground with 2 m/s and slides with 3 m/s; μ = 0.5.
/// let a = Matrix::from([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
/// let (lo, hi) = (vec![0.0, -f64::INFINITY, -f64::INFINITY], vec![f64::INFINITY; 3]);
/// let lcp = Lcp::new(a, vec![-2.0, -3.0, 0.0], lo, hi)?;
/// let friction = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
///
/// let boxed = friction.coupled_box();
/// let mut x = vec![0.0; 3];
/// iterate(&boxed, &mut x);
/// assert_eq!(x, [2.0, 1.0, 0.0]);
/// assert_eq!(boxed.scaled_residual(&x), 0.0);
/// assert!(boxed.is_within(&x, 1e-8, &mut 0) && boxed.improves_on_zero(&x, 1e-8));
///
/// // The box ±μ x_n depends on x. With the box of this x the problem has the same solution.
/// assert!(!boxed.is_frozen() && boxed.frozen_at(&x).is_frozen());
/// assert_eq!(boxed.frozen_at(&x).scaled_residual(&x), 0.0);
///
/// // x may grow without end along d = (1, 0.5, 0), but not along (1, 0.6, 0), outside the cone.
/// let cone = ConeProblem::new(friction, Law::Associated);
/// assert!(cone.recedes(&[1.0, 0.5, 0.0]) && !cone.recedes(&[1.0, 0.6, 0.0]));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub trait Complementarity: Sized {
    /// A and b.
    fn lcp(&self) -> &Lcp;

    /// x ← Π_K(x).
    fn project_all(&self, x: &mut [f64]);

    /// The largest dimensionless residual, 0 exactly at the solutions.
    fn scaled_residual(&self, x: &[f64]) -> f64;

    /// Whether the residual is at most the tolerance, also in compensated sums; `first` is the row
    /// to check first, updated for the next call.
    fn is_within(&self, x: &[f64], tolerance: f64, first: &mut usize) -> bool;

    /// Whether neither K nor w's shift depends on x.
    fn is_frozen(&self) -> bool;

    /// The problem with everything that depends on x fixed at its value at this x. x solves this
    /// problem if and only if it solves the frozen one.
    fn frozen_at(&self, x: &[f64]) -> Self;

    /// Whether x + t d stays in K for all t ≥ 0, from every x in K; false if w has a shift.
    fn recedes(&self, d: &[f64]) -> bool;

    /// Whether x is closer to a solution than x = Π(0). If not, x has diverged, and its residual is
    /// small only relative to its terms.
    fn improves_on_zero(&self, _x: &[f64], _tolerance: f64) -> bool {
        true
    }
}

impl Complementarity for Lcp {
    fn lcp(&self) -> &Lcp {
        self
    }

    fn project_all(&self, x: &mut [f64]) {
        self.project_all(x);
    }

    fn scaled_residual(&self, x: &[f64]) -> f64 {
        merit::scaled_residual(self, x)
    }

    fn is_within(&self, x: &[f64], tolerance: f64, first: &mut usize) -> bool {
        merit::is_within(self, x, tolerance, first)
    }

    fn is_frozen(&self) -> bool {
        self.coupling().is_none()
    }

    fn frozen_at(&self, x: &[f64]) -> Self {
        self.frozen_at(x)
    }

    fn recedes(&self, d: &[f64]) -> bool {
        let is_open = |i: usize| match d[i] {
            d_i if self.is_coupled(i) => {
                let (lo, hi) = self.bounds(i, d);
                lo <= d_i && d_i <= hi
            }
            d if d > 0.0 => self.hi()[i].is_infinite(),
            d if d < 0.0 => self.lo()[i].is_infinite(),
            _ => true,
        };
        (0..d.len()).all(is_open)
    }

    fn improves_on_zero(&self, x: &[f64], tolerance: f64) -> bool {
        merit::improves_on_zero(self, x, tolerance)
    }
}
