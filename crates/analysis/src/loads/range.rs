//! The forces that cause the same motion as an answer, and the range of a linear function of them.
//!
//! ```text
//! Jᵀ y = Jᵀ x            the same motion, so the same w
//! lo ≤ y_i ≤ hi          where w_i may be 0; y_i = x_i elsewhere
//! |y_i| ≤ μ y_k          a friction row that may stick; y_i = ± μ y_k if it slides
//! ```
//!
//! All of them are answers if x is one. x is seldom exact, so its w is not either: with the bound e
//! on the error of the motion in the energy norm, w_i is wrong by at most e √a_ii. A larger w_i is
//! not 0 in the exact motion; a smaller one counts as 0, and the force of its row is free.
//!
//! Two linear programs give the least and the largest value of a function, and a quadratic program
//! the y with the smallest Σ y². They are solved in double precision by clarabel. x itself is
//! always one of the y: its own violations of bounds are allowed.

use lcplab_lcp::{Gauss, Lcp, Question};
use lcplab_page::number::readable;

use super::Range;
use crate::motion_error::MotionError;

/// Larger problems are not examined.
const MAX_ROWS: usize = 300;
/// The largest motion error, relative to the change that the constraints cause.
const MOST_ERROR: f64 = 1e-4;
/// A range that is shorter than this part of the largest force is a single value.
const UNIQUE: f64 = 1e-6;
/// Part of a row's terms below which w may be 0: b contains the gap, a difference of positions that
/// are rounded, divided by the time step.
const ROUNDING: f64 = 1e-12;

/// A row of a program: entries, and a right-hand side.
type Line = (Vec<(usize, f64)>, f64);

/// The set of forces, scaled to a largest entry of 1.
pub(super) struct Ranges {
    n: usize,
    scale: f64,
    equations: Vec<Line>,
    /// Lines g with gᵀy ≤ h.
    inequalities: Vec<Line>,
    /// The y with the smallest Σ y².
    least_norm: Vec<f64>,
}

impl Ranges {
    /// # Errors
    /// With the reason, if the problem is too large, x is 0 or not accurate enough, or the program
    /// is not solved.
    pub(super) fn of(question: &Question, x: &[f64]) -> Result<Self, String> {
        let (Some(lcp), Some(gauss)) = (question.boxed(), &question.problem().motion) else {
            return Err("the problem states no motion".into());
        };
        if lcp.len() > MAX_ROWS {
            return Err(format!("the problem has more than {MAX_ROWS} rows"));
        }
        let scale = x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        if !(scale > 0.0 && scale.is_finite()) {
            return Err("no force acts".into());
        }
        let error = error(question, x)?;
        let (equations, inequalities) = (motion(gauss, x, scale), Vec::new());
        let mut set =
            Ranges { n: lcp.len(), scale, equations, inequalities, least_norm: Vec::new() };
        let w = lcp.w(x);
        for i in 0..lcp.len() {
            let terms: f64 = lcp.matrix().row(i).iter().map(|(j, a)| (a * x[j]).abs()).sum();
            let rounding = ROUNDING * (terms + lcp.b()[i].abs());
            let may_be_zero = w[i].abs() <= error * lcp.matrix().diagonal(i).sqrt() + rounding;
            set.bound(lcp, i, x, if may_be_zero { 0.0 } else { w[i] });
            // Compliance makes a force unique: w = J u + γ x.
            if gauss.compliance[i] > 0.0 {
                set.equations.push((vec![(i, 1.0)], x[i] / scale));
            }
        }
        let least_norm = solve(&set, &vec![0.0; set.n], 1.0);
        set.least_norm = least_norm.ok_or("the least-norm forces were not found")?;
        Ok(set)
    }

    /// The bounds of row i; those that x violates reach to x.
    fn bound(&mut self, lcp: &Lcp, i: usize, x: &[f64], w: f64) {
        let y = |i: usize| x[i] / self.scale;
        let coupled = lcp.coupled_to(i).filter(|(_, mu)| *mu > 0.0);
        match coupled {
            Some((k, mu)) if w != 0.0 => {
                let side = if w > 0.0 { mu } else { -mu };
                self.equations.push((vec![(i, 1.0), (k, side)], y(i) + side * y(k)));
            }
            Some((k, mu)) => {
                for sign in [1.0, -1.0] {
                    let reached = (sign * y(i) - mu * y(k)).max(0.0);
                    self.inequalities.push((vec![(i, sign), (k, -mu)], reached));
                }
            }
            None if w != 0.0 || lcp.is_coupled(i) => self.equations.push((vec![(i, 1.0)], y(i))),
            None => {
                let (lo, hi) = (lcp.lo()[i] / self.scale, lcp.hi()[i] / self.scale);
                if lo.is_finite() {
                    self.inequalities.push((vec![(i, -1.0)], -lo.min(y(i))));
                }
                if hi.is_finite() {
                    self.inequalities.push((vec![(i, 1.0)], hi.max(y(i))));
                }
            }
        }
    }

