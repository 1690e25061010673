//! A contact: two bodies do not interpenetrate; one unilateral row along the unit normal n from
//! body 0 to body 1.
//!
//! ```text
//! c = n·d − (R0 + R1)
//! ```
//!
//! d joins the anchors: material points where a vertex touches, or the center of a ball, whose
//! radius R is subtracted. The touching point of a ball is not material; with it J'u of a rolling
//! ball would be wrong by |ω|²R. The quantity that determines n distinguishes the kinds of
//! [`Normal`]:
//!
//! ```text
//! face     n = R0 n_body: J = [−n, −((r0+d)×n), n, r1×n], J'u = n·cent + 2(ω0×n)·rel + (ω0×(ω0×n))·d
//! centers  n = d/|d|: a distance row
//! edge     n = h/|h|, h = d − e(e·d): the face's J and J'u, plus |h' − n(n·h')|²/|h| as n turns
//! rim      n as of a face, c = n·d − R s with a across the circle, u = a·n, s = √(1 − u²):
//!          J also ∓(R u/s) (a×n), J'u also R u'²/s³ + (R u/s) (ω1−ω0)·(a×n)'
//! edges    n = m/|m|, m = e0×e1; with P = I − nnᵀ, t = P d/|m|
//!          J = [−n, −(r0×n) + e0×(e1×t), n, r1×n + e1×(t×e0)], J'u = n·cent + 2 n'·rel + n''·d
//! ```
//!
//! K&M (22).

use nalgebra::{RealField, Vector3, Vector6};

use super::arms::{Arms, separation};
use super::distance::COINCIDENT;
use super::{Bodies, Constraint, Degenerate, Kind, Position, Row, constant, friction};
use crate::body::{Anisotropy, Pose, State, stack};

/// A contact point: 1 row, or 3 (normal and two tangents) with friction.
///
/// ```
/// use lcplab_bodies::body::{Pose, State};
/// use lcplab_bodies::constraint::{Contact, Normal};
/// use nalgebra::Vector3;
///
/// // A ball of radius 0.5 m with its center 0.75 m above the ground.
/// let contact = Contact {
///     bodies: [None, Some(0)],
///     anchors: [Vector3::zeros(); 2],
///     radii: [0.0, 0.5],
///     normal: Normal::Face(Vector3::z()),
///     friction: 0.0,
///     anisotropy: None,
/// };
/// let pose = Pose { p: 0.75 * Vector3::z(), ..Pose::default() };
/// let ball = State { pose, ..State::WORLD };
/// let nearest = contact.nearest([&State::WORLD, &ball])?;
/// assert_eq!((nearest.gap, nearest.normal), (0.25, Vector3::z()));
/// assert_eq!(nearest.point, 0.25 * Vector3::z()); // the ball's lowest point
/// # Ok::<(), lcplab_bodies::constraint::Degenerate>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Contact {
    /// The bodies; the normal of a face or an edge belongs to body 0.
    pub bodies: Bodies,
    /// The anchors in the bodies' frames (m): material points, or centers of balls.
    pub anchors: [Vector3<f64>; 2],
    /// The radii of balls around the anchors (m), 0 for material points.
    pub radii: [f64; 2],
    /// The quantity that determines the normal.
    pub normal: Normal,
    /// The coefficient of friction μ; without friction there are no tangential rows.
    pub friction: f64,
    /// If friction depends on the direction: the body (0 or 1 of this contact) whose surface has
    /// the direction along which the coefficient is μ.
    pub anisotropy: Option<(usize, Anisotropy)>,
}

/// How near the surfaces of a [`Contact`] are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// The gap c (m), negative if the bodies overlap.
    pub gap: f64,
    /// The unit normal n (world), from body 0 to body 1.
    pub normal: Vector3<f64>,
    /// The touching point of body 1 (m, world).
    pub point: Vector3<f64>,
}

/// The quantity that determines the normal of a contact. Vectors are unit vectors in their body's
/// frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Normal {
    /// The normal of a face of body 0.
    Face(Vector3<f64>),
    /// The direction from anchor 0 to anchor 1.
    Centers,
    /// Perpendicular to an edge of body 0 with this direction, toward anchor 1.
    Edge(Vector3<f64>),
    /// Perpendicular to an edge of body 0 and one of body 1, along e0 × e1.
    Edges([Vector3<f64>; 2]),
    /// The normal of a face of body 0 that a circle around anchor 1 of body 1 touches.
    Rim(Rim),
}

/// A circle of body 1 that touches with its lowest point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rim {
    /// The unit normal of the face, in the frame of body 0.
    pub normal: Vector3<f64>,
    /// The unit axis of the circle, perpendicular to its plane, in the frame of body 1; not
    /// parallel to the normal.
    pub axis: Vector3<f64>,
    /// The circle's radius (m).
    pub radius: f64,
}

