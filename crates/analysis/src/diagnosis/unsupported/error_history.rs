//! The error after each sweep, measured and predicted by theory.

use lcplab_solver::{AndersonPgs, BlockPgs, Order, Pgs};
use serde::{Deserialize, Serialize};

use super::examine::UserSolver;
use super::frame::Frame;
use super::linear::{Linear, SweepParameters};
use super::reference::{ReferenceSolution, start};
use super::thresholds::GOOD;

/// A course has this many times the number of sweeps used in practice, and at least a minimum.
const LONGER: usize = 4;
const LEAST: usize = 40;
const MOST: usize = 400;

/// Other methods whose course is shown.
const METHODS: [&str; 2] = [BlockPgs::NAME, AndersonPgs::NAME];

/// The error at the start and after each sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ErrorHistory {
    /// The name of the method.
    pub name: String,
    /// The measured error.
    pub missing: Vec<f64>,
    /// The error predicted by theory, as far as there is a prediction; empty for methods without
    /// one.
    pub theory: Vec<Option<f64>>,
}

/// The courses of Gauss-Seidel with and without relaxation, and of other row-by-row methods, from
/// Π(0). Empty if no solution is known.
pub fn error_histories(frame: &Frame, user_solver: &UserSolver) -> Vec<ErrorHistory> {
    let lcp = &frame.lcp;
    let Some(reference) = ReferenceSolution::of(frame) else { return Vec::new() };
    let sweeps = (LONGER * user_solver.options.settings.max_iterations).clamp(LEAST, MOST);
    let mut settings = user_solver.options.settings.clone();
    (settings.max_iterations, settings.tolerance) = (sweeps, 0.0);
    let linear = Linear::new(lcp, &reference);
    let zero = start(lcp);
    let relaxed = [(1.0, Pgs::NAME), (1.6, "ω = 1.6")].map(|(omega, name)| {
        let solver = Pgs { omega, order: Order::Natural, settings: settings.clone() };
        let way = SweepParameters { omega, is_reversed: false };
        let theory = (0..=sweeps).map(|k| linear.missing(&zero, way, k)).collect();
        ErrorHistory {
            name: name.into(),
            missing: reference.error_history(&solver, &zero, 0.0),
            theory,
        }
    });
    let other = |name: &str| {
        let mut own = user_solver.clone();
        own.options.settings = settings.clone();
        let missing = reference.error_history(&*own.other(name)?, &zero, GOOD * GOOD);
        Some(ErrorHistory { name: name.into(), missing, theory: Vec::new() })
    };
    relaxed.into_iter().chain(METHODS.into_iter().filter_map(other)).collect()
}
