//! What do a sweep over a tower of 700 cubes, and a solve to a tolerance, cost?
//!
//! A is not formed. Processing eight pairs at a time changes the order of the rows and therefore
//! the number of sweeps, so the sweeps to a fraction of the first natural residual are also counted
//! and timed.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use lcplab::lcp::{Lcp, merit};
use lcplab::solver::kernel::Width;
use lcplab::solver::kernel::impulses::{RowByRow, SimdPairs, System};
use lcplab::storage::scaled_rows;
use lcplab_benches::problems::posed;

/// Sweeps of the check against the plain sweep.
const CHECKED: usize = 11;
/// The allowed difference of iterates, as a fraction of the largest |x|.
const ROUNDING: f64 = 1e-11;
/// Sweeps between two residual checks, and the maximum number of sweeps.
const LOOK: usize = 20;
const MOST: usize = 20_000;

/// The same sweeps in another form, from x = 0.
trait Sweeps {
    fn sweep(&mut self);
    fn x(&self) -> Vec<f64>;
}

struct Plain<'a>(&'a System, RowByRow);

impl Sweeps for Plain<'_> {
    fn sweep(&mut self) {
        self.1.sweep(self.0);
    }

    fn x(&self) -> Vec<f64> {
        self.1.x().to_vec()
    }
}

impl Sweeps for SimdPairs {
    fn sweep(&mut self) {
        SimdPairs::sweep(self);
    }

    fn x(&self) -> Vec<f64> {
        SimdPairs::x(self)
    }
}

/// Sweeps over the assembled A in this order, as they are defined.
fn by_definition(lcp: &Lcp, order: &[usize]) -> Vec<f64> {
    let mut x = vec![0.0; lcp.len()];
    for _ in 0..CHECKED {
        for &i in order {
            x[i] = lcp.project(i, x[i] - lcp.row_w(i, &x) / lcp.matrix().diagonal(i), &x);
        }
    }
    x
}

fn check(lcp: &Lcp, order: &[usize], mut form: impl Sweeps) {
    (0..CHECKED).for_each(|_| form.sweep());
    let expected = by_definition(lcp, order);
    let size = expected.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    let apart = form.x().iter().zip(&expected).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    assert!(
        apart <= ROUNDING * size,
        "the iterates differ from those of the plain sweep by {apart}"
    );
}

/// Sweeps until the natural residual is this fraction of the first; none above the maximum.
fn sweeps_to(lcp: &Lcp, part: f64, mut form: impl Sweeps) -> Option<usize> {
    let first = merit::natural_residual(lcp, &vec![0.0; lcp.len()]);
    (LOOK..=MOST).step_by(LOOK).find(|_| {
        (0..LOOK).for_each(|_| form.sweep());
        merit::natural_residual(lcp, &form.x()) <= part * first
    })
}

fn tower(criterion: &mut Criterion) {
    let posed = posed("tower", 3).expect("a step");
    let (lcp, rows) = (&posed.lcp, scaled_rows(&posed.assembly));
    let bodies = posed.assembly.blocks.len();
    let system = System::new(bodies, &rows, lcp).expect("no row of zeros");
    let plain = || Plain(&system, RowByRow::new(&system));
    let eight = |width| SimdPairs::new(&system, width).expect("pairs");
    let widest = || eight(Width::widest());
    check(lcp, &(0..lcp.len()).collect::<Vec<_>>(), plain());
    Width::available().for_each(|width| check(lcp, &widest().order(), eight(width)));

    let mut group = criterion.benchmark_group("a sweep of a tower");
    group.sample_size(20).throughput(Throughput::Elements(lcp.len() as u64));
    let mut kernel = plain();
    group.bench_function("row by row", |bencher| bencher.iter(|| kernel.sweep()));
    for width in Width::available() {
        let mut kernel = eight(width);
        let id = BenchmarkId::new("eight pairs", format!("{width:?}"));
        group.bench_function(id, |bencher| bencher.iter(|| kernel.sweep()));
    }
    group.finish();

    let mut group = criterion.benchmark_group("a tower to a part of the first residual");
    group.sample_size(10);
    for part in [1e-2, 1e-3] {
        let counts = [sweeps_to(lcp, part, plain()), sweeps_to(lcp, part, widest())];
        println!("sweeps to {part:e}, row by row and eight pairs: {counts:?}");
        if let [Some(by_rows), Some(by_eight)] = counts {
            let id = BenchmarkId::new("row by row", part);
            group.bench_function(id, |bencher| {
                let run = |mut kernel: Plain| (0..by_rows).for_each(|_| kernel.sweep());
                bencher.iter_batched(plain, run, criterion::BatchSize::LargeInput);
            });
            let id = BenchmarkId::new("eight pairs", part);
            group.bench_function(id, |bencher| {
                let run = |mut kernel: SimdPairs| (0..by_eight).for_each(|_| kernel.sweep());
                bencher.iter_batched(widest, run, criterion::BatchSize::LargeInput);
            });
        }
    }
}

criterion_group!(benches, tower);
criterion_main!(benches);
