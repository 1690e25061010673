//! What do a verdict and an exact proof cost? Random definite problems with half of the rows free.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use lcplab::judge::exact::prove;
use lcplab::judge::{Demand, Verdict, judge};
use lcplab::lcp::{Lcp, Matrix};
use lcplab::solver::{Dantzig, Settings, Solver, Start};
use nalgebra::DMatrix;

/// A = JJᵀ + 1 with 53-bit entries from a fixed sequence, b so that about half of the rows are
/// free.
fn problem(n: usize) -> Lcp {
    let mut state = 1u64;
    let mut next = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let j = DMatrix::from_fn(n, n, |_, _| next());
    let a = &j * j.transpose() + DMatrix::identity(n, n);
    let b = (0..n).map(|_| next()).collect();
    Lcp::new(Matrix::from(a.as_view()), b, vec![0.0; n], vec![f64::INFINITY; n])
        .expect("a valid problem")
}

/// Both prove that an exact solution is near x; `prove` also returns its fractions.
fn proofs(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("proof");
    group.sample_size(10);
    let demand = Demand { prove_up_to: Demand::EXACT_ROWS, ..Demand::default() };
    for n in [20, 50, 150] {
        let lcp = problem(n);
        let settings = Settings::default().with_tolerance(1e-12);
        let x = Dantzig { settings }.solve(&lcp, &Start::default(), &mut ()).x;
        assert!(matches!(judge(&lcp, &x, &demand).verdict, Verdict::Proved { .. }));
        assert!(prove(&lcp, &x).is_some(), "the solution must be proved");
        group.bench_function(BenchmarkId::new("judge", n), |bencher| {
            bencher.iter(|| judge(black_box(&lcp), &x, &demand));
        });
        group.bench_function(BenchmarkId::new("fractions", n), |bencher| {
            bencher.iter(|| prove(black_box(&lcp), &x));
        });
    }
}

criterion_group!(benches, proofs);
criterion_main!(benches);
