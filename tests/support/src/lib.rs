//! What the tests of several crates share.

mod machine;
mod pile;

pub use machine::{EFFORTS, MECHANISMS, Machine, machine};
pub use pile::pile;

use std::ops::ControlFlow;

use lcplab_judge::{Certificate, Demand, Verdict, judge};
use lcplab_lcp::friction::{Contact, FrictionProblem};
use lcplab_lcp::{Coupling, Lcp, Matrix, merit};
use lcplab_solver::{Event, Iterate, Observer, Pgs, Settings, Solution, Solver, Start, StepDetail};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use proptest::test_runner::{Config, FileFailurePersistence, RngSeed};

/// ∞.
pub const INF: f64 = f64::INFINITY;

/// The configuration of every property test: failing cases are kept beside the tests, and every run
/// tries the same cases, unless PROPTEST_RNG_SEED names others. LCPLAB_CASES=1000 tries a thousand
/// times as many.
pub fn cases(count: u32) -> Config {
    let rng_seed = match Config::default().rng_seed {
        RngSeed::Random => RngSeed::Fixed(1),
        asked => asked,
    };
    Config {
        rng_seed,
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..Config::with_cases(count.saturating_mul(times()))
    }
}

/// How many times as many cases are wanted: `LCPLAB_CASES`, 1 without it.
fn times() -> u32 {
    std::env::var("LCPLAB_CASES").ok().and_then(|times| times.parse().ok()).unwrap_or(1)
}

/// A dense problem with bounds 0 and ∞.
pub fn contacts(rows: &[&[f64]], b: &[f64]) -> Lcp {
    boxed(rows, b, &vec![0.0; b.len()], &vec![INF; b.len()])
}

/// A dense problem.
pub fn boxed(rows: &[&[f64]], b: &[f64], lo: &[f64], hi: &[f64]) -> Lcp {
    let a = Matrix::dense(rows.len(), &rows.concat());
    Lcp::new(a, b.to_vec(), lo.to_vec(), hi.to_vec()).expect("a valid problem")
}

/// Keeps every iterate.
#[derive(Default)]
pub struct Iterates(pub Vec<Vec<f64>>);

impl Observer for Iterates {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        self.0.push(iterate.x.to_vec());
        ControlFlow::Continue(())
    }
}

/// All iterates of a solver from 0, the start first.
pub fn iterates(solver: &dyn Solver, lcp: &Lcp) -> Vec<Vec<f64>> {
    let mut iterates = Iterates::default();
    solver.solve(lcp, &Start::default(), &mut iterates);
    iterates.0
}

/// Keeps the events of a solve, and of its parts what a function takes of them.
struct Record<F, T> {
    events: Vec<Event>,
    take: Option<F>,
    taken: Vec<T>,
}

impl<T, F: FnMut(&StepDetail<'_>) -> Option<T>> Observer for Record<F, T> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        self.events.push(iterate.event);
        ControlFlow::Continue(())
    }

    fn wants_details(&self) -> bool {
        self.take.is_some()
    }

    fn part(&mut self, part: &StepDetail<'_>) {
        self.taken.extend(self.take.as_mut().and_then(|take| take(part)));
    }
}

