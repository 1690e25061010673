//! The diagonal of A as a metric.
//!
//! Rows have different units (N s, N m s), so Σ x_i² is not meaningful. Σ a_ii x_i² is an energy,
//! and w_i / a_ii is the gradient of ½ xᵀAx + bᵀx in that metric. A gradient method in this metric
//! is the same as one for D^-½ A D^-½ (unit diagonal) in the variables D^½ x, but needs no square
//! roots; the choice of units does not change it.

use super::Status;
use crate::tolerances::FLAT_CURVATURE;
use lcplab_lcp::friction::ConeProblem;
use lcplab_lcp::{Complementarity, Lcp};

/// D = diag(A), and λ.
#[derive(Debug, Clone)]
pub(super) struct Metric {
    /// d_i; 1 for pinned rows without a diagonal entry in A.
    pub(super) diagonal: Vec<f64>,
    /// λ: an upper bound on the largest eigenvalue of D⁻¹A for symmetric A, the largest absolute
    /// row sum of D^-½ A D^-½. For semidefinite A it is at most the number of entries in a row.
    pub(super) eigenvalue: f64,
}

/// The curvature of the objective along a direction d: the sign of dᵀA d.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Curvature {
    /// dᵀA d.
    Positive(f64),
    /// For semidefinite A this means A d = 0: moving along d changes no w.
    Flat,
    /// A is not semidefinite.
    Negative,
}

impl Metric {
    /// The metric, if the diagonal is positive wherever x can move.
    pub(super) fn of(lcp: &Lcp) -> Result<Metric, Status> {
        Ok(Metric::with_diagonal(lcp, diagonal(lcp)?))
    }

    fn with_diagonal(lcp: &Lcp, diagonal: Vec<f64>) -> Metric {
        let root: Vec<f64> = diagonal.iter().map(|d| d.sqrt()).collect();
        let scaled = |i: usize, (j, a): (usize, f64)| a.abs() / root[i] / root[j];
        let row_sum = |i: usize| lcp.matrix().row(i).iter().map(|a| scaled(i, a)).sum();
        let eigenvalue = (0..lcp.len()).map(row_sum).fold(1.0, f64::max);
        Metric { diagonal, eigenvalue }
    }

    /// The same for methods that minimize the objective: A must also be symmetric.
    pub(super) fn of_symmetric(lcp: &Lcp) -> Result<Metric, Status> {
        Ok(Metric::with_diagonal(lcp, diagonal_of_symmetric(lcp)?))
    }

    /// The same for cones. A contact has one d for its three rows, so the projection onto the cone
    /// is the same in this metric as in the Euclidean one.
    pub(super) fn of_cones(problem: &ConeProblem) -> Result<Metric, Status> {
        let lcp = problem.lcp();
        let mut metric = Metric::of_symmetric(lcp)?;
        for contact in problem.friction().contacts() {
            contact.put([problem.scale(contact); 3], &mut metric.diagonal);
        }
        Ok(Metric::with_diagonal(lcp, metric.diagonal))
    }

    /// Σ d_i u_i v_i.
    pub(super) fn inner(&self, u: &[f64], v: &[f64]) -> f64 {
        self.diagonal.iter().zip(u).zip(v).map(|((d, u), v)| d * u * v).sum()
    }

    /// w_i / d_i at x: the gradient of the objective in this metric.
    pub(super) fn gradient(&self, lcp: &Lcp, x: &[f64]) -> Vec<f64> {
        (0..x.len()).map(|i| lcp.row_w(i, x) / self.diagonal[i]).collect()
    }

    /// The curvature along d; the threshold for zero is relative to λ dᵀD d.
    pub(super) fn curvature(&self, lcp: &Lcp, d: &[f64]) -> Curvature {
        let scale = self.eigenvalue * self.inner(d, d);
        match energy_product(lcp, d, d) {
            c if c < -FLAT_CURVATURE.sqrt() * scale => Curvature::Negative,
            c if c <= FLAT_CURVATURE * scale => Curvature::Flat,
            c => Curvature::Positive(c),
        }
    }
}

/// D, if it is positive wherever x can move.
pub(super) fn diagonal(lcp: &Lcp) -> Result<Vec<f64>, Status> {
    let entry = |row: usize| match lcp.matrix().diagonal(row) {
        d if d > 0.0 => Ok(d),
        _ if lcp.lo()[row] == lcp.hi()[row] => Ok(1.0),
        _ => Err(Status::ZeroDiagonal { row }),
    };
    (0..lcp.len()).map(entry).collect()
}

/// The same, if A is also symmetric.
pub(super) fn diagonal_of_symmetric(lcp: &Lcp) -> Result<Vec<f64>, Status> {
    if lcp.matrix().is_nearly_symmetric() {
        diagonal(lcp)
    } else {
        Err(Status::OutsideClass { reason: "A is not symmetric" })
    }
}

/// uᵀ A v.
pub(super) fn energy_product(lcp: &Lcp, u: &[f64], v: &[f64]) -> f64 {
    (0..u.len()).filter(|&i| u[i] != 0.0).map(|i| u[i] * lcp.matrix().row_dot(i, v)).sum()
}
