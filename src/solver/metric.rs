//! The diagonal of A as a measure of length.
//!
//! Rows have units of their own (N s, N m s), so Σ x_i² adds what cannot be added. Σ a_ii x_i² is an
//! energy, and ∇ = w_i / a_ii is the gradient of ½ xᵀAx + bᵀx in that measure. Gradient methods
//! that use it are those for D^-½ A D^-½ (unit diagonal) in the variables D^½ x, without any root
//! taken: no choice of units changes them.

use super::Status;
use crate::lcp::Lcp;

/// D: the diagonal of A, with 1 for pinned rows where A has none.
#[derive(Debug, Clone)]
pub(super) struct Metric(Vec<f64>);

impl Metric {
    /// The diagonal, if it is positive wherever x can move.
    pub(super) fn of(lcp: &Lcp) -> Result<Metric, Status> {
        let entry = |row: usize| match lcp.matrix().diagonal(row) {
            d if d > 0.0 => Ok(d),
            _ if lcp.lo()[row] == lcp.hi()[row] => Ok(1.0),
            _ => Err(Status::ZeroDiagonal { row }),
        };
        (0..lcp.len()).map(entry).collect::<Result<_, _>>().map(Metric)
    }

    /// The same for methods that descend the objective: A must be symmetric too.
    pub(super) fn of_symmetric(lcp: &Lcp) -> Result<Metric, Status> {
        if !lcp.matrix().is_symmetric() {
            return Err(Status::OutsideClass { reason: "A is not symmetric" });
        }
        Metric::of(lcp)
    }

    /// d_i.
    pub(super) fn diagonal(&self, i: usize) -> f64 {
        self.0[i]
    }

    /// Σ d_i u_i v_i.
    pub(super) fn inner(&self, u: &[f64], v: &[f64]) -> f64 {
        self.0.iter().zip(u).zip(v).map(|((d, u), v)| d * u * v).sum()
    }

    /// w_i / d_i at x: the gradient of the objective in this measure.
    pub(super) fn gradient(&self, lcp: &Lcp, x: &[f64]) -> Vec<f64> {
        (0..x.len()).map(|i| lcp.row_w(i, x) / self.0[i]).collect()
    }

    /// A bound on the largest eigenvalue of D⁻¹A for symmetric A: the largest absolute row sum of
    /// D^-½ A D^-½. It is at most the number of entries in a row where A is semidefinite.
    pub(super) fn largest_eigenvalue(&self, lcp: &Lcp) -> f64 {
        let root: Vec<f64> = self.0.iter().map(|d| d.sqrt()).collect();
        let entry = |i: usize, (j, a): (usize, f64)| a.abs() / root[i] / root[j];
        let row_sum = |i: usize| lcp.matrix().row(i).iter().map(|a| entry(i, a)).sum();
        (0..lcp.len()).map(row_sum).fold(1.0, f64::max)
    }
}

/// uᵀ A v.
pub(super) fn energy_product(lcp: &Lcp, u: &[f64], v: &[f64]) -> f64 {
    (0..u.len()).filter(|&i| u[i] != 0.0).map(|i| u[i] * lcp.matrix().row_dot(i, v)).sum()
}
