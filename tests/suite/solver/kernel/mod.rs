mod dense;
mod impulses;
mod panels;
mod rank_one;
mod rows;
mod table;
mod terms;

use lcplab::lcp::{Coupling, Lcp, Matrix};
use lcplab::solver::{Pgs, Settings};

use crate::common::iterates;

/// x after so many sweeps of the plain method.
fn plain(lcp: &Lcp, omega: f64, sweeps: usize) -> Vec<f64> {
    let settings = Settings {
        tolerance: 0.0,
        max_iterations: sweeps,
        check_every: sweeps,
        ..Settings::default()
    };
    let pgs = Pgs { omega, settings, ..Pgs::default() };
    iterates(&pgs, lcp).pop().unwrap()
}

/// The same problem with its rows in another order.
fn reordered(lcp: &Lcp, order: &[usize]) -> Lcp {
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

#[track_caller]
fn assert_close(found: &[f64], expected: &[f64], part: f64) {
    let size = expected.iter().fold(0.0, |size, x| f64::max(size, x.abs()));
    for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert!((found - expected).abs() <= part * size, "row {i}: {found} for {expected}");
    }
}
