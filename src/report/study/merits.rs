//! The same iterates of one run, measured by every merit function.

use std::ops::ControlFlow;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::settings::{AtStep, Given};
use crate::error::Result;
use crate::lcp::friction::{ConeProblem, FrictionProblem, Law, merit as cone_merit};
use crate::lcp::{Complementarity, Lcp, merit};
use crate::solver::{ConePgs, ConeSolver, Iterate, Observer, Order, Pgs, Settings, Solver, Start};

/// Which problem a run solves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Shape {
    /// The LCP, friction in a box, by PGS.
    Box,
    /// Coulomb's law with circular cones, by PGS for cones.
    Cone,
}

/// LCPs on which the merit functions are compared.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The LCPs.
    pub scenes: Vec<AtStep>,
}

impl Study for Plan {
    const NAME: &'static str = "merits";
    type Finding = Vec<Run>;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        self.scenes.iter().map(|task| task.scene.clone()).collect()
    }

    fn run(&self, task: usize) -> Result<(Self::Finding, ())> {
        Ok((run(self.scenes[task].given()?), ()))
    }
}

/// A run on an LCP.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// The scene or the file.
    pub scene: String,
    /// Its title.
    pub title: String,
    /// What it solves.
    pub shape: Shape,
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

/// A measure of how far x is from a solution of P.
struct Merit<P> {
    name: &'static str,
    definition: &'static str,
    of: fn(&P, &[f64]) -> f64,
}

const BOX: [Merit<Lcp>; 6] = [
    Merit {
        name: "scaled residual",
        definition: "|x − Π(x − w/s)| s over the terms of its row, the worst",
        of: merit::scaled_residual,
    },
    Merit {
        name: "natural residual",
        definition: "|x − Π(x − w)|, the worst",
        of: merit::natural_residual,
    },
    Merit {
        name: "Fischer-Burmeister",
        definition: "|a + b − √(a² + b²)| of distance and push, the worst",
        of: merit::fischer_burmeister,
    },
    Merit { name: "Siconos", definition: "|x − Π(x − w)|₂ over |b|₂", of: merit::siconos },
    Merit {
        name: "DART",
        definition: "|x − Π(x − w)|∞ over max(1, |b|∞, |A|∞ |x|∞)",
        of: merit::dart,
    },
    Merit {
        name: "K&M (4)",
        definition: "|A x + b|₂ over |b|₂: not zero at a solution with an active bound",
        of: merit::km4,
    },
];

const CONE: [Merit<ConeProblem>; 6] = [
    Merit {
        name: "scaled residual",
        definition: "|x − Π_K(x − ŵ/s)| s over the terms of its contact, the worst",
        of: |problem, x| problem.scaled_residual(x),
    },
    Merit {
        name: "RR-9118, Siconos",
        definition: "|x − Π_K(x − ŵ)|₂ over |b|₂",
        of: cone_merit::rr9118,
    },
    Merit {
        name: "FCLIB",
        definition: "|x − Π_K(x − ŵ)|₂ over 1 + √|b|₂ for contacts, over 1 + |b|₂ for other rows",
        of: cone_merit::fclib,
    },
    Merit {
        name: "Siconos, as LCP",
        definition: "|x − Π(x − w)|₂ over |b|₂ with the box ±μ x_n: another law",
        of: |problem, x| merit::siconos(&problem.friction().coupled_box(), x),
    },
    Merit {
        name: "DART",
        definition: "|x − Π(x − w)|∞ over max(1, |b|∞, |A|∞ |x|∞) with the box: another law",
        of: |problem, x| merit::dart(&problem.friction().coupled_box(), x),
    },
    Merit {
        name: "K&M (4)",
        definition: "|A x + b|₂ over |b|₂: not zero at a solution with an active bound",
        of: |problem, x| merit::km4(problem.lcp(), x),
    },
];

/// Most sweeps of the run.
const SWEEPS: usize = 60;

/// Runs PGS on an LCP, and on its cones where it has contacts with friction.
fn run(Given { name, title, lcp }: Given) -> Vec<Run> {
    let settings = Settings {
        tolerance: 0.0,
        max_iterations: SWEEPS,
        check_every: SWEEPS,
        ..Settings::default()
    };
    let run = |shape, curves| Run { scene: name.clone(), title: title.clone(), shape, curves };
    let pgs = Pgs { omega: 1.0, order: Order::default(), settings: settings.clone() };
    let mut seen = Seen::new(&lcp, &BOX);
    pgs.solve(&lcp, &Start::default(), &mut seen);
    let mut runs = vec![run(Shape::Box, seen.curves())];
    let friction = FrictionProblem::of(&lcp).ok().filter(|f| !f.contacts().is_empty());
    if let Some(friction) = friction {
        let problem = ConeProblem::new(friction, Law::Coulomb);
        let mut seen = Seen::new(&problem, &CONE);
        ConePgs { settings }.solve(&problem, &Start::default(), &mut seen);
        runs.push(run(Shape::Cone, seen.curves()));
    }
    runs
}

/// An observer that measures every iterate by every merit.
struct Seen<'a, P> {
    problem: &'a P,
    merits: &'a [Merit<P>],
    values: Vec<Vec<f64>>,
}

impl<'a, P> Seen<'a, P> {
    fn new(problem: &'a P, merits: &'a [Merit<P>]) -> Self {
        Seen { problem, merits, values: vec![Vec::new(); merits.len()] }
    }

    fn curves(self) -> Vec<Curve> {
        let curve = |(merit, values): (&Merit<P>, Vec<f64>)| Curve {
            name: merit.name.to_string(),
            definition: merit.definition.to_string(),
            values,
        };
        self.merits.iter().zip(self.values).map(curve).collect()
    }
}

impl<P> Observer for Seen<'_, P> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        for (merit, values) in self.merits.iter().zip(&mut self.values) {
            values.push((merit.of)(self.problem, iterate.x));
        }
        ControlFlow::Continue(())
    }
}
