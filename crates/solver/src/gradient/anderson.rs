//! Projected Gauss-Seidel with Anderson acceleration.
//!
//! A sweep of [`Pgs`](crate::Pgs) is a map x → P(x), whose fixed points are the solutions. Anderson
//! (1965) combines the results of the last sweeps so that their steps cancel as far as possible:
//!
//! ```text
//! f = P(x) − x,   γ = argmin |f − ΔF γ|_D,   y = Π( P(x) − ΔP γ )        the last five differences ΔF, ΔP
//! x ← y if q(y) < q(P(x)), else P(x)                                     q = ½ xᵀAx + bᵀx
//! ```
//!
//! While no row changes sides, a sweep is a linear map and this is a Krylov method on I − G (Walker
//! & Ni 2011), which removes the few slow error components of a stack in the same number of sweeps.
//! The comparison makes it safe: q decreases in each step at least as much as in the sweep alone,
//! so the method converges wherever Gauss-Seidel does. With coupled rows q is no criterion; there
//! the length |P(y) − y|_D of another sweep decides, and convergence is not guaranteed, as for
//! Gauss-Seidel itself.
//!
//! An iteration is a sweep plus two products with A for the comparison. A row with a_ii ≤ 0 gives
//! `ZeroDiagonal`; iterates that overflow give `Diverged`.

use std::collections::VecDeque;
use std::ops::ControlFlow;

use crate::iterate::iterate;
use crate::metric::Metric;
use crate::tolerances::DEPENDENT_DIFFERENCE;
use crate::{Event, Observer, Settings, Solution, Solver, Start};
use lcplab_lcp::{Lcp, dot};

/// The number of differences that are kept.
const MEMORY: usize = 5;

/// Anderson-accelerated projected Gauss-Seidel.
#[derive(Debug, Clone, Default)]
pub struct AndersonPgs {
    /// The common settings; an iteration is a sweep followed by the mixing.
    pub settings: Settings,
}

impl AndersonPgs {
    /// Its name in the registry.
    pub const NAME: &'static str = "anderson-pgs";
}

impl Solver for AndersonPgs {
    fn name(&self) -> &str {
        AndersonPgs::NAME
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        let metric = match Metric::of_symmetric(lcp) {
            Ok(metric) => metric,
            Err(status) => return Solution::outside_class(lcp, x, status, 0, &self.settings),
        };
        let mut memory = Memory::default();
        iterate(lcp, x, 0, &self.settings, observer, |x| {
            let end = swept(lcp, &metric, x);
            let step = difference(&end, x);
            let mixed = memory.mixed(&metric, &end, &step).map(|mut mixed| {
                lcp.project_all(&mut mixed);
                mixed
            });
            memory.remember(end.clone(), step);
            let better =
                mixed.filter(|mixed| height(lcp, &metric, mixed) < height(lcp, &metric, &end));
            x.copy_from_slice(better.as_deref().unwrap_or(&end));
            ControlFlow::Continue(Event::Sweep)
        })
    }
}

/// P(x).
fn swept(lcp: &Lcp, metric: &Metric, x: &[f64]) -> Vec<f64> {
    let mut x = x.to_vec();
    for i in 0..x.len() {
        x[i] = lcp.project(i, x[i] - lcp.row_w(i, &x) / metric.diagonal[i], &x);
    }
    x
}

/// The quantity that must decrease.
fn height(lcp: &Lcp, metric: &Metric, x: &[f64]) -> f64 {
    if lcp.has_coupled_rows() {
        let step = difference(&swept(lcp, metric, x), x);
        return metric.inner(&step, &step);
    }
    // w = A x + b
    0.5 * (dot(&lcp.w(x), x) + dot(lcp.b(), x))
}

/// The results and steps of the last sweeps.
#[derive(Debug, Default)]
struct Memory {
    last: Option<(Vec<f64>, Vec<f64>)>,
    /// (ΔP, ΔF), newest first.
    differences: VecDeque<(Vec<f64>, Vec<f64>)>,
}

impl Memory {
    fn remember(&mut self, end: Vec<f64>, step: Vec<f64>) {
        self.last = Some((end, step));
    }

    /// P(x) − ΔP γ; `None` after the first sweep.
    fn mixed(&mut self, metric: &Metric, end: &[f64], step: &[f64]) -> Option<Vec<f64>> {
        let (last_end, last_step) = self.last.as_ref()?;
        self.differences.push_front((difference(end, last_end), difference(step, last_step)));
        self.differences.truncate(MEMORY);
        let steps: Vec<&[f64]> = self.differences.iter().map(|(_, step)| step.as_slice()).collect();
        let weights = least_squares(metric, &steps, step);
        let mut mixed = end.to_vec();
        for (weight, (moved, _)) in weights.iter().zip(&self.differences) {
            mixed.iter_mut().zip(moved).for_each(|(mixed, moved)| *mixed -= weight * moved);
        }
        Some(mixed)
    }
}

/// The γ that minimizes |f − Σ γ_k f_k|_D, by Gram-Schmidt orthogonalization of the f_k. Stops at
/// the first f_k that depends on the previous ones.
fn least_squares(metric: &Metric, columns: &[&[f64]], f: &[f64]) -> Vec<f64> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    // Column k: its components along the basis, then the length of the rest.
    let mut triangle: Vec<Vec<f64>> = Vec::new();
    for column in columns {
        let (mut rest, mut parts) = (column.to_vec(), Vec::new());
        for direction in &basis {
            let part = metric.inner(direction, &rest);
            rest.iter_mut().zip(direction).for_each(|(rest, own)| *rest -= part * own);
            parts.push(part);
        }
        let square = metric.inner(&rest, &rest);
        if !(square > DEPENDENT_DIFFERENCE * metric.inner(column, column)) {
            break;
        }
        let length = square.sqrt();
        rest.iter_mut().for_each(|rest| *rest /= length);
        parts.push(length);
        basis.push(rest);
        triangle.push(parts);
    }
    let mut weights: Vec<f64> = basis.iter().map(|direction| metric.inner(direction, f)).collect();
    for k in (0..weights.len()).rev() {
        weights[k] /= triangle[k][k];
        let weight = weights[k];
        for (i, part) in triangle[k][..k].iter().enumerate() {
            weights[i] -= weight * part;
        }
    }
    weights
}

fn difference(u: &[f64], v: &[f64]) -> Vec<f64> {
    u.iter().zip(v).map(|(u, v)| u - v).collect()
}
