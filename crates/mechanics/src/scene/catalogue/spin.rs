//! Rotating rigid bodies: a free one, and a heavy symmetric top on a pivot. The scenes
//! `dzhanibekov` and `top`.
//!
//! ```text
//! Euler's equations   I1 ω1' = (I2 − I3) ω2 ω3 and so on, I1 < I2 < I3, no torque.
//! with 2E = Σ I ω², L² = Σ I² ω²; if L² > 2 E I2:
//!   period  4 K(k) √(I1 I2 I3 / ((I3 − I2)(L² − 2 E I1))),
//!   k² = (I2 − I1)(2 E I3 − L²) / ((I3 − I2)(L² − 2 E I1)),   else with 1 and 3 exchanged
//! steady top          m g l = Ω (I3 ω3 − I1 Ω cos θ),  I1 about the pivot
//! ```
//!
//! Landau & Lifshitz, *Mechanics*, §37 and §35. K(k) = π / (2 agm(1, √(1 − k²))).

use std::f64::consts::PI;

/// A free body with its principal moments (kg m²), ascending, and rates about them (rad/s).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeBody {
    /// I1 < I2 < I3.
    pub moments: [f64; 3],
    /// ω1, ω2, ω3 in the body's frame.
    pub rates: [f64; 3],
}

impl FreeBody {
    /// The period (s) of the rates; the body flips twice in it.
    ///
    /// ```
    /// use lcplab_mechanics::scene::catalogue::spin::FreeBody;
    ///
    /// // A small disturbance of the turn about axis 3 goes round like ω √((I3 − I1)(I3 − I2)/(I1 I2)).
    /// let body = FreeBody { moments: [1.0, 2.0, 3.0], rates: [1e-6, 0.0, 1.0] };
    /// assert!((body.period() - std::f64::consts::TAU).abs() < 1e-9);
    /// ```
    pub fn period(&self) -> f64 {
        let [mut i1, i2, mut i3] = self.moments;
        let sum = |power: i32| -> f64 {
            let terms = self.moments.iter().zip(&self.rates);
            terms.map(|(i, w)| i.powi(power) * w * w).sum()
        };
        // 2 E and L²
        let (energy, momentum) = (sum(1), sum(2));
        if momentum < energy * i2 {
            (i1, i3) = (i3, i1);
        }
        let scale = (i3 - i2) * (momentum - energy * i1);
        // k²
        let modulus = (i2 - i1) * (energy * i3 - momentum) / scale;
        4.0 * PI / (2.0 * agm(1.0, (1.0 - modulus).sqrt())) * (i1 * i2 * i3 / scale).sqrt()
    }
}

/// A symmetric top whose axis is inclined by θ and precesses at a constant rate.
///
/// ```
/// use lcplab_mechanics::scene::catalogue::spin::SteadyTop;
///
/// // A horizontal axis, 1 m long: m g l = Ω I3 ω3, and Ω² l = 10 m/s² toward the pivot's axis.
/// let top = SteadyTop {
///     mass: 2.0,
///     length: 1.0,
///     moments: [3.0, 1.0],
///     angle: std::f64::consts::FRAC_PI_2,
///     gravity: 10.0,
/// };
/// let precession = 10f64.sqrt();
/// assert!((top.spin(precession) - 20.0 / precession).abs() < 1e-14); // rad/s
/// assert!((top.load(precession) - 20.0 * 2f64.sqrt()).abs() < 1e-13); // N
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadyTop {
    /// m (kg).
    pub mass: f64,
    /// l from the pivot to the center of mass (m).
    pub length: f64,
    /// I1 about a line through the pivot perpendicular to the axis, and I3 about the axis (kg m²).
    pub moments: [f64; 2],
    /// θ from the vertical (rad).
    pub angle: f64,
    /// g (m/s²).
    pub gravity: f64,
}

impl SteadyTop {
    /// The spin ω3 (rad/s) about its axis for steady precession at Ω (rad/s).
    pub fn spin(&self, precession: f64) -> f64 {
        let [i1, i3] = self.moments;
        let torque = self.mass * self.gravity * self.length;
        (torque / precession + i1 * precession * self.angle.cos()) / i3
    }

    /// The force (N) on the pivot: the weight and the centripetal force.
    pub fn load(&self, precession: f64) -> f64 {
        let inwards = precession * precession * self.length * self.angle.sin();
        self.mass * self.gravity.hypot(inwards)
    }
}

/// The arithmetic-geometric mean.
fn agm(mut a: f64, mut b: f64) -> f64 {
    while (a - b).abs() > 1e-15 * a {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    a
}
