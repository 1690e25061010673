//! Solvers without a status: with a planted mistake, without one, and an exact one.

use lcplab_lcp::Lcp;
use lcplab_lcp::exact::all_solutions;
use lcplab_solver::{Observer, Solution, Solver, Start, Status};

/// A solver that returns x and no status, as most plug-ins do: projected Gauss-Seidel with one
/// mistake, or none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sweeps {
    /// Correct.
    Right,
    /// µ² instead of µ.
    MuSquared,
    /// Friction bounds from the x after the first sweep.
    FirstBound,
    /// Each increment clamped at the bounds, instead of their sum.
    ClampedIncrements,
    /// Friction bounds from the row after the normal.
    NextIndex,
    /// µ / √2 instead of µ.
    OverRootTwo,
}

pub const BUGS: [Sweeps; 5] = [
    Sweeps::MuSquared,
    Sweeps::FirstBound,
    Sweeps::ClampedIncrements,
    Sweeps::NextIndex,
    Sweeps::OverRootTwo,
];

impl Sweeps {
    /// x after this number of sweeps.
    pub fn swept(self, lcp: &Lcp, sweeps: usize) -> Vec<f64> {
        let n = lcp.len();
        let (mut x, mut first) = (vec![0.0; n], vec![0.0; n]);
        for sweep in 0..sweeps {
            for i in 0..n {
                let (lo, hi) = self.bounds(lcp, i, if sweep == 0 { &x } else { &first }, &x);
                let step = -lcp.row_w(i, &x) / lcp.matrix().diagonal(i);
                x[i] = match self {
                    Sweeps::ClampedIncrements => x[i] + step.max(lo).min(hi),
                    _ => (x[i] + step).max(lo).min(hi),
                };
            }
            if sweep == 0 {
                first.clone_from(&x);
            }
        }
        x
    }

    fn bounds(self, lcp: &Lcp, i: usize, first: &[f64], x: &[f64]) -> (f64, f64) {
        let Some((k, mu)) = lcp.coupled_to(i) else { return (lcp.lo()[i], lcp.hi()[i]) };
        let most = match self {
            Sweeps::MuSquared => mu * mu * x[k].max(0.0),
            Sweeps::FirstBound => mu * first[k].max(0.0),
            Sweeps::NextIndex => mu * x[k + 1].max(0.0),
            Sweeps::OverRootTwo => mu / 2f64.sqrt() * x[k].max(0.0),
            Sweeps::Right | Sweeps::ClampedIncrements => mu * x[k].max(0.0),
        };
        (-most, most)
    }
}

/// A solver that does this number of sweeps and returns x without a status; `says` is the number
/// that it reports, if any.
pub struct Engine {
    pub sweeps: Sweeps,
    pub count: usize,
    pub says: bool,
}

impl Solver for Engine {
    fn name(&self) -> &str {
        "engine"
    }

    fn solve(&self, lcp: &Lcp, _: &Start<'_>, _: &mut dyn Observer) -> Solution {
        let x = self.sweeps.swept(lcp, self.count);
        let status = match x.iter().all(|x| x.is_finite()) {
            true => Status::Solved,
            false => return Solution::new(lcp, vec![0.0; lcp.len()], Status::NotFinite, 1),
        };
        let iterations = if self.says { self.count } else { 1 };
        Solution::new(lcp, x, status, iterations).with_implied_claim(true)
    }
}

/// The first exact solution, rounded, without a status; no answer if there is none.
pub struct Exact;

impl Solver for Exact {
    fn name(&self) -> &str {
        "exact"
    }

    fn solve(&self, lcp: &Lcp, _: &Start<'_>, _: &mut dyn Observer) -> Solution {
        match all_solutions(lcp).and_then(|all| all.into_iter().next()) {
            Some(x) => {
                let x = x.iter().map(|x| x.to_f64().value()).collect();
                Solution::new(lcp, x, Status::Solved, 1).with_implied_claim(true)
            }
            None => Solution::new(lcp, vec![0.0; lcp.len()], Status::IterationLimit, 1),
        }
    }
}
