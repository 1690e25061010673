//! Clarabel on the LCP as a quadratic program over a box, with each of its two factorizations.
//!
//! ```text
//! minimize ½ xᵀA x + bᵀx   subject to   lo ≤ x ≤ hi
//! ```

use std::time::Instant;

use clarabel::algebra::CscMatrix;
use clarabel::solver::SupportedConeT::NonnegativeConeT;
use clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus};
use lcplab::lcp::{Lcp, merit};

use crate::contender::{Contender, Run};
use crate::ours::TOLERANCE;

/// The tolerances of gap and feasibility that are tried until its residual is as small as ours.
const ASKED: [f64; 3] = [1e-8, 1e-10, 1e-12];

/// A program in its form: min ½ xᵀP x + qᵀx, G x ≤ h.
struct Program {
    p: CscMatrix,
    q: Vec<f64>,
    g: CscMatrix,
    h: Vec<f64>,
}

/// Clarabel's own factorization and faer's.
pub fn solvers<'a>(lcp: &Lcp) -> Vec<Contender<'a>> {
    let names = [("clarabel, qdldl", "qdldl"), ("clarabel, faer", "faer")];
    names.map(|(name, method)| contender(name, method, lcp)).into()
}

fn contender<'a>(name: &str, method: &'static str, lcp: &Lcp) -> Contender<'a> {
    let program = Program::of(lcp);
    let is_enough =
        |asked: &f64| merit::scaled_residual(lcp, &program.solve(method, *asked).x) <= TOLERANCE;
    let asked = ASKED.into_iter().find(is_enough).unwrap_or(ASKED[0]);
    Contender::peer(name, move || program.solve(method, asked))
}

impl Program {
    fn of(lcp: &Lcp) -> Program {
        let n = lcp.len();
        let upper = |i: usize| lcp.matrix().row(i).iter().filter(move |&(j, _)| j >= i);
        let entries = (0..n).flat_map(|i| upper(i).map(move |(j, a)| (i, j, a)));
        let lower = (0..n).map(|i| (i, -1.0, -lcp.lo()[i]));
        let bounds = lower.chain((0..n).map(|i| (i, 1.0, lcp.hi()[i])));
        let bounds: Vec<_> = bounds.filter(|(_, _, h)| h.is_finite()).collect();
        let sides = bounds.iter().enumerate().map(|(row, &(i, sign, _))| (row, i, sign));
        Program {
            p: columns(n, n, entries),
            q: lcp.b().to_vec(),
            g: columns(bounds.len(), n, sides),
            h: bounds.iter().map(|(_, _, h)| *h).collect(),
        }
    }

    fn solve(&self, method: &str, asked: f64) -> Run {
        let start = Instant::now();
        let settings = DefaultSettingsBuilder::default()
            .verbose(false)
            .max_threads(1)
            .direct_solve_method(method.to_string())
            .tol_gap_abs(asked)
            .tol_gap_rel(asked)
            .tol_feas(asked)
            .build();
        let cones = [NonnegativeConeT(self.h.len())];
        let solver = settings.map_err(|error| error.to_string()).and_then(|settings| {
            DefaultSolver::new(&self.p, &self.q, &self.g, &self.h, &cones, settings)
                .map_err(|error| error.to_string())
        });
        match solver {
            Ok(mut solver) => {
                solver.solve();
                let seconds = start.elapsed().as_secs_f64();
                let complaint = match solver.solution.status {
                    SolverStatus::Solved | SolverStatus::AlmostSolved => None,
                    status => Some(format!("{status:?}")),
                };
                Run { seconds, x: solver.solution.x, complaint }
            }
            Err(complaint) => {
                let seconds = start.elapsed().as_secs_f64();
                Run { seconds, x: vec![f64::NAN; self.q.len()], complaint: Some(complaint) }
            }
        }
    }
}

fn columns(rows: usize, n: usize, entries: impl Iterator<Item = (usize, usize, f64)>) -> CscMatrix {
    let (mut i, mut j, mut v) = (Vec::new(), Vec::new(), Vec::new());
    for (row, column, value) in entries {
        i.push(row);
        j.push(column);
        v.push(value);
    }
    CscMatrix::new_from_triplets(rows, n, i, j, v)
}
