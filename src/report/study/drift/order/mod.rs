//! Errors as a function of the step length, with the order that theory derives for each scheme.
//!
//! Every problem has a closed form; the measured quantity is the distance to it at a given time:
//!
//! ```text
//! fall    a stone's height after 1 s                              z0 + v0 t − g t²/2
//! swing   a pendulum after 1 s: position, energy, rod length      elliptic functions; constant
//! bounce  height between the first two bounces                    e² h
//! slide   a box's path down a slope in ½ s                        g (sin θ − μ cos θ) t²/2
//! ```
//!
//! The observed order is that of the two shortest steps whose error is not yet rounding; the fitted
//! order is the slope of the line through all of them, with its standard error.

mod curve;
mod expected;
mod problem;

pub use curve::{Curve, ROUNDING, SLACK, Sample};
pub use expected::Expected;
pub use problem::Problem;

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};
use crate::scene::{Integrator, Scene, Scheme};

/// Problems with closed forms, with every scheme and decreasing step lengths.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Orders {
    /// The problems.
    pub problems: Vec<Problem>,
    /// The number of times the step is halved.
    #[serde(default = "halvings")]
    pub halvings: u32,
}

fn halvings() -> u32 {
    4
}

/// The finding for one problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// The problem.
    pub problem: Problem,
    /// One curve per quantity and method.
    pub curves: Vec<Curve>,
}

/// The schemes, and the other integrators of the acceleration level.
pub(super) fn methods() -> Vec<(String, Scheme, Integrator)> {
    let family = |f: Scheme| (f.name().to_string(), f, Integrator::SemiImplicitEuler);
    let other = |name: &str, integrator| (name.to_string(), Scheme::Acceleration, integrator);
    let others =
        [other("midpoint rule", Integrator::ImplicitMidpoint), other("RK4", Integrator::Rk4)];
    Scheme::ALL.into_iter().map(family).chain(others).collect()
}

impl Orders {
    /// The errors of one problem with every scheme.
    ///
    /// # Errors
    /// If the step is halved too often.
    pub(crate) fn run(&self, problem: Problem) -> Result<Finding> {
        if self.halvings > 10 {
            let reason = format!("must be at most 10, is {}", self.halvings);
            return Err(Error::invalid("drift", "orders.halvings", reason));
        }
        Ok(Finding { problem, curves: self.curves(problem)? })
    }

    fn curves(&self, problem: Problem) -> Result<Vec<Curve>> {
        let mut scene = Scene::load(problem.scene())?;
        (scene.step.alpha, scene.step.baumgarte) = (0.0, 0.0);
        scene.solver.tolerance = 1e-12;
        let one = |(name, scheme, integrator): &(String, Scheme, Integrator)| {
            let runs: Vec<(f64, Option<Vec<f64>>)> = (0..=self.halvings)
                .map(|halving| {
                    let mut scene = scene.clone();
                    scene.step.scheme = *scheme;
                    scene.step.integrator = *integrator;
                    scene.step.dt = problem.longest() / f64::from(1u32 << halving);
                    (scene.step.dt, problem.measure(&scene))
                })
                .collect();
            let curve = |(k, (quantity, unit)): (usize, &(&str, &str))| Curve {
                quantity: quantity.to_string(),
                unit: unit.to_string(),
                method: name.clone(),
                errors: runs
                    .iter()
                    .map(|(dt, found)| Sample {
                        dt: *dt,
                        error: found.as_ref().map_or(f64::NAN, |found| found[k]),
                    })
                    .collect(),
                expected: expected::expected(problem, quantity, *scheme, *integrator),
            };
            problem.quantities().iter().enumerate().map(curve).collect::<Vec<_>>()
        };
        let curves: Vec<Vec<Curve>> = methods().par_iter().map(one).collect();
        Ok(curves.concat())
    }
}
