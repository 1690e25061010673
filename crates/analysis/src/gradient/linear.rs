//! Linear systems in rational numbers, and the numerical rank of one.

use dashu_int::IBig;
use dashu_ratio::RBig;

use lcplab_lcp::exact::modular;

/// A pivot below this fraction of the largest is rounding.
pub(super) const RELATIVE_ZERO: f64 = 1e-12;

/// The solutions y of K y = r, one for each r; `None` if K is singular.
pub(super) fn solve(k: &[Vec<RBig>], right: &[Vec<RBig>]) -> Option<Vec<Vec<RBig>>> {
    let scales: Vec<RBig> = k.iter().map(|row| common_denominator(row)).collect();
    let rows = || k.iter().zip(&scales);
    let matrix: Vec<Vec<IBig>> = rows().map(|(row, scale)| integers(row, scale)).collect();
    let one = |r: &Vec<RBig>| {
        let r: Vec<RBig> = r.iter().zip(&scales).map(|(r, scale)| r * scale).collect();
        let scale = common_denominator(&r);
        let (numerators, denominator) = modular::solve(&matrix, &integers(&r, &scale))?;
        let denominator = RBig::from(denominator) * scale;
        Some(numerators.into_iter().map(|y| RBig::from(y) / &denominator).collect())
    };
    // A matrix that is singular modulo the prime is rarely regular.
    let solutions: Option<Vec<_>> = right.iter().map(one).collect();
    solutions.or_else(|| eliminated(k, right).map(|(solutions, _)| solutions))
}

/// The solutions, and whether the determinant is positive, by Gauss-Jordan elimination.
pub(super) fn eliminated(k: &[Vec<RBig>], right: &[Vec<RBig>]) -> Option<(Vec<Vec<RBig>>, bool)> {
    let m = k.len();
    let row = |(i, row): (usize, &Vec<RBig>)| {
        row.iter().chain(right.iter().map(|r| &r[i])).cloned().collect::<Vec<RBig>>()
    };
    let mut rows: Vec<Vec<RBig>> = k.iter().enumerate().map(row).collect();
    let mut is_positive = true;
    for c in 0..m {
        let pivot = (c..m).find(|&r| rows[r][c] != RBig::ZERO)?;
        is_positive ^= pivot != c;
        rows.swap(c, pivot);
        let scale = rows[c][c].clone();
        is_positive ^= scale < RBig::ZERO;
        rows[c].iter_mut().for_each(|entry| *entry /= &scale);
        let own = rows[c].clone();
        for (r, row) in rows.iter_mut().enumerate() {
            let factor = row[c].clone();
            if r != c && factor != RBig::ZERO {
                row.iter_mut().zip(&own).for_each(|(entry, own)| *entry -= &factor * own);
            }
        }
    }
    let solution = |s: usize| rows.iter().map(|row| row[m + s].clone()).collect();
    Some(((0..right.len()).map(solution).collect(), is_positive))
}

/// A largest set of rows of K, in ascending order, that are independent beyond rounding: complete
/// pivoting, after scaling to a unit diagonal where the diagonal is not 0.
pub(super) fn independent_rows(k: &[Vec<RBig>]) -> Vec<usize> {
    let (m, scale) = (k.len(), scales(k));
    let mut matrix: Vec<Vec<f64>> =
        (0..m).map(|i| (0..m).map(|j| scale[i] * number(&k[i][j]) * scale[j]).collect()).collect();
    let (mut rows, mut open) = (Vec::new(), (0..m).collect::<Vec<usize>>());
    let mut first = 0.0;
    for _ in 0..m {
        let places = open.iter().flat_map(|&i| (0..m).map(move |j| (i, j)));
        let largest = places.max_by(|a, b| {
            matrix[a.0][a.1].abs().total_cmp(&matrix[b.0][b.1].abs()).then(b.cmp(a))
        });
        let Some((i, j)) = largest else { break };
        let pivot = matrix[i][j];
        first = f64::max(first, pivot.abs());
        if !(pivot.abs() > RELATIVE_ZERO * first) {
            break;
        }
        rows.push(i);
        open.retain(|&r| r != i);
        let own = matrix[i].clone();
        for &r in &open {
            let factor = matrix[r][j] / pivot;
            matrix[r].iter_mut().zip(&own).for_each(|(entry, own)| *entry -= factor * own);
            matrix[r][j] = 0.0;
        }
    }
    rows.sort_unstable();
    rows
}

/// The factors of rows and columns that give a unit diagonal.
pub(super) fn scales(k: &[Vec<RBig>]) -> Vec<f64> {
    k.iter().enumerate().map(|(i, row)| 1.0 / size(&row[i], row).sqrt()).collect()
}

/// The size of a row: its diagonal entry, or its largest one where that is 0; 1 for a row of zeros.
fn size(diagonal: &RBig, row: &[RBig]) -> f64 {
    let largest = row.iter().map(|a| number(a).abs()).fold(0.0, f64::max);
    match (number(diagonal).abs(), largest) {
        (0.0, 0.0) => 1.0,
        (0.0, largest) => largest,
        (own, _) => own,
    }
}

/// The nearest floating-point number.
pub(super) fn number(x: &RBig) -> f64 {
    x.to_f64().value()
}

/// A sum of products.
pub(super) fn dot<'a>(
    a: impl IntoIterator<Item = &'a RBig>,
    b: impl IntoIterator<Item = &'a RBig>,
) -> RBig {
    let terms = a.into_iter().zip(b).filter(|(a, b)| **a != RBig::ZERO && **b != RBig::ZERO);
    terms.fold(RBig::ZERO, |sum, (a, b)| sum + a * b)
}

/// A common multiple of the denominators, as a positive number.
fn common_denominator(row: &[RBig]) -> RBig {
    row.iter().fold(RBig::ONE, |all, entry| {
        let rest = entry * &all;
        all * RBig::from(rest.denominator().clone())
    })
}

/// The row times a number that makes its entries integers.
fn integers(row: &[RBig], scale: &RBig) -> Vec<IBig> {
    row.iter().map(|entry| (entry * scale).numerator().clone()).collect()
}
