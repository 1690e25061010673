//! Volumes and principal moments of inertia of homogeneous shapes, in closed form.

use nalgebra::Vector3;

use super::Shape;

/// The volume (m³); none for a point and a half space.
pub fn volume(shape: &Shape) -> Option<f64> {
    match shape {
        Shape::Sphere { radius } => Some(4.0 / 3.0 * std::f64::consts::PI * radius.powi(3)),
        Shape::Box { half } => Some(8.0 * half.x * half.y * half.z),
        Shape::Point | Shape::Plane { .. } => None,
    }
}

/// The principal moments (kg m²) of a homogeneous body of this mass (kg): ⅖ m r² for a sphere,
/// m (b² + c²)/3 about the axis along a of a box with half edges a, b, c; none for a point and a
/// half space.
///
/// ```
/// use lcplab::body::{Shape, inertia};
///
/// let moments = inertia::moments(&Shape::Sphere { radius: 0.5 }, 10.0).unwrap();
/// assert_eq!(moments.x, 1.0);
/// ```
pub fn moments(shape: &Shape, mass: f64) -> Option<Vector3<f64>> {
    match shape {
        Shape::Sphere { radius } => Some(Vector3::repeat(0.4 * mass * radius * radius)),
        Shape::Box { half } => {
            let square = half.component_mul(half);
            Some(square.map(|a| mass * (square.sum() - a) / 3.0))
        }
        Shape::Point | Shape::Plane { .. } => None,
    }
}
