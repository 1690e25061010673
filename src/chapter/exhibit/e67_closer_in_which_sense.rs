//! E67: nearer with every update, but in which norm, section on iterative methods.

use dashu_int::IBig;
use dashu_ratio::RBig;

use super::common::{equations, largest, sweeps};
use super::{Finding, Measure};
use crate::error::Result;
use crate::lcp::{Lcp, merit};
use crate::plot::{Axis, Lines, Series};
use crate::solver::Pgs;

/// A by rows, b in this library's sign, x*: all integers.
type Case = (&'static [i64], &'static [i64], &'static [i64]);
const NEAR: Case = (&[1, 2, 2, 5], &[-2, -5], &[0, 1]);
const RESIDUAL: Case = (&[5, 4, -2, 4, 8, -2, -2, -2, 1], &[-1, -1, -3], &[]);

fn problem((a, b, _): Case) -> Result<Lcp> {
    let floats = |values: &[i64]| values.iter().map(|&value| value as f64).collect::<Vec<_>>();
    equations(&floats(a), &floats(b))
}

/// One Gauss-Seidel sweep from 0 in rational arithmetic.
fn exact_sweep((a, b, _): Case) -> Vec<RBig> {
    let n = b.len();
    let number = |value: i64| RBig::from(IBig::from(value));
    let mut x = vec![RBig::ZERO; n];
    for i in 0..n {
        let others = (0..n).filter(|&j| j != i);
        let sum = others.fold(number(b[i]), |sum, j| sum + number(a[n * i + j]) * &x[j]);
        x[i] = -sum / number(a[n * i + i]);
    }
    x
}

/// √(Σ values²), rounded after the exact sum.
fn norm(values: impl IntoIterator<Item = RBig>) -> f64 {
    values.into_iter().fold(RBig::ZERO, |sum, value| sum + &value * &value).to_f64().value().sqrt()
}

pub(super) fn example() -> Result<Finding> {
    let near = problem(NEAR)?;
    let x = sweeps(Pgs::NAME, &near, &[0.0; 2], 50)?;
    let distance = |x: &[f64]| x[0].hypot(x[1] - 1.0);
    let number = |value: i64| RBig::from(IBig::from(value));
    let exact = norm(exact_sweep(NEAR).into_iter().zip(NEAR.2).map(|(x, &star)| x - number(star)));

    let second = problem(RESIDUAL)?;
    let y = sweeps(Pgs::NAME, &second, &[0.0; 3], 1)?;
    let z = exact_sweep(RESIDUAL);
    let w = |i: usize| {
        (0..3).fold(number(RESIDUAL.1[i]), |sum, j| sum + number(RESIDUAL.0[3 * i + j]) * &z[j])
    };
    let exact_residual = norm((0..3).map(w)) / norm(RESIDUAL.1.iter().map(|&b| number(b)));

    let rises = x.windows(2).map(|pair| {
        (merit::objective(&near, &pair[1]) - merit::objective(&near, &pair[0])).max(0.0)
    });
    let moved = Measure::new("|x − x*| after a sweep", "", distance(&x[0]), distance(&x[1]));
    let residual = Measure::new(
        "(4) after a sweep",
        "",
        merit::km4(&second, &y[0]),
        merit::km4(&second, &y[1]),
    );
    let objective = Measure::new("rise of the objective", "", 0.0, largest(rises));
    Ok(Finding::new(
        "A x = (2, 5) with A = [1 2; 2 5], solution (0, 1), and A x = (1, 1, 3) with A = [5 4 −2; 4 8 −2; −2 −2 1]; \
         Gauss-Seidel from 0. The printed column has what the claim allows at most: the distance, and the \
         residual (4) |A x − b|/|b|, before the sweep. The last line is the largest rise of ½ xᵀA x − bᵀx in \
         50 sweeps of the first problem; in that sense the claim is right.",
    )
    .measure(moved.truth(&[exact], "rational arithmetic", 1e-9))
    .measure(residual.truth(&[exact_residual], "rational arithmetic", 1e-9))
    .measure(objective.truth(&[0.0], "theory", 1e-15).agreeing())
    .plot(&drawing(&near, &x)))
}

/// The distance in both norms, sweep by sweep.
fn drawing(lcp: &Lcp, x: &[Vec<f64>]) -> Lines {
    let least = merit::objective(lcp, &[0.0, 1.0]);
    // |x − x*|² in the norm of A is twice the excess of the objective over its minimum.
    let in_norm_of_a = |x: &[f64]| (2.0 * (merit::objective(lcp, x) - least)).max(0.0).sqrt();
    let curve = |distance: &dyn Fn(&[f64]) -> f64| {
        let shown = x.iter().take(21).enumerate();
        shown.map(|(sweep, x)| (sweep as f64, distance(x))).collect::<Vec<_>>()
    };
    Lines::new(
        "e67",
        "Distance from the solution, sweep by sweep",
        "In the norm of A the iterates come nearer in each sweep. Measured by |x \
                 − x*| the first sweep leads away, to more than twice the distance.",
        Axis::linear("sweep", ""),
        Axis::linear("distance from x*", ""),
        vec![
            Series::measured("|x − x*|", curve(&|x| x[0].hypot(x[1] - 1.0))),
            Series::measured("norm of A", curve(&in_norm_of_a)),
        ],
    )
}
