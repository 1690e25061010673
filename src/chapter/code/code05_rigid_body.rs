//! Code 5: the rigid body, its forces, and its inverse inertia in world axes.
//!
//! ```text
//! printed     Tᵀ I⁻¹ T     T the matrix of the orientation
//! corrected   R I⁻¹ Rᵀ     R for column vectors
//! ```
//!
//! The listing is written for a library of row vectors, v' = v T, where T is the Rᵀ of column
//! vectors; there it is right. Used literally with column vectors it rotates the inertia the wrong
//! way. Its forces lack the gyroscopic torque −ω × I ω (E26), and its caption names an integrator
//! that it does not contain (E60). In print the function is not `const` but is called through a
//! pointer to a constant (E36).

use nalgebra::{DMatrix, Matrix3, Quaternion, UnitQuaternion, Vector3};

use super::Listing;

pub(in crate::chapter) const LISTING: Listing = Listing {
    id: "Code 5",
    title: "the rigid body",
    printed: "State, sums of force and torque, and Tᵀ I⁻¹ T with the T of row vectors.",
    corrected: "R I⁻¹ Rᵀ for column vectors, and the gyroscopic torque among the torques.",
    errata: &["E26", "E36", "E60"],
};

/// A rigid body; a point mass has an `inverse_inertia` of 0, an immovable body also an
/// `inverse_mass` of 0.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidBody {
    /// The center of mass (m, world).
    pub position: Vector3<f64>,
    /// Rotates body to world; only the end of Code 7 normalizes it.
    pub orientation: Quaternion<f64>,
    /// Velocity (m/s).
    pub linear_velocity: Vector3<f64>,
    /// Angular velocity (rad/s, world).
    pub angular_velocity: Vector3<f64>,
    /// The sum of forces so far (N).
    pub force: Vector3<f64>,
    /// The sum of torques so far (N m, world).
    pub torque: Vector3<f64>,
    /// One over the mass (1/kg).
    pub inverse_mass: f64,
    /// The inverse inertia in body axes (1/(kg m²)).
    pub inverse_inertia: Matrix3<f64>,
}

/// The convention for multiplying vectors by matrices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Vectors {
    /// Row vectors, v T.
    Rows,
    /// Column vectors, R v.
    Columns,
}

impl RigidBody {
    /// A point mass (kg) at a position (m) with a velocity (m/s).
    pub fn point(mass: f64, position: Vector3<f64>, velocity: Vector3<f64>) -> Self {
        RigidBody {
            position,
            orientation: Quaternion::identity(),
            linear_velocity: velocity,
            angular_velocity: Vector3::zeros(),
            force: Vector3::zeros(),
            torque: Vector3::zeros(),
            inverse_mass: 1.0 / mass,
            inverse_inertia: Matrix3::zeros(),
        }
    }

    /// Adds a force (N) at a point of the world (m), with its torque r × f.
    pub fn add_force(&mut self, point: &Vector3<f64>, force: &Vector3<f64>) {
        self.force += force;
        let arm = point - self.position;
        self.add_torque(&arm.cross(force));
    }

    /// Adds a torque (N m, world).
    pub(crate) fn add_torque(&mut self, torque: &Vector3<f64>) {
        self.torque += torque;
    }

    /// The matrix of the orientation in this convention.
    pub(crate) fn orientation_matrix(&self, vectors: Vectors) -> Matrix3<f64> {
        let unit = UnitQuaternion::new_normalize(self.orientation);
        let columns = unit.to_rotation_matrix().into_inner();
        match vectors {
            Vectors::Columns => columns,
            Vectors::Rows => columns.transpose(),
        }
    }

    /// The gyroscopic torque −ω × I ω (N m, world), which the listing lacks; 0 for a point mass.
    pub fn gyroscopic_torque(&self) -> Vector3<f64> {
        let inertia = corrected(self).try_inverse().unwrap_or_default();
        -self.angular_velocity.cross(&(inertia * self.angular_velocity))
    }

    /// The 4 × 3 matrix Q with q' = Q ω.
    pub fn quaternion_rate(&self) -> DMatrix<f64> {
        let Quaternion { coords: q } = self.orientation;
        let rows = [-q.x, -q.y, -q.z, q.w, q.z, -q.y, -q.z, q.w, q.x, q.y, -q.x, q.w];
        DMatrix::from_row_slice(4, 3, &rows) * 0.5
    }
}

/// The listing's inverse inertia in world axes, Tᵀ I⁻¹ T with the matrix T of this convention.
pub fn printed(body: &RigidBody, vectors: Vectors) -> Matrix3<f64> {
    let orientation = body.orientation_matrix(vectors);
    orientation.transpose() * body.inverse_inertia * orientation
}

/// R I⁻¹ Rᵀ.
pub fn corrected(body: &RigidBody) -> Matrix3<f64> {
    let orientation = body.orientation_matrix(Vectors::Columns);
    orientation * body.inverse_inertia * orientation.transpose()
}
