//! The state of a body: pose s = [p; q] and velocity u = [v; ω].

use nalgebra::{Quaternion, RealField, UnitQuaternion, Vector3, Vector6};

use super::{angular, linear, stack};

/// Position and orientation. The scalar type is generic so that tests can use dual numbers.
///
/// ```
/// use std::f64::consts::FRAC_PI_2;
///
/// use lcplab_bodies::body::Pose;
/// use nalgebra::{UnitQuaternion, Vector3};
///
/// // At (1, 0, 0), turned by a quarter about z.
/// let q = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), FRAC_PI_2);
/// let pose = Pose { p: Vector3::x(), q };
/// let near = |a: Vector3<f64>, b: Vector3<f64>| (a - b).norm() < 1e-15;
/// assert!(near(pose.direction(&Vector3::x()), Vector3::y()));
/// assert!(near(pose.point(&Vector3::x()), Vector3::new(1.0, 1.0, 0.0)));
/// assert!(near(pose.local(&Vector3::new(1.0, 1.0, 0.0)), Vector3::x()));
/// assert!(near(pose.after(&pose.inverse()).p, Vector3::zeros()));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose<T: RealField + Copy = f64> {
    /// The center of mass (m, world).
    pub p: Vector3<T>,
    /// The rotation from body to world axes.
    pub q: UnitQuaternion<T>,
}

impl<T: RealField + Copy> Pose<T> {
    /// The world point (m) that has these coordinates in the body's frame: p + R r.
    #[inline]
    pub fn point(&self, body: &Vector3<f64>) -> Vector3<T> {
        self.p + self.direction(body)
    }

    /// The world vector that has these components in the body's frame: R r.
    #[inline]
    pub fn direction(&self, body: &Vector3<f64>) -> Vector3<T> {
        self.q * body.map(nalgebra::convert::<f64, T>)
    }
}

/// The identity: at the origin, not rotated.
impl Default for Pose {
    fn default() -> Self {
        State::WORLD.pose
    }
}

impl Pose {
    /// The coordinates in the body's frame (m) of a world point: Rᵀ (x − p).
    #[inline]
    pub fn local(&self, world: &Vector3<f64>) -> Vector3<f64> {
        self.q.inverse() * (world - self.p)
    }

    /// The world pose of an object whose pose in the body's frame is `inner`.
    pub fn after(&self, inner: &Pose) -> Pose {
        Pose { p: self.point(&inner.p), q: self.q * inner.q }
    }

    /// The inverse pose.
    pub fn inverse(&self) -> Pose {
        let q = self.q.inverse();
        Pose { p: -(q * self.p), q }
    }
}

/// A body's pose and velocity.
///
/// ```
/// use lcplab_bodies::body::{State, stack};
/// use nalgebra::{Quaternion, Vector3};
///
/// // A wheel rolls at 1 m/s and 2 rad/s.
/// let wheel = State { v: Vector3::x(), omega: 2.0 * Vector3::y(), ..State::WORLD };
/// assert_eq!(wheel.velocity(), stack(Vector3::x(), 2.0 * Vector3::y()));
/// assert_eq!(wheel.with_velocity(&wheel.velocity()), wheel);
/// assert_eq!(wheel.rate(), (Vector3::x(), Quaternion::new(0.0, 0.0, 1.0, 0.0))); // q' = ½ (0, ω)
/// // Moved as by its velocity for ½ s.
/// assert_eq!(wheel.displaced(&(0.5 * wheel.velocity())), wheel.advanced(0.5));
/// assert!(wheel.is_finite() && !State { v: Vector3::repeat(f64::NAN), ..wheel }.is_finite());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Position and orientation.
    pub pose: Pose,
    /// Velocity of the center of mass (m/s, world).
    pub v: Vector3<f64>,
    /// Angular velocity (rad/s, world).
    pub omega: Vector3<f64>,
}

impl State {
    /// The state of the world itself: at the origin, at rest.
    pub const WORLD: State = State {
        pose: Pose {
            p: Vector3::new(0.0, 0.0, 0.0),
            q: UnitQuaternion::new_unchecked(Quaternion::new(1.0, 0.0, 0.0, 0.0)),
        },
        v: Vector3::new(0.0, 0.0, 0.0),
        omega: Vector3::new(0.0, 0.0, 0.0),
    };

    /// u = [v; ω].
    #[inline]
    pub fn velocity(&self) -> Vector6<f64> {
        stack(self.v, self.omega)
    }

    /// The same pose with another velocity u = [v; ω].
    pub fn with_velocity(&self, u: &Vector6<f64>) -> State {
        State { pose: self.pose, v: linear(u), omega: angular(u) }
    }

    /// ds/dt = S(s) u: the velocity v, and q' = ½ (0, ω) ⊗ q.
    pub fn rate(&self) -> (Vector3<f64>, Quaternion<f64>) {
        (self.v, Quaternion::from_imag(self.omega) * self.pose.q.into_inner() * 0.5)
    }

    /// The pose after dt (s) at constant velocity u: p + dt v, and q turned by exactly dt ω, which
    /// is the solution of s' = S(s) u; the velocity is unchanged.
    ///
    /// ```
    /// use lcplab_bodies::body::State;
    /// use nalgebra::Vector3;
    ///
    /// let wheel = State { omega: Vector3::new(0.0, 3.0, 0.0), ..State::WORLD };
    /// let turned = wheel.advanced(0.5).pose.q.scaled_axis(); // rad
    /// assert!((turned - Vector3::new(0.0, 1.5, 0.0)).norm() < 1e-15);
    /// ```
    pub fn advanced(&self, dt: f64) -> State {
        let half = 0.5 * dt * self.omega;
        let angle = half.norm();
        let (sin, cos) = libm::sincos(angle);
        let sinc = if angle > 0.0 { sin / angle } else { 1.0 };
        let turn = Quaternion::from_parts(cos, sinc * half);
        let q = UnitQuaternion::new_normalize(turn * self.pose.q.into_inner());
        State { pose: Pose { p: self.pose.p + dt * self.v, q }, ..*self }
    }

    /// The pose moved by Δp and turned by Δθ, d = [Δp; Δθ]; the velocity is unchanged.
    pub fn displaced(&self, d: &Vector6<f64>) -> State {
        State { pose: self.with_velocity(d).advanced(1.0).pose, ..*self }
    }

    /// Whether all numbers are finite.
    pub fn is_finite(&self) -> bool {
        let numbers = [self.pose.p, self.v, self.omega];
        numbers.iter().all(|x| x.iter().all(|x| x.is_finite()))
            && self.pose.q.coords.iter().all(|x| x.is_finite())
    }
}
