//! Exercise 4.2: one contact of sequential impulses.
//!
//! A body of this inverse mass (1/kg) moves at v (m/s, away from the ground is positive). The
//! contact has given it the impulse `total` (N s) so far in this step. Correct the contact's
//! velocity to 0, as far as a contact can: it may take back what it has given, but all in all it
//! may not pull.

/// The velocity and the total impulse after the correction.
pub fn answer(v: f64, inverse_mass: f64, total: f64) -> (f64, f64) {
    let new = f64::max(0.0, total - v / inverse_mass);
    (v + (new - total) * inverse_mass, new)
}
