//! One rigid body: what it weighs, what it looks like, where it is and how it moves.
//!
//! World axes are right-handed, z is up by custom. A body's frame has its origin in the centre of
//! mass and its axes along the principal axes of inertia. SI units throughout.

mod alignment;
mod gyroscopic;
pub mod inertia;
mod polytope;
mod state;

pub use alignment::alignment;
pub use gyroscopic::Gyroscopic;
pub use polytope::{Cylinder, Edge, Face, Polytope};
pub use state::{Pose, State};

use std::sync::Arc;

use nalgebra::{Matrix3, Vector3, Vector6};

/// A body of a scene. Its state is kept apart, because it changes and this does not.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// The name by which constraints and reports refer to it.
    pub name: String,
    /// How it answers to forces.
    pub mass: Mass,
    /// What it looks like to collision detection.
    pub shape: Shape,
    /// The coefficient of dry friction of its surface; that of a pair is the geometric mean.
    pub friction: f64,
    /// That of static friction, no less, where one is stated; that of a pair is the geometric mean.
    pub static_friction: Option<f64>,
    /// The coefficient of restitution of its surface; that of the scene without it.
    pub restitution: Option<f64>,
    /// A constant force (N, world), beside gravity.
    pub force: Vector3<f64>,
    /// The point on which it acts (m, in the body's frame).
    pub force_at: Vector3<f64>,
    /// A constant torque (N m, world).
    pub torque: Vector3<f64>,
}

impl Body {
    /// The constant force and torque on the centre of mass, [f; τ] (N, N m), in this pose.
    pub fn wrench(&self, pose: &Pose) -> Vector6<f64> {
        stack(self.force, pose.direction(&self.force_at).cross(&self.force) + self.torque)
    }
}

/// How a body answers to forces: the blocks of M and M⁻¹.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mass {
    /// Does not move: M⁻¹ = 0, and no velocity components.
    Fixed,
    /// Has a place but no orientation: 3 velocity components.
    Point {
        /// Mass (kg), positive.
        mass: f64,
    },
    /// Has 6 velocity components u = [v; ω].
    Rigid {
        /// Mass (kg), positive.
        mass: f64,
        /// Principal moments of inertia about the body's axes (kg m²), positive.
        moments: Vector3<f64>,
    },
}

/// The shape of a body, in its own frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A point; touches everything but other points.
    Point,
    /// A ball.
    Sphere {
        /// Radius (m).
        radius: f64,
    },
    /// A box with faces across the body's axes.
    Box {
        /// Half of each edge length (m).
        half: Vector3<f64>,
    },
    /// All points within a radius of a segment along the body's z axis.
    Capsule {
        /// Half of the segment's length (m).
        half_length: f64,
        /// Radius (m).
        radius: f64,
    },
    /// A convex polytope with its centre of mass at the origin and principal axes.
    Hull(Arc<Polytope>),
    /// Several convex shapes that move as one, the centre of mass of all at the origin.
    Compound(Arc<Vec<Placed>>),
    /// The half space behind a plane through the body's origin.
    Plane {
        /// The unit normal, pointing out of the matter.
        normal: Vector3<f64>,
    },
}

/// A convex part of a compound.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// Its shape.
    pub shape: Shape,
    /// Where it is in the body's frame.
    pub pose: Pose,
}

impl Mass {
    /// The number of velocity components: 0, 3 or 6.
    #[inline]
    pub fn dof(&self) -> usize {
        match self {
            Mass::Fixed => 0,
            Mass::Point { .. } => 3,
            Mass::Rigid { .. } => 6,
        }
    }

    /// The mass (kg); 0 for a fixed body, which takes no part in energy and momentum.
    pub fn mass(&self) -> f64 {
        match *self {
            Mass::Fixed => 0.0,
            Mass::Point { mass } | Mass::Rigid { mass, .. } => mass,
        }
    }

    /// I_world = R diag(moments) Rᵀ (kg m²); 0 for a body that cannot turn.
    pub fn world_inertia(&self, pose: &Pose) -> Matrix3<f64> {
        self.turned(pose, |moment| moment)
    }

    /// M⁻¹ times a force and torque [f; τ]: the acceleration they cause; 0 for a fixed body.
    pub fn accelerate(&self, pose: &Pose, wrench: &Vector6<f64>) -> Vector6<f64> {
        let inverse_mass = match self {
            Mass::Fixed => return Vector6::zeros(),
            _ => 1.0 / self.mass(),
        };
        let linear = inverse_mass * linear(wrench);
        let angular = self.spin(pose, &angular(wrench));
        stack(linear, angular)
    }

    /// The angular velocity I⁻¹ L (rad/s, world) of an angular momentum L about the centre of mass
    /// (kg m²/s, world); 0 for a body that cannot turn.
    pub fn spin(&self, pose: &Pose, momentum: &Vector3<f64>) -> Vector3<f64> {
        self.turned(pose, f64::recip) * momentum
    }

    /// Kinetic energy ½ m |v|² + ½ ω·I ω (J).
    pub fn kinetic_energy(&self, state: &State) -> f64 {
        0.5 * self.mass() * state.v.norm_squared() + self.spin_energy(state)
    }

    /// Its part ½ ω·I ω (J).
    pub fn spin_energy(&self, state: &State) -> f64 {
        0.5 * state.omega.dot(&self.spin_momentum(state))
    }

    /// The angular momentum I ω about the centre of mass (kg m²/s, world), by way of the body's
    /// axes: in the world's the small moment of a thin body drowns in the rounding of the large
    /// ones.
    pub(crate) fn spin_momentum(&self, state: &State) -> Vector3<f64> {
        let Mass::Rigid { moments, .. } = self else { return Vector3::zeros() };
        state.pose.q * moments.component_mul(&(state.pose.q.inverse() * state.omega))
    }

    /// Linear momentum m v (kg m/s).
    pub fn momentum(&self, state: &State) -> Vector3<f64> {
        self.mass() * state.v
    }

    /// Angular momentum about the world's origin, p × m v + I ω (kg m²/s).
    pub fn angular_momentum(&self, state: &State) -> Vector3<f64> {
        state.pose.p.cross(&self.momentum(state)) + self.spin_momentum(state)
    }

    /// R diag(f(moments)) Rᵀ, made exactly symmetric: rounding alone would leave A unsymmetric.
    fn turned(&self, pose: &Pose, f: impl Fn(f64) -> f64) -> Matrix3<f64> {
        let Mass::Rigid { moments, .. } = self else { return Matrix3::zeros() };
        let r = pose.q.to_rotation_matrix();
        let turned = r.matrix() * Matrix3::from_diagonal(&moments.map(f)) * r.matrix().transpose();
        0.5 * (turned + turned.transpose())
    }
}

/// The first three components of [v; ω] or [f; τ].
#[inline]
pub fn linear(u: &Vector6<f64>) -> Vector3<f64> {
    u.fixed_rows::<3>(0).into_owned()
}

/// The last three components of [v; ω] or [f; τ].
#[inline]
pub fn angular(u: &Vector6<f64>) -> Vector3<f64> {
    u.fixed_rows::<3>(3).into_owned()
}

/// [a; b] from its halves.
#[inline]
pub fn stack(a: Vector3<f64>, b: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(a.x, a.y, a.z, b.x, b.y, b.z)
}
