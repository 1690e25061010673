//! A column of bodies on the ground, with one contact below each body and vertical motion only.
//!
//! ```text
//! w_i = u_i − u_{i−1} + gap_i / dt,   a_ii = 1/m_i + 1/m_{i−1},   a_{i,i−1} = −1/m_{i−1},   m_{−1} = ∞
//! ```

use lcplab_lcp::file::Problem;
use lcplab_lcp::{Lcp, Matrix};
use lcplab_solver::{Settings, Start};
use serde::Deserialize;
use serde_json::{Value, json};

use super::Answer;
use super::trace::{numbers, solver};

/// Standard gravity (m/s²).
const G: f64 = 9.81;

/// Bodies at rest on each other.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Column {
    /// kg, from the ground up.
    masses: Vec<f64>,
    /// The time step (s).
    dt: f64,
}

impl Column {
    /// The problem of a step at rest, as a problem file.
    pub fn answer(&self) -> Answer {
        let (u, gaps) = (vec![0.0; self.masses.len()], vec![0.0; self.masses.len()]);
        let lcp = self.lcp(&u, &gaps)?;
        Ok(json!({ "problem": Problem::new("column", lcp).to_json() }))
    }

    /// The problem of a step from these velocities and gaps.
    fn lcp(&self, u: &[f64], gaps: &[f64]) -> Result<Lcp, String> {
        let (m, n) = (&self.masses, self.masses.len());
        let is_good = |value: &f64| value.is_finite() && *value > 0.0;
        if n == 0 || n > 60 || !m.iter().all(is_good) || !is_good(&self.dt) {
            return Err("masses and dt must be positive, and there may be at most 60 bodies".into());
        }
        let entry = |i: usize, j: usize| match (i, j) {
            (0, 0) => 1.0 / m[0],
            (i, j) if i == j => 1.0 / m[i] + 1.0 / m[i - 1],
            (i, j) if i.abs_diff(j) == 1 => -1.0 / m[i.min(j)],
            _ => 0.0,
        };
        let a: Vec<f64> = (0..n * n).map(|k| entry(k / n, k % n)).collect();
        let fall = |i: usize| u[i] - G * self.dt;
        let below = |i: usize| if i == 0 { 0.0 } else { fall(i - 1) };
        let b = (0..n).map(|i| fall(i) - below(i) + gaps[i].max(0.0) / self.dt).collect();
        Lcp::new(Matrix::dense(n, &a), b, vec![0.0; n], vec![f64::INFINITY; n])
            .map_err(|error| error.to_string())
    }
}

/// The motion of a column with a fixed number of sweeps per step.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    masses: Vec<f64>,
    dt: f64,
    steps: usize,
    solver: String,
    #[serde(default = "one")]
    omega: f64,
    /// Sweeps per step; without it each step is solved.
    sweeps: Option<usize>,
    #[serde(default)]
    backward: bool,
    /// Whether a step starts from the impulses of the previous one.
    warm: bool,
}

fn one() -> f64 {
    1.0
}

impl Motion {
    /// After each step: how far each body has sunk (m), the impulses (N s), and the unsupported
    /// fraction of the weight.
    pub fn answer(self) -> Answer {
        let column = Column { masses: self.masses, dt: self.dt };
        let (m, n, dt) = (&column.masses, column.masses.len(), column.dt);
        let tolerance = if self.sweeps.is_some() { 0.0 } else { Settings::default().tolerance };
        let max_iterations = self.sweeps.unwrap_or(10_000).min(10_000);
        let settings =
            Settings::default().with_tolerance(tolerance).with_max_iterations(max_iterations);
        let solver = solver(&self.solver, self.omega, self.backward, settings)?;
        let weight = m.iter().sum::<f64>() * G * dt;
        let (mut u, mut z, mut x) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        let mut frames: Vec<Value> = Vec::new();
        for _ in 0..self.steps.min(2_000) {
            let gaps: Vec<f64> =
                (0..n).map(|i| z[i] - if i == 0 { 0.0 } else { z[i - 1] }).collect();
            let lcp = column.lcp(&u, &gaps)?;
            let start = if self.warm { Start::at(&x) } else { Start::default() };
            x = solver.solve(&lcp, &start, &mut ()).x;
            for i in 0..n {
                let above = x.get(i + 1).copied().unwrap_or(0.0);
                u[i] += -G * dt + (x[i] - above) / m[i];
                z[i] += dt * u[i];
            }
            let missing = (weight - x[0]) / weight;
            frames.push(json!({ "z": numbers(&z), "x": numbers(&x), "missing": missing }));
        }
        Ok(json!({ "frames": frames }))
    }
}
