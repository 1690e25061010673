//! The errors of one method as a function of the step length, and their order.

use serde::{Deserialize, Serialize};

use super::Expected;

/// The errors of a quantity by one method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// The measured quantity.
    pub quantity: String,
    /// Its unit.
    pub unit: String,
    /// The scheme, or an integrator of the acceleration level that is not the default.
    pub method: String,
    /// The steps (s), the longest first, and the errors.
    pub errors: Vec<Sample>,
    /// The theoretical prediction.
    pub expected: Expected,
}

/// The error for one step length.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// The step (s).
    pub dt: f64,
    /// |measured − exact|; NaN if the simulation failed.
    #[serde(with = "lcplab_analysis::number::always")]
    pub error: f64,
}

/// Errors below this are rounding (m, J).
pub const ROUNDING: f64 = 1e-11;
/// The allowed difference between an observed order and the derived one.
pub const SLACK: f64 = 0.1;

impl Curve {
    /// log2 of the ratio of the last two errors that are not rounding.
    pub fn observed(&self) -> Option<f64> {
        match self.significant()[..] {
            [.., (h, coarse), (half, fine)] => Some((coarse / fine).log2() / (h / half).log2()),
            _ => None,
        }
    }

    /// The slope of log error over log dt by least squares, with its standard error.
    pub fn fitted(&self) -> Option<(f64, f64)> {
        let points: Vec<_> =
            self.significant().iter().map(|(dt, error)| (dt.log2(), error.log2())).collect();
        let n = points.len() as f64;
        if points.len() < 3 {
            return None;
        }
        let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
        let (x, y) = (mean(|p| p.0), mean(|p| p.1));
        let spread: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
        let slope = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>() / spread;
        let left: f64 = points.iter().map(|p| (p.1 - y - slope * (p.0 - x)).powi(2)).sum();
        Some((slope, (left / (n - 2.0) / spread).sqrt()))
    }

    /// Whether theory holds; `None` if it makes no claim.
    pub fn holds(&self) -> Option<bool> {
        match self.expected {
            Expected::Order { order, .. } => {
                Some(self.observed().is_some_and(|seen| (seen - order).abs() <= SLACK))
            }
            Expected::Exact { .. } => {
                Some(self.errors.iter().all(|sample| sample.error <= ROUNDING))
            }
            Expected::Open { .. } => None,
        }
    }

    fn significant(&self) -> Vec<(f64, f64)> {
        let seen = self.errors.iter().filter(|s| s.error > ROUNDING && s.error.is_finite());
        seen.map(|sample| (sample.dt, sample.error)).collect()
    }
}