    /// The range of a linear function of the forces.
    pub(super) fn range(&self, function: &[(usize, f64)]) -> Option<Range> {
        let mut cost = vec![0.0; self.n];
        function.iter().for_each(|(i, value)| cost[*i] += value);
        let value = |y: &[f64]| y.iter().zip(&cost).map(|(y, c)| y * c).sum::<f64>() * self.scale;
        let least = value(&solve(self, &cost, 0.0)?);
        let opposite: Vec<f64> = cost.iter().map(|c| -c).collect();
        let most = value(&solve(self, &opposite, 0.0)?);
        let size = function.iter().fold(0.0, |most: f64, (_, value)| most.max(value.abs()));
        let is_unique = most - least <= UNIQUE * self.scale * size;
        Some(Range { least, most, least_norm: value(&self.least_norm), is_unique })
    }
}

/// The bound on the error of x's motion in the energy norm.
fn error(question: &Question, x: &[f64]) -> Result<f64, String> {
    let error = MotionError::of(question, x).ok_or("the problem states no motion")??;
    let part = error.relative();
    if part <= MOST_ERROR {
        return Ok(error.bound);
    }
    Err(format!(
        "they need an answer whose motion error is at most {} of the change that the constraints cause; it is {}",
        readable(MOST_ERROR, 2),
        readable(part, 2)
    ))
}

/// Jᵀ y = Jᵀ x, each equation scaled to a largest entry of 1.
fn motion(gauss: &Gauss, x: &[f64], scale: f64) -> Vec<Line> {
    let mut lines = vec![Vec::new(); gauss.target.len()];
    for (i, row) in gauss.jacobian.iter().enumerate() {
        row.iter().for_each(|&(column, value)| lines[column].push((i, value)));
    }
    let line = |entries: Vec<(usize, f64)>| {
        let size = entries.iter().fold(0.0, |most: f64, (_, value)| most.max(value.abs()));
        let entries: Vec<_> = entries.into_iter().map(|(i, value)| (i, value / size)).collect();
        let right = entries.iter().map(|(i, value)| value * x[*i] / scale).sum();
        (entries, right)
    };
    lines.into_iter().filter(|entries| entries.iter().any(|e| e.1 != 0.0)).map(line).collect()
}

/// The y of the set with the smallest `cost`ᵀ y + `square` Σ y² / 2.
#[cfg(feature = "clarabel")]
fn solve(set: &Ranges, cost: &[f64], square: f64) -> Option<Vec<f64>> {
    use ::clarabel::algebra::CscMatrix;
    use ::clarabel::solver::{
        DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus, SupportedConeT,
    };
    let n = set.n;
    let triplets = |lines: &[&Line]| {
        let (mut i, mut j, mut v) = (Vec::new(), Vec::new(), Vec::new());
        for (row, (entries, _)) in lines.iter().enumerate() {
            for &(column, value) in entries {
                i.push(row);
                j.push(column);
                v.push(value);
            }
        }
        CscMatrix::new_from_triplets(lines.len(), n, i, j, v)
    };
    let lines: Vec<&Line> = set.equations.iter().chain(&set.inequalities).collect();
    let right: Vec<f64> = lines.iter().map(|line| line.1).collect();
    let diagonal: Vec<Line> = (0..n).map(|i| (vec![(i, square)], 0.0)).collect();
    let quadratic = triplets(&diagonal.iter().collect::<Vec<_>>());
    let cones = [
        SupportedConeT::ZeroConeT(set.equations.len()),
        SupportedConeT::NonnegativeConeT(set.inequalities.len()),
    ];
    let settings = DefaultSettingsBuilder::default().verbose(false).build().ok()?;
    let solver = DefaultSolver::new(&quadratic, cost, &triplets(&lines), &right, &cones, settings);
    let mut solver = solver.ok()?;
    solver.solve();
    (solver.solution.status == SolverStatus::Solved).then(|| solver.solution.x.clone())
}

#[cfg(not(feature = "clarabel"))]
fn solve(_: &Ranges, _: &[f64], _: f64) -> Option<Vec<f64>> {
    None
}
