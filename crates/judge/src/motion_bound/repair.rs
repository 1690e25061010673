//! Finds a motion near u(x) that satisfies the rows, in plain floating point.

use faer::{Mat, Side};

use super::scaled::Scaled;
use crate::interval::Interval;

/// An eigenvalue below this fraction of the largest counts as zero.
const RELATIVE_ZERO: f64 = 1e-12;

pub(super) struct Repair<'a> {
    problem: &'a Scaled<'a>,
    /// The rows F that are moved to w = 0, ascending.
    rows: Vec<usize>,
    inverse: Option<PseudoInverse>,
    /// The impulses applied in each row so far.
    applied: Vec<f64>,
    /// u.
    pub(super) motion: Vec<f64>,
    /// u − u(x), approximately.
    pub(super) change: Vec<f64>,
}

impl<'a> Repair<'a> {
    /// Starts at u(x) with the rows that are free after a projected step: correct if x is nearly
    /// correct.
    pub(super) fn of_pushing(problem: &'a Scaled<'a>) -> Self {
        Self::with(problem, |i, u| pushes(problem, i, u))
    }

    /// Starts at u(x) with the rows whose x is strictly between its bounds.
    pub(super) fn of_loaded(problem: &'a Scaled<'a>) -> Self {
        let (x, lo, hi) = (problem.x, &problem.gauss.lo, &problem.gauss.hi);
        Self::with(problem, |i, _| lo[i] < x[i] && x[i] < hi[i])
    }

    fn with(problem: &'a Scaled<'a>, is_meant: impl Fn(usize, &[f64]) -> bool) -> Self {
        let motion = problem.motion();
        let change = vec![0.0; motion.len()];
        let rows = (0..problem.x.len()).filter(|&i| is_meant(i, &motion)).collect();
        let applied = vec![0.0; problem.x.len()];
        Repair { problem, rows, inverse: None, applied, motion, change }
    }

    /// Moves the rows F and the violated rows to w = 0; contacts to a margin above it, relative to
    /// the largest terms of their w.
    pub(super) fn improve(&mut self, w: &[Interval], violated: &[usize], margin: f64) {
        let problem = self.problem;
        let margin = margin * self.size();
        self.extend(violated.iter().copied());
        let missing = |&i: &usize| {
            let soft = problem.gauss.compliance[i] * self.applied[i];
            problem.open_side(i) * margin - w[i].middle() - soft
        };
        self.apply(self.rows.iter().map(missing).collect());
    }

    /// Opens all contacts at the same speed, the worst violation plus the margin: if the rows F
    /// were chosen wrongly, they may contradict each other.
    pub(super) fn lift(&mut self, w: &[Interval], violated: &[usize], margin: f64) {
        let problem = self.problem;
        let worst = violated.iter().map(|&i| w[i].magnitude()).fold(0.0, f64::max);
        if worst == 0.0 {
            return;
        }
        self.rows.clear();
        self.inverse = None;
        self.extend((0..w.len()).filter(|&i| problem.is_hard(i)));
        let speed = worst + margin * self.size();
        let missing = |&i: &usize| match problem.open_side(i) {
            0.0 => -w[i].middle(),
            side => side * speed,
        };
        self.apply(self.rows.iter().map(missing).collect());
    }

    /// The largest terms of a w in F.
    fn size(&self) -> f64 {
        self.rows.iter().map(|&i| self.problem.size(i, &self.motion)).fold(0.0, f64::max)
    }

    fn extend(&mut self, rows: impl Iterator<Item = usize>) {
        let before = self.rows.len();
        self.rows.extend(rows);
        self.rows.sort_unstable();
        self.rows.dedup();
        if self.rows.len() > before || self.inverse.is_none() {
            self.inverse = PseudoInverse::of(&self.problem.delassus(&self.rows));
        }
    }

    /// Changes w in the rows F by these amounts.
    fn apply(&mut self, missing: Vec<f64>) {
        let Some(inverse) = &self.inverse else { return };
        let y = inverse.times(&missing);
        for (&i, y) in self.rows.iter().zip(&y) {
            self.applied[i] += y;
        }
        for (j, du) in self.problem.response(&self.rows, &y).into_iter().enumerate() {
            self.motion[j] += du;
            self.change[j] += du;
        }
    }
}

/// Whether x_i − w_i/a_ii lies strictly between the bounds of row i.
fn pushes(problem: &Scaled<'_>, i: usize, u: &[f64]) -> bool {
    let (lo, hi) = (problem.gauss.lo[i], problem.gauss.hi[i]);
    let target = problem.x[i] - problem.w(i, u).middle() / problem.delassus(&[i])[(0, 0)];
    lo < target && target < hi
}

/// V Λ⁺ Vᵀ of a symmetric semidefinite matrix, scaled to a unit diagonal.
struct PseudoInverse {
    vectors: Mat<f64>,
    inverse_values: Vec<f64>,
    scales: Vec<f64>,
}

impl PseudoInverse {
    fn of(a: &Mat<f64>) -> Option<Self> {
        let n = a.nrows();
        if n == 0 {
            return None;
        }
        let scale = |i: usize| if a[(i, i)] > 0.0 { 1.0 / a[(i, i)].sqrt() } else { 1.0 };
        let scales: Vec<f64> = (0..n).map(scale).collect();
        let scaled = Mat::from_fn(n, n, |i, j| scales[i] * a[(i, j)] * scales[j]);
        let eigen = scaled.self_adjoint_eigen(Side::Lower).ok()?;
        let values: Vec<f64> = (0..n).map(|i| eigen.S()[i]).collect();
        let least = RELATIVE_ZERO * values.iter().copied().fold(0.0, f64::max);
        let inverse = |&value: &f64| if value > least { 1.0 / value } else { 0.0 };
        let inverse_values = values.iter().map(inverse).collect();
        Some(PseudoInverse { vectors: eigen.U().to_owned(), inverse_values, scales })
    }

    fn times(&self, r: &[f64]) -> Vec<f64> {
        let n = r.len();
        let v = &self.vectors;
        let along = |k: usize| (0..n).map(|i| v[(i, k)] * self.scales[i] * r[i]).sum::<f64>();
        let parts: Vec<f64> = (0..n).map(|k| self.inverse_values[k] * along(k)).collect();
        let entry = |i: usize| (0..n).map(|k| v[(i, k)] * parts[k]).sum::<f64>();
        (0..n).map(|i| self.scales[i] * entry(i)).collect()
    }
}
