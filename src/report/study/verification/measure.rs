//! Helpers of all cases: a scene, the method of stepping, and halved step lengths.

use super::{Criterion, Row, Sample, Size};
use crate::body::State;
use crate::error::Result;
use crate::scene::{Integrator, Scene, Scheme};
use crate::simulation;
use crate::simulation::{Simulation, Step};
use crate::solver::Dantzig;

/// A scheme, and the integrator for the acceleration level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Method {
    Velocity,
    Acceleration,
    Rk4,
    Midpoint,
    Scheme(Scheme),
}

impl Method {
    fn name(self) -> &'static str {
        match self {
            Method::Velocity => "velocity",
            Method::Acceleration => "acceleration",
            Method::Rk4 => "RK4",
            Method::Midpoint => "midpoint rule",
            Method::Scheme(scheme) => scheme.name(),
        }
    }

    fn apply(self, scene: &mut Scene) {
        scene.step.scheme = match self {
            Method::Velocity => Scheme::Velocity,
            Method::Scheme(scheme) => scheme,
            _ => Scheme::Acceleration,
        };
        scene.step.integrator = match self {
            Method::Rk4 => Integrator::Rk4,
            Method::Midpoint => Integrator::ImplicitMidpoint,
            _ => Integrator::SemiImplicitEuler,
        };
    }
}

/// The theory of a quantity.
pub(super) struct Known {
    pub quantity: String,
    /// As LaTeX.
    pub formula: &'static str,
    pub unit: &'static str,
    pub expected: f64,
    pub criterion: Criterion,
}

impl Known {
    /// A quantity whose error decreases like dt to this power.
    pub fn order(
        order: f64,
        quantity: impl Into<String>,
        formula: &'static str,
        unit: &'static str,
        expected: f64,
    ) -> Self {
        let criterion = Criterion::Order(order);
        Known { quantity: quantity.into(), formula, unit, expected, criterion }
    }

    /// A quantity that does not depend on the step length.
    pub fn exact(
        (tolerance, because): (f64, &str),
        quantity: impl Into<String>,
        formula: &'static str,
        unit: &'static str,
        expected: f64,
    ) -> Self {
        let criterion = Criterion::Exact { tolerance, because: because.into() };
        Known { quantity: quantity.into(), formula, unit, expected, criterion }
    }
}

/// The tolerance for quantities whose only error is rounding.
pub(super) const ROUNDING: (f64, &str) = (1e-10, "rounding errors, accumulated over all steps");

/// A case with its scene at the longest step.
pub(super) struct Case {
    pub name: &'static str,
    pub scene: Scene,
    /// The number of step lengths, each half of the previous one, that an order is read from.
    pub levels: usize,
}

impl Case {
    /// A case of a shipped scene, without feedback of errors.
    pub(crate) fn load(name: &'static str, scene: &str, size: Size) -> Result<Self> {
        Ok(Case::of(name, Scene::load(scene)?, size))
    }

    /// A case of a scene, without feedback of errors.
    pub(crate) fn of(name: &'static str, mut scene: Scene, size: Size) -> Self {
        (scene.step.alpha, scene.step.baumgarte) = (0.0, 0.0);
        scene.solver.tolerance = 1e-12;
        Case { name, scene, levels: size.levels() }
    }

    /// The rows of quantities measured in one run of the scene, in the order of `known`; the scene
    /// passed to `measure` has the method and the step length of the run. Where no quantity depends
    /// on the step length, the longest ones are enough: two, or one of [`Size::Fast`].
    pub(crate) fn rows(
        &self,
        method: Method,
        known: Vec<Known>,
        measure: impl Fn(&Scene) -> Option<Vec<f64>>,
    ) -> Vec<Row> {
        let mut scene = self.scene.clone();
        method.apply(&mut scene);
        let has_order = known.iter().any(|known| matches!(known.criterion, Criterion::Order(_)));
        let levels = if has_order { self.levels } else { (self.levels / 2).max(1) };
        let runs: Vec<(f64, Option<Vec<f64>>)> = (0..levels)
            .map(|level| {
                let mut scene = scene.clone();
                scene.step.dt /= f64::from(1u32 << level);
                (scene.step.dt, measure(&scene))
            })
            .collect();
        let sample = |k: usize| {
            let measured =
                |found: &Option<Vec<f64>>| found.as_ref().and_then(|f| f.get(k).copied());
            let samples = runs.iter().map(|(dt, found)| Sample {
                dt: *dt,
                measured: measured(found).unwrap_or(f64::NAN),
            });
            samples.collect()
        };
        let row = |(k, known): (usize, Known)| Row {
            case: self.name.into(),
            scene: self.scene.name.clone(),
            method: method.name().into(),
            quantity: known.quantity,
            formula: known.formula.into(),
            unit: known.unit.into(),
            expected: known.expected,
            samples: sample(k),
            criterion: known.criterion,
        };
        known.into_iter().enumerate().map(row).collect()
    }
}

/// A simulation of the scene.
pub(super) fn start(scene: &Scene) -> Option<Simulation> {
    let solver = Box::new(Dantzig { settings: simulation::options(scene).settings });
    Some(Simulation::new(scene.clone(), solver))
}

/// The scene's first step.
pub(super) fn first(scene: &Scene) -> Option<Step> {
    start(scene)?.step().ok()
}

/// The step that ends nearest to this time.
pub(super) fn last(scene: &Scene, time: f64) -> Option<Step> {
    let mut simulation = start(scene)?;
    let mut last = None;
    for _ in 0..(time / scene.step.dt).round() as usize {
        last = Some(simulation.step().ok()?);
    }
    last
}

/// The states after a time.
pub(super) fn after(scene: &Scene, time: f64) -> Option<Vec<State>> {
    last(scene, time).map(|step| step.states)
}

/// The times at which a value crosses 0 downwards, the first `count` of them before a limit;
/// `value` gives the value and its rate. Between two steps it is interpolated linearly; with RK4 by
/// the cubic with the rates, whose error is of fifth order if the fourth derivative vanishes too.
pub(super) fn passages(
    scene: &Scene,
    (count, limit): (usize, f64),
    value: impl Fn(&[State]) -> (f64, f64),
) -> Option<Vec<f64>> {
    let dt = scene.step.dt;
    let mut simulation = start(scene)?;
    let mut before = value(simulation.states());
    let mut times = Vec::new();
    while times.len() < count {
        let now = value(&simulation.step().ok()?.states);
        // A jump of an angle from π to −π is not a crossing.
        if before.0 > 0.0 && now.0 <= 0.0 && before.0 - now.0 < 1.0 {
            let part = match scene.step.integrator {
                Integrator::Rk4 => cubic_root(before, now, dt),
                _ => before.0 / (before.0 - now.0),
            };
            times.push(simulation.time() - dt + part * dt);
        }
        before = now;
        if simulation.time() > limit {
            return None;
        }
    }
    Some(times)
}

/// The root in [0, 1] of the cubic with these values and rates at the ends of a step h, by
/// bisection.
fn cubic_root((y0, r0): (f64, f64), (y1, r1): (f64, f64), h: f64) -> f64 {
    let cubic = |s: f64| {
        let t = 1.0 - s;
        t * t * (1.0 + 2.0 * s) * y0 + s * s * (1.0 + 2.0 * t) * y1 + s * t * h * (t * r0 - s * r1)
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if cubic(middle) > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}
