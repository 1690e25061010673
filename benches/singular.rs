//! What does an exact answer cost where contacts are redundant? Stacks of cubes with a contact at each
//! corner, with and without friction, singular and regularised by 1e-8 of the mean diagonal; our solvers
//! beside clarabel, at the tolerances that each needs to be right to about 1e-9.

#![allow(missing_docs)]

mod measure;

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, SupportedConeT};
use lcplab::certificate::{Demand, judge};
use lcplab::lcp::{Lcp, Matrix, library, merit};
use lcplab::solver::{Options, Settings, Start, Status, by_name};
use measure::{Contender, interleaved, timed};
use std::time::Instant;

const TOLERANCE: f64 = 1e-9;
/// Of clarabel's gap and feasibility, as in its own benchmarks.
const CLARABEL: f64 = 1e-8;
/// Seconds to spend on a problem.
const BUDGET: f64 = 2.0;
/// A run longer than this (s) is not repeated.
const LONG: f64 = 0.1;
const SOLVERS: [&str; 3] = ["interior-point", "dantzig", "lemke"];

fn main() {
    println!(
        "| problem | solver | median (µs) | best (µs) | scaled residual | times as fast as clarabel |"
    );
    println!("|---|---|---|---|---|---|");
    for mu in [0.0, 0.5] {
        for boxes in [5, 10, 20, 50] {
            for regularised in [false, true] {
                let family = library::by_name("box-stack").expect("a family");
                let given = [("boxes", f64::from(boxes)), ("mu", mu)];
                let lcp = family.generate(&given).expect("values in range").lcp;
                let kind = if mu > 0.0 { "friction" } else { "stack" };
                let name =
                    format!("{kind} {boxes}{}", if regularised { ", regularised" } else { "" });
                compare(&name, &if regularised { with_compliance(&lcp) } else { lcp });
            }
        }
    }
}

/// A + 1e-8 of its mean diagonal.
fn with_compliance(lcp: &Lcp) -> Lcp {
    let n = lcp.len();
    let gamma = 1e-8 * (0..n).map(|i| lcp.matrix().diagonal(i)).sum::<f64>() / n as f64;
    let entries = (0..n).flat_map(|i| lcp.matrix().row(i).iter().map(move |(j, a)| (i, j, a)));
    let added = (0..n).map(|i| (i, i, gamma));
    let matrix = Matrix::sparse(n, &entries.chain(added).collect::<Vec<_>>());
    Lcp::new(matrix, lcp.b().to_vec(), lcp.lo().to_vec(), lcp.hi().to_vec())
        .expect("valid as before")
}

fn compare(problem: &str, lcp: &Lcp) {
    let settings = Settings { tolerance: TOLERANCE, ..Settings::default() };
    let options = Options { settings, ..Options::default() };
    let solvers = SOLVERS.map(|name| by_name(name, &options).expect("a solver"));
    let mut contenders = vec![Contender::new("clarabel", || timed(|| drop(clarabel(lcp))))];
    let mut residuals = vec![merit::scaled_residual(lcp, &clarabel(lcp))];
    let mut spent = timed(|| drop(clarabel(lcp)));
    for solver in &solvers {
        let start = Instant::now();
        let solution = solver.solve(lcp, &Start::default(), &mut ());
        let once = start.elapsed().as_secs_f64();
        let demand = Demand { tolerance: TOLERANCE, prove_up_to: 0 };
        if solution.status != Status::Solved {
            println!("| {problem} | {} | **fails** ({}) | | | |", solver.name(), solution.status);
            continue;
        }
        let verdict = judge(lcp, &solution.x, &demand).verdict;
        assert!(verdict.is_solution(), "{} claims what is {verdict}", solver.name());
        if once > LONG {
            println!("| {problem} | {} | one run: {:.0} | | | |", solver.name(), 1e6 * once);
            continue;
        }
        spent += once;
        let run = || timed(|| drop(solver.solve(lcp, &Start::default(), &mut ())));
        contenders.push(Contender::new(solver.name(), run));
        residuals.push(merit::scaled_residual(lcp, &solution.x));
    }
    let rounds = (BUDGET / spent) as usize;
    let times = interleaved(rounds.clamp(3, 101), &mut contenders);
    for ((contender, time), residual) in contenders.iter().zip(&times).zip(&residuals) {
        let (median, best) = (times[0].median / time.median, times[0].best / time.best);
        println!(
            "| {problem} | {} | {:.0} | {:.0} | {residual:.0e} | {median:.2}, {best:.2} |",
            contender.name,
            1e6 * time.median,
            1e6 * time.best,
        );
    }
}

/// The quadratic program over the box, by clarabel, setup included.
fn clarabel(lcp: &Lcp) -> Vec<f64> {
    let n = lcp.len();
    let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
    for column in 0..n {
        for (row, a) in lcp.matrix().row(column).iter().filter(|&(row, _)| row <= column) {
            rows.push(row);
            values.push(a);
        }
        starts.push(rows.len());
    }
    let quadratic = CscMatrix::new(n, n, starts, rows, values);
    let bounds = [(-1.0, lcp.lo()), (1.0, lcp.hi())];
    let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
    let mut right = Vec::new();
    for i in 0..n {
        for (sign, bound) in bounds.iter().filter(|(_, bound)| bound[i].is_finite()) {
            rows.push(right.len());
            values.push(*sign);
            right.push(sign * bound[i]);
        }
        starts.push(rows.len());
    }
    let within = CscMatrix::new(right.len(), n, starts, rows, values);
    let cones = [SupportedConeT::NonnegativeConeT(right.len())];
    let settings = DefaultSettingsBuilder::default()
        .verbose(false)
        .tol_gap_abs(CLARABEL)
        .tol_gap_rel(CLARABEL)
        .tol_feas(CLARABEL)
        .max_threads(1)
        .build()
        .expect("valid settings");
    let mut solver = DefaultSolver::new(&quadratic, lcp.b(), &within, &right, &cones, settings)
        .expect("a valid program");
    solver.solve();
    solver.solution.x.clone()
}
