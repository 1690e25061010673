//! Verifies constraints: compares c, J and J'u of their rows with exact derivatives of c(s).
//!
//! Along p(t) = p + v t and q(t) = exp(ω t) q with constant v and ω, u' = 0, so c'(0) = J u and
//! c''(0) = J'u. Second-order dual numbers compute both to full accuracy: there is no step size to
//! choose, unlike for finite differences, and the only trusted formula is that of [`Position`]. J
//! is checked with each velocity component separately, J'u with the states' own velocities.

use std::fmt;

use nalgebra::{Quaternion, UnitQuaternion, Vector3, Vector6};
use num_dual::Dual2_64;

use super::{Bounds, Constraint, Degenerate, Position};
use crate::body::{Pose, State};

/// Differences up to this, relative to the exact number or 1 if that is larger, are rounding
/// errors.
const ROUNDING: f64 = 1e-9;

/// A constraint with a known position: every [`Constraint`] with [`Position`] implements it.
pub trait Verifiable: Constraint {
    /// c(s) with dual numbers.
    #[doc(hidden)] // [`derivatives`] takes states
    fn dual(&self, poses: [&Pose<Dual2_64>; 2]) -> Vec<Dual2_64>;
}

impl<C: Constraint + Position> Verifiable for C {
    fn dual(&self, poses: [&Pose<Dual2_64>; 2]) -> Vec<Dual2_64> {
        self.c(poses)
    }
}

/// An error of a constraint at some states.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Mistake {
    /// The constraint is not defined at these states: try others.
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
    /// A number that differs from c(s) or its derivative.
    #[error("row {row}: {quantity} is {ours}, by dual numbers {exact}")]
    Wrong {
        /// The row, from 0.
        row: usize,
        /// The quantity that is wrong.
        quantity: Quantity,
        /// Its value in the row.
        ours: f64,
        /// The exact value.
        exact: f64,
    },
}

/// A quantity of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// c.
    Position,
    /// An entry of J: the body, and the component of its [v; ω] from 0 to 5.
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

/// Compares all rows that have a position with dual numbers, at these states; for the world the
/// state is [`State::WORLD`], whatever is given. The c of a motor's row is not compared, because it
/// is always 0.
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

/// c, ċ and c̈ of every row that has a position, for bodies that move with constant velocities:
/// exact, by dual numbers and c(s) only. Since u' = 0, ċ is J u and c̈ is J'u. For the world the
/// state is [`State::WORLD`], whatever is given.
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

/// p + v t and exp(ω t) q at t = 0 with their first two derivatives: since q' = ½ (0, ω) q and ω is
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
