//! E03: the Gauss-Seidel sums without coefficients, K&M (2).

use super::common::{enumerated, equations, last};
use super::{Finding, Measure};
use crate::error::Result;

/// Sixty sweeps of (2) with these coefficients; b in the sign of A x = b.
fn swept<const N: usize>(
    a: [[f64; N]; N],
    b: [f64; N],
    coefficient: impl Fn(usize, usize) -> f64,
) -> [f64; N] {
    let mut x = [0.0; N];
    for i in (0..60).flat_map(|_| 0..N) {
        let others = (0..N).filter(|&j| j != i).map(|j| coefficient(i, j) * x[j]);
        x[i] = (b[i] - others.sum::<f64>()) / a[i][i];
    }
    x
}

fn measure<const N: usize>(
    name: &str,
    a: [[f64; N]; N],
    b: [f64; N],
    printed: impl Fn(usize, usize) -> f64,
) -> Result<Measure> {
    let corrected = swept(a, b, |i, j| a[i][j]);
    let truth = last(enumerated(&equations(a.as_flattened(), &b.map(|b| -b))?));
    let x = Measure::new(name, "", swept(a, b, printed)[0], corrected[0]);
    Ok(x.truth(&truth[..1], "exact elimination", 1e-12))
}

/// Coefficients left out; indices exchanged in an unsymmetric and in a symmetric matrix.
pub(super) fn example() -> Result<Finding> {
    let chain = [[4.0, 1.0, 0.0], [1.0, 3.0, 1.0], [0.0, 1.0, 2.0]];
    let skewed = [[4.0, 2.0], [-1.0, 3.0]];
    Ok(Finding::new(
        "Sixty sweeps from 0 for A x = (1, 2, …), which is w = A x + b = 0 with b = (−1, −2, …). \
         A₁ = [4 1 0; 1 3 1; 0 1 2] is symmetric, A₂ = [4 2; −1 3] is not.",
    )
    .measure(measure("x₁, A₁, no coefficients", chain, [1.0, 2.0, 3.0], |_, _| 1.0)?)
    .measure(measure("x₁, A₂, i and j exchanged", skewed, [1.0, 2.0], |i, j| skewed[j][i])?)
    .measure(
        measure("x₁, A₁, i and j exchanged", chain, [1.0, 2.0, 3.0], |i, j| chain[j][i])?
            .agreeing(),
    ))
}
