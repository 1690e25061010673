//! Bytes as a small LCP.

use arbitrary::{Result, Unstructured};
use lcplab::lcp::{Coupling, Lcp, Matrix};

/// Numbers that hurt.
const NASTY: [f64; 14] = [
    0.0,
    -0.0,
    5e-324,
    -5e-324,
    1e-310,
    2.2250738585072014e-308,
    1e-300,
    1e-150,
    1e-16,
    1e16,
    1e150,
    1e300,
    -1e300,
    f64::MAX,
];

/// A problem of up to five rows: whole numbers, a few nasty ones, or any finite ones at all.
pub fn problem(u: &mut Unstructured<'_>) -> Result<Lcp> {
    let n = u.int_in_range(0..=5)?;
    let mut a = vec![0.0; n * n];
    match u.int_in_range(0..=2)? {
        0 => {
            let columns = u.int_in_range(1..=5)?;
            let j = numbers(u, n * columns)?;
            for (k, a) in a.iter_mut().enumerate() {
                let (r, c) = (k / n, k % n);
                *a = finite((0..columns).map(|m| j[r * columns + m] * j[c * columns + m]).sum());
            }
        }
        1 => {
            for r in 0..n {
                for c in r..n {
                    let value = number(u)?;
                    (a[r * n + c], a[c * n + r]) = (value, value);
                }
            }
        }
        _ => a = numbers(u, n * n)?,
    }
    let b = numbers(u, n)?;
    let (mut lo, mut hi) = (vec![0.0; n], vec![f64::INFINITY; n]);
    for i in 0..n {
        let (one, other) = (number(u)?, number(u)?);
        (lo[i], hi[i]) = match u.int_in_range(0..=6)? {
            0 => (f64::NEG_INFINITY, f64::INFINITY),
            1 => (f64::NEG_INFINITY, one),
            2 => (one, f64::INFINITY),
            3 => (one, one),
            4 => (one.min(other), one.max(other)),
            _ => (0.0, f64::INFINITY),
        };
    }
    let matrix = match u.arbitrary()? {
        true => Matrix::dense(n, &a),
        false => {
            let entries = a.iter().enumerate().filter(|(_, a)| **a != 0.0);
            Matrix::sparse(n, &entries.map(|(k, a)| (k / n, k % n, *a)).collect::<Vec<_>>())
        }
    };
    let lcp = Lcp::new(matrix, b, lo, hi).expect("finite numbers, lo ≤ hi");
    if n < 2 || u.ratio(3, 4)? {
        return Ok(lcp);
    }
    let normals = [u.int_in_range(0..=n - 1)?, u.int_in_range(0..=n - 1)?];
    let mu = numbers(u, n)?.into_iter().map(f64::abs).collect();
    // One contact or two, with a tangent or several, beside rows of neither.
    let bound = (0..n).map(|_| u.int_in_range(0..=2)).collect::<Result<Vec<_>>>()?;
    let is_free = |i: usize| !normals.contains(&i);
    let index = (0..n).map(|i| normals.get(bound[i]).copied().filter(|_| is_free(i))).collect();
    let coupled = Coupling::new(index, mu).and_then(|coupling| lcp.clone().with_coupling(coupling));
    Ok(coupled.unwrap_or(lcp)) // a normal row that may pull takes no friction
}

/// So many of them.
pub fn numbers(u: &mut Unstructured<'_>, count: usize) -> Result<Vec<f64>> {
    (0..count).map(|_| number(u)).collect()
}

fn number(u: &mut Unstructured<'_>) -> Result<f64> {
    let byte: u8 = u.arbitrary()?;
    Ok(match byte {
        0..=13 => NASTY[usize::from(byte)],
        14..=29 => finite(u.arbitrary()?),
        30..=79 => (f64::from(byte) - 55.0) / 16.0,
        _ => f64::from(byte % 9) - 4.0,
    })
}

fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { 1.0 }
}
