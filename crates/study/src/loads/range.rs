//! The forces that cause the same motion as an answer, and the range of a linear function of them.
//!
//! ```text
//! Jᵀ y = Jᵀ x            the same motion, so the same w
//! lo ≤ y_i ≤ hi          where w_i = 0; y_i = x_i elsewhere
//! |y_i| ≤ μ y_k          a friction row that does not slide; y_i = ± μ y_k if it slides
//! ```
//!
//! All of them are exact answers if x is one. Two linear programs give the least and the largest
//! value of a function, and a quadratic program the y with the smallest Σ y². They are solved in
//! double precision by clarabel.

use lcplab_problem::{Gauss, Lcp};

use super::Range;

/// Larger problems are not examined.
const MAX_ROWS: usize = 300;
/// Relative size below which a w counts as 0.
const ROUNDING: f64 = 1e-9;

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
    /// `None` if the problem is too large, or x is 0 or no answer to it.
    pub(super) fn of(lcp: &Lcp, gauss: &Gauss, x: &[f64]) -> Option<Self> {
        let scale = x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        if lcp.len() > MAX_ROWS || !(scale > 0.0 && scale.is_finite()) {
            return None;
        }
        let (equations, inequalities) = (motion(gauss, x, scale), Vec::new());
        let mut set =
            Ranges { n: lcp.len(), scale, equations, inequalities, least_norm: Vec::new() };
        let w = lcp.w(x);
        for i in 0..lcp.len() {
            let terms: f64 = lcp.matrix().row(i).iter().map(|(j, a)| (a * x[j]).abs()).sum();
            let is_zero = w[i].abs() <= ROUNDING * (terms + lcp.b()[i].abs());
            set.bound(lcp, i, x[i] / scale, if is_zero { 0.0 } else { w[i] });
            // Compliance makes a force unique: w = J u + γ x.
            if gauss.compliance[i] > 0.0 {
                set.equations.push((vec![(i, 1.0)], x[i] / scale));
            }
        }
        set.least_norm = solve(&set, &vec![0.0; set.n], 1.0)?;
        Some(set)
    }

    /// The bounds of row i, whose x is y here.
    fn bound(&mut self, lcp: &Lcp, i: usize, y: f64, w: f64) {
        let coupled = lcp.coupled_to(i).filter(|(_, mu)| *mu > 0.0);
        match coupled {
            Some((k, mu)) if w != 0.0 => {
                let side = if w > 0.0 { mu } else { -mu };
                self.equations.push((vec![(i, 1.0), (k, side)], 0.0));
            }
            Some((k, mu)) => {
                for sign in [1.0, -1.0] {
                    self.inequalities.push((vec![(i, sign), (k, -mu)], 0.0));
                }
            }
            None if w != 0.0 || lcp.is_coupled(i) => self.equations.push((vec![(i, 1.0)], y)),
            None => {
                let (lo, hi) = (lcp.lo()[i] / self.scale, lcp.hi()[i] / self.scale);
                if lo.is_finite() {
                    self.inequalities.push((vec![(i, -1.0)], -lo));
                }
                if hi.is_finite() {
                    self.inequalities.push((vec![(i, 1.0)], hi));
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
        Some(Range { least, most, least_norm: value(&self.least_norm) })
    }
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
    let is_solved =
        matches!(solver.solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved);
    is_solved.then(|| solver.solution.x.clone())
}

#[cfg(not(feature = "clarabel"))]
fn solve(_: &Ranges, _: &[f64], _: f64) -> Option<Vec<f64>> {
    None
}
