//! The orientation of a cloud of points, for example of a body represented by three particles (the
//! chapter's Figure 10).
//!
//! ```text
//! R = argmin Σ |R (r_i − r̄) − (p_i − p̄)|²;   H = Σ (p_i − p̄)(r_i − r̄)ᵀ = U Σ Vᵀ,   R = U diag(1, 1, ±1) Vᵀ
//! ```
//!
//! The sign makes det R = 1; R is the orthogonal factor of H's polar decomposition. Three points
//! not on a line are sufficient, since two directions in a plane determine the third. Kabsch 1976.

#![allow(non_snake_case)]

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

/// A cloud whose width is below this fraction of its length counts as a line.
const FLAT: f64 = 1e-9;

/// The rotation that best maps the reference points to the points, up to a translation; `None` if
/// they lie on a line or their numbers differ.
///
/// ```
/// use lcplab_bodies::body::alignment;
/// use nalgebra::{UnitQuaternion, Vector3};
///
/// let triangle = [Vector3::x(), Vector3::y(), Vector3::zeros()];
/// let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -2.0, 1.0));
/// let turned = triangle.map(|point| turn * point + Vector3::new(5.0, 6.0, 7.0));
/// let found = alignment(&triangle, &turned).expect("three points not in a line");
/// assert!(found.angle_to(&turn) < 1e-14);
/// ```
pub fn alignment(
    reference: &[Vector3<f64>],
    points: &[Vector3<f64>],
) -> Option<UnitQuaternion<f64>> {
    if reference.len() != points.len() {
        return None;
    }
    let mean = |cloud: &[Vector3<f64>]| cloud.iter().sum::<Vector3<f64>>() / cloud.len() as f64;
    let (r_mean, p_mean) = (mean(reference), mean(points));
    let pairs = reference.iter().zip(points);
    let H: Matrix3<f64> = pairs.map(|(r, p)| (p - p_mean) * (r - r_mean).transpose()).sum();
    let svd = H.try_svd(true, true, f64::EPSILON, 0)?;
    // The singular values are in descending order.
    let (U, V_t, sigma) = (svd.u?, svd.v_t?, svd.singular_values);
    if !(sigma[1] > FLAT * sigma[0]) {
        return None;
    }
    let sign = (U * V_t).determinant().signum();
    let R = U * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign)) * V_t;
    Some(UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(R)))
}
