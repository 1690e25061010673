//! Modified proportioning with reduced gradient projections (MPRGP): conjugate gradients in a box.
//!
//! The gradient ∇_i = w_i / a_ii splits into two usable parts: φ on the free rows, and β on the
//! rows at a bound that should leave it. Both vanish at a solution.
//!
//! ```text
//! φ̃ = the part of φ that a step of length ᾱ can use before a bound stops it
//! |β|² ≤ φ̃·φ:  a conjugate gradient step on the free rows, x ← x − α p
//!               (expansion: cut off at the first bound, then x ← Π(x − ᾱ φ); p is reset)
//! otherwise:    proportioning: x ← x − α β lets rows leave their bounds; p is reset
//! ```
//!
//! Conjugate gradients explore the free rows in about √κ steps, where Gauss-Seidel needs κ, and
//! many rows can join or leave the bounds in a single step. No step raises the objective. For
//! symmetric positive definite A the method converges linearly at a rate known from the extreme
//! eigenvalues, and in finitely many steps (up to rounding) if w ≠ 0 on all rows at a bound (Dostál
//! & Schöberl 2005; both bounds: Dostál 2009). Lengths are measured by D = diag(A), and ᾱ = 1/λ
//! with an upper bound λ on the largest eigenvalue of D⁻¹A. A step costs two products with A.
//!
//! If A is singular, p may have zero curvature: then x moves until it reaches a bound, and if there
//! is none, the problem has no solution (`Ray`). pᵀA p < 0 or A not symmetric: `OutsideClass`. A
//! row with a_ii ≤ 0: `ZeroDiagonal`. Coupled rows: see [`frozen`].

use std::ops::ControlFlow;

use crate::iterate::{iterate, largest};
use crate::metric::{Curvature, Metric, energy_product};
use crate::{Event, Observer, Settings, Solution, Solver, Start, Status, frozen};
use lcplab_lcp::Lcp;

/// MPRGP, projected conjugate gradients.
#[derive(Debug, Clone, Default)]
pub struct Mprgp {
    /// The common settings; an iteration is one step of any of the three kinds.
    pub settings: Settings,
}

impl Mprgp {
    /// Its name in the registry.
    pub const NAME: &'static str = "mprgp";
}

impl Solver for Mprgp {
    fn name(&self) -> &str {
        Mprgp::NAME
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        let metric = match Metric::of_symmetric(lcp) {
            Ok(metric) => metric,
            Err(status) => return Solution::outside_class(lcp, x, status, 0, &self.settings),
        };
        frozen::solve(lcp, x, &self.settings, |lcp, x, first| {
            let mut run = Run { lcp, metric: &metric, p: None };
            iterate(lcp, x, first, &self.settings, observer, |x| run.step(x))
        })
    }
}

struct Run<'a> {
    lcp: &'a Lcp,
    metric: &'a Metric,
    /// The last conjugate direction; `None` if the next step restarts.
    p: Option<Vec<f64>>,
}

impl Run<'_> {
    fn step(&mut self, x: &mut [f64]) -> ControlFlow<Status, Event> {
        let n = x.len();
        let gradient = self.metric.gradient(self.lcp, x);
        let free: Vec<f64> = (0..n).map(|i| self.free(i, x[i], gradient[i])).collect();
        let chopped: Vec<f64> = (0..n).map(|i| self.chopped(i, x[i], gradient[i])).collect();
        let usable: Vec<f64> = (0..n).map(|i| self.usable(i, x[i], free[i])).collect();
        let proportional =
            self.metric.inner(&chopped, &chopped) <= self.metric.inner(&usable, &free);
        let p = match self.p.take() {
            _ if !proportional => chopped,
            Some(p) => self.conjugate(x, &free, p),
            None => free,
        };
        let (length, limit) = (self.minimizer(&gradient, &p)?, self.slack(x, &p));
        if length.is_infinite() && limit.is_infinite() {
            if p.iter().any(|p| !p.is_finite()) {
                return ControlFlow::Break(Status::NotFinite);
            }
            let direction: Vec<f64> = p.iter().map(|p| -p).collect();
            return ControlFlow::Break(Status::Ray { row: largest(&direction), direction });
        }
        for i in 0..n {
            x[i] -= f64::min(length, limit) * p[i];
        }
        // Rounding may leave a row slightly off the bound that it reached.
        self.lcp.project_all(x);
        if length <= limit && proportional {
            self.p = Some(p);
        } else if proportional {
            self.expand(x);
        }
        ControlFlow::Continue(Event::Step)
    }

    /// φ_i: the value on a free row, 0 at a bound.
    fn free(&self, i: usize, x: f64, value: f64) -> f64 {
        if self.lcp.lo()[i] < x && x < self.lcp.hi()[i] { value } else { 0.0 }
    }

    /// β_i.
    fn chopped(&self, i: usize, x: f64, gradient: f64) -> f64 {
        let (lo, hi) = (self.lcp.lo()[i], self.lcp.hi()[i]);
        let leaves = (x == lo && gradient < 0.0) || (x == hi && gradient > 0.0);
        if leaves && lo < hi { gradient } else { 0.0 }
    }

    /// φ̃_i: λ times the distance that x_i can move.
    fn usable(&self, i: usize, x: f64, free: f64) -> f64 {
        let (lo, hi) = (self.lcp.lo()[i], self.lcp.hi()[i]);
        free.min(self.metric.eigenvalue * (x - lo)).max(self.metric.eigenvalue * (x - hi))
    }

    /// The part of φ that is conjugate to the last direction p: φ − (φᵀA p / pᵀA p) p.
    fn conjugate(&self, x: &[f64], free: &[f64], mut p: Vec<f64>) -> Vec<f64> {
        let gamma = energy_product(self.lcp, &p, free) / energy_product(self.lcp, &p, &p);
        for i in 0..p.len() {
            p[i] = self.free(i, x[i], free[i] - gamma * p[i]);
        }
        p
    }

    /// The step length that minimizes the objective along −p; ∞ if the objective decreases without
    /// limit.
    fn minimizer(&self, gradient: &[f64], p: &[f64]) -> ControlFlow<Status, f64> {
        let slope = self.metric.inner(gradient, p);
        match self.metric.curvature(self.lcp, p) {
            _ if !(slope > 0.0) => ControlFlow::Break(Status::Stalled),
            Curvature::Positive(curvature) => ControlFlow::Continue(slope / curvature),
            Curvature::Flat => ControlFlow::Continue(f64::INFINITY),
            Curvature::Negative => {
                let reason = "A is not positive semidefinite";
                ControlFlow::Break(Status::OutsideClass { reason })
            }
        }
    }

    /// How far x can move along −p within the bounds.
    fn slack(&self, x: &[f64], p: &[f64]) -> f64 {
        let slack = |i: usize| match p[i] {
            p if p > 0.0 => (x[i] - self.lcp.lo()[i]) / p,
            p if p < 0.0 => (x[i] - self.lcp.hi()[i]) / p,
            _ => f64::INFINITY,
        };
        (0..x.len()).map(slack).fold(f64::INFINITY, f64::min)
    }

    /// x ← Π(x − ᾱ φ).
    fn expand(&self, x: &mut [f64]) {
        let gradient = self.metric.gradient(self.lcp, x);
        for i in 0..x.len() {
            x[i] -= self.free(i, x[i], gradient[i]) / self.metric.eigenvalue;
        }
        self.lcp.project_all(x);
    }
}
