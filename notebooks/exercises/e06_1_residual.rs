//! Exercise 6.1: the natural residual of a row.
//!
//! |x − Π(x − w)|, Π moving a number to the nearest one in [lo, hi]. It is 0 exactly on the three segments of
//! lesson 1.

/// The natural residual.
pub fn answer(x: f64, w: f64, lo: f64, hi: f64) -> f64 {
    todo!()
}
