//! What does a sweep over a dense A cost, compared with reading A once?
//!
//! The eigenvalues of A are 1/n, 2/n, …, 1, and half of the rows are free. The read sums the
//! entries of the same memory that the sweeps read, in three ways, of which the fastest counts.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use lcplab::lcp::{Lcp, Matrix, library};
use lcplab::solver::kernel::Width;
use lcplab::solver::kernel::dense::{Columns, Rows};
use lcplab::solver::kernel::reading::{Reading, read};

/// Sweeps from x = 0 that are timed together, which must still change x.
const SWEEPS: usize = 8;
/// The allowed difference of iterates, as a fraction of the largest |x|.
const ROUNDING: f64 = 1e-11;

fn problem(n: usize) -> Lcp {
    let lcp =
        library::by_name("pd").expect("a problem").generate(&[("n", n as f64)]).expect("n").lcp;
    let matrix = Matrix::from(lcp.matrix().to_dense().as_view());
    Lcp::new(matrix, lcp.b().to_vec(), lcp.lo().to_vec(), lcp.hi().to_vec()).expect("a problem")
}

/// Sweeps as they are defined: x_i ← Π_i(x_i − w_i / a_ii).
fn plain(lcp: &Lcp) -> Vec<f64> {
    let mut x = vec![0.0; lcp.len()];
    for _ in 0..SWEEPS {
        for i in 0..lcp.len() {
            x[i] = lcp.project(i, x[i] - lcp.row_w(i, &x) / lcp.matrix().diagonal(i), &x);
        }
    }
    x
}

fn swept(n: usize, mut sweep: impl FnMut(&mut [f64])) -> Vec<f64> {
    let mut x = vec![0.0; n];
    (0..SWEEPS).for_each(|_| sweep(&mut x));
    x
}

fn assert_same(found: &[f64], expected: &[f64]) {
    let size = expected.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    let apart = found.iter().zip(expected).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    assert!(
        apart <= ROUNDING * size,
        "the iterates differ from those of the plain sweep by {apart}"
    );
}

fn dense(criterion: &mut Criterion) {
    for n in [200, 500, 1000] {
        let lcp = problem(n);
        let Matrix::Dense(a) = lcp.matrix() else { unreachable!("made of a dense matrix") };
        let (a, expected) = (a.entries(), plain(&lcp));
        let mut group = criterion.benchmark_group(format!("eight dense sweeps, n = {n}"));
        group.sample_size(20).throughput(Throughput::Elements((SWEEPS * n * n) as u64));
        for reading in Reading::ALL {
            let id = BenchmarkId::new("read", format!("{reading:?}"));
            let once = |_| _ = black_box(read(black_box(a), reading, Width::widest()));
            group.bench_function(id, |bencher| bencher.iter(|| (0..SWEEPS).for_each(once)));
        }
        for width in Width::available() {
            let rows = Rows::of(&lcp, 1.0, width).expect("no zero diagonal");
            assert_same(&swept(n, |x| rows.sweep(x)), &expected);
            let id = BenchmarkId::new("by rows", format!("{width:?}"));
            group.bench_function(id, |bencher| bencher.iter(|| swept(n, |x| rows.sweep(x))));

            let columns = || Columns::of(&lcp, 1.0, width).expect("no zero diagonal");
            let sweeps = |mut columns: Columns| swept(n, |x| _ = columns.sweep(x));
            assert_same(&sweeps(columns()), &expected);
            let id = BenchmarkId::new("by columns", format!("{width:?}"));
            group.bench_function(id, |bencher| {
                bencher.iter_batched(columns, sweeps, criterion::BatchSize::LargeInput);
            });
        }
    }
}

criterion_group!(benches, dense);
criterion_main!(benches);
