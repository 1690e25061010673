//! Equations w_i = 0 that follow from others, because their rows of A and b depend on each other.

use dashu_int::IBig;
use dashu_int::ops::Abs;

use super::system::{Numbers, System};
use lcplab_lcp::exact::dyadic::{Dyadic, dyadic, rational, whole};
use lcplab_lcp::exact::modular::solve;
use lcplab_lcp::exact::rounded_up;

/// A row whose remainder, relative to its largest entry, is below this depends on others.
const DEPENDENT: f64 = 1e-9;

/// A linear dependence of rows of A: Σ f_j (row j) = 0. If w = 0 in all other rows, then w = e in
/// the redundant row i, with f_i e = Σ f_j b_j; it is 0 if the rows of b depend in the same way.
#[derive(Debug, Clone, PartialEq)]
pub struct Dependence {
    /// The redundant row.
    pub row: usize,
    /// The rows with their factors f, the redundant one among them.
    pub factors: Vec<(usize, IBig)>,
}

/// Checks the dependences for a system that still has all its equations, and returns the redundant
/// rows. No |e| may exceed `most`.
///
/// # Errors
/// Why an equation does not follow from the remaining ones.
pub(super) fn check(
    system: &System<'_>,
    dependences: &[Dependence],
    most: f64,
) -> Result<Vec<usize>, String> {
    let still = system.still();
    let rows: Vec<usize> = dependences.iter().map(|dependence| dependence.row).collect();
    let numbers = system.numbers();
    for (k, dependence) in dependences.iter().enumerate() {
        let Dependence { row, factors } = dependence;
        let is_allowed = |(j, f): &(usize, IBig)| {
            still.binary_search(j).is_ok() && (j == row || !rows.contains(j)) && *f != IBig::ZERO
        };
        let is_once =
            !rows[..k].contains(row) && factors.iter().filter(|(j, _)| j == row).count() == 1;
        let is_valid = is_once && factors.iter().all(is_allowed);
        if !is_valid || !sums_to_zero(numbers, factors) || !is_within(numbers, dependence, most) {
            return Err(format!("w = 0 in row {row} does not follow from other rows"));
        }
    }
    Ok(rows)
}

/// Whether Σ f_j (row j of A) = 0.
fn sums_to_zero(numbers: &Numbers, factors: &[(usize, IBig)]) -> bool {
    let mut sums = vec![Dyadic::ZERO; numbers.b.len()];
    for (j, factor) in factors {
        let factor = whole(factor.clone());
        numbers.a[*j].iter().for_each(|(column, a)| sums[*column] += &factor * a);
    }
    sums.iter().all(|sum| *sum == Dyadic::ZERO)
}

/// Whether |e| ≤ most; a row of a motion has no bias that could change, and needs e = 0.
fn is_within(numbers: &Numbers, dependence: &Dependence, most: f64) -> bool {
    let most = if dependence.row < numbers.biased { most } else { 0.0 };
    let (sum, own) = offset(numbers, dependence);
    sum <= own * dyadic(most)
}

/// |Σ f_j b_j| and |f_i|, whose ratio is |e|.
fn offset(numbers: &Numbers, Dependence { row, factors }: &Dependence) -> (Dyadic, Dyadic) {
    let term = |(j, factor): &(usize, IBig)| whole(factor.clone()) * &numbers.b[*j];
    let sum = factors.iter().map(term).fold(Dyadic::ZERO, |sum, term| sum + term);
    let own = factors.iter().find(|(j, _)| j == row).map_or(IBig::ZERO, |(_, own)| own.clone());
    (sum.abs(), whole(own).abs())
}

/// The largest |e| of the dependences, rounded up.
pub(super) fn largest_offset(system: &System<'_>, dependences: &[Dependence]) -> f64 {
    let offsets = dependences.iter().map(|dependence| {
        let (sum, own) = offset(system.numbers(), dependence);
        rational(&sum) / rational(&own)
    });
    rounded_up(&offsets.max().unwrap_or_default())
}

/// The dependences of the rows with w = 0 on a basis of these rows, with no |e| above `most`; rows
/// that depend on it only up to rounding are not among them.
pub(super) fn find(system: &System<'_>, most: f64) -> Vec<Dependence> {
    let (still, numbers) = (system.still(), system.numbers());
    let entries = still.iter().flat_map(|&i| &numbers.a[i]);
    let last = entries.map(|(_, a)| a.repr().exponent()).min().unwrap_or(0);
    let integers = |&i: &usize| {
        let mut row = vec![IBig::ZERO; numbers.b.len()];
        for (column, a) in &numbers.a[i] {
            row[*column] = (a.clone() << -last).to_int().value();
        }
        row
    };
    let rows: Vec<Vec<IBig>> = still.iter().map(integers).collect();
    let (basis, columns) = basis(numbers, &still);
    let part = |r: usize| columns.iter().map(|&c| rows[r][c].clone()).collect::<Vec<IBig>>();
    let transposed: Vec<Vec<IBig>> =
        columns.iter().map(|&c| basis.iter().map(|&r| rows[r][c].clone()).collect()).collect();
    let dependence = |r: usize| {
        let (factors, denominator) = solve(&transposed, &part(r))?;
        let kept = basis.iter().zip(factors).filter(|(_, factor)| *factor != IBig::ZERO);
        let mut factors: Vec<(usize, IBig)> = kept.map(|(&r, factor)| (still[r], factor)).collect();
        factors.push((still[r], -denominator));
        factors.sort_unstable_by_key(|(row, _)| *row);
        let dependence = Dependence { row: still[r], factors };
        let holds =
            sums_to_zero(numbers, &dependence.factors) && is_within(numbers, &dependence, most);
        holds.then_some(dependence)
    };
    (0..still.len()).filter(|r| !basis.contains(r)).filter_map(dependence).collect()
}

/// Numbers of rows in `still` that are linearly independent in double precision, and columns in
/// which they are: by elimination with complete pivoting.
fn basis(numbers: &Numbers, still: &[usize]) -> (Vec<usize>, Vec<usize>) {
    let scaled = |&i: &usize| {
        let mut row = vec![0.0; numbers.b.len()];
        for (column, a) in &numbers.a[i] {
            row[*column] = a.to_f64().value();
        }
        let largest = row.iter().fold(0.0, |most, a| f64::max(most, a.abs()));
        row.iter_mut().for_each(|a| *a /= largest);
        row
    };
    let mut left: Vec<(usize, Vec<f64>)> = still.iter().map(scaled).enumerate().collect();
    let (mut rows, mut columns) = (Vec::new(), Vec::new());
    loop {
        let largest = |row: &[f64]| {
            let entries = row.iter().enumerate().map(|(c, a)| (a.abs(), c));
            entries.max_by(|(a, c), (b, d)| a.total_cmp(b).then(d.cmp(c)))
        };
        let pivots = left.iter().enumerate().filter_map(|(k, (_, row))| {
            let (size, column) = largest(row)?;
            Some((size, k, column))
        });
        let pivot = pivots.max_by(|(a, k, _), (b, l, _)| a.total_cmp(b).then(l.cmp(k)));
        let Some((_, k, column)) = pivot.filter(|(size, ..)| *size > DEPENDENT) else { break };
        let (r, own) = left.remove(k);
        for (_, row) in &mut left {
            let factor = row[column] / own[column];
            row.iter_mut().zip(&own).for_each(|(value, own)| *value -= factor * own);
            row[column] = 0.0;
        }
        rows.push(r);
        columns.push(column);
    }
    (rows, columns)
}
