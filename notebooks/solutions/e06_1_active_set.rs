//! Exercise 6.1: the point of an active set, for two rows.
//!
//! Rows that are free have w_i = 0, the others x_i = 0, where w = A x + b. A is symmetric, positive
//! definite. Signs do not matter yet: x may be negative.

/// x of the active set.
pub fn answer(a: [[f64; 2]; 2], b: [f64; 2], free: [bool; 2]) -> [f64; 2] {
    match free {
        [false, false] => [0.0, 0.0],
        [true, false] => [-b[0] / a[0][0], 0.0],
        [false, true] => [0.0, -b[1] / a[1][1]],
        [true, true] => {
            let det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
            [(a[0][1] * b[1] - a[1][1] * b[0]) / det, (a[1][0] * b[0] - a[0][0] * b[1]) / det]
        }
    }
}
