//! Errors against the length of the step, with the order that theory derives for each family.
//!
//! Every problem has a closed form; what is measured is a distance to it at a given time:
//!
//! ```text
//! fall    a stone's height after 1 s                              z0 + v0 t − g t²/2
//! swing   a pendulum after 1 s: place, energy, length of its rod  elliptic functions; both stay
//! bounce  height between the first two bounces                    e² h
//! slide   a box's way down a slope in ½ s                         g (sin θ − μ cos θ) t²/2
//! ```
//!
//! The observed order is that of the two shortest steps whose error is not yet rounding; the fitted one is
//! the slope of the line through all of them, with its standard error.

mod curve;
mod expected;

pub use curve::{Curve, ROUNDING, SLACK, Sample};
pub use expected::Expected;

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use crate::error::{Error, Result};
use crate::scene::catalogue::bounce::Drop;
use crate::scene::catalogue::fall::Fall;
use crate::scene::catalogue::pendulum::{Pendulum, Swing};
use crate::scene::{Integrator, Scene, Scheme};
use crate::simulation::{Simulation, Step};

/// Problems with closed forms by every family, with shorter and shorter steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The problems.
    pub problems: Vec<Problem>,
    /// How often the step is halved.
    #[serde(default = "halvings")]
    pub halvings: u32,
}

fn halvings() -> u32 {
    4
}

/// A problem with a closed form.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Problem {
    /// A stone.
    Fall,
    /// A pendulum released level with its pivot.
    Swing,
    /// A ball with e = ½.
    Bounce,
    /// A box on a slope.
    Slide,
}

/// One problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// The problem.
    pub problem: Problem,
    /// A curve each quantity and method.
    pub curves: Vec<Curve>,
}

/// The families, and the other integrators of the acceleration level.
fn methods() -> Vec<(String, Scheme, Integrator)> {
    let family = |f: Scheme| (f.name().to_string(), f, Integrator::SemiImplicitEuler);
    let other = |name: &str, integrator| {
        (format!("acceleration, {name}"), Scheme::Acceleration, integrator)
    };
    let others = [other("midpoint", Integrator::ImplicitMidpoint), other("RK4", Integrator::Rk4)];
    Scheme::ALL.into_iter().map(family).chain(others).collect()
}

impl Problem {
    /// The shipped scene.
    pub fn scene(self) -> &'static str {
        match self {
            Problem::Fall => "free_fall",
            Problem::Swing => "pendulum",
            Problem::Bounce => "bouncing_ball",
            Problem::Slide => "incline",
        }
    }

    /// What is measured, and its unit.
    fn quantities(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Problem::Fall => &[("height", "m")],
            Problem::Swing => &[("place", "m"), ("energy", "J"), ("length of the rod", "m")],
            Problem::Bounce => &[("height after a bounce", "m")],
            Problem::Slide => &[("way", "m")],
        }
    }

    /// The longest step (s).
    fn longest(self) -> f64 {
        match self {
            Problem::Fall | Problem::Swing => 0.02,
            Problem::Bounce | Problem::Slide => 0.01,
        }
    }

    /// The errors of the quantities; `None` if the simulation fails.
    fn measure(self, scene: &Scene) -> Option<Vec<f64>> {
        let mut simulation = Simulation::of(scene).ok()?;
        let g = scene.gravity.norm();
        let start = scene.states[scene.states.len() - 1];
        match self {
            Problem::Fall => {
                let fall = Fall { height: start.pose.p.z, speed: start.v.z, gravity: g };
                let z = last(&mut simulation, 1.0)?.states[0].pose.p.z;
                Some(vec![(z - fall.height_after(1.0)).abs()])
            }
            Problem::Swing => swing(&mut simulation, g),
            Problem::Bounce => {
                let height = start.pose.p.z - RADIUS;
                let e = scene.contact.restitution;
                let drop = Drop { height, restitution: e, gravity: g };
                let top = top_of_first_flight(&mut simulation, drop.time_of(2))?;
                Some(vec![(top - drop.height_after(1)).abs()])
            }
            Problem::Slide => {
                let (time, angle) = (0.5, 20f64.to_radians());
                let rate = g * (angle.sin() - scene.contact.friction * angle.cos());
                let p = last(&mut simulation, time)?.states[1].pose.p;
                Some(vec![((p - start.pose.p).norm() - 0.5 * rate * time * time).abs()])
            }
        }
    }
}

/// The ball's radius (m).
const RADIUS: f64 = 0.1;

/// The step that ends at this time.
fn last(simulation: &mut Simulation, time: f64) -> Option<Step> {
    let steps = (time / simulation.scene().step.dt).round() as usize;
    (0..steps).map(|_| simulation.step().ok()).last()?
}

/// Place after 1 s, and the largest errors of energy and length up to then.
fn swing(simulation: &mut Simulation, gravity: f64) -> Option<Vec<f64>> {
    let first = simulation.motion().energy();
    let (mut energy, mut length) = (0.0f64, 0.0f64);
    let steps = (1.0 / simulation.scene().step.dt).round() as usize;
    for _ in 0..steps {
        let step = simulation.step().ok()?;
        energy = energy.max((step.motion.energy() - first).abs());
        length = length.max(step.motion.drift);
    }
    let pendulum = Pendulum { length: 1.0, gravity };
    let start = Swing { angles: [std::f64::consts::FRAC_PI_2], rates: [0.0] };
    let (sin, cos) = pendulum.after(1.0, start).angles[0].sin_cos();
    let p = simulation.states()[0].pose.p;
    Some(vec![(p.x - sin).hypot(p.z + cos), energy, length])
}

/// The greatest height of the ball's lowest point between its first bounce and its second.
fn top_of_first_flight(simulation: &mut Simulation, second: f64) -> Option<f64> {
    let (mut bounces, mut top) = (0, 0.0f64);
    while simulation.time() < second + 0.1 {
        let before = simulation.states()[1].v.z;
        let state = simulation.step().ok()?.states[1];
        bounces += usize::from(before < 0.0 && state.v.z > 0.0);
        if bounces == 1 {
            top = top.max(state.pose.p.z - RADIUS);
        }
    }
    (bounces > 0).then_some(top)
}

impl Plan {
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

impl Study for Plan {
    const NAME: &'static str = "order";
    type Finding = Finding;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        self.problems.iter().map(|problem| problem.scene().to_string()).collect()
    }

    fn run(&self, task: usize) -> Result<(Finding, ())> {
        if self.halvings > 10 {
            let reason = format!("must be at most 10, is {}", self.halvings);
            return Err(Error::invalid("order", "halvings", reason));
        }
        let problem = self.problems[task];
        Ok((Finding { problem, curves: self.curves(problem)? }, ()))
    }
}
