//! Newton's method on the LCP written as equations H(x) = 0 that have a kink.
//!
//! With w̃_i = w_i / a_ii, the distance to the solution that row i alone can see,
//!
//! ```text
//! minimum map          H_i = x_i − Π_i(x_i − w̃_i) = the median of x_i − lo_i, w̃_i, x_i − hi_i
//! Fischer-Burmeister   H_i = φ(x_i − lo_i, −φ(hi_i − x_i, −w̃_i)),   φ(a, b) = a + b − √(a² + b²)
//! ```
//!
//! vanish exactly at the solutions (a bound at infinity drops its φ; Billups 1995 for two finite
//! ones), and no variable is doubled for the upper bounds. Each step solves for d
//!
//! ```text
//! (JᵀJ + ν I) d = −Jᵀ H,   J a generalised Jacobian at x,   ν = 10⁻¹⁰ |H|² / Σ b_i²/a_ii
//! ```
//!
//! and halves it until |H| falls enough. For the minimum map row i of J is that of A where row i is
//! free and a unit row where it is at a bound: the step solves for the guessed active set, which is
//! final once the guess is right. For Fischer-Burmeister |H|² has no kink, so that d always leads
//! downhill and the limit solves the LCP if A is a P0 matrix, as semidefinite ones are. Near a
//! solution both double the correct digits in each step (Qi & Sun 1993; De Luca, Facchinei &
//! Kanzow 1996).
//!
//! Redundant contacts make J singular. The term ν (Levenberg-Marquardt) then picks the least change
//! of x, and since it vanishes with |H|² it does not spoil the speed (Yamashita & Fukushima 2001).
//! Where no length of d reduces |H|, which happens at kinks of the minimum map, the step is a sweep
//! of [`Pgs`](super::Pgs), and the observer is told so (`Sweep` for `Step`).
//!
//! |H|² is summed as Σ a_ii H_i², an energy. A step costs a dense least-squares problem, O(n³): A
//! of any kind with a positive diagonal, up to 2000 rows. The bounds of coupled rows are part of H,
//! with their derivatives. `ZeroDiagonal` and `Diverged` as for PGS.

use std::ops::ControlFlow;

use faer::Mat;
use faer::prelude::SolveLstsq;

use super::iterate::iterate;
use super::metric::Metric;
use super::{Event, Observer, Settings, Solution, Solver, Start, Status};
use crate::lcp::Lcp;
use crate::memory::Memory;

/// Halvings of a step before a sweep is taken instead.
const HALVINGS: i32 = 12;
/// |H|² must fall by this part of what a linear H would give.
const SUFFICIENT: f64 = 1e-4;
/// ν for |H|² = Σ b_i²/a_ii, which it has at x = 0 without bounds. Only the flattest directions
/// feel it.
const DAMPING: f64 = 1e-10;
/// ν stays above this, so that a singular J keeps its least-squares problem solvable.
const LEAST_DAMPING: f64 = 1e-28;
/// Above this many rows the dense problem takes too long.
const MAX_ROWS: usize = 2_000;

/// The equations whose root is sought.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Equations {
    /// The median of x − lo, w̃ and x − hi.
    #[default]
    MinimumMap,
    /// φ(x − lo, −φ(hi − x, −w̃)).
    FischerBurmeister,
}

/// Newton's method with line search on nonsmooth equations.
#[derive(Debug, Clone, Default)]
pub struct Newton {
    /// The equations whose root is sought.
    pub equations: Equations,
    /// The common settings; an iteration is a step.
    pub settings: Settings,
}

impl Solver for Newton {
    fn name(&self) -> &'static str {
        match self.equations {
            Equations::MinimumMap => "newton",
            Equations::FischerBurmeister => "fischer-newton",
        }
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        if lcp.len() > MAX_ROWS {
            let reason = "a dense Jacobian of more than 2000 rows";
            return Solution::new(lcp, x, Status::OutsideClass { reason }, 0);
        }
        if let Some(status) = self.settings.refusal(Memory::square(lcp.len()).times(4)) {
            return Solution::new(lcp, x, status, 0); // the 2n × n least-squares problem and its factors
        }
        let metric = match Metric::of(lcp) {
            Ok(metric) => metric,
            Err(status) => return Solution::new(lcp, x, status, 0),
        };
        let run = Run { lcp, metric: &metric, equations: self.equations };
        iterate(lcp, x, 0, &self.settings, observer, |x| {
            if let Some(next) = run.newton_step(x) {
                x.copy_from_slice(&next);
                return ControlFlow::Continue(Event::Step);
            }
            for i in 0..x.len() {
                x[i] = lcp.project(i, x[i] - lcp.row_w(i, x) / metric.diagonal[i], x);
            }
            ControlFlow::Continue(Event::Sweep)
        })
    }
}

/// H_i with its derivatives by x_i, w̃_i, lo_i and hi_i.
#[derive(Debug, Clone, Copy)]
struct Row {
    value: f64,
    by_x: f64,
    by_w: f64,
    by_lo: f64,
    by_hi: f64,
}

