//! Impacts that bounce. The scenes `bouncing_ball`, `cradle` and `cradle_touching`.

/// A ball dropped from rest: T = √(2 h/g), and each bounce leaves the part e of the speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drop {
    /// h (m), of the lowest point.
    pub height: f64,
    /// e.
    pub restitution: f64,
    /// g (m/s²).
    pub gravity: f64,
}

impl Drop {
    /// e^(2k) h (m), the height between bounce k and the next.
    pub fn height_after(&self, bounces: i32) -> f64 {
        self.height * self.restitution.powi(2 * bounces)
    }

    /// The time (s) of bounce k, from 1: T (1 + 2 (e + … + e^(k−1))).
    pub fn time_of(&self, bounce: i32) -> f64 {
        let flights: f64 = (1..bounce).map(|k| self.restitution.powi(k)).sum();
        (2.0 * self.height / self.gravity).sqrt() * (1.0 + 2.0 * flights)
    }
}

/// The speeds after the first of three equal balls that touch comes with v, by one LCP with
/// Newton's law in the pair that approached and none in the pair that did not: v2 − v1 = e v, v3 =
/// v2.
pub fn chain_of_three(speed: f64, restitution: f64) -> [f64; 3] {
    let others = (1.0 + restitution) * speed / 3.0;
    [(1.0 - 2.0 * restitution) * speed / 3.0, others, others]
}
