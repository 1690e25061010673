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

use nalgebra::Vector3;

use super::arms::Arms;
use super::contact::{Contact, Frame};
use super::{Bounds, Kind, Row};
use crate::body::{State, stack};

/// The two tangential rows that follow a contact's normal row.
pub(super) fn rows(contact: &Contact, arms: &Arms, frame: &Frame, states: [&State; 2]) -> [Row; 2] {
    let [s0, s1] = states;
    let rho1 = arms.r[1] + frame.toe;
    let rho0 = s1.pose.p + rho1 - s0.pose.p;
    let slip = s1.v + s1.omega.cross(&rho1) - s0.v - s0.omega.cross(&rho0);
    let rho1_rate = s1.omega.cross(&arms.r[1]) + frame.toe_rate;
    let rho0_rate = s1.v + rho1_rate - s0.v;
    let slip_product = s1.omega.cross(&rho1_rate) - s0.omega.cross(&rho0_rate);
    tangents(&frame.n).map(|t| {
        let jacobian = [stack(-t, -rho0.cross(&t)), stack(t, rho1.cross(&t))];
        let product = t.dot(&slip_product) + frame.turn.cross(&t).dot(&slip);
        let bounds = Bounds::Friction { normal: 0, mu: contact.friction };
        Row { bounds, ..Row::equation(Kind::Friction, 0.0, jacobian, product) }
    })
}

/// Two unit tangents with t1 × t2 = n: t1 is the world's x axis projected along n, or the y axis if
/// n is nearly x. On a slope that falls along x, t1 points down or up the slope.
pub fn tangents(n: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let axis = if n.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
    let t1 = (axis - n * n.dot(&axis)).normalize();
    [t1, n.cross(&t1)]
}
