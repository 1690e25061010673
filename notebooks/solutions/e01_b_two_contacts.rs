//! Find the bug 1.b: two contacts.
//!
//! The program goes through the four cases of the lesson and should return the x ≥ 0 with w = A x +
//! b ≥ 0 and x[i] w[i] = 0 for both rows; A is symmetric, positive definite. Its users say:
//! "Contacts that do not feel each other are always right. Three balls in a line are right most of
//! the time, but sometimes a contact that should hold goes on closing, or one pulls." There is
//! exactly one mistake.

/// The answer of the two-row problem.
pub fn answer(a: [[f64; 2]; 2], b: [f64; 2]) -> [f64; 2] {
    // Neither contact pushes.
    if b[0] >= 0.0 && b[1] >= 0.0 {
        return [0.0, 0.0];
    }
    // Only contact i pushes: its w is 0, and the other contact, k, does not close.
    for (i, k) in [(0, 1), (1, 0)] {
        let push = -b[i] / a[i][i];
        let opens = b[k] + a[k][i] * push; // the push at i moves contact k too
        if push >= 0.0 && opens >= 0.0 {
            let mut x = [0.0, 0.0];
            x[i] = push;
            return x;
        }
    }
    // Both push: both w are 0.
    let det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    [(a[0][1] * b[1] - a[1][1] * b[0]) / det, (a[1][0] * b[0] - a[0][0] * b[1]) / det]
}
