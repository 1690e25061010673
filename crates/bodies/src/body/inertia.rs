//! Volumes and principal moments of inertia of homogeneous shapes: closed forms for simple shapes,
//! sums over the tetrahedra between the faces and an interior point for hulls, and the parallel
//! axis theorem for compounds.
//!
//! ```
//! use lcplab_bodies::body::inertia::{principal_frame, principal_frame_of_parts, volume};
//! use lcplab_bodies::body::{Placed, Polytope, Pose, Shape};
//! use nalgebra::Vector3;
//!
//! let half = Vector3::new(1.0, 0.5, 0.25);
//! assert_eq!(volume(&Shape::Box { half }), Some(1.0)); // 2 m × 1 m × 0.5 m
//! assert_eq!(volume(&Shape::Point), None);
//! assert!(principal_frame(&Polytope::cuboid(&half)).p.norm() < 1e-15); // it is centered
//!
//! // Two equal balls, 2 m apart.
//! let ball = |x: f64| {
//!     let pose = Pose { p: x * Vector3::x(), ..Pose::default() };
//!     Placed { shape: Shape::Sphere { radius: 0.5 }, pose }
//! };
//! let frame = principal_frame_of_parts(&[ball(0.0), ball(2.0)]);
//! assert!((frame.p - Vector3::x()).norm() < 1e-15); // the center of mass is in the middle
//! ```

use nalgebra::{Matrix3, Rotation3, SymmetricEigen, UnitQuaternion, Vector3};

use super::{Placed, Polytope, Pose, Shape};

/// Products of inertia below this fraction of the moments are rounding errors.
const DIAGONAL: f64 = 1e-12;

/// The volume (m³); `None` for a point and a half space.
pub fn volume(shape: &Shape) -> Option<f64> {
    match shape {
        Shape::Sphere { radius } => Some(ball(*radius)),
        Shape::Box { half } => Some(8.0 * half.x * half.y * half.z),
        Shape::Capsule { half_length, radius } => {
            Some(cylinder(*half_length, *radius) + ball(*radius))
        }
        Shape::Hull(hull) => Some(Solid::of(hull).volume),
        Shape::Compound(parts) => Some(Solid::of_parts(parts).volume),
        Shape::Point | Shape::Plane { .. } => None,
    }
}

/// The principal moments (kg m²) of a homogeneous body of this mass (kg): ⅖ m r² for a sphere, m
/// (b² + c²)/3 about the axis along a for a box with half edges a, b, c; `None` for a point and a
/// half space.
///
/// ```
/// use lcplab_bodies::body::{Shape, inertia};
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
        Shape::Capsule { half_length, radius } => Some(capsule(*half_length, *radius, mass)),
        Shape::Hull(hull) => Some(Solid::of(hull).moments(mass)),
        Shape::Compound(parts) => Some(Solid::of_parts(parts).moments(mass)),
        Shape::Point | Shape::Plane { .. } => None,
    }
}

/// The frame of a homogeneous polytope, in the polytope's own axes: the origin is the center of
/// mass, the axes are principal. If its own axes are principal, they are kept.
pub fn principal_frame(polytope: &Polytope) -> Pose {
    Solid::of(polytope).frame()
}

/// The same for several homogeneous parts; where two parts overlap, the mass counts twice.
pub fn principal_frame_of_parts(parts: &[Placed]) -> Pose {
    Solid::of_parts(parts).frame()
}

fn ball(radius: f64) -> f64 {
    4.0 / 3.0 * std::f64::consts::PI * radius.powi(3)
}

fn cylinder(half_length: f64, radius: f64) -> f64 {
    2.0 * half_length * std::f64::consts::PI * radius * radius
}

/// The moments of a cylinder of mass m_c and two half balls of mass m_s together; l is the half
/// length:
///
/// ```text
/// I_z = m_c r²/2 + ⅖ m_s r²,   I_x = m_c (l²/3 + r²/4) + m_s (⅖ r² + l² + ¾ l r)
/// ```
fn capsule(l: f64, r: f64, mass: f64) -> Vector3<f64> {
    let density = mass / (cylinder(l, r) + ball(r));
    let (middle, ends) = (density * cylinder(l, r), density * ball(r));
    let along = middle * r * r / 2.0 + ends * 0.4 * r * r;
    let across = middle * (l * l / 3.0 + r * r / 4.0) + ends * (0.4 * r * r + l * l + 0.75 * l * r);
    Vector3::new(across, across, along)
}