/// The solution from 0 and the events of its iterates, without parts.
pub fn events(solver: &dyn Solver, lcp: &Lcp) -> (Solution, Vec<Event>) {
    let take: Option<fn(&StepDetail<'_>) -> Option<()>> = None;
    let mut record = Record { events: Vec::new(), take, taken: Vec::new() };
    (solver.solve(lcp, &Start::default(), &mut record), record.events)
}

/// The solution from 0, the events of its iterates, and what a function takes of its parts.
pub fn parts<T>(
    solver: &dyn Solver,
    lcp: &Lcp,
    take: impl FnMut(&StepDetail<'_>) -> Option<T>,
) -> (Solution, Vec<Event>, Vec<T>) {
    let mut record = Record { events: Vec::new(), take: Some(take), taken: Vec::new() };
    let solution = solver.solve(lcp, &Start::default(), &mut record);
    (solution, record.events, record.taken)
}

/// The objective of every iterate.
pub fn objectives(solver: &dyn Solver, lcp: &Lcp) -> Vec<f64> {
    iterates(solver, lcp).iter().map(|x| merit::objective(lcp, x)).collect()
}

/// tridiag(−1, 2, −1) with this first diagonal entry: a chain of rods for 2, a stack on the ground
/// for 1.
pub fn tridiagonal(n: usize, first: f64) -> Matrix {
    let diagonal = (0..n).map(|i| (i, i, if i == 0 { first } else { 2.0 }));
    let beside = (1..n).flat_map(|i| [(i, i - 1, -1.0), (i - 1, i, -1.0)]);
    Matrix::sparse(n, &diagonal.chain(beside).collect::<Vec<_>>())
}

/// n equal bodies at rest on each other, after one step of 1/60 s under gravity.
pub fn stack(n: usize) -> Lcp {
    let mut b = vec![0.0; n];
    b[0] = -9.81 / 60.0;
    Lcp::new(tridiagonal(n, 1.0), b, vec![0.0; n], vec![INF; n]).expect("a valid problem")
}

/// n equal rods in a line, all to be brought to these velocities: equations only.
pub fn chain(n: usize) -> Lcp {
    let b = (0..n).map(|i| (i as f64).sin()).collect();
    Lcp::new(tridiagonal(n, 2.0), b, vec![-INF; n], vec![INF; n]).expect("a valid problem")
}

/// The only notion of "correct": the judge accepts x.
#[track_caller]
pub fn assert_certified(lcp: &Lcp, x: &[f64]) -> Certificate {
    let certificate = judge(lcp, x, &Demand::default());
    assert!(certificate.verdict.is_solution(), "{} for x = {x:?}", certificate.verdict);
    certificate
}

/// The judge proves x exactly.
#[track_caller]
pub fn assert_proved(lcp: &Lcp, x: &[f64]) {
    let verdict = judge(lcp, x, &Demand::default()).verdict;
    assert!(matches!(verdict, Verdict::Proved { .. }), "{verdict} for x = {x:?}");
}

/// A problem whose solution was chosen first: x* and w* complementary, b = w* − A x*.
#[derive(Debug, Clone)]
pub struct Manufactured {
    /// The problem.
    pub lcp: Lcp,
    /// x*.
    pub x: Vec<f64>,
    /// w*.
    pub w: Vec<f64>,
}

/// Random boxed problems with A = JJᵀ + shift, J of `n` rows and `columns` columns; A is singular
/// for shift = 0 and fewer columns than rows. All numbers are small multiples of ¼, so x* is exact.
pub fn manufactured(n: usize, columns: usize, shift: f64) -> impl Strategy<Value = Manufactured> {
    let quarter = |range: std::ops::RangeInclusive<i32>| range.prop_map(|k| f64::from(k) / 4.0);
    let row = (0..4u8, quarter(1..=8), quarter(0..=8), quarter(-8..=8));
    let j = proptest::collection::vec(quarter(-4..=4), n * columns);
    (j, proptest::collection::vec(row, n)).prop_map(move |(j, rows)| {
        let j = DMatrix::from_vec(n, columns, j);
        let a = &j * j.transpose() + DMatrix::identity(n, n) * shift;
        let (mut lo, mut hi, mut x, mut w) = (vec![], vec![], vec![], vec![]);
        for (kind, width, slack, at) in rows {
            let (l, h) = match kind {
                0 => (-INF, INF),
                1 => (at, INF),
                _ => (at, at + width),
            };
            let (xi, wi) = match (kind, (slack * 4.0) as i32 % 3) {
                (0, _) => (at, 0.0),
                (1, 0) => (at, slack),
                (1, _) => (at + slack, 0.0),
                (_, 0) => (l, slack),
                (_, 1) => (h, -slack),
                _ => (l + width / 2.0, 0.0),
            };
            lo.push(l);
            hi.push(h);
            x.push(xi);
            w.push(wi);
        }
        let b = DVector::from_column_slice(&w) - &a * DVector::from_column_slice(&x);
        let lcp = Lcp::new(Matrix::from(a.as_view()), b.as_slice().to_vec(), lo, hi);
        Manufactured { lcp: lcp.expect("a valid problem"), x, w }
    })
}

/// A unit mass on the floor, μ = ½, x_n = `press` if it does not lift off, pushed with `push` at an
/// angle (degrees) to t1.
pub fn pushed_mass(press: f64, push: f64, degrees: f64) -> FrictionProblem {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let rows: [&[f64]; 3] = [&[1.0, 0.0, 0.0], &[0.0, 1.0, 0.0], &[0.0, 0.0, 1.0]];
    let b = [-press, -push * cos, -push * sin];
    let lcp = boxed(&rows, &b, &[0.0, -INF, -INF], &[INF; 3]);
    FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }]).expect("one contact")
}

