//! The same iterates of one run, measured by every merit function.

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use super::problem_of;
use crate::lcp::{Lcp, merit};
use crate::scene::Scene;
use crate::solver::{Iterate, Observer, Order, Pgs, Settings, Solver, Start};

/// A run of PGS on one LCP of a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Study {
    /// The scene.
    pub scene: String,
    /// Its title.
    pub title: String,
    /// One curve a merit.
    pub curves: Vec<Curve>,
}

/// One merit after each sweep, the start first.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// The merit's name.
    pub name: String,
    /// Its definition.
    pub definition: String,
    /// Its values.
    pub values: Vec<f64>,
}

/// A measure of how far x is from a solution.
type Merit = fn(&Lcp, &[f64]) -> f64;

const MERITS: [(&str, &str, Merit); 6] = [
    (
        "scaled residual",
        "|x − Π(x − w/s)| s over the terms of its row, the worst",
        merit::scaled_residual,
    ),
    ("natural residual", "|x − Π(x − w)|, the worst", merit::natural_residual),
    (
        "Fischer-Burmeister",
        "|a + b − √(a² + b²)| of distance and push, the worst",
        merit::fischer_burmeister,
    ),
    ("Siconos", "|x − Π(x − w)|₂ over |b|₂", merit::siconos),
    ("DART", "|x − Π(x − w)|∞ over max(1, |b|∞, |A|∞ |x|∞)", merit::dart),
    ("K&M (4)", "|A x + b|₂ over |b|₂: not zero at a solution with an active bound", merit::km4),
];

/// Most sweeps of the run.
const SWEEPS: usize = 60;

/// Runs PGS on the scene's last LCP of a step.
pub fn run(scene: &Scene, step: usize) -> Option<Study> {
    let lcp = problem_of(scene, step)?.lcp;
    let mut seen = Seen { lcp: &lcp, values: vec![Vec::new(); MERITS.len()] };
    let settings = Settings { tolerance: 0.0, max_iterations: SWEEPS, check_every: SWEEPS };
    Pgs { omega: 1.0, order: Order::default(), settings }.solve(&lcp, &Start::default(), &mut seen);
    let curve = |((name, definition, _), values): (&(&str, &str, Merit), Vec<f64>)| Curve {
        name: (*name).to_string(),
        definition: (*definition).to_string(),
        values,
    };
    let curves = MERITS.iter().zip(seen.values).map(curve).collect();
    Some(Study { scene: scene.name.clone(), title: scene.title.clone(), curves })
}

struct Seen<'a> {
    lcp: &'a Lcp,
    values: Vec<Vec<f64>>,
}

impl Observer for Seen<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        for ((_, _, merit), values) in MERITS.iter().zip(&mut self.values) {
            values.push(merit(self.lcp, iterate.x));
        }
        ControlFlow::Continue(())
    }
}
