//! Checks of exercises: sweeping.

use super::Verdict;

/// One sweep of PGS: checked against the definition of the sweep, row by row. When row i is done,
/// the earlier rows have their new x and the later ones their old x, and row i alone must satisfy
/// its LCP.
///
/// # Errors
/// Names the row that is not satisfied at its turn.
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
                return Err(format!("{at}; this row alone does not satisfy its LCP"));
            }
        }
    }
    Ok(())
}

/// One contact with accumulated clamping: checked against momentum and the one-row LCP of the total
/// impulse.
///
/// # Errors
/// Names the law that an answer violates.
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
/// The extrapolation: tested on sweeps with a known limit, artificial ones and those of a column.
///
/// # Errors
/// Gives the distance from the limit.
pub fn extrapolate(answer: fn([&[f64]; 3]) -> Vec<f64>) -> Verdict {
    let cases: [(&[f64], &[f64], f64); 5] = [
        (&[4.0, 3.0, 1.0], &[-1.0, -1.5, -0.5], 0.75),
        (&[0.5, 0.0], &[0.25, 0.125], 0.25),
        (&[2.0, 1.0], &[1.0, -0.5], -0.5),
        (&[3.0, 7.0, 2.0], &[-2.0, 0.0, 1.0], 0.9),
        (&[1.0, 5.0], &[0.0, 0.0], 0.5),
    ];
    for (end, error, rho) in cases {
        let sweep = |k: i32| -> Vec<f64> {
            end.iter().zip(error).map(|(end, error)| end + error * f64::powi(rho, k)).collect()
        };
        let sweeps = [0, 1, 2].map(sweep);
        let got = answer(sweeps.each_ref().map(Vec::as_slice));
        let off = distance(&got, end);
        if !(off < 1e-9) {
            return Err(format!(
                "the sweeps {sweeps:?} end at {end:?}, each error shrinks by {rho}; the answer {got:?} is off by {off}"
            ));
        }
    }
    // Column of n bodies: the exact answer is n, n - 1, …, 1.
    for (n, first) in [(3, 3), (5, 8), (10, 40)] {
        let end: Vec<f64> = (1..=n).rev().map(f64::from).collect();
        let sweeps = [0, 1, 2].map(|k| swept_column(n as usize, first + k));
        let got = answer(sweeps.each_ref().map(Vec::as_slice));
        let (off, before) = (distance(&got, &end), distance(&sweeps[2], &end));
        if !(off < 0.1 * before) {
            return Err(format!(
                "a column of {n} bodies, sweeps {first} to {}: the last is off by {before:.5}, the answer by \
                 {off:.5}; it should be ten times nearer at least",
                first + 2
            ));
        }
    }
    // Row 0 alone determines ρ = 0.9, and row 1 would end below 0.
    let got = answer([&[3.0, 0.02], &[2.1, 0.01], &[1.29, 0.005]]);
    match got.iter().position(|x| !(*x >= 0.0)) {
        Some(i) => Err(format!("x[{i}] = {} of the answer {got:?}: a contact pulls", got[i])),
        None => Ok(()),
    }
}

/// The largest difference; ∞ if the lengths differ or a number is NaN.
fn distance(x: &[f64], y: &[f64]) -> f64 {
    if x.len() != y.len() || x.iter().any(|x| x.is_nan()) {
        return f64::INFINITY;
    }
    x.iter().zip(y).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

/// A column of equal bodies (m g dt = 1 N s) after this number of sweeps from 0, ground first.
fn swept_column(n: usize, sweeps: usize) -> Vec<f64> {
    let mut x = vec![0.0; n + 1];
    for _sweep in 0..sweeps {
        for i in 0..n {
            x[i] = match i {
                0 => x[1] + 1.0,
                _ => 0.5 * (x[i - 1] + x[i + 1]),
            };
        }
    }
    x.truncate(n);
    x
}

/// Bug 4.b, projected Gauss-Seidel on contacts: checked for complementarity after many sweeps.
///
/// # Errors
/// Names the contact that is not satisfied, or says that x has diverged.
pub fn projected(answer: fn(&[Vec<f64>], &[f64], usize) -> Vec<f64>) -> Verdict {
    let joints = vec![vec![2.0, -1.0, 0.0], vec![-1.0, 2.0, -1.0], vec![0.0, -1.0, 2.0]];
    let balls = vec![vec![2.0, -1.0], vec![-1.0, 2.0]];
    let plank = vec![vec![2.0, 1.0], vec![1.0, 2.0]];
    let box_ = vec![vec![3.0, 1.0, 2.0], vec![1.0, 4.0, 3.0], vec![2.0, 3.0, 3.0]];
    for (name, a, b) in [
        ("a column, all contacts push", &joints, vec![-1.0, -1.0, -1.0]),
        ("three balls, the first is hit", &balls, vec![-1.0, 2.0]),
        ("three balls, the middle one moves", &balls, vec![1.0, -1.0]),
        ("a plank on two supports", &plank, vec![-4.0, -5.0]),
        ("a plank, one end leaves", &plank, vec![1.0, -2.0]),
        ("a plank, one end is lifted", &plank, vec![-1.0, -6.0]),
        ("one body, three contacts", &box_, vec![0.0, 0.0, -1.0]),
    ] {
        let x = answer(a, &b, 200);
        if x.len() != b.len() {
            return Err(format!("x has {} entries, the answer {}", b.len(), x.len()));
        }
        let at = format!("{name}: A = {a:?}, b = {b:?}, after 200 sweeps x = {x:.4?}");
        let largest = x.iter().fold(0.0, |size, x| f64::max(size, x.abs()));
        if !(largest < 100.0) {
            return Err(format!("{at}; no impulse of the answer is larger than 5 N s"));
        }
        for i in 0..x.len() {
            let w = b[i] + (0..x.len()).map(|j| a[i][j] * x[j]).sum::<f64>();
            if !(x[i] >= 0.0) {
                return Err(format!("{at}; contact {i} pulls"));
            }
            if !(w >= -1e-9) {
                return Err(format!("{at}; contact {i} still closes at {:.4} m/s", -w));
            }
            if x[i] > 1e-9 && w > 1e-9 {
                return Err(format!("{at}; contact {i} opens at {w:.4} m/s, yet it pushes"));
            }
        }
    }
    Ok(())
}
