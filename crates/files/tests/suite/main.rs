//! Each format: files of the tools whose it is are read with the numbers they were made of, what is
//! written reads back as the same bits, and bad files are refused with place and reason.

mod chrono;
mod disk;
#[cfg(feature = "fclib")]
mod fclib;
mod hostile;
mod mat;
mod matrix_market;
mod mujoco;
mod npz;
mod qps;
mod registry;
mod siconos;

use std::path::{Path, PathBuf};

use lcplab_files as files;
use lcplab_files::Format;
use lcplab_lcp::file::Problem;
use lcplab_lcp::friction::FrictionProblem;
use lcplab_lcp::{Coupling, Lcp, Matrix};
use proptest::prelude::*;

use lcplab_testing::{INF, manufactured, rubbing};

/// A sample file, made by tests/problems/exchange/make.py.
fn sample(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/problems/exchange").join(name)
}

/// The problem that a text of this format holds.
fn parse(format: &str, text: &str) -> Result<Problem, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p");
    std::fs::write(&path, text).unwrap();
    let read = files::read(&path, Some(Format::by_name(format).unwrap()));
    read.map_err(|error| error.to_string().replace(path.to_str().unwrap(), "p"))
}

fn message(format: &str, text: &str) -> String {
    parse(format, text).unwrap_err()
}

/// The problem after it was written in a format and read again.
fn again(problem: &Problem, format: &str) -> Problem {
    let folder = tempfile::tempdir().unwrap();
    let format = Format::by_name(format).unwrap();
    let path = folder.path().join(format!("again{}", format.endings[0]));
    files::write(problem, &path, Some(format)).unwrap();
    files::read(&path, None).unwrap()
}

fn refusal(problem: &Problem, format: &str) -> String {
    files::encode(problem, Format::by_name(format).unwrap()).unwrap_err().to_string()
}

fn rows(matrix: &Matrix) -> Vec<Vec<f64>> {
    let n = matrix.len();
    (0..n).map(|i| (0..n).map(|j| matrix.entry(i, j)).collect()).collect()
}

/// The same numbers to the last bit, however A is stored.
#[track_caller]
fn assert_same(a: &Lcp, b: &Lcp) {
    let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&rows(a.matrix()).concat()), bits(&rows(b.matrix()).concat()));
    for (a, b) in [(a.b(), b.b()), (a.lo(), b.lo()), (a.hi(), b.hi())] {
        assert_eq!(bits(a), bits(b));
    }
    assert_eq!(a.coupling(), b.coupling());
}

/// A boxed problem with numbers of all sizes: those of a manufactured one, times odd factors.
fn boxes() -> impl Strategy<Value = Problem> {
    let odd = || proptest::array::uniform4(any::<f64>());
    (manufactured(4, 4, 0.1), odd(), any::<bool>()).prop_map(|(m, odd, is_sparse)| {
        let a = |i: usize, j: usize| m.lcp.matrix().entry(i, j) / 3.0 + 0.0; // no −0
        let matrix = if is_sparse {
            let all = (0..16).map(|k| (k / 4, k % 4, a(k / 4, k % 4)));
            Matrix::sparse(4, &all.filter(|e| e.2 != 0.0).collect::<Vec<_>>())
        } else {
            Matrix::dense(4, &(0..16).map(|k| a(k / 4, k % 4)).collect::<Vec<_>>())
        };
        let b = odd.map(|v| if v.is_finite() { v } else { 1.0 / 3.0 }).to_vec();
        let lcp = Lcp::new(matrix, b, m.lcp.lo().to_vec(), m.lcp.hi().to_vec());
        Problem::new("boxes", lcp.expect("a valid problem"))
    })
}

/// A friction problem as a coupled box: contacts, and behind them one equation.
fn frictions(equations: usize) -> impl Strategy<Value = Problem> {
    rubbing(2, 5, 0.3).prop_map(move |friction| {
        let order = [1, 2, 3, 4, 5, 6, 0];
        let rows = &order[..6 + equations];
        Problem::new("frictions", reordered(&friction, rows))
    })
}

/// The rows of a friction problem in this order, with numbers that no short decimal holds.
fn reordered(friction: &FrictionProblem, rows: &[usize]) -> Lcp {
    let lcp = friction.lcp();
    let n = rows.len();
    let third = |v: f64| v / 3.0 + 0.0;
    let a: Vec<f64> =
        (0..n * n).map(|k| third(lcp.matrix().entry(rows[k / n], rows[k % n]))).collect();
    let b = rows.iter().map(|i| third(lcp.b()[*i])).collect();
    let lo = rows.iter().map(|i| lcp.lo()[*i]).collect();
    let place = |i: usize| rows.iter().position(|row| *row == i).unwrap();
    let (mut index, mut mu) = (vec![None; n], vec![0.0; n]);
    for contact in friction.contacts() {
        let [normal, t1, t2] = contact.rows.map(place);
        for t in [t1, t2] {
            (index[t], mu[t]) = (Some(normal), contact.mu);
        }
    }
    let lcp = Lcp::new(Matrix::dense(n, &a), b, lo, vec![INF; n]).expect("a valid problem");
    lcp.with_coupling(Coupling::new(index, mu).expect("contacts")).expect("contacts")
}
