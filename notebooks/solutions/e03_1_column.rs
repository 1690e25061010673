//! Exercise 3.1: a column of balls, without a matrix.
//!
//! Balls lie on each other, ball 0 on the ground, ball k with the mass m[k] (kg). Left to itself
//! ball k would move at u[k] (m/s, upwards positive) after the step: u* of the lesson. Contact k is
//! the one below ball k. After the step no contact may close, none may pull, and one that opens
//! gives nothing. So balls that would close in on each other move on together, with the momentum
//! that they have; a group may run into the next one; and the ground stops what comes down. Take
//! the balls from the ground up and keep a list of the groups.

/// The impulse of each contact (N s).
pub fn answer(m: &[f64], u: &[f64]) -> Vec<f64> {
    let mut groups: Vec<(f64, f64, usize)> = Vec::new(); // mass, momentum, number of balls
    for k in 0..m.len() {
        let mut group = (m[k], m[k] * u[k], 1);
        while let Some(below) = groups.pop_if(|below| below.1 / below.0 > group.1 / group.0) {
            group = (group.0 + below.0, group.1 + below.1, group.2 + below.2);
        }
        groups.push(group);
    }
    let mut speed = Vec::new();
    for (mass, momentum, count) in groups {
        speed.extend(vec![f64::max(0.0, momentum / mass); count]);
    }
    // What contact k has given is what the balls above it have gained.
    let gained = |j: usize| m[j] * (speed[j] - u[j]);
    (0..m.len()).map(|k| (k..m.len()).map(gained).sum()).collect()
}
