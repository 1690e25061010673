//! Exercise 15.2: a leaning tower.
//!
//! Boxes 1 m wide lie on each other, seen from the front; x[k] (m, to the right) is the middle of
//! box k and m[k] (kg) its mass, evenly spread. Box 0 lies on the ground. Layer 0 is below it and
//! presses at its two ends. Layer k lies between the boxes k - 1 and k, which touch where they
//! overlap, and presses at the left and the right end of the overlap. Find the impulses in a step
//! of dt (s) in which nothing moves or turns. No layer can pull. g = 9.81 m/s².

/// The impulses of each layer at its left and right end (N s); `None` if the tower falls.
pub fn answer(x: &[f64], m: &[f64], dt: f64) -> Option<Vec<[f64; 2]>> {
    let mut layers = Vec::new();
    for k in 0..x.len() {
        let below = if k == 0 { x[0] } else { x[k - 1] };
        let (left, right) = (x[k].max(below) - 0.5, x[k].min(below) + 0.5);
        // The layer carries all that is above it, where the center of mass of all that is.
        let mass: f64 = m[k..].iter().sum();
        let middle = (k..x.len()).map(|j| m[j] * x[j]).sum::<f64>() / mass;
        let part = (middle - left) / (right - left); // at the right end
        if !(0.0..=1.0).contains(&part) {
            return None;
        }
        let load = mass * 9.81 * dt;
        layers.push([(1.0 - part) * load, part * load]);
    }
    Some(layers)
}
