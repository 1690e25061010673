//! Find the bug 8.b: sweeps that know when to stop.
//!
//! The program should sweep over contacts, w = A x + b ≥ 0, x ≥ 0, x w = 0, until the natural
//! residual is at most the tolerance, and return x and the number of sweeps. Its users say: "The
//! answers are right. But as soon as a contact opens it does all of its thousand sweeps, though the
//! first few were enough." There is exactly one mistake.

/// x, and the number of sweeps that were done.
pub fn answer(a: &[Vec<f64>], b: &[f64], tolerance: f64) -> (Vec<f64>, usize) {
    let n = b.len();
    let mut x = vec![0.0; n];
    for sweep in 1..=1000 {
        for i in 0..n {
            let w = b[i] + (0..n).map(|j| a[i][j] * x[j]).sum::<f64>();
            x[i] = f64::max(0.0, x[i] - w / a[i][i]);
        }
        let mut residual = 0.0;
        for i in 0..n {
            let w = b[i] + (0..n).map(|j| a[i][j] * x[j]).sum::<f64>();
            residual = f64::max(residual, w.abs());
        }
        if residual <= tolerance {
            return (x, sweep);
        }
    }
    (x, 1000)
}
