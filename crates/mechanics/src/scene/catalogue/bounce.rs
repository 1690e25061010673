//! Impacts with restitution. The scenes `bouncing_ball`, `cradle` and `cradle_touching`.
//!
//! ```
//! use lcplab_mechanics::scene::catalogue::bounce::{Drop, chain_of_three};
//!
//! // From 20 m at g = 10 m/s² a ball falls for 2 s; e = ½ halves its speed, and its height becomes
//! // a quarter.
//! let ball = Drop { height: 20.0, restitution: 0.5, gravity: 10.0 };
//! assert_eq!(ball.height_after(1), 5.0);
//! assert_eq!((ball.time_of(1), ball.time_of(2)), (2.0, 4.0)); // up 1 s and down 1 s
//!
//! // e = 1: momentum −1/3 + 2/3 + 2/3 = 1, and v2 − v1 = 1.
//! let [v1, v2, v3] = chain_of_three(1.0, 1.0);
//! assert!((v1 + v2 + v3 - 1.0).abs() < 1e-15 && (v2 - v1 - 1.0).abs() < 1e-15 && v2 == v3);
//! ```

/// A ball dropped from rest: T = √(2 h/g), and each bounce reduces the speed by the factor e.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drop {
    /// h (m), the initial height of the lowest point.
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

/// The final speeds of three equal balls in contact after the first arrives with v, from one LCP
/// with Newton's law in the approaching pair and none in the other: v2 − v1 = e v, v3 = v2.
pub fn chain_of_three(speed: f64, restitution: f64) -> [f64; 3] {
    let others = (1.0 + restitution) * speed / 3.0;
    [(1.0 - 2.0 * restitution) * speed / 3.0, others, others]
}
