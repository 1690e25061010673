//! The error after each sweep, measured and predicted by theory.

use lcplab_solver::{Order, Pgs};
use serde::{Deserialize, Serialize};

use super::examine::{GOOD, Practice};
use super::frame::Frame;
use super::linear::{Linear, Way};
use super::yard::{Yard, start};

/// A course has this many times the number of sweeps used in practice, and at least a minimum.
const LONGER: usize = 4;
const LEAST: usize = 40;
const MOST: usize = 400;

/// Other methods whose course is shown.
const METHODS: [&str; 2] = ["block-pgs", "anderson-pgs"];

/// The error at the start and after each sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Course {
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
pub fn courses(frame: &Frame, practice: &Practice) -> Vec<Course> {
    let lcp = &frame.lcp;
    let Some(yard) = Yard::of(frame) else { return Vec::new() };
    let sweeps = (LONGER * practice.options.settings.max_iterations).clamp(LEAST, MOST);
    let mut settings = practice.options.settings.clone();
    (settings.max_iterations, settings.tolerance) = (sweeps, 0.0);
    let linear = Linear::new(lcp, &yard);
    let zero = start(lcp);
    let relaxed = [(1.0, "pgs"), (1.6, "ω = 1.6")].map(|(omega, name)| {
        let solver = Pgs { omega, order: Order::Natural, settings: settings.clone() };
        let way = Way { omega, is_reversed: false };
        let theory = (0..=sweeps).map(|k| linear.missing(&zero, way, k)).collect();
        Course { name: name.into(), missing: yard.course(&solver, &zero, 0.0), theory }
    });
    let other = |name: &str| {
        let mut own = practice.clone();
        own.options.settings = settings.clone();
        let missing = yard.course(&*own.other(name)?, &zero, GOOD * GOOD);
        Some(Course { name: name.into(), missing, theory: Vec::new() })
    };
    relaxed.into_iter().chain(METHODS.into_iter().filter_map(other)).collect()
}
