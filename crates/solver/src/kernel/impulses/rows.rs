//! Sequential impulses row by row, in the given order.

use super::{Row, System, Velocity, WIDTH};

/// Projected Gauss-Seidel row by row.
#[derive(Debug, Clone, Default)]
pub struct RowByRow {
    x: Vec<f64>,
    v: Vec<Velocity>,
}

impl RowByRow {
    /// Starts at x = 0 and v = 0.
    pub fn new(system: &System) -> Self {
        RowByRow { x: vec![0.0; system.rows.len()], v: vec![[0.0; WIDTH]; system.bodies] }
    }

    /// Starts from this x, and from the velocities v plus those that x adds.
    pub fn start(&mut self, system: &System, x: &[f64], v: &[Velocity]) {
        self.x.clear();
        self.x.extend_from_slice(x);
        self.v.clear();
        self.v.extend_from_slice(v);
        system.push_velocities(x, &mut self.v);
    }

    /// One sweep over all rows of the system given at the start.
    pub fn sweep(&mut self, system: &System) {
        for (i, row) in system.rows.iter().enumerate() {
            let Row { bodies: [p, q], jacobian: [j_p, j_q] } = *row;
            let mut w = system.aims[i].b;
            for k in 0..WIDTH {
                // w_i = Ĵ_i v + b_i
                w += j_p[k] * self.v[p][k] + j_q[k] * self.v[q][k];
            }
            let x = system.project(i, self.x[i] - w * system.inverse[i], &self.x);
            let change = x - self.x[i];
            self.x[i] = x;
            for k in 0..WIDTH {
                // v ← v + Ĵ_iᵀ δ_i
                self.v[p][k] += j_p[k] * change;
                self.v[q][k] += j_q[k] * change;
            }
        }
    }

    /// x, one entry per row.
    pub fn x(&self) -> &[f64] {
        &self.x
    }

    /// v, one entry per body.
    pub fn v(&self) -> &[Velocity] {
        &self.v
    }
}
