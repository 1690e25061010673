//! The tangential rows of a contact: dry friction as a box, |x_t| ≤ μ x_n along two tangents.
//!
//! They have no position: c = 0, and the row's velocity is the slip at the touching point
//!
//! ```text
//! ρ1 = r1 + toe,   ρ0 = p1 + ρ1 − p0
//! J u = t·slip,   slip = v1 + ω1×ρ1 − v0 − ω0×ρ0,   J = [−t, −(ρ0×t), t, ρ1×t]
//! J'u = t·(ω1×ρ1' − ω0×ρ0') + (Ω×t)·slip,   ρ1' = ω1×r1 + toe',   ρ0' = v1 + ρ1' − v0
//! ```
//!
//! where the vector toe (−R1 n for a ball) leads from anchor 1 to the touching point, and Ω is the
//! angular velocity of the tangents as they follow n: body 0's ω if n is fixed to it, else n×n'.
//! The touching point of a ball is not material; therefore ρ1' contains toe'.
//!
//! Anisotropic friction, μ1 along a direction d of a surface and μ2 across it, limits x_t to an
//! ellipse, and friction dissipates as much as the ellipse allows. With t1 along d and a t2 of the
//! length μ2/μ1 instead of 1, the ellipse is the disk of radius μ1 x_n again, and the law is that
//! of isotropic friction:
//!
//! ```text
//! (x1/μ1)² + (x2/μ2)² ≤ x_n²   ⇔   |(x1, y2)| ≤ μ1 x_n     with x2 = y2 μ2/μ1
//! ```
//!
//! So do the box and the polygon. The impulse of the row is y2 times t2, as for every row.

use nalgebra::Vector3;

use super::arms::Arms;
use super::contact::{Contact, Frame};
use super::{Bounds, Kind, Row};
use crate::body::{Anisotropy, Pose, State, stack};

/// The sine of the angle to the normal below which a direction is no direction on the surface.
const NORMAL_TO_SURFACE: f64 = 1e-6;

/// The two tangential rows that follow a contact's normal row.
#[inline]
pub(super) fn rows(contact: &Contact, arms: &Arms, frame: &Frame, states: [&State; 2]) -> [Row; 2] {
    let [s0, s1] = states;
    let rho1 = arms.r[1] + frame.toe;
    let rho0 = s1.pose.p + rho1 - s0.pose.p;
    let slip = s1.v + s1.omega.cross(&rho1) - s0.v - s0.omega.cross(&rho0);
    let rho1_rate = s1.omega.cross(&arms.r[1]) + frame.toe_rate;
    let rho0_rate = s1.v + rho1_rate - s0.v;
    let slip_product = s1.omega.cross(&rho1_rate) - s0.omega.cross(&rho0_rate);
    let (tangents, turn) = match contact.anisotropy {
        Some((body, surface)) => aligned(&surface, frame, &states[body].pose, &states[body].omega),
        None => (tangents(&frame.n), frame.turn),
    };
    tangents.map(|t| {
        let jacobian = [stack(-t, -rho0.cross(&t)), stack(t, rho1.cross(&t))];
        let product = t.dot(&slip_product) + turn.cross(&t).dot(&slip);
        let bounds = Bounds::Friction { normal: 0, mu: contact.friction };
        Row { bounds, ..Row::equation(Kind::Friction, 0.0, jacobian, product) }
    })
}

/// The tangents along and across a surface's direction, and their angular velocity (rad/s). Where
/// the direction is normal to the surface, friction is the same in all directions.
fn aligned(
    surface: &Anisotropy,
    frame: &Frame,
    pose: &Pose,
    omega: &Vector3<f64>,
) -> ([Vector3<f64>; 2], Vector3<f64>) {
    let (n, d) = (frame.n, pose.direction(&surface.direction));
    let along = d - n * n.dot(&d);
    let Some(t1) = along.try_normalize(NORMAL_TO_SURFACE) else {
        return (tangents(&n), frame.turn);
    };
    let across = n.cross(&t1);
    let rate = omega.cross(&d) - frame.n_rate * n.dot(&d);
    let spin = across.dot(&rate) / along.norm();
    ([t1, across * surface.ratio], n.cross(&frame.n_rate) + n * spin)
}

/// Two unit tangents with t1 × t2 = n: t1 is the world's x axis projected along n, or the y axis if
/// n is nearly x. On a slope that falls along x, t1 points down or up the slope.
///
/// ```
/// use lcplab_bodies::constraint::tangents;
/// use nalgebra::Vector3;
///
/// assert_eq!(tangents(&Vector3::z()), [Vector3::x(), Vector3::y()]); // on the ground
/// assert_eq!(tangents(&Vector3::x()), [Vector3::y(), Vector3::z()]); // on a wall
/// ```
pub fn tangents(n: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let axis = if n.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
    let t1 = (axis - n * n.dot(&axis)).normalize();
    [t1, n.cross(&t1)]
}
