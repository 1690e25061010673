//! Find the bug 6.b: how far a row gets.
//!
//! One move of Dantzig's method. The rows before the last are satisfied: free with x > 0 and w = 0,
//! or at the bound with x = 0 and w > 0. The last row closes, w < 0, and its x rises. For each N s
//! that it rises, x[r] changes by dx[r] and w[r] by dw[r]. The program should return how far it
//! rises (N s) until its own w is 0, or until another row is about to break its sign, and the
//! number of the row that stops it. Its users say: "With some problems it is right. With others the
//! row that has to push more is moved backwards, by a step below 0." There is exactly one mistake.

/// The length of the move, and the row that stops it.
pub fn answer(x: &[f64], w: &[f64], dx: &[f64], dw: &[f64]) -> (f64, usize) {
    let last = x.len() - 1;
    // The row's own w, if nothing stops it before.
    let mut first = (-w[last] / dw[last], last);
    for r in 0..last {
        // A free row must keep its x, a row at its bound its w.
        let (value, change) = if x[r] > 0.0 { (x[r], dx[r]) } else { (w[r], dw[r]) };
        if change == 0.0 {
            continue;
        }
        let step = -value / change;
        if step < first.0 {
            first = (step, r);
        }
    }
    first
}
