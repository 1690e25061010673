//! The numbers of the textbook: single or double precision.

use std::iter::Sum;

use nalgebra::RealField;

/// A floating-point number of single or double precision.
///
/// ```
/// use lcplab_solver::textbook::Real;
///
/// assert_eq!(f32::nearest(0.1).double(), 0.1 + 1.4901161138336505e-9); // 24 bits
/// let tenth: f64 = Real::nearest(0.1);
/// assert_eq!(tenth.double(), 0.1);
/// ```
pub trait Real: RealField + Copy + Sum {
    /// The number of this precision that is nearest to a number in double precision.
    fn nearest(value: f64) -> Self;

    /// The same number in double precision.
    fn double(self) -> f64;
}

impl Real for f32 {
    fn nearest(value: f64) -> f32 {
        value as f32
    }

    fn double(self) -> f64 {
        f64::from(self)
    }
}

impl Real for f64 {
    fn nearest(value: f64) -> f64 {
        value
    }

    fn double(self) -> f64 {
        self
    }
}
