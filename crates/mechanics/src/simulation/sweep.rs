//! Row-by-row impulses on the bodies' velocities: Gauss-Seidel without a matrix.
//!
//! ```text
//! w_i = J_i u + bias_i + γ_i x_i,   a_i = J_i M⁻¹ J_iᵀ + γ_i
//! x_i⁺ = Π_i(x_i − w_i/a_i),   u ← u + M⁻¹ J_iᵀ (x_i⁺ − x_i),   i = 1 … n
//! ```
//!
//! With u = target + M⁻¹Jᵀx at the start this is projected Gauss-Seidel on A = J M⁻¹Jᵀ + diag(γ)
//! (K&M (2), (3)); u carries the sums Σ_j a_ij x_j. Catto, *Iterative Dynamics with Temporal
//! Coherence*, GDC 2005.

use nalgebra::Vector6;

use crate::assembly::{Assembly, Row};
use crate::constraint::Bounds;

/// What a row is to do: J u + bias + γ x → 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct RowTarget {
    /// Added to J u (m/s or rad/s).
    pub bias: f64,
    /// γ (m/s per N s, rad/s per N m s).
    pub compliance: f64,
}

/// The rows of an assembly with their responses.
pub(super) struct Sweeper<'a> {
    assembly: &'a Assembly,
    /// For how long the forces of motors act (s).
    h: f64,
    /// M⁻¹ J_iᵀ, a block a part of the row.
    responses: Vec<Vec<Vector6<f64>>>,
    /// J_i M⁻¹ J_iᵀ.
    diagonal: Vec<f64>,
}

impl<'a> Sweeper<'a> {
    pub fn new(assembly: &'a Assembly, h: f64) -> Self {
        let response = |row: &Row| -> Vec<Vector6<f64>> {
            let parts = row.parts();
            parts.map(|part| assembly.blocks[part.block].accelerate(&part.jacobian)).collect()
        };
        let responses: Vec<_> = assembly.rows.iter().map(response).collect();
        let diagonal = |(row, responses): (&Row, &Vec<Vector6<f64>>)| {
            row.parts().zip(responses).map(|(part, response)| part.jacobian.dot(response)).sum()
        };
        let diagonal = assembly.rows.iter().zip(&responses).map(diagonal).collect();
        Sweeper { assembly, h, responses, diagonal }
    }

    /// J_i M⁻¹ J_iᵀ (1/kg, 1/(kg m²)).
    pub fn diagonal(&self, i: usize) -> f64 {
        self.diagonal[i]
    }

    /// One pass over all rows; x has an entry a row, u one a column. Rows that move nothing are
    /// left alone.
    pub fn sweep(&self, aims: &[RowTarget], x: &mut [f64], u: &mut [f64]) {
        for i in 0..x.len() {
            let a = self.diagonal[i] + aims[i].compliance;
            if a > 0.0 {
                let w = self.velocity(i, u) + aims[i].bias + aims[i].compliance * x[i];
                let next = self.project(i, x[i] - w / a, x);
                self.push(i, next - x[i], u);
                x[i] = next;
            }
        }
    }

    /// J_i u.
    pub fn velocity(&self, i: usize, u: &[f64]) -> f64 {
        let blocks = &self.assembly.blocks;
        let parts = self.assembly.rows[i].parts();
        parts.map(|part| part.jacobian.dot(&blocks[part.block].gather(u))).sum()
    }

    /// u ← u + M⁻¹ J_iᵀ amount.
    pub fn push(&self, i: usize, amount: f64, u: &mut [f64]) {
        for (part, response) in self.assembly.rows[i].parts().zip(&self.responses[i]) {
            let block = &self.assembly.blocks[part.block];
            block.scatter(&(block.gather(u) + response * amount), u);
        }
    }

    /// Π_i at x.
    fn project(&self, i: usize, value: f64, x: &[f64]) -> f64 {
        let (lo, hi) = match self.assembly.rows[i].bounds {
            Bounds::Friction { normal, mu } => (-mu * x[normal].max(0.0), mu * x[normal].max(0.0)),
            Bounds::Effort(effort) => (-effort * self.h, effort * self.h),
            bounds => bounds.interval(),
        };
        value.max(lo).min(hi)
    }
}
