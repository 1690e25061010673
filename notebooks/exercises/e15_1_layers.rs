//! Exercise 15.1: what each layer of a stack carries.
//!
//! A stack stands still. masses[0] (kg) is the lowest body. In a step of dt (s) each contact gives
//! an impulse (N s); g is in m/s².

/// The impulses between ground and lowest body, lowest and second, and so on: one a body.
pub fn answer(masses: &[f64], g: f64, dt: f64) -> Vec<f64> {
    todo!()
}
