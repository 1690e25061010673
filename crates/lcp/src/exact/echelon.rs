//! Gauss-Jordan elimination over the integers.

use dashu_int::IBig;

/// The solution set of a system of linear equations.
pub(super) enum System {
    /// The equations contradict each other.
    None,
    /// One solution: numerators over a positive denominator.
    One(Vec<IBig>, IBig),
    /// More than one solution: `open` unknowns can be chosen freely.
    Many { open: usize },
}

/// Solves the equations c·y + c₀ = 0 in m unknowns; each row holds the integers c, then c₀.
///
/// Fraction-free Gauss-Jordan elimination (Bareiss 1968): after each step all pivot rows have the
/// same pivot, and every division is exact.
pub(super) fn solve(mut rows: Vec<Vec<IBig>>, m: usize) -> System {
    let mut pivot = IBig::ONE;
    let mut pivots = Vec::new();
    for c in 0..=m {
        let top = pivots.len();
        let Some(r) = (top..rows.len()).find(|&r| rows[r][c] != IBig::ZERO) else { continue };
        if c == m {
            // 0 = 1
            return System::None;
        }
        rows.swap(top, r);
        let own = std::mem::take(&mut rows[top]);
        for row in rows.iter_mut().filter(|row| !row.is_empty()) {
            let factor = row[c].clone();
            for (entry, other) in row.iter_mut().zip(&own) {
                *entry = (&*entry * &own[c] - &factor * other) / &pivot;
            }
        }
        pivot = own[c].clone();
        rows[top] = own;
        pivots.push(c);
    }
    if pivots.len() < m {
        return System::Many { open: m - pivots.len() };
    }
    let is_negative = pivot < IBig::ZERO;
    let numerator = |row: &Vec<IBig>| if is_negative { row[m].clone() } else { -row[m].clone() };
    let numerators = rows[..m].iter().map(numerator).collect();
    System::One(numerators, if is_negative { -pivot } else { pivot })
}