struct Run<'a> {
    lcp: &'a Lcp,
    metric: &'a Metric,
    equations: Equations,
}

impl Run<'_> {
    /// x + λ d with the first λ = 1, ½, ¼, … that reduces |H|² enough, if any does.
    fn newton_step(&self, x: &[f64]) -> Option<Vec<f64>> {
        let rows = self.rows(x);
        let square = self.square(&rows);
        let d = self.direction(x, &rows, square)?;
        let shorter = |k: i32| {
            let lambda = 0.5f64.powi(k);
            let next: Vec<f64> = x.iter().zip(&d).map(|(x, d)| x + lambda * d).collect();
            let enough = (1.0 - SUFFICIENT * lambda) * square;
            (self.square(&self.rows(&next)) <= enough).then_some(next)
        };
        (0..=HALVINGS).find_map(shorter)
    }

    fn rows(&self, x: &[f64]) -> Vec<Row> {
        let row = |i: usize| {
            let (lo, hi) = self.lcp.bounds(i, x);
            let w = self.lcp.row_w(i, x) / self.metric.diagonal[i];
            match self.equations {
                Equations::MinimumMap => minimum_map(x[i], w, lo, hi),
                Equations::FischerBurmeister => fischer_burmeister(x[i], w, lo, hi),
            }
        };
        (0..x.len()).map(row).collect()
    }

    /// Σ a_ii H_i².
    fn square(&self, rows: &[Row]) -> f64 {
        rows.iter().enumerate().map(|(i, row)| self.metric.diagonal[i] * row.value.powi(2)).sum()
    }

    /// The least-squares solution of J d = −H, √ν d = 0, in the variables √a_ii x_i.
    fn direction(&self, x: &[f64], rows: &[Row], square: f64) -> Option<Vec<f64>> {
        let n = x.len();
        let root: Vec<f64> = (0..n).map(|i| self.metric.diagonal[i].sqrt()).collect();
        let start: f64 = (0..n).map(|i| (self.lcp.b()[i] / root[i]).powi(2)).sum();
        let reduction = if start > 0.0 { (square / start).min(1.0) } else { 1.0 };
        let damping = (DAMPING * reduction).max(LEAST_DAMPING).sqrt(); // √ν
        let mut j = Mat::<f64>::zeros(2 * n, n);
        let mut rhs = Mat::<f64>::zeros(2 * n, 1);
        for (i, row) in rows.iter().enumerate() {
            rhs[(i, 0)] = -root[i] * row.value;
            j[(n + i, i)] = damping;
            if row.by_w != 0.0 {
                for (k, a) in self.lcp.matrix().row(i).iter() {
                    j[(i, k)] += row.by_w * a / root[i] / root[k];
                }
            }
            j[(i, i)] += row.by_x;
            if let Some((k, slope)) = self.bound_slope(i, x) {
                j[(i, k)] += slope * (row.by_hi - row.by_lo) * root[i] / root[k];
            }
        }
        let solution = j.qr().solve_lstsq(&rhs);
        let d: Vec<f64> = (0..n).map(|i| solution[(i, 0)] / root[i]).collect();
        d.iter().all(|d| d.is_finite()).then_some(d)
    }

    /// For a coupled row the row k that bounds it and the derivative of hi_i = −lo_i by x_k.
    fn bound_slope(&self, i: usize, x: &[f64]) -> Option<(usize, f64)> {
        let coupling = self.lcp.coupling()?;
        let k = coupling.index(i)?;
        Some((k, if x[k] > 0.0 { coupling.mu(i) } else { 0.0 }))
    }
}

fn minimum_map(x: f64, w: f64, lo: f64, hi: f64) -> Row {
    let row = |value, by_x, by_w, by_lo, by_hi| Row { value, by_x, by_w, by_lo, by_hi };
    if w.min(x - lo) < x - hi {
        row(x - hi, 1.0, 0.0, 0.0, -1.0)
    } else if w < x - lo {
        row(w, 0.0, 1.0, 0.0, 0.0)
    } else {
        row(x - lo, 1.0, 0.0, -1.0, 0.0)
    }
}

fn fischer_burmeister(x: f64, w: f64, lo: f64, hi: f64) -> Row {
    let [inner, p, q] = phi(hi - x, -w);
    let [value, a, b] = phi(x - lo, -inner);
    Row { value, by_x: a + b * p, by_w: b * q, by_lo: -a, by_hi: -b * p }
}

/// φ(a, b) = a + b − √(a² + b²) with its derivatives; at (0, 0) those of the diagonal a = b.
fn phi(a: f64, b: f64) -> [f64; 3] {
    if a == f64::INFINITY {
        return [b, 0.0, 1.0];
    }
    let r = a.hypot(b);
    if r == 0.0 {
        let slope = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
        return [0.0, slope, slope];
    }
    // a + b − r loses all digits where one of them is small and the other positive
    let value = if a + b > 0.0 { 2.0 * a * b / (a + b + r) } else { a + b - r };
    [value, 1.0 - a / r, 1.0 - b / r]
}
