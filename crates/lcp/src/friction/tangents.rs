//! The residual of a contact's two tangents together: the unit that makes x_t comparable with w_t.
//!
//! ```text
//! s_t x_t                where the disk is wider than terms_t / s_t
//! (terms_t / R) x_t      where it is narrower: then no step is longer than the disk's width
//! ```

use crate::merit::{self, RowTerms, reach_of_friction};

/// The w_t of a contact and the sizes it is compared with, in units of 2^`exponent`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tangents {
    pub w: [f64; 2],
    /// The terms of both rows.
    pub magnitude: f64,
    /// s_t, or 1 if both rows of A are 0.
    pub scale: f64,
    has_scale: bool,
    pub exponent: i32,
    /// R: the possible radius of the disk, given the accuracy of the normal impulse.
    reach: f64,
}

/// The factor that makes x_t comparable with w_t.
#[derive(Debug, Clone, Copy)]
pub(super) enum Unit {
    /// s_t, in units of 2^`exponent`.
    Scale { scale: f64, exponent: i32 },
    /// terms_t / R, which may exceed the largest `f64`.
    Reach { magnitude: f64, reach: f64, exponent: i32 },
}

impl Unit {
    pub fn of(self, x: f64) -> f64 {
        match self {
            Unit::Scale { scale, exponent } => merit::product(scale, x, -exponent),
            Unit::Reach { magnitude, reach, .. } => magnitude * (x / reach),
        }
    }

    /// The unit as a number.
    pub fn value(self) -> f64 {
        match self {
            Unit::Scale { scale, .. } => scale,
            Unit::Reach { magnitude, reach, exponent } => libm::ldexp(magnitude / reach, exponent),
        }
    }
}

impl Tangents {
    /// The tangents of these rows with this s_t, under a normal impulse of this size.
    pub fn new(
        rows: [RowTerms; 2],
        scale: Option<f64>,
        mu: f64,
        normal: f64,
        exponent: i32,
    ) -> Self {
        let w = rows.map(|row| libm::ldexp(row.w, row.exponent - exponent));
        let [m1, m2] = rows.map(|row| libm::ldexp(row.magnitude, row.exponent - exponent));
        let magnitude = crate::hypot(m1, m2);
        let reach = reach_of_friction(mu, normal);
        let (scale, has_scale) = (scale.unwrap_or(1.0), scale.is_some());
        Tangents { w, magnitude, scale, has_scale, exponent, reach }
    }

    /// The measure in the unit of s_t, and in the unit of the disk if the disk is narrower or if
    /// both rows of A are 0, so that s_t gives no unit.
    pub fn measured<T: Copy>(&self, measure: impl Fn(Unit) -> T) -> [T; 2] {
        let Tangents { magnitude, scale, has_scale, exponent, reach, .. } = *self;
        let own = Unit::Scale { scale, exponent };
        let by_scale = measure(own);
        let is_felt = magnitude > 0.0 && reach.is_finite();
        match is_felt && (own.of(reach) < magnitude || !has_scale) {
            true => [by_scale, measure(Unit::Reach { magnitude, reach, exponent })],
            false => [by_scale; 2],
        }
    }
}
