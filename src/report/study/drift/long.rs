//! Errors of energy and of constraints over many periods, by integrator and step length.

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toml::Table;

use super::order::methods;
use crate::error::Result;
use crate::report::study::variation::Variation;
use crate::scene::{Scene, Scheme};
use crate::simulation::Simulation;
use crate::solver::Registry;

/// A scene whose exact motion is periodic and conserves its energy.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Periodic {
    /// A shipped scene or a file.
    pub scene: String,
    /// Its name in the figure.
    pub title: String,
    /// Overridden fields of the scene.
    #[serde(default, skip_serializing_if = "Table::is_empty")]
    #[schemars(with = "serde_json::Map<String, serde_json::Value>")]
    pub change: Table,
    /// The period of the motion (s).
    pub period: f64,
    /// The number of periods.
    #[serde(default = "hundred")]
    pub periods: usize,
}

fn hundred() -> usize {
    100
}

/// A scene by every integrator with dt and dt/2.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LongRun {
    /// The scene.
    pub scene: Periodic,
    /// One curve per integrator and step length, integrators first.
    pub curves: Vec<Curve>,
}

/// One integrator with one step length.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// The scheme, and after a comma its integrator if it is not the default.
    pub method: String,
    /// The divisor of the scene's dt.
    pub division: usize,
    /// The step (s).
    pub dt: f64,
    /// The largest |E − E₀| in each period, relative to the largest kinetic energy in the first.
    pub energy: Vec<f64>,
    /// The largest constraint error in each period (m).
    pub drift: Vec<f64>,
    /// Why it ended early, if it did.
    pub failure: Option<String>,
}

impl Periodic {
    /// Runs the scene with its solver, one of these, with both levels and with the other
    /// integrators of the acceleration level.
    ///
    /// # Errors
    /// If the scene does not exist, or is invalid with the overridden fields.
    pub(crate) fn run(&self, solvers: &Registry) -> Result<LongRun> {
        let mut scene = Variation::of(&self.scene, &self.change).scene()?;
        scene.solvers = solvers.clone();
        let levels = methods().into_iter().filter(|(_, scheme, _)| Scheme::LEVELS.contains(scheme));
        let runs: Vec<_> = levels.flat_map(|method| [(method.clone(), 1), (method, 2)]).collect();
        let curves = runs.into_par_iter().map(|((name, scheme, integrator), division)| {
            let mut scene = scene.at_level(scheme);
            scene.step.integrator = integrator;
            scene.step.dt /= division as f64;
            self.curve(&scene, name, division)
        });
        Ok(LongRun { scene: self.clone(), curves: curves.collect::<Result<_>>()? })
    }

    fn curve(&self, scene: &Scene, method: String, division: usize) -> Result<Curve> {
        let dt = scene.step.dt;
        let (mut energy, mut drift) = (vec![0.0f64; self.periods], vec![0.0f64; self.periods]);
        let mut simulation = Simulation::of(scene)?;
        let (start, mut kinetic, mut failure) = (simulation.motion().energy(), 0.0f64, None);
        for step in 1..=(self.periods as f64 * self.period / dt).floor() as usize {
            let motion = match simulation.step() {
                Ok(step) => step.motion,
                Err(reason) => {
                    failure = Some(reason.to_string());
                    break;
                }
            };
            let period = ((step as f64 * dt / self.period) as usize).min(self.periods - 1);
            energy[period] = energy[period].max((motion.energy() - start).abs());
            drift[period] = drift[period].max(motion.drift);
            if period == 0 {
                kinetic = kinetic.max(motion.kinetic);
            }
        }
        energy.iter_mut().for_each(|error| *error /= kinetic);
        if failure.is_some() {
            let ended = (simulation.time() / self.period) as usize;
            energy.truncate(ended);
            drift.truncate(ended);
        }
        Ok(Curve { method, division, dt, energy, drift, failure })
    }
}
