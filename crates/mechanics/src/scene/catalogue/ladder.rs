//! A ladder on a rough floor against a smooth wall. The scene `ladder`.
//!
//! A capsule of length L between the centers of its ends, radius r, at θ from the floor. Moments
//! about the center of the foot: W L sin θ + μ N r = m g (L/2) cos θ at rest, where W equals the
//! friction:
//!
//! ```text
//! W = m g L cos θ / (2 (L sin θ + r)),   it holds while μ ≥ W/(m g)
//! ```
//!
//! When it slides with friction μ N and both ends stay in contact, with x = (L/2) cos θ, z = (L/2)
//! sin θ:
//!
//! ```text
//! N = m (g + (L/2) cos θ θ''),   W = μ N − m (L/2) sin θ θ'',
//! I θ'' = (L/2) sin θ W + μ N ((L/2) sin θ + r) − (L/2) cos θ N
//! ```

/// The ladder.
///
/// ```
/// use lcplab_mechanics::scene::catalogue::ladder::Ladder;
///
/// // A thin ladder at 45°: W = m g / (2 tan θ) = m g / 2, so that it needs μ ≥ ½.
/// let angle = std::f64::consts::FRAC_PI_4;
/// let ladder = Ladder { mass: 10.0, length: 2.0, radius: 0.0, angle };
/// assert!((ladder.push_of_wall(10.0) - 50.0).abs() < 1e-12); // N
/// let inertia = 10.0 * 2.0 * 2.0 / 12.0; // kg m²
/// assert!(ladder.angular_acceleration(10.0, 0.5, inertia).abs() < 1e-14);
/// assert!(ladder.angular_acceleration(10.0, 0.4, inertia) < 0.0); // it slides down
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ladder {
    /// m (kg).
    pub mass: f64,
    /// L (m), without the rounded ends.
    pub length: f64,
    /// r (m).
    pub radius: f64,
    /// θ from the floor (rad).
    pub angle: f64,
}

impl Ladder {
    /// The wall's force W (N) at rest, for g (m/s²).
    pub fn push_of_wall(&self, gravity: f64) -> f64 {
        let (sin, cos) = self.angle.sin_cos();
        self.mass * gravity * self.length * cos / (2.0 * (self.length * sin + self.radius))
    }

    /// θ'' (rad/s²) of a ladder at rest whose foot slides with friction μ, with the moment of
    /// inertia I (kg m²) about its center; negative when it slides down.
    pub fn angular_acceleration(&self, gravity: f64, mu: f64, inertia: f64) -> f64 {
        let (sin, cos) = self.angle.sin_cos();
        let half = 0.5 * self.length;
        // (moment of N) / N
        let lever = mu * (self.length * sin + self.radius) - half * cos;
        let resistance =
            inertia + self.mass * half * half * sin * sin - self.mass * half * cos * lever;
        self.mass * gravity * lever / resistance
    }
}
