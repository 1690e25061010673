//! E64: constraints drift, sections on drift and on Figure 4.

use nalgebra::Vector2;

use super::common::largest;
use super::setting::{DT, G, over_time};
use super::{Finding, Measure};
use crate::error::Result;
use crate::plot::{Axis, Lines, Series};
use crate::scene::{Feedback, Scene, Scheme, Step};
use crate::simulation::Simulation;
use crate::solver::Dantzig;

const STEPS: usize = 600;

/// The four methods: their name and step settings.
fn methods() -> [(&'static str, Step); 4] {
    let with = |scheme, baumgarte, feedback| {
        let plain = Step { dt: DT, count: STEPS, ..Step::default() };
        Step { scheme, baumgarte, feedback, ..plain }
    };
    [
        ("velocity, no feedback", with(Scheme::Velocity, 0.0, Feedback::Corrected)),
        ("velocity, β c", with(Scheme::Velocity, 0.1, Feedback::Unscaled)),
        ("velocity, β c/dt", with(Scheme::Velocity, 0.1, Feedback::Corrected)),
        ("acceleration", with(Scheme::Acceleration, 0.0, Feedback::Corrected)),
    ]
}

/// |length − 1 m| after each step, by the library's simulation.
fn simulated(step: Step) -> Result<Vec<f64>> {
    let scene = Scene { step, ..Scene::load("pendulum")? };
    let mut simulation = Simulation::new(scene, Box::new(Dantzig::default()));
    let recording = simulation.run(STEPS, |_| std::ops::ControlFlow::Continue(()));
    Ok(recording.motion.iter().map(|motion| motion.drift).collect())
}

/// The largest length error again, from the formulas of one rod in a plane.
fn by_hand(step: &Step) -> f64 {
    let gravity = Vector2::new(0.0, -G);
    let (mut p, mut v, mut worst) = (Vector2::new(1.0, 0.0), Vector2::zeros(), 0.0_f64);
    for _ in 0..STEPS {
        let length: f64 = p.norm();
        let n = p / length;
        if step.scheme == Scheme::Acceleration {
            let turning = (v.norm_squared() - n.dot(&v).powi(2)) / length;
            v += DT * (gravity - n * (n.dot(&gravity) + turning));
        } else {
            let rate = if step.feedback == Feedback::Unscaled { 1.0 } else { 1.0 / DT };
            v += DT * gravity;
            v -= n * (n.dot(&v) + step.baumgarte * rate * (length - 1.0));
        }
        p += DT * v;
        worst = worst.max((p.norm() - 1.0).abs());
    }
    worst
}

pub(super) fn example() -> Result<Finding> {
    let mut finding = Finding::new(
        "A pendulum of 1 m and 1 kg is released level with its pivot; 10 s at 60 steps a second, β = 0.1. The \
         largest error of its length by this library's simulation, and again by the formulas of one rod in a \
         plane. Printed: none.",
    );
    let mut series = Vec::new();
    for (name, step) in methods() {
        let by_hand = by_hand(&step);
        let errors = simulated(step)?;
        let measure = Measure::new(name, "m", 0.0, largest(errors.iter().copied()));
        finding = finding.measure(measure.truth(&[by_hand], "by hand", 1e-6));
        series.push(Series::measured(name, over_time(&errors)));
    }
    Ok(finding.plot(&Lines::new(
        "e64",
        "Error of a pendulum's length",
        "Without feedback the rod grows by jerks, most where the bob is fastest. \
                 Feedback of β c without 1/dt changes little; β c/dt holds the error at \
                 two centimetres. At the acceleration level the error grows fastest.",
        Axis::linear("time", "s"),
        Axis::linear("length error", "m"),
        series,
    )))
}
