//! What do direct and Newton-like methods cost on definite problems and on a large net, compared
//! with clarabel, and how much does a start from the last active set save?

mod contest;

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use lcplab::error::Result;
use lcplab::lcp::Lcp;
use lcplab::solver::{BlockPivoting, Settings, Solution, Solver, Start, Warm};
use lcplab_benches::problems::{Bounds, posed};

const SOLVERS: [&str; 5] = ["dantzig", "block-pivoting", "lemke", "newton", "interior-point"];
const CONDITION: f64 = 400.0;
const TOLERANCE: f64 = 1e-9;

fn definite(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("definite");
    group.sample_size(10).measurement_time(Duration::from_secs(1));
    let one_sided = contest::sizes(&[50, 100, 200, 500, 1000]).iter();
    let two_sided = contest::sizes(&[50, 100, 200, 500]).iter();
    let problems = one_sided.map(|&n| (Bounds::OneSided, n));
    for (bounds, n) in problems.chain(two_sided.map(|&n| (Bounds::TwoSided, n))) {
        let lcp = bounds.lcp(n, CONDITION).expect("a problem");
        contest::all(&mut group, &bounds.problem(n), &lcp, TOLERANCE, &SOLVERS);
    }
}

/// b changes by about a hundredth, and the active set of the answer does not: block pivoting from a
/// cold start, and with the active set and factor of the previous problem.
fn warm_factor(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("block pivoting, b moved");
    group.sample_size(10).measurement_time(Duration::from_secs(1));
    let settings = Settings::default().with_tolerance(TOLERANCE);
    let solver = BlockPivoting { settings, ..BlockPivoting::default() };
    for &n in contest::sizes(&[200, 500, 1000]) {
        let before = Bounds::OneSided.lcp(n, CONDITION).expect("a problem");
        let (kept, cold) = (Warm::default(), Start::default());
        let warm = Start { warm: Some(&kept), ..cold };
        let now = moved(&before, &solver.solve(&before, &warm, &mut ())).expect("a problem");
        for (name, start) in [("cold", cold), ("warm", warm)] {
            let solve = || solver.solve(black_box(&now), &start, &mut ());
            contest::ours(&mut group, name, &n.to_string(), &now, TOLERANCE, solve);
        }
    }
}

/// The problem whose b belongs to a slightly changed x and w, with the same active set by
/// construction.
fn moved(lcp: &Lcp, answer: &Solution) -> Result<Lcp> {
    const CHANGE: f64 = 0.01;
    let mut random = oorandom::Rand64::new(1);
    let mut part = || 1.0 + CHANGE * (2.0 * random.rand_float() - 1.0);
    let x: Vec<f64> = answer.x.iter().map(|x| x * part()).collect();
    let b = (0..lcp.len()).map(|i| {
        let w = if x[i] > 0.0 { 0.0 } else { answer.w[i] * part() };
        w - lcp.matrix().row_dot(i, &x)
    });
    lcp.with_b(b.collect())
}

/// A large sparse A: a net, one row a rod.
fn net(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("net");
    group.sample_size(10).measurement_time(Duration::from_secs(5));
    let posed = posed("net", 3).expect("a step");
    contest::all(&mut group, "net", &posed.lcp, 2e-7, &["interior-point"]);
}

criterion_group!(benches, definite, net, warm_factor);
criterion_main!(benches);