/// The normal of a contact at one instant, and its motion.
pub(super) struct Frame {
    /// n (world).
    pub n: Vector3<f64>,
    /// n' (1/s).
    pub n_rate: Vector3<f64>,
    /// The angular velocity (rad/s) of the tangents, which follow n.
    pub turn: Vector3<f64>,
    /// From anchor 1 to the touching point (m), and its rate (m/s).
    pub toe: Vector3<f64>,
    pub toe_rate: Vector3<f64>,
    jacobian: [Vector6<f64>; 2],
    velocity_product: f64,
}

impl Contact {
    /// Inlined, as its cases are, so that [`nearest`](Contact::nearest) computes neither J nor J'u.
    #[inline(always)]
    fn frame(&self, arms: &Arms, states: [&State; 2]) -> Result<Frame, Degenerate> {
        let mut frame = match &self.normal {
            Normal::Rim(of) => return rim(arms, states, of),
            Normal::Face(n) => face(arms, states, states[0].pose.direction(n)),
            Normal::Centers => round(arms, states, None)?,
            Normal::Edge(axis) => round(arms, states, Some(states[0].pose.direction(axis)))?,
            Normal::Edges([e0, e1]) => {
                edges(arms, states, states[0].pose.direction(e0), states[1].pose.direction(e1))?
            }
        };
        frame.toe = -self.radii[1] * frame.n;
        frame.toe_rate = -self.radii[1] * frame.n_rate;
        Ok(frame)
    }

    /// c with the normal of this frame.
    fn separation(&self, arms: &Arms, frame: &Frame) -> f64 {
        match self.normal {
            Normal::Rim(_) => frame.n.dot(&(arms.d + frame.toe)),
            _ => frame.n.dot(&arms.d) - self.radii[0] - self.radii[1],
        }
    }

    /// The gap, the normal and the touching point at these states.
    ///
    /// # Errors
    /// If n is not defined.
    #[inline]
    pub fn nearest(&self, states: [&State; 2]) -> Result<Nearest, Degenerate> {
        let arms = Arms::new(states, &self.anchors);
        let frame = self.frame(&arms, states)?;
        Ok(Nearest {
            gap: self.separation(&arms, &frame),
            normal: frame.n,
            point: states[1].pose.p + arms.r[1] + frame.toe,
        })
    }
}

impl Constraint for Contact {
    fn bodies(&self) -> Bodies {
        self.bodies
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let mut rows = Vec::with_capacity(3);
        self.add_rows(states, &mut rows)?;
        Ok(rows)
    }

    fn add_rows(&self, states: [&State; 2], rows: &mut Vec<Row>) -> Result<(), Degenerate> {
        let arms = Arms::new(states, &self.anchors);
        let frame = self.frame(&arms, states)?;
        let c = self.separation(&arms, &frame);
        rows.push(Row::inequality(Kind::Normal, c, frame.jacobian, frame.velocity_product));
        if self.friction > 0.0 {
            rows.extend(friction::rows(self, &arms, &frame, states));
        }
        Ok(())
    }

    fn anchors(&self) -> Option<[Vector3<f64>; 2]> {
        Some(self.anchors)
    }
}

/// n is fixed to body 0.
#[inline(always)]
fn face(arms: &Arms, states: [&State; 2], n: Vector3<f64>) -> Frame {
    let omega0 = states[0].omega;
    Frame {
        n,
        n_rate: omega0.cross(&n),
        turn: omega0,
        toe: Vector3::zeros(),
        toe_rate: Vector3::zeros(),
        jacobian: arms.row_with_normal_on_body_0(&n),
        velocity_product: arms.product_with_normal_on_body_0(&n, &omega0),
    }
}

/// n points to anchor 1 from an edge of body 0 along `axis`, or from anchor 0 if there is no axis:
/// like a face whose normal moves in body 0's frame.
#[inline(always)]
fn round(
    arms: &Arms,
    states: [&State; 2],
    axis: Option<Vector3<f64>>,
) -> Result<Frame, Degenerate> {
    let across = |y: Vector3<f64>| axis.map_or(y, |e| y - e * e.dot(&y));
    let h = across(arms.d);
    let n = h.try_normalize(0.0).ok_or(COINCIDENT)?;
    // The rate as seen from body 0.
    let h_rate = across(arms.rel - states[0].omega.cross(&arms.d));
    let slide = h_rate - n * n.dot(&h_rate);
    let fixed = face(arms, states, n);
    let n_rate = fixed.n_rate + slide / h.norm();
    Ok(Frame {
        n_rate,
        turn: n.cross(&n_rate),
        velocity_product: fixed.velocity_product + slide.norm_squared() / h.norm(),
        ..fixed
    })
}

