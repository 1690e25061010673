//! Checks of lesson 10, sparsity and storage.

use super::Verdict;

/// The place of an entry in a dense matrix kept row by row: held against counting.
///
/// # Errors
/// Names the entry that lies elsewhere.
pub fn place(answer: fn(usize, usize, usize, usize) -> usize) -> Verdict {
    for (rows, columns) in [(2, 3), (4, 4), (5, 1), (1, 7)] {
        let mut counted = 0;
        for row in 0..rows {
            for column in 0..columns {
                let got = answer(row, column, rows, columns);
                if got >= rows * columns {
                    return Err(format!(
                        "entry ({row}, {column}) of {rows} × {columns}: place {got} is past the end"
                    ));
                }
                if got != counted {
                    return Err(format!(
                        "entry ({row}, {column}) of {rows} × {columns}: {counted} numbers stand before it, \
                         place {got} does not fit that"
                    ));
                }
                counted += 1;
            }
        }
    }
    Ok(())
}

/// The product of compressed rows: held against the dense product of small whole numbers.
///
/// # Errors
/// Says which row is off.
pub fn compressed_rows(answer: fn(&[usize], &[usize], &[f64], &[f64]) -> Vec<f64>) -> Verdict {
    // [2 0 −1; 0 0 0; 0 3 4], with an empty row, and its transpose's neighbour [0 5; 6 0].
    type Case =
        (&'static [usize], &'static [usize], &'static [f64], &'static [f64], &'static [f64]);
    let cases: [Case; 2] = [
        (
            &[0, 2, 2, 4],
            &[0, 2, 1, 2],
            &[2.0, -1.0, 3.0, 4.0],
            &[1.0, 10.0, 100.0],
            &[-98.0, 0.0, 430.0],
        ),
        (&[0, 1, 2], &[1, 0], &[5.0, 6.0], &[1.0, 2.0], &[10.0, 6.0]),
    ];
    for (starts, columns, values, x, product) in cases {
        let got = answer(starts, columns, values, x);
        if got.len() != product.len() {
            return Err(format!(
                "starts = {starts:?} is a matrix of {} rows, the answer has {} entries",
                product.len(),
                got.len()
            ));
        }
        if let Some(i) = (0..got.len()).find(|&i| got[i] != product[i]) {
            return Err(format!(
                "starts = {starts:?}, columns = {columns:?}, values = {values:?}, x = {x:?}: row {i} of \
                 the answer is {}",
                got[i]
            ));
        }
    }
    Ok(())
}

/// The pattern of A: held against products of J with distinct entries, in which nothing cancels.
///
/// # Errors
/// Says for which bodies the count is off.
pub fn pattern(answer: fn(&[[Option<usize>; 2]]) -> usize) -> Verdict {
    let cases: [&[[Option<usize>; 2]]; 5] = [
        &[[None, Some(0)]],
        &[[None, Some(0)], [None, Some(1)]],
        &[[None, Some(0)], [Some(0), Some(1)], [Some(1), Some(2)]],
        &[[Some(0), Some(1)], [Some(0), Some(1)], [Some(2), Some(3)]],
        &[[Some(0), None], [Some(1), Some(0)], [None, Some(1)]],
    ];
    for rows in cases {
        let bodies = 1 + rows.iter().flatten().flatten().max().copied().unwrap_or(0);
        // Powers of two: no sum of products of them is zero.
        let entry = |i: usize, k: usize| match rows[i].contains(&Some(k)) {
            true => f64::powi(2.0, (i * bodies + k) as i32),
            false => 0.0,
        };
        let product = |i, j| (0..bodies).map(|k| entry(i, k) * entry(j, k)).sum::<f64>();
        let n = rows.len();
        let count = (0..n * n).filter(|place| product(place / n, place % n) != 0.0).count();
        let got = answer(rows);
        if got != count {
            let way = if got > count { "more than there are" } else { "too few" };
            return Err(format!("bodies {rows:?}: {got} entries are {way}"));
        }
    }
    Ok(())
}