/// The integrals of 1, x and x xᵀ over a homogeneous solid of density 1.
struct Solid {
    volume: f64,
    center: Vector3<f64>,
    /// ∫ (x − center)(x − center)ᵀ dV.
    second: Matrix3<f64>,
}

impl Solid {
    /// Sums over the tetrahedra (0, a, b, c) between an interior point and the triangles of the
    /// faces: V = a·(b×c)/6, ∫x = V s/4, ∫x xᵀ = V (aaᵀ + bbᵀ + ccᵀ + ssᵀ)/20 with s = a + b + c.
    fn of(polytope: &Polytope) -> Self {
        let vertices = &polytope.vertices;
        let within = vertices.iter().sum::<Vector3<f64>>() / vertices.len() as f64;
        let (mut volume, mut first, mut second) = (0.0, Vector3::zeros(), Matrix3::zeros());
        for face in &polytope.faces {
            let a = vertices[face.corners[0]] - within;
            for pair in face.corners[1..].windows(2) {
                let [b, c] = [pair[0], pair[1]].map(|k| vertices[k] - within);
                let (part, s) = (a.dot(&b.cross(&c)) / 6.0, a + b + c);
                volume += part;
                first += s * (part / 4.0);
                second += [a, b, c, s].map(|x| x * x.transpose()).iter().sum::<Matrix3<f64>>()
                    * (part / 20.0);
            }
        }
        let offset = first / volume;
        Solid {
            volume,
            center: within + offset,
            second: second - offset * offset.transpose() * volume,
        }
    }

    /// The sum of the parts: C = Σ (R C_i Rᵀ + V_i d dᵀ) with d from the common center to that of a
    /// part.
    fn of_parts(parts: &[Placed]) -> Self {
        let volumes: Vec<f64> = parts.iter().map(|p| volume(&p.shape).unwrap_or(0.0)).collect();
        let volume: f64 = volumes.iter().sum();
        let weighted = parts.iter().zip(&volumes).map(|(part, v)| part.pose.p * *v);
        let center = weighted.sum::<Vector3<f64>>() / volume;
        let second = |(part, v): (&Placed, &f64)| {
            let moments = moments(&part.shape, *v).unwrap_or_default();
            let own = Matrix3::from_diagonal(&moments.map(|moment| 0.5 * moments.sum() - moment));
            let (r, d) = (part.pose.q.to_rotation_matrix(), part.pose.p - center);
            r.matrix() * own * r.matrix().transpose() + d * d.transpose() * *v
        };
        let second = parts.iter().zip(&volumes).map(second).sum();
        Solid { volume, center, second }
    }

    /// The inertia tensor about the center for density 1: tr(C) 1 − C.
    fn inertia(&self) -> Matrix3<f64> {
        Matrix3::identity() * self.second.trace() - self.second
    }

    /// The moments (kg m²) about its axes, which must be principal, for this mass (kg).
    fn moments(&self, mass: f64) -> Vector3<f64> {
        self.inertia().diagonal() * (mass / self.volume)
    }

    /// The frame with principal axes.
    fn frame(&self) -> Pose {
        let inertia = self.inertia();
        let products = inertia - Matrix3::from_diagonal(&inertia.diagonal());
        if products.amax() <= DIAGONAL * inertia.trace() {
            return Pose { p: self.center, q: UnitQuaternion::identity() };
        }
        let axes = SymmetricEigen::new(inertia).eigenvectors;
        let (x, y) = (axes.column(0).into_owned(), axes.column(1).into_owned());
        let right_handed = Matrix3::from_columns(&[x, y, x.cross(&y)]);
        let rotation = Rotation3::from_matrix_unchecked(right_handed);
        Pose { p: self.center, q: UnitQuaternion::from_rotation_matrix(&rotation) }
    }
}
