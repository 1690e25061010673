//! Exercise 8.1: one friction row in a sweep of the coupled box.
//!
//! Gauss-Seidel satisfies a row by x_t − w_t / a_tt. Friction may be μ x_n at most, in either direction;
//! x_n is the present impulse of the contact's normal row, and may still be 0.

/// The new x_t from the old one, the row's w_t and a_tt, μ and x_n ≥ 0.
pub fn answer(x_t: f64, w_t: f64, a_tt: f64, mu: f64, x_n: f64) -> f64 {
    todo!()
}
