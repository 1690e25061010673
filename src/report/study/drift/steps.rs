//! Energy and constraint errors over time, for decreasing step lengths.

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use crate::report::study::STEPPER;
use crate::report::study::comparison::{Sample, thinned};
use crate::scene::{Scene, Scheme};
use crate::simulation::{self, Simulation};
use crate::solver::by_name;

/// A scene at both levels with several step lengths.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Levels {
    /// The scene.
    pub scene: String,
    /// Its title.
    pub title: String,
    /// Simulated time (s).
    pub duration: f64,
    /// The reference for energy drift: the largest kinetic energy of the finest run (J).
    pub scale: f64,
    /// One curve per level and step length, levels first.
    pub curves: Vec<Curve>,
}

/// One level with one step length.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// The level.
    pub scheme: String,
    /// The divisor of the scene's dt.
    pub division: usize,
    /// The step (s).
    pub dt: f64,
    /// The motion from the start to the last step, [`thinned`].
    pub samples: Vec<Sample>,
    /// Why it ended early, if it did.
    pub failure: Option<String>,
}

/// Runs the scene for this duration with dt, dt/2 and dt/4 at both levels.
pub fn run(scene: &Scene, duration: f64) -> Levels {
    let mut scale = 0.0;
    let mut curves = Vec::new();
    for level in Scheme::LEVELS {
        for division in [1, 2, 4] {
            let mut scene = scene.at_level(level);
            scene.step.dt /= division as f64;
            let (curve, kinetic) = curve(&scene, division, duration);
            scale = f64::max(scale, kinetic);
            curves.push(curve);
        }
    }
    let (name, title) = (scene.name.clone(), scene.title.clone());
    Levels { scene: name, title, duration, scale, curves }
}

fn curve(scene: &Scene, division: usize, duration: f64) -> (Curve, f64) {
    let steps = (duration / scene.step.dt).round() as usize;
    let mut curve = Curve {
        scheme: scene.step.scheme.name().to_string(),
        division,
        dt: scene.step.dt,
        samples: Vec::new(),
        failure: None,
    };
    let solver = match by_name(STEPPER, &simulation::options(scene)) {
        Ok(solver) => solver,
        Err(error) => {
            curve.failure = Some(error.to_string());
            return (curve, 0.0);
        }
    };
    let recording =
        Simulation::new(scene.clone(), solver).run(steps, |_| ControlFlow::Continue(()));
    curve.samples = thinned(&recording.motion.iter().map(Sample::from).collect::<Vec<_>>());
    curve.failure = recording.failure.map(|failure| failure.to_string());
    (curve, recording.motion.iter().map(|motion| motion.kinetic).fold(0.0, f64::max))
}

impl Curve {
    /// The largest |E − E_0| (J).
    pub fn energy_error(&self) -> f64 {
        let first = self.samples.first().map_or(0.0, |sample| sample.energy);
        self.samples.iter().map(|sample| (sample.energy - first).abs()).fold(0.0, f64::max)
    }

    /// The largest constraint error (m).
    pub fn drift(&self) -> f64 {
        self.samples.iter().map(|sample| sample.drift).fold(0.0, f64::max)
    }
}
