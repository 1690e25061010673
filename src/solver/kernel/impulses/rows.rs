//! One row after the other, in the order they come.

use super::{System, Velocities, WIDTH};

/// Projected Gauss-Seidel row by row.
#[derive(Debug, Clone)]
pub struct RowByRow<'a> {
    system: &'a System<'a>,
    x: Vec<f64>,
    v: Velocities,
}

impl<'a> RowByRow<'a> {
    /// The sweeps, from x = 0.
    pub fn new(system: &'a System<'a>) -> Self {
        RowByRow { system, x: vec![0.0; system.rows.len()], v: vec![[0.0; 8]; system.bodies] }
    }

    /// One sweep over all rows.
    pub fn sweep(&mut self) {
        let System { rows, lcp, inverse, .. } = self.system;
        for (i, row) in rows.iter().enumerate() {
            let [p, q] = row.bodies;
            let [j_p, j_q] = &row.jacobian;
            let mut w = lcp.b()[i];
            for k in 0..WIDTH {
                w += j_p[k] * self.v[p][k] + j_q[k] * self.v[q][k]; // w_i = Ĵ_i v + b_i
            }
            let x = lcp.project(i, self.x[i] - w * inverse[i], &self.x);
            let change = x - self.x[i];
            self.x[i] = x;
            for k in 0..WIDTH {
                self.v[p][k] += j_p[k] * change; // v ← v + Ĵ_iᵀ δ_i
                self.v[q][k] += j_q[k] * change;
            }
        }
    }

    /// x, one entry a row.
    pub fn x(&self) -> &[f64] {
        &self.x
    }
}
