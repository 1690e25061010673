//! What does a sweep over a dense A cost beside reading A once? Random definite problems with half of
//! the rows free, swept from 0; the sweeps that count are the fourth to the eleventh, which still change x.

#![allow(missing_docs)]

mod measure;

use std::hint::black_box;

use lcplab::lcp::{Lcp, Matrix, library};
use lcplab::solver::kernel::Width;
use lcplab::solver::kernel::dense::{Columns, Rows, read};
use measure::{Contender, interleaved, timed};

const ROUNDS: usize = 61;
const BEFORE: usize = 3;
const COUNTED: usize = 8;

fn main() {
    println!("| n | contender | median (µs) | best (µs) | of one read, by medians and by bests |");
    println!("|---|---|---|---|---|");
    for n in [200, 500, 1000] {
        compare(&problem(n));
    }
}

/// Eigenvalues 1/n, 2/n, …, 1.
fn problem(n: usize) -> Lcp {
    let family = library::by_name("pd").expect("a family");
    let lcp = family.generate(&[("n", n as f64)]).expect("values in range").lcp;
    let dense = Matrix::from(lcp.matrix().to_dense().as_view());
    Lcp::new(dense, lcp.b().to_vec(), lcp.lo().to_vec(), lcp.hi().to_vec())
        .expect("valid as before")
}

fn compare(lcp: &Lcp) {
    let n = lcp.len();
    let Matrix::Dense(a) = lcp.matrix() else { unreachable!("made dense") };
    let widest = Width::widest();
    let mut contenders = vec![Contender::new("one read of A", || {
        timed(|| (0..COUNTED).for_each(|_| _ = black_box(read(black_box(a.as_slice()), widest))))
    })];
    contenders.push(swept("the plain loop", lcp, |x| plain_sweep(lcp, x)));
    for width in Width::available() {
        let rows = Rows::of(lcp, 1.0, width).expect("a positive diagonal");
        contenders.push(swept(format!("rows, {width:?}"), lcp, move |x| rows.sweep(x)));
    }
    for width in Width::available() {
        contenders.push(Contender::new(format!("columns, {width:?}"), move || {
            let mut columns = Columns::of(lcp, 1.0, width).expect("a positive diagonal");
            time_of(lcp, |x| _ = columns.sweep(x))
        }));
    }
    let times = interleaved(ROUNDS, &mut contenders);
    for (contender, time) in contenders.iter().zip(&times) {
        let (median, best) = (time.median / times[0].median, time.best / times[0].best);
        println!(
            "| {n} | {} | {:.1} | {:.1} | {median:.2}, {best:.2} |",
            contender.name,
            1e6 * time.median / COUNTED as f64,
            1e6 * time.best / COUNTED as f64
        );
    }
}

fn swept<'a>(
    name: impl Into<String>,
    lcp: &'a Lcp,
    sweep: impl Fn(&mut [f64]) + 'a,
) -> Contender<'a> {
    Contender::new(name, move || time_of(lcp, &sweep))
}

/// The time of the sweeps that count; their x must be that of the plain sweeps.
fn time_of(lcp: &Lcp, mut sweep: impl FnMut(&mut [f64])) -> f64 {
    let mut x = vec![0.0; lcp.len()];
    (0..BEFORE).for_each(|_| sweep(&mut x));
    let time = timed(|| (0..COUNTED).for_each(|_| sweep(&mut x)));
    let mut expected = vec![0.0; lcp.len()];
    (0..BEFORE + COUNTED).for_each(|_| plain_sweep(lcp, &mut expected));
    let close = |(x, y): (&f64, &f64)| (x - y).abs() <= 1e-10 * (1.0 + y.abs());
    assert!(x.iter().zip(&expected).all(close), "nothing is timed that is not right");
    time
}

fn plain_sweep(lcp: &Lcp, x: &mut [f64]) {
    for i in 0..x.len() {
        let unclamped = x[i] - lcp.row_w(i, x) / lcp.matrix().diagonal(i);
        x[i] = lcp.project(i, unclamped, x);
    }
}
