//! Linear programs in exact arithmetic: is there a y ≥ 0 with M y = r?
//!
//! Phase one of the simplex method, over the integers: all entries of the tableau have one
//! denominator, the last pivot, and every division is exact (Edmonds 1967). Bland's rule (take the
//! first eligible column and row) guarantees termination.

use dashu_int::IBig;

/// The result of a linear program.
pub enum ProgramResult {
    /// y, over a positive denominator.
    Point(Vec<IBig>, IBig),
    /// p with pᵀM ≤ 0 and pᵀr > 0, times a positive number: it proves that there is no y.
    Multipliers(Vec<IBig>),
}

/// Decides whether M y = r, y ≥ 0 has a solution; each row holds M's entries, then r's.
pub fn solve(mut rows: Vec<Vec<IBig>>, columns: usize) -> ProgramResult {
    let m = rows.len();
    let signs: Vec<bool> = rows.iter().map(|row| row[columns] < IBig::ZERO).collect();
    for (i, row) in rows.iter_mut().enumerate() {
        if signs[i] {
            row.iter_mut().for_each(|value| *value = -std::mem::take(value));
        }
        let right = row.pop().expect("its right side");
        // Artificial variables
        row.extend((0..m).map(|k| IBig::from(u8::from(k == i))));
        row.push(right);
    }
    let width = columns + m + 1;
    // The sum of the infeasibilities, and its rate of change with each column.
    let mut costs: Vec<IBig> =
        (0..width).map(|j| rows.iter().fold(IBig::ZERO, |sum, row| sum - &row[j])).collect();
    costs[columns..columns + m].iter_mut().for_each(|cost| *cost = IBig::ZERO);
    let mut basis: Vec<usize> = (columns..columns + m).collect();
    let mut denominator = IBig::ONE;
    while let Some(c) = (0..columns).find(|&j| costs[j] < IBig::ZERO) {
        let ratio_is_less = |i: usize, k: usize| {
            let (own, other) =
                (&rows[i][width - 1] * &rows[k][c], &rows[k][width - 1] * &rows[i][c]);
            own < other || own == other && basis[i] < basis[k]
        };
        let rising = (0..m).filter(|&i| rows[i][c] > IBig::ZERO);
        let Some(r) = rising.reduce(|best, i| if ratio_is_less(i, best) { i } else { best }) else {
            // Impossible: the sum is at least 0.
            break;
        };
        let own = std::mem::take(&mut rows[r]);
        for row in rows.iter_mut().filter(|row| !row.is_empty()).chain([&mut costs]) {
            let factor = row[c].clone();
            for (value, own_value) in row.iter_mut().zip(&own) {
                *value = (&*value * &own[c] - &factor * own_value) / &denominator;
            }
        }
        denominator = own[c].clone();
        rows[r] = own;
        basis[r] = c;
    }
    if costs[width - 1] < IBig::ZERO {
        // The reduced cost of row i's artificial variable is 1 − p_i.
        let multiplier = |i: usize| {
            let p = &denominator - &costs[columns + i];
            if signs[i] { -p } else { p }
        };
        return ProgramResult::Multipliers((0..m).map(multiplier).collect());
    }
    let mut point = vec![IBig::ZERO; columns];
    for (row, &variable) in rows.iter().zip(&basis) {
        if variable < columns {
            point[variable] = row[width - 1].clone();
        }
    }
    ProgramResult::Point(point, denominator)
}
