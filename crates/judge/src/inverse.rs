//! The inverse of a matrix in double precision.

/// Gauss-Jordan elimination with row exchanges; `None` if a pivot is 0 or not finite.
pub(crate) fn inverse(mut a: Vec<Vec<f64>>) -> Option<Vec<Vec<f64>>> {
    let n = a.len();
    for (i, row) in a.iter_mut().enumerate() {
        row.extend((0..n).map(|j| f64::from(u8::from(i == j))));
    }
    for c in 0..n {
        let pivot = (c..n).max_by(|&i, &j| a[i][c].abs().total_cmp(&a[j][c].abs()))?;
        a.swap(c, pivot);
        let mut own = std::mem::take(&mut a[c]);
        let factor = own[c];
        if factor == 0.0 || !factor.is_finite() {
            return None;
        }
        own.iter_mut().for_each(|value| *value /= factor);
        for row in a.iter_mut().filter(|row| !row.is_empty()) {
            let factor = row[c];
            if factor != 0.0 {
                row[c..].iter_mut().zip(&own[c..]).for_each(|(value, own)| *value -= factor * own);
            }
        }
        a[c] = own;
    }
    let finite = a.into_iter().map(|row| row[n..].to_vec());
    finite.map(|row| row.iter().all(|v| v.is_finite()).then_some(row)).collect()
}
