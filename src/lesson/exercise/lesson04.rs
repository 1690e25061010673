//! Checks of lesson 4, sweeping.

use std::f64::consts::PI;

use super::Verdict;
use crate::lcp::Matrix;
use crate::solver::theory::{sor_iteration_matrix, spectral_radius};

/// One sweep of PGS: held against the definition of the sweep, row by row. When row i is done, the rows
/// before it have their new x and those behind it their old one, and row i alone must satisfy its LCP.
///
/// # Errors
/// Says which row is not satisfied at its turn.
pub fn sweep(answer: fn(&[Vec<f64>], &[f64], &[f64], &[f64], Vec<f64>) -> Vec<f64>) -> Verdict {
    let a = vec![vec![2.0, -1.0, 0.0], vec![-1.0, 4.0, 1.0], vec![0.0, 1.0, 3.0]];
    let (lo, hi) = (vec![0.0, -1.0, 0.0], vec![f64::INFINITY, 1.0, 2.0]);
    for (b, old) in [
        (vec![-1.0, -1.0, 2.0], vec![0.0; 3]),
        (vec![3.0, -2.0, -1.0], vec![1.0, 0.5, 2.0]),
        (vec![-4.0, -9.0, -20.0], vec![0.0; 3]),
        (vec![-1.0, 8.0, -1.0], vec![0.5, 1.0, 0.0]),
    ] {
        let new = answer(&a, &b, &lo, &hi, old.clone());
        if new.len() != 3 {
            return Err(format!("x has 3 entries, the answer {}", new.len()));
        }
        for i in 0..3 {
            let x: Vec<f64> = (0..3).map(|j| if j <= i { new[j] } else { old[j] }).collect();
            let w = b[i] + (0..3).map(|j| a[i][j] * x[j]).sum::<f64>();
            let at = format!(
                "b = {b:?}, from x = {old:?}: when row {i} is done x = {x:?}, w[{i}] = {w}"
            );
            if !(lo[i]..=hi[i]).contains(&x[i]) {
                return Err(format!("{at}; x[{i}] lies outside [{}, {}]", lo[i], hi[i]));
            }
            let fits = w.abs() < 1e-12 || (w > 0.0 && x[i] == lo[i]) || (w < 0.0 && x[i] == hi[i]);
            if !fits {
                return Err(format!("{at}; this row could still do better on its own"));
            }
        }
    }
    Ok(())
}

/// One contact with accumulated clamping: held against momentum and the one-row LCP of the total.
///
/// # Errors
/// Says which law an answer breaks.
pub fn impulse(answer: fn(f64, f64, f64) -> (f64, f64)) -> Verdict {
    for (v, inverse_mass, total) in
        [(-2.0, 0.5, 0.0), (-2.0, 0.5, 3.0), (1.0, 0.5, 3.0), (4.0, 0.5, 3.0), (1.0, 2.0, 0.0)]
    {
        let (after, sum) = answer(v, inverse_mass, total);
        let at = format!(
            "v = {v}, 1/m = {inverse_mass}, {total} N s so far: now v = {after}, {sum} N s in all"
        );
        if ((after - v) - inverse_mass * (sum - total)).abs() > 1e-12 {
            return Err(format!("{at}; velocity and impulse do not fit together"));
        }
        if !(sum >= 0.0) {
            return Err(format!("{at}; the contact has pulled"));
        }
        if !(after >= -1e-12) {
            return Err(format!("{at}; the body still sinks in"));
        }
        if sum * after > 1e-12 {
            return Err(format!("{at}; the body leaves, yet the contact keeps what it pushed"));
        }
    }
    Ok(())
}

/// ω*: no other ω may do better, by the eigenvalues of the iteration matrix.
///
/// # Errors
/// Names an ω that is better.
pub fn omega(answer: fn(f64) -> f64) -> Verdict {
    for n in [3, 6, 12] {
        let diagonal = (0..n).map(|i| (i, i, 2.0));
        let beside = (1..n).flat_map(|i| [(i, i - 1, -1.0), (i - 1, i, -1.0)]);
        let a = Matrix::sparse(n, &diagonal.chain(beside).collect::<Vec<_>>());
        let jacobi = (PI / (n + 1) as f64).cos();
        let radius = |omega: f64| spectral_radius(&sor_iteration_matrix(&a, omega));
        let own = answer(jacobi);
        if !(own > 0.0 && own < 2.0) {
            return Err(format!("Jacobi {jacobi}: ω = {own}, but SOR needs 0 < ω < 2"));
        }
        let factor = radius(own);
        let other = (1..200).map(|k| 0.01 * f64::from(k)).find(|&o| radius(o) < factor - 1e-5);
        if let Some(other) = other {
            let verb = if other > own { "larger" } else { "smaller" };
            return Err(format!(
                "Jacobi {jacobi}: a sweep with ω = {own} leaves {factor} of the error; a {verb} ω leaves less"
            ));
        }
    }
    Ok(())
}
