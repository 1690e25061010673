//! A rigid body: its mass properties, its shape, its pose and its velocity.
//!
//! World axes are right-handed, by convention with z up. The origin of a body's frame is its center
//! of mass, and its axes are the principal axes of inertia. SI units throughout.
//!
//! ```
//! use lcplab_bodies::body::{Mass, Pose, State, angular, linear, stack};
//! use nalgebra::{Matrix3, Vector3};
//!
//! // A ball of 8 kg with I = 1 kg m², 4 m above the x axis, flies at 2 m/s and spins at 3 rad/s.
//! let ball = Mass::Rigid { mass: 8.0, moments: Vector3::repeat(1.0) };
//! let pose = Pose { p: 4.0 * Vector3::y(), ..Pose::default() };
//! let state = State { pose, v: 2.0 * Vector3::x(), omega: 3.0 * Vector3::z() };
//! assert_eq!((ball.dof(), ball.mass()), (6, 8.0));
//! assert_eq!(ball.momentum(&state), 16.0 * Vector3::x()); // kg m/s
//! assert_eq!(ball.angular_momentum(&state), (-4.0 * 16.0 + 3.0) * Vector3::z()); // kg m²/s
//! assert_eq!(ball.spin_energy(&state), 4.5); // ½ · 1 · 3² J
//! assert_eq!(ball.kinetic_energy(&state), 20.5); // ½ · 8 · 2² + 4.5 J
//! assert_eq!(ball.world_inertia(&pose), Matrix3::identity());
//!
//! // 8 N along x and 2 N m about z.
//! let u = ball.accelerate(&pose, &stack(8.0 * Vector3::x(), 2.0 * Vector3::z()));
//! assert_eq!((linear(&u), angular(&u)), (Vector3::x(), 2.0 * Vector3::z())); // m/s², rad/s²
//! ```

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

/// A body of a scene. Its state is stored separately, because it changes and these properties do
/// not.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// The name by which constraints and reports refer to it.
    pub name: String,
    /// Its mass properties.
    pub mass: Mass,
    /// Its shape for collision detection.
    pub shape: Shape,
    /// The coefficient of dry friction of its surface; a pair of bodies uses the geometric mean.
    pub friction: f64,
    /// The coefficient of static friction, if given, at least `friction`; a pair uses the geometric
    /// mean.
    pub static_friction: Option<f64>,
    /// The direction in which its surface has this friction, if friction across it differs.
    pub anisotropy: Option<Anisotropy>,
    /// The coefficient of restitution of its surface; `None` for the scene's value.
    pub restitution: Option<f64>,
    /// A constant force (N, world), in addition to gravity.
    pub force: Vector3<f64>,
    /// The point where the force acts (m, in the body's frame).
    pub force_at: Vector3<f64>,
    /// A constant torque (N m, world).
    pub torque: Vector3<f64>,
}

impl Body {
    /// The constant force and torque about the center of mass, [f; τ] (N, N m), in this pose.
    ///
    /// ```
    /// use lcplab_bodies::body::{Body, Mass, Pose, Shape, stack};
    /// use nalgebra::Vector3;
    ///
    /// // 10 N upward, 1 m beside the center of mass: 10 N m about −y.
    /// let body = Body {
    ///     name: "lever".into(),
    ///     mass: Mass::Rigid { mass: 1.0, moments: Vector3::repeat(1.0) },
    ///     shape: Shape::Point,
    ///     friction: 0.0,
    ///     static_friction: None,
    ///     anisotropy: None,
    ///     restitution: None,
    ///     force: 10.0 * Vector3::z(),
    ///     force_at: Vector3::x(),
    ///     torque: Vector3::zeros(),
    /// };
    /// assert_eq!(body.wrench(&Pose::default()), stack(10.0 * Vector3::z(), -10.0 * Vector3::y()));
    /// ```
    pub fn wrench(&self, pose: &Pose) -> Vector6<f64> {
        stack(self.force, pose.direction(&self.force_at).cross(&self.force) + self.torque)
    }
}

/// A surface whose friction depends on the direction, such as a runner's, a tire's or brushed
/// metal's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Anisotropy {
    /// The direction along which the surface has its coefficient of friction (unit vector, in the
    /// body's frame); on each face its projection counts.
    pub direction: Vector3<f64>,
    /// The coefficient across this direction divided by that along it, above 0.
    pub ratio: f64,
}

/// The mass properties of a body: its blocks of M and M⁻¹.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mass {
    /// Immovable: M⁻¹ = 0, and no velocity components.
    Fixed,
    /// A particle without orientation: 3 velocity components.
    Point {
        /// Mass (kg), positive.
        mass: f64,
    },
    /// A rigid body with 6 velocity components u = [v; ω].
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
    /// A point; it collides with all shapes except other points.
    Point,
    /// A ball.
    Sphere {
        /// Radius (m).
        radius: f64,
    },
    /// A box with faces perpendicular to the body's axes.
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
    /// A convex polytope with its center of mass at the origin and principal axes.
    Hull(Arc<Polytope>),
    /// Several convex shapes that move together, with their common center of mass at the origin.
    Compound(Arc<Vec<Placed>>),
    /// The half space behind a plane through the body's origin.
    Plane {
        /// The unit normal, pointing out of the half space.
        normal: Vector3<f64>,
    },
}

/// A convex part of a compound.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// Its shape.
    pub shape: Shape,
    /// Its pose in the body's frame.
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

    /// The mass (kg); 0 for a fixed body, which does not contribute to energy and momentum.
    pub fn mass(&self) -> f64 {
        match *self {
            Mass::Fixed => 0.0,
            Mass::Point { mass } | Mass::Rigid { mass, .. } => mass,
        }
    }

    /// I_world = R diag(moments) Rᵀ (kg m²); 0 for a body that cannot rotate.
    pub fn world_inertia(&self, pose: &Pose) -> Matrix3<f64> {
        self.turned(pose, |moment| moment)
    }

    /// M⁻¹ times a force and torque [f; τ]: the resulting acceleration; 0 for a fixed body.
    pub fn accelerate(&self, pose: &Pose, wrench: &Vector6<f64>) -> Vector6<f64> {
        let inverse_mass = match self {
            Mass::Fixed => return Vector6::zeros(),
            _ => 1.0 / self.mass(),
        };
        let linear = inverse_mass * linear(wrench);
        let angular = self.spin(pose, &angular(wrench));
        stack(linear, angular)
    }

    /// The angular velocity I⁻¹ L (rad/s, world) for an angular momentum L about the center of mass
    /// (kg m²/s, world); 0 for a body that cannot rotate.
    pub(crate) fn spin(&self, pose: &Pose, momentum: &Vector3<f64>) -> Vector3<f64> {
        self.turned(pose, f64::recip) * momentum
    }

    /// Kinetic energy ½ m |v|² + ½ ω·I ω (J).
    pub fn kinetic_energy(&self, state: &State) -> f64 {
        0.5 * self.mass() * state.v.norm_squared() + self.spin_energy(state)
    }

    /// The rotational kinetic energy ½ ω·I ω (J).
    pub fn spin_energy(&self, state: &State) -> f64 {
        0.5 * state.omega.dot(&self.spin_momentum(state))
    }

    /// The angular momentum I ω about the center of mass (kg m²/s, world), computed in the body's
    /// axes: in world axes the small moment of a thin body is lost in the rounding errors of the
    /// large ones.
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

    /// R diag(f(moments)) Rᵀ, made exactly symmetric; rounding would otherwise make A asymmetric.
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
