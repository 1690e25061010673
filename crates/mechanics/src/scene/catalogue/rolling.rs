//! Rolling balls. The scenes `rolling_sphere` and `rolling_balls`.
//!
//! ```text
//! a ball, I = 2/5 m R², thrown without spin:  v = v0 − μ g t, ω R = 5/2 μ g t, so that it rolls
//!     from T = 2 v0/(7 μ g) on, at 5/7 v0
//! on a box with acceleration a, without slip:  m a_b = f, I α = f R, a_b + α R = a, so a_b = 2/7 a
//! ```
//!
//! ```
//! use lcplab_mechanics::scene::catalogue::rolling::{PushedBox, SlidingBall};
//!
//! // 7 m/s, braked by μ g = 1 m/s² for 2 s, until it rolls at 5 m/s.
//! let ball = SlidingBall { speed: 7.0, friction: 0.1, gravity: 10.0 };
//! assert!((ball.sliding_time() - 2.0).abs() < 1e-15);
//! assert!((ball.rolling_speed() - 5.0).abs() < 1e-15);
//! assert!((ball.way_after(3.0) - 17.0).abs() < 1e-14); // 7 · 2 − ½ · 2² + 5 · 1 m
//!
//! // 11 N push a box of 2 kg with a ball of 7 kg, which counts as 2 kg; no friction below.
//! let (mass, ball_mass) = (2.0, 7.0);
//! let pushed =
//!     PushedBox { push: 11.0, mass, balls: 1.0, ball_mass, friction: 0.0, gravity: 10.0 };
//! assert!((pushed.acceleration() - 2.75).abs() < 1e-14);
//! assert!((pushed.acceleration_of_ball() - 2.75 * 2.0 / 7.0).abs() < 1e-14);
//! ```

/// A homogeneous ball thrown along the ground without spin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlidingBall {
    /// v0 (m/s).
    pub speed: f64,
    /// μ.
    pub friction: f64,
    /// g (m/s²).
    pub gravity: f64,
}

impl SlidingBall {
    /// T (s), the time until it rolls.
    pub fn sliding_time(&self) -> f64 {
        2.0 * self.speed / (7.0 * self.friction * self.gravity)
    }

    /// The speed (m/s) once it rolls.
    pub fn rolling_speed(&self) -> f64 {
        5.0 / 7.0 * self.speed
    }

    /// The distance (m) traveled after a time (s).
    pub fn way_after(&self, time: f64) -> f64 {
        let slides = time.min(self.sliding_time());
        let braked = 0.5 * self.friction * self.gravity * slides * slides;
        self.speed * slides - braked + self.rolling_speed() * (time - slides)
    }
}

/// Balls on a box that is pushed over the ground by a force through its center.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PushedBox {
    /// F (N).
    pub push: f64,
    /// M (kg).
    pub mass: f64,
    /// n, the number of balls.
    pub balls: f64,
    /// m (kg) of each.
    pub ball_mass: f64,
    /// μ between box and ground; the balls do not slip.
    pub friction: f64,
    /// g (m/s²).
    pub gravity: f64,
}

impl PushedBox {
    /// a (m/s²) of the box while it slides.
    pub fn acceleration(&self) -> f64 {
        let load = self.balls * self.ball_mass;
        let brake = self.friction * (self.mass + load) * self.gravity;
        (self.push - brake) / (self.mass + 2.0 / 7.0 * load)
    }

    /// a (m/s²) of each ball.
    pub fn acceleration_of_ball(&self) -> f64 {
        2.0 / 7.0 * self.acceleration()
    }
}
