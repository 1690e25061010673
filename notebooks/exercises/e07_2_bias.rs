//! Exercise 7.2: the bias of a contact.
//!
//! In w = J u⁺ + bias ≥ 0 the bias of a contact depends on its gap c (m):
//! a gap (c > 0) may close within the step dt (s), but not more;
//! an overlap deeper than the slop (m) gives up the part β of what is beyond the slop;
//! between the two nothing is corrected.

/// The bias (m/s).
pub fn answer(c: f64, dt: f64, beta: f64, slop: f64) -> f64 {
    todo!()
}
