//! What `benches/peers` writes: plain numbers, with the machine and the day they belong to.

use serde::{Deserialize, Serialize};

use crate::timing::Time;

/// One run of `benches/peers`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Recording {
    /// The day of the run, year-month-day.
    pub date: String,
    /// What it ran on.
    pub machine: Machine,
    /// The libraries, installed or not.
    pub libraries: Vec<Library>,
    /// Problems in numbers.
    pub problems: Vec<Problem>,
    /// Whole scenes.
    pub scenes: Vec<Scene>,
}

/// A machine.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Machine {
    /// The processor's own name.
    pub processor: String,
    /// How many threads it can run; every time is of one.
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

/// A problem and what everybody made of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Problem {
    /// Its name.
    pub name: String,
    /// The number of rows.
    pub rows: usize,
    /// By contender.
    pub answers: Vec<Answer>,
}

/// An answer that was looked at before it was timed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// Whose.
    pub contender: String,
    /// Whether it is one of lcplab's own methods.
    pub ours: bool,
    /// The scaled residual of x; none if it is not finite.
    pub residual: Option<f64>,
    /// What the contender itself complained of.
    pub complaint: Option<String>,
    /// What it took; none if x is not an answer.
    pub time: Option<Time>,
}

/// A scene that several engines stepped.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// Its name.
    pub name: String,
    /// The number of moving bodies.
    pub bodies: usize,
    /// The length of a step (s).
    pub dt: f64,
    /// How long the bodies were left alone (s) before they were looked at.
    pub after: f64,
    /// What they had to keep to then.
    pub bounds: Bounds,
    /// By engine.
    pub engines: Vec<Engine>,
}

/// How far bodies that should rest may be from where they belong.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Bounds {
    /// The deepest overlap (m).
    pub penetration: f64,
    /// The farthest way of a body's center from its place at the start (m).
    pub drift: f64,
}

impl Bounds {
    /// Whether both are at most those.
    pub fn is_within(&self, bounds: &Bounds) -> bool {
        self.penetration <= bounds.penetration && self.drift <= bounds.drift
    }
}

/// An engine's go at a scene, with as few iterations as keep to the bounds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Engine {
    /// The engine and what it calls the step.
    pub engine: String,
    /// Whether it is lcplab.
    pub ours: bool,
    /// The number of iterations of a step: the least that was enough, or the most that was tried.
    pub iterations: usize,
    /// What was measured with them; none if it is not finite.
    pub reached: Option<Bounds>,
    /// One step (s); none if it did not keep to the bounds.
    pub step: Option<Time>,
}
