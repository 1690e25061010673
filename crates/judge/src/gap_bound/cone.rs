//! Friction cones that may have a different coefficient for each axis, and projections onto them.

use crate::interval::{Interval, norm_up};

/// The number of bisection steps for the multiplier: full floating-point accuracy.
const HALVINGS: usize = 64;

/// A contact's cone: all x with √(Σ (x_i/μ_i)²) ≤ x_n.
#[derive(Debug, Clone, PartialEq)]
pub struct EllipticCone {
    /// The row of the normal force n.
    pub normal: usize,
    /// The rows of friction i, each with its coefficient μ_i ≥ 0.
    pub friction: Vec<(usize, f64)>,
}

impl EllipticCone {
    /// Its rows, the normal row first.
    pub(super) fn rows(&self) -> impl Iterator<Item = usize> + '_ {
        [self.normal].into_iter().chain(self.friction.iter().map(|&(row, _)| row))
    }

    /// Moves the cone's entries of x to the nearest point of the cone in the norm Σ γ_i x_i², up to
    /// rounding, then verifiably into the cone. x and γ > 0 (`compliance`) have one entry per row.
    ///
    /// ```
    /// use lcplab_judge::gap_bound::EllipticCone;
    ///
    /// // μ = 1: the point (1, 3) is √2 away from the edge (2, 2).
    /// let cone = EllipticCone { normal: 0, friction: vec![(1, 1.0)] };
    /// let mut x = [1.0, 3.0];
    /// cone.project(&mut x, &[1.0, 1.0]);
    /// assert!((x[0] - 2.0).abs() < 1e-12 && (x[1] - 2.0).abs() < 1e-12);
    /// ```
    pub fn project(&self, x: &mut [f64], compliance: &[f64]) {
        for &(row, _) in self.friction.iter().filter(|(_, mu)| *mu == 0.0) {
            x[row] = 0.0;
        }
        let root = |row: usize| compliance[row].sqrt();
        let scale = root(self.normal);
        // In y = √γ x the cone is √(Σ (y_i/m_i)²) ≤ y_n and the norm is Euclidean.
        let axes: Vec<(f64, f64)> =
            self.friction.iter().map(|&(i, mu)| (root(i) * x[i], root(i) * mu / scale)).collect();
        let normal = scale * x[self.normal];
        let length = |part: &dyn Fn(f64, f64) -> f64| {
            axes.iter().map(|&(y, m)| part(y, m).powi(2)).sum::<f64>().sqrt()
        };
        let multiplier = if length(&|y, m| if m == 0.0 { 0.0 } else { y / m }) <= normal {
            return self.enclose(x);
        } else if length(&|y, m| m * y) <= -normal {
            f64::INFINITY
        } else {
            multiplier(normal, &|factor| length(&|y, m| y * m / (m * m + factor)))
        };
        for (&(row, _), &(y, m)) in self.friction.iter().zip(&axes) {
            x[row] = if m == 0.0 { 0.0 } else { y * (m * m / (m * m + multiplier)) / root(row) };
        }
        x[self.normal] = 0.0;
        self.enclose(x);
    }

    /// Raises the normal entry until x is verifiably in the cone.
    fn enclose(&self, x: &mut [f64]) {
        let bounded = self.friction.iter().filter(|(_, mu)| *mu > 0.0);
        let part = |&(i, mu): &(usize, f64)| {
            let ratio = (x[i] / mu).abs();
            Interval::around_zero(if ratio == 0.0 { 0.0 } else { ratio.next_up() })
        };
        x[self.normal] = x[self.normal].max(norm_up(bounded.map(part)));
    }

    /// Raises the normal entry until w is verifiably in the dual cone, √(Σ (μ_i w_i)²) ≤ w_n.
    pub(super) fn enclose_dual(&self, w: &mut [f64]) {
        let part = |&(i, mu): &(usize, f64)| Interval::from(mu) * w[i].into();
        w[self.normal] = w[self.normal].max(norm_up(self.friction.iter().map(part)));
    }
}

/// The Lagrange multiplier of the nearest point: the λ > 0 with (1 − λ) N(λ) = y_n, whose left side
/// is decreasing.
fn multiplier(normal: f64, length: &dyn Fn(f64) -> f64) -> f64 {
    // The range of λ / (1 + λ).
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        let factor = middle / (1.0 - middle);
        if (1.0 - factor) * length(factor) > normal { low = middle } else { high = middle }
    }
    high / (1.0 - high)
}
