//! Accelerated projected gradient descent with restart.
//!
//! ```text
//! x⁺ ← Π( y − ∇(y) / L ),   ∇_i = w_i / a_ii
//! y  ← x⁺ + β (x⁺ − x),     β = θ (1 − θ) / (θ² + θ⁺),   θ⁺² = (1 − θ⁺) θ²,   θ = 1 at first
//! ```
//!
//! Projected gradient steps (damped [`Jacobi`](crate::Jacobi)) from an extrapolated point y:
//! Nesterov's method (1983), used for contacts by Mazhar, Heyn, Negrut & Tasora (2015). After k
//! steps the objective is within 2 L |x⁰ − x*|² / k² of its minimum for every symmetric
//! semidefinite A; plain steps achieve only 1/k. Momentum makes the objective oscillate. Whenever
//! the last step goes uphill, ⟨∇(y), x⁺ − x⟩ > 0, the momentum is reset (θ = 1; O'Donoghue & Candès
//! 2015), which restores the linear rate 1 − 1/√κ without knowing κ.
//!
//! L is found by backtracking: it starts at 1, and a step is repeated with doubled L until the
//! objective lies below its model, dᵀA d ≤ L dᵀD d with d = x⁺ − y. Lengths are measured by
//! D = diag(A), so units do not matter and L never exceeds the number of entries in a row. A step
//! costs two products with A, plus one for each repetition.
//!
//! Only Π depends on the feasible set, so the same code works for boxes and for circular friction
//! cones, where D has one number per contact.
//!
//! A not symmetric: `OutsideClass`. A row with a_ii ≤ 0: `ZeroDiagonal`. Coupled rows and Coulomb's
//! law: see [`frozen`].

use std::ops::ControlFlow;

use crate::iterate::iterate;
use crate::metric::{Metric, energy_product};
use crate::tolerances::INNER_TOLERANCE;
use crate::{ConeSolver, Event, Observer, Settings, Solution, Solver, Start, Status, frozen};
use lcplab_lcp::friction::ConeProblem;
use lcplab_lcp::{Complementarity, Lcp};

/// Accelerated projected gradient descent.
#[derive(Debug, Clone, Default)]
pub struct Apgd {
    /// The common settings; an iteration is one accepted gradient step.
    pub settings: Settings,
}

impl Apgd {
    /// Its name in the registry.
    pub const NAME: &'static str = "apgd";
}

impl Solver for Apgd {
    fn name(&self) -> &str {
        Apgd::NAME
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        self.descend(lcp, Metric::of_symmetric(lcp), start, observer)
    }
}

impl ConeSolver for Apgd {
    fn name(&self) -> &str {
        Apgd::NAME
    }

    fn solve(
        &self,
        problem: &ConeProblem,
        start: &Start<'_>,
        observer: &mut dyn Observer,
    ) -> Solution {
        self.descend(problem, Metric::of_cones(problem), start, observer)
    }
}

impl Apgd {
    fn descend<P: Complementarity>(
        &self,
        problem: &P,
        metric: Result<Metric, Status>,
        start: &Start<'_>,
        observer: &mut dyn Observer,
    ) -> Solution {
        let x = start.point(problem);
        let metric = match metric {
            Ok(metric) => metric,
            Err(status) => return Solution::outside_class(problem, x, status, 0, &self.settings),
        };
        let mut inner = self.settings.clone();
        let mut is_unsolved = problem.scaled_residual(&x) > inner.tolerance;
        frozen::solve(problem, x, &self.settings, |problem, x, first| {
            let lcp = problem.lcp();
            let residual = problem.scaled_residual(&x);
            if is_unsolved && residual <= inner.tolerance {
                // The frozen problem has a smaller residual than the cone problem.
                inner.tolerance = INNER_TOLERANCE * residual;
            }
            // From the second round on the tolerance is tightened.
            is_unsolved = true;
            let (mut y, mut theta, mut curvature) = (x.clone(), 1.0, 1.0);
            iterate(problem, x, first, &inner, observer, |x| {
                let gradient = metric.gradient(lcp, &y);
                let next = loop {
                    let next = gradient_step(problem, &y, &gradient, 1.0 / curvature);
                    let d = difference(&next, &y);
                    let below = energy_product(lcp, &d, &d) <= curvature * metric.inner(&d, &d);
                    if below || curvature >= metric.eigenvalue {
                        break next;
                    }
                    curvature = f64::min(2.0 * curvature, metric.eigenvalue);
                };
                let step = difference(&next, x);
                let uphill = metric.inner(&gradient, &step) > 0.0;
                if uphill {
                    // This makes β = 0.
                    theta = 1.0;
                }
                let beta = momentum(&mut theta);
                for i in 0..x.len() {
                    x[i] = next[i];
                    y[i] = next[i] + beta * step[i];
                }
                ControlFlow::Continue(Event::Step)
            })
        })
    }
}

/// Π(y − t ∇).
fn gradient_step(problem: &impl Complementarity, y: &[f64], gradient: &[f64], t: f64) -> Vec<f64> {
    let mut next: Vec<f64> = y.iter().zip(gradient).map(|(y, g)| y - t * g).collect();
    problem.project_all(&mut next);
    next
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// Updates θ and returns β.
fn momentum(theta: &mut f64) -> f64 {
    let old = *theta;
    let square = old * old;
    // θ⁺² = (1 − θ⁺) θ²
    *theta = 0.5 * ((square * square + 4.0 * square).sqrt() - square);
    old * (1.0 - old) / (square + *theta)
}
