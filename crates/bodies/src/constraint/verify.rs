//! Is a constraint what it says? c, J and J'u of its rows against exact derivatives of c(s).
//!
//! Along p(t) = p + v t and q(t) = exp(ω t) q with constant v and ω, u' = 0, so c'(0) = J u and
//! c''(0) = J'u. Second-order dual numbers give both to the last digits: no step to choose, as
//! finite differences have, and no formula to trust but that of [`Position`]. J is tried along each
//! velocity component alone, J'u along the states' own velocities.

use std::fmt;

use nalgebra::{Quaternion, UnitQuaternion, Vector3, Vector6};
use num_dual::Dual2_64;

use super::{Bounds, Constraint, Degenerate, Position};
use crate::body::{Pose, State};

/// A difference up to this, relative to 1 or the exact number if that is larger, is rounding.
const ROUNDING: f64 = 1e-9;

/// A constraint whose position is known: every [`Constraint`] that is a [`Position`] is one.
pub trait Verifiable: Constraint {
    /// c(s) over dual numbers.
    fn dual(&self, poses: [&Pose<Dual2_64>; 2]) -> Vec<Dual2_64>;
}

impl<C: Constraint + Position> Verifiable for C {
    fn dual(&self, poses: [&Pose<Dual2_64>; 2]) -> Vec<Dual2_64> {
        self.c(poses)
    }
}

/// What is wrong with a constraint at some states.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Mistake {
    /// It has no rows there: try other states.
    #[error("{0}")]
    Undefined(Degenerate),
    /// Fewer rows than positions.
    #[error("{rows} rows for {positions} positions")]
    Missing {
        /// The number of rows.
        rows: usize,
        /// The number of entries of c(s).
        positions: usize,
    },
    /// A number that is not what c(s) and its derivatives say.
    #[error("row {row}: {quantity} is {ours}, by dual numbers {exact}")]
    Wrong {
        /// The row, from 0.
        row: usize,
        /// Which of its numbers.
        quantity: Quantity,
        /// Its value in the row.
        ours: f64,
        /// What it should be.
        exact: f64,
    },
}

/// A number of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// c.
    Position,
    /// An entry of J: of this body's [v; ω], the component from 0 to 5.
    Jacobian(usize, usize),
    /// J'u.
    VelocityProduct,
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Quantity::Position => f.write_str("c"),
            Quantity::Jacobian(body, k) => write!(f, "J[body {body}][{k}]"),
            Quantity::VelocityProduct => f.write_str("J'u"),
        }
    }
}

/// Compares all rows that have a position with dual numbers, at these states; where a body is the
/// world its state is [`State::WORLD`], whatever is given. The c of a motor's row is not compared:
/// it is 0, whatever place its position tells.
///
/// # Errors
/// The first [`Mistake`].
///
/// ```
/// use lcplab_bodies::body::State;
/// use lcplab_bodies::constraint::{Distance, verify};
/// use nalgebra::Vector3;
///
/// let rod = Distance { bodies: [None, Some(0)], anchors: [Vector3::zeros(); 2], length: 1.0 };
/// let mut bob = State::WORLD;
/// (bob.pose.p.x, bob.v.y) = (2.0, 3.0);
/// verify(&rod, [&State::WORLD, &bob])?;
/// # Ok::<(), lcplab_bodies::constraint::Mistake>(())
/// ```
pub fn verify(constraint: &dyn Verifiable, states: [&State; 2]) -> Result<(), Mistake> {
    let bodies = constraint.bodies();
    let states = [0, 1].map(|k| if bodies[k].is_some() { *states[k] } else { State::WORLD });
    let rows = constraint.rows([&states[0], &states[1]]).map_err(Mistake::Undefined)?;
    let exact = |states: &[State; 2]| constraint.dual([&moving(&states[0]), &moving(&states[1])]);
    let own = exact(&states);
    if rows.len() < own.len() {
        return Err(Mistake::Missing { rows: rows.len(), positions: own.len() });
    }
    for (row, exact) in own.iter().enumerate() {
        if !matches!(rows[row].bounds, Bounds::Effort(_)) {
            compare(row, Quantity::Position, rows[row].c, exact.re)?;
        }
        compare(row, Quantity::VelocityProduct, rows[row].velocity_product, exact.v2)?;
    }
    for body in (0..2).filter(|&body| bodies[body].is_some()) {
        for k in 0..6 {
            let mut still = states.map(|state| state.with_velocity(&Vector6::zeros()));
            still[body] = still[body].with_velocity(&Vector6::ith(k, 1.0));
            for (row, exact) in exact(&still).iter().enumerate() {
                let ours = rows[row].jacobian[body][k];
                compare(row, Quantity::Jacobian(body, k), ours, exact.v1)?;
            }
        }
    }
    Ok(())
}

/// c, ċ and c̈ of every row that has a position, as the bodies go on with their velocities
/// unchanged: exact, by dual numbers and c(s) alone. Since u' = 0 there, ċ is J u and c̈ is J'u.
/// Where a body is the world its state is [`State::WORLD`], whatever is given.
///
/// ```
/// use lcplab_bodies::body::State;
/// use lcplab_bodies::constraint::{Distance, derivatives};
/// use nalgebra::Vector3;
///
/// let rod = Distance { bodies: [None, Some(0)], anchors: [Vector3::zeros(); 2], length: 2.0 };
/// let mut bob = State::WORLD;
/// (bob.pose.p.x, bob.v.y) = (2.0, 3.0); // on a circle of 2 m at 3 m/s
/// assert_eq!(derivatives(&rod, [&State::WORLD, &bob]), [[0.0, 0.0, 4.5]]);
/// ```
pub fn derivatives(constraint: &dyn Verifiable, states: [&State; 2]) -> Vec<[f64; 3]> {
    let bodies = constraint.bodies();
    let states = [0, 1].map(|k| if bodies[k].is_some() { *states[k] } else { State::WORLD });
    let rows = constraint.dual([&moving(&states[0]), &moving(&states[1])]);
    rows.iter().map(|c| [c.re, c.v1, c.v2]).collect()
}

fn compare(row: usize, quantity: Quantity, ours: f64, exact: f64) -> Result<(), Mistake> {
    if (ours - exact).abs() <= ROUNDING * exact.abs().max(1.0) {
        return Ok(());
    }
    Err(Mistake::Wrong { row, quantity, ours, exact })
}

/// p + v t and exp(ω t) q at t = 0 with their first two derivatives: with q' = ½ (0, ω) q and ω
/// constant, q'' = −¼ |ω|² q.
fn moving(state: &State) -> Pose<Dual2_64> {
    let (p, q) = (state.pose.p, state.pose.q.into_inner());
    let (p_rate, q_rate) = state.rate();
    let q_bend = q * (-0.25 * state.omega.norm_squared());
    let dual = |k: usize| Dual2_64::new(q.coords[k], q_rate.coords[k], q_bend.coords[k]);
    Pose {
        p: Vector3::from_fn(|k, _| Dual2_64::new(p[k], p_rate[k], 0.0)),
        q: UnitQuaternion::new_unchecked(Quaternion::new(dual(3), dual(0), dual(1), dual(2))),
    }
}
