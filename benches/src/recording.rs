//! The record that `benches/peers` writes: numbers, with the machine and the day of the run.

use serde::{Deserialize, Serialize};

use crate::timing::Time;

/// One run of `benches/peers`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Recording {
    /// The day of the run, year-month-day.
    pub date: String,
    /// The machine.
    pub machine: Machine,
    /// The libraries, installed or not.
    pub libraries: Vec<Library>,
    /// Numerical problems.
    pub problems: Vec<Problem>,
    /// Whole scenes.
    pub scenes: Vec<Scene>,
}

/// A machine.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Machine {
    /// The processor's own name.
    pub processor: String,
    /// The number of threads it can run; all times are those of one thread.
    pub threads: usize,
    /// The operating system.
    pub system: String,
    /// The compiler of lcplab and of the libraries in Rust.
    pub compiler: String,
}

/// A library.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Library {
    /// Its name.
    pub name: String,
    /// Its version; none if it was not installed.
    pub version: Option<String>,
    /// How to install it.
    pub package: String,
}

/// A problem with all answers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Problem {
    /// Its name.
    pub name: String,
    /// The number of rows.
    pub rows: usize,
    /// By contender.
    pub answers: Vec<Answer>,
}

/// An answer that was checked before it was timed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// The contender.
    pub contender: String,
    /// Whether it is one of lcplab's own methods.
    pub ours: bool,
    /// The scaled residual of x; none if it is not finite.
    pub residual: Option<f64>,
    /// The error that the contender itself reported.
    pub complaint: Option<String>,
    /// The times; none if x is not an answer.
    pub time: Option<Time>,
}

/// A scene stepped by several engines.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// Its name.
    pub name: String,
    /// The number of moving bodies.
    pub bodies: usize,
    /// The length of a step (s).
    pub dt: f64,
    /// The simulated time (s) before the bodies were checked.
    pub after: f64,
    /// The bounds that they had to satisfy then.
    pub bounds: Bounds,
    /// By engine.
    pub engines: Vec<Engine>,
}

/// The largest allowed deviations of bodies that should rest.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Bounds {
    /// The deepest overlap (m).
    pub penetration: f64,
    /// The largest displacement of a body's center from the start (m).
    pub drift: f64,
}

impl Bounds {
    /// Whether both are within these limits.
    pub fn is_within(&self, bounds: &Bounds) -> bool {
        self.penetration <= bounds.penetration && self.drift <= bounds.drift
    }
}

/// An engine's run of a scene, with the smallest number of iterations that satisfies the bounds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Engine {
    /// The engine and its name of the step.
    pub engine: String,
    /// Whether it is lcplab.
    pub ours: bool,
    /// Iterations per step: the smallest sufficient number, or the largest number tried.
    pub iterations: usize,
    /// The measured deviations; none if they are not finite.
    pub reached: Option<Bounds>,
    /// The time of one step (s); none if the bounds were not satisfied.
    pub step: Option<Time>,
}
