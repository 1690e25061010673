//! Solvers compared with clarabel on one problem: an answer that the judge rejects is not timed.

use std::hint::black_box;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId};
use lcplab::judge::{Demand, Verdict, judge};
use lcplab::lcp::Lcp;
use lcplab::reference::{Reference, box_qp_to};
use lcplab::solver::{Options, Registry, Settings, Solution, Start, Status};

/// The tolerances of gap and feasibility for clarabel, tried in order until x is accepted.
const ASKED: [f64; 5] = [1e-8, 1e-9, 1e-10, 1e-11, 1e-12];

pub type Group<'a> = BenchmarkGroup<'a, WallTime>;

/// The sizes to measure; only the first one in a run that tests the benchmarks.
pub fn sizes<T>(all: &[T]) -> &[T] {
    if std::env::args().any(|argument| argument == "--test") { &all[..1] } else { all }
}

/// Whether the judge accepts x.
fn is_right(lcp: &Lcp, x: &[f64], tolerance: f64) -> bool {
    let demand = Demand { tolerance, prove_up_to: 0 };
    !matches!(judge(lcp, x, &demand).verdict, Verdict::NotASolution { .. })
}

/// Times a method of ours, if its answer is right.
pub fn ours(
    group: &mut Group,
    name: &str,
    problem: &str,
    lcp: &Lcp,
    tolerance: f64,
    run: impl Fn() -> Solution,
) {
    let first = run();
    if first.status != Status::Solved || !is_right(lcp, &first.x, tolerance) {
        println!("{name}, {problem}: no answer, {}", first.status);
        return;
    }
    group.bench_function(BenchmarkId::new(name, problem), |bencher| bencher.iter(&run));
}

/// Times clarabel with the loosest tolerance that the judge accepts.
pub fn clarabel(
    group: &mut Group,
    name: &str,
    problem: &str,
    lcp: &Lcp,
    tolerance: f64,
    ask: impl Fn(f64) -> Option<Reference>,
) {
    let is_enough = |asked: &f64| {
        ask(*asked).is_some_and(|found| found.solved && is_right(lcp, &found.point, tolerance))
    };
    let Some(asked) = ASKED.into_iter().find(is_enough) else {
        println!("{name}, {problem}: no answer");
        return;
    };
    let id = BenchmarkId::new(name, problem);
    group.bench_function(id, |bencher| bencher.iter(|| ask(black_box(asked))));
}

/// Times clarabel and solvers of the registry.
#[allow(dead_code, reason = "not all benchmarks use it")]
pub fn all(group: &mut Group, problem: &str, lcp: &Lcp, tolerance: f64, solvers: &[&str]) {
    clarabel(group, "clarabel", problem, lcp, tolerance, |asked| box_qp_to(lcp, asked));
    let settings = Settings::default().with_tolerance(tolerance);
    let options = Options::default().with_settings(settings);
    for name in solvers {
        let solver = Registry::standard().entry(name).expect("a solver").build(&options);
        let solve = || solver.solve(black_box(lcp), &Start::default(), &mut ());
        ours(group, name, problem, lcp, tolerance, solve);
    }
}