/// Random problems of some contacts after one row that is an equation: A = JJᵀ + shift with J of
/// `columns` columns, b = J u*, so that u = 0 is always a possible motion.
pub fn rubbing(
    contacts: usize,
    columns: usize,
    shift: f64,
) -> impl Strategy<Value = FrictionProblem> {
    let n = 1 + 3 * contacts;
    let quarters =
        |count| proptest::collection::vec((-4..=4).prop_map(|k| f64::from(k) / 4.0), count);
    let mu = proptest::collection::vec((0..=4).prop_map(|k| f64::from(k) / 4.0), contacts);
    (quarters(n * columns), quarters(columns), mu).prop_map(move |(j, u, mu)| {
        let j = DMatrix::from_vec(n, columns, j);
        let a = &j * j.transpose() + DMatrix::identity(n, n) * shift;
        let b = &j * DVector::from_vec(u);
        let lo = (0..n).map(|i| if i % 3 == 1 { 0.0 } else { -INF }).collect();
        let lcp = Lcp::new(Matrix::from(a.as_view()), b.as_slice().to_vec(), lo, vec![INF; n]);
        let contact = |(c, &mu): (usize, &f64)| Contact { rows: [1, 2, 3].map(|i| i + 3 * c), mu };
        let contacts = mu.iter().enumerate().map(contact).collect();
        FrictionProblem::new(lcp.expect("a valid problem"), contacts).expect("valid contacts")
    })
}

/// x after `sweeps` sweeps of the plain method.
pub fn plain(lcp: &Lcp, omega: f64, sweeps: usize) -> Vec<f64> {
    let settings = Settings::default()
        .with_tolerance(0.0)
        .with_max_iterations(sweeps)
        .with_check_every(sweeps);
    let pgs = Pgs { omega, settings, ..Pgs::default() };
    iterates(&pgs, lcp).pop().unwrap()
}

/// The same problem with its rows in another order.
pub fn reordered(lcp: &Lcp, order: &[usize]) -> Lcp {
    let mut place = vec![0; order.len()];
    order.iter().enumerate().for_each(|(k, &i)| place[i] = k);
    let row = |&i: &usize| lcp.matrix().row(i).iter().map(move |(j, a)| (i, j, a));
    let entries: Vec<_> =
        order.iter().flat_map(row).map(|(i, j, a)| (place[i], place[j], a)).collect();
    let of = |values: &[f64]| order.iter().map(|&i| values[i]).collect::<Vec<_>>();
    let matrix = Matrix::sparse(order.len(), &entries);
    let other = Lcp::new(matrix, of(lcp.b()), of(lcp.lo()), of(lcp.hi())).unwrap();
    let Some(coupling) = lcp.coupling() else { return other };
    let index = order.iter().map(|&i| coupling.index(i).map(|k| place[k])).collect();
    let mu = order.iter().map(|&i| coupling.mu(i)).collect();
    other.with_coupling(Coupling::new(index, mu).unwrap()).unwrap()
}

/// Equal within this part of the largest expected number.
#[track_caller]
pub fn assert_close(found: &[f64], expected: &[f64], part: f64) {
    let size = expected.iter().fold(0.0, |size, x| f64::max(size, x.abs()));
    for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert!((found - expected).abs() <= part * size, "row {i}: {found} for {expected}");
    }
}