/// n is perpendicular to the edge e0 of body 0 and the edge e1 of body 1.
#[inline(always)]
fn edges(
    arms: &Arms,
    states: [&State; 2],
    e0: Vector3<f64>,
    e1: Vector3<f64>,
) -> Result<Frame, Degenerate> {
    let m = e0.cross(&e1);
    let length = m.norm();
    let n = m.try_normalize(1e-9).ok_or(PARALLEL)?;
    let [omega0, omega1] = [states[0].omega, states[1].omega];
    let (e0_rate, e1_rate) = (omega0.cross(&e0), omega1.cross(&e1));
    let m_rate = e0_rate.cross(&e1) + e0.cross(&e1_rate);
    let length_rate = n.dot(&m_rate);
    let n_rate = (m_rate - n * length_rate) / length;
    let m_product = omega0.cross(&e0_rate).cross(&e1)
        + 2.0 * e0_rate.cross(&e1_rate)
        + e0.cross(&omega1.cross(&e1_rate));
    let length_product = n.dot(&m_product) + n_rate.dot(&m_rate);
    let n_product = (m_product - n * length_product - 2.0 * n_rate * length_rate) / length;
    let t = (arms.d - n * n.dot(&arms.d)) / length;
    let [mut j0, mut j1] = arms.row(&n);
    j0 += stack(Vector3::zeros(), e0.cross(&e1.cross(&t)));
    j1 += stack(Vector3::zeros(), e1.cross(&t.cross(&e0)));
    Ok(Frame {
        n,
        n_rate,
        turn: n.cross(&n_rate),
        toe: Vector3::zeros(),
        toe_rate: Vector3::zeros(),
        jacobian: [j0, j1],
        velocity_product: n.dot(&arms.cent) + 2.0 * n_rate.dot(&arms.rel) + n_product.dot(&arms.d),
    })
}

/// n is fixed to body 0, and the lowest point of a circle of body 1 touches.
#[inline(always)]
fn rim(arms: &Arms, states: [&State; 2], of: &Rim) -> Result<Frame, Degenerate> {
    let [omega0, omega1] = [states[0].omega, states[1].omega];
    let (n, a) = (states[0].pose.direction(&of.normal), states[1].pose.direction(&of.axis));
    let across = a.cross(&n);
    let (u, s) = (a.dot(&n), across.norm());
    if s <= FLAT {
        return Err(Degenerate { reason: "a circle lies flat, so no point of it is the lowest" });
    }
    let fixed = face(arms, states, n);
    let (relative, a_rate) = (omega1 - omega0, omega1.cross(&a));
    let across_rate = a_rate.cross(&n) + a.cross(&fixed.n_rate);
    let (u_rate, lever) = (relative.dot(&across), of.radius * u / s);
    let s_rate = -u * u_rate / s;
    let down = n - a * u;
    let down_rate = fixed.n_rate - a_rate * u - a * u_rate;
    let [mut j0, mut j1] = fixed.jacobian;
    j0 -= stack(Vector3::zeros(), across * lever);
    j1 += stack(Vector3::zeros(), across * lever);
    Ok(Frame {
        toe: down * (-of.radius / s),
        toe_rate: (down_rate * s - down * s_rate) * (-of.radius / (s * s)),
        jacobian: [j0, j1],
        velocity_product: fixed.velocity_product
            + of.radius * u_rate * u_rate / s.powi(3)
            + lever * relative.dot(&across_rate),
        ..fixed
    })
}

/// A circle lies flat if its axis is this close to the normal (sine of the angle).
const FLAT: f64 = 1e-9;

const PARALLEL: Degenerate =
    Degenerate { reason: "the two edges are parallel, so no direction is perpendicular to both" };

impl Position for Contact {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        let d = separation(poses, &self.anchors);
        let c: T = match &self.normal {
            Normal::Face(n) => poses[0].direction(n).dot(&d),
            Normal::Rim(Rim { normal, axis, radius }) => {
                let n = poses[0].direction(normal);
                let s = poses[1].direction(axis).cross(&n).norm();
                n.dot(&d) - s * constant::<T>(*radius)
            }
            Normal::Centers => d.norm(),
            Normal::Edge(axis) => {
                let e = poses[0].direction(axis);
                (d - e * e.dot(&d)).norm()
            }
            Normal::Edges([e0, e1]) => {
                poses[0].direction(e0).cross(&poses[1].direction(e1)).normalize().dot(&d)
            }
        };
        vec![c - constant(self.radii[0] + self.radii[1])]
    }
}
