//! From rates to motion: one step of y' = f(y), y = (p, q, v, ω) of all bodies.
//!
//! ```text
//! explicit Euler      y⁺ = y + h f(y)
//! Runge-Kutta         k1 = f(y), k2 = f(y + h/2 k1), k3 = f(y + h/2 k2), k4 = f(y + h k3),
//!                     y⁺ = y + h/6 (k1 + 2 k2 + 2 k3 + k4)
//! implicit midpoint   k = f(y + h/2 k), by repetition;   y⁺ = y + h k
//! ```
//!
//! q' = ½ (0, ω) ⊗ q is linear in q, so the stages take q as it comes: normalised between the
//! stages the fourth order would be lost. The forces see the rotation of the direction of q. At the
//! end of the step q is normalised. Hairer, Lubich & Wanner, *Geometric Numerical Integration*.

use nalgebra::{Quaternion, UnitQuaternion, Vector3, Vector6};

use super::Cause;
use crate::body::{Pose, State, angular, linear};

/// Repetitions of the midpoint's equation; with h times the stiffest rate below 1 far fewer do.
const MAX_REPETITIONS: usize = 200;
/// The change of h k, relative to y, at which the iteration has converged.
const CONVERGED: f64 = 1e-14;
/// The change that is accepted if 200 repetitions do not reach `CONVERGED`: the tolerance of a
/// solver.
const ACCEPTED_CHANGE: f64 = 1e-8;
/// The change at which the iteration has diverged.
const DIVERGED: f64 = 1e6;

/// y' of one body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rate {
    p: Vector3<f64>,
    q: Quaternion<f64>,
    v: Vector3<f64>,
    omega: Vector3<f64>,
}

/// y' of all bodies at a stage, so long (s) after the beginning; its quaternions are not
/// normalised.
pub(super) type Field<'f> = &'f mut dyn FnMut(f64, &[State]) -> Result<Vec<Rate>, Cause>;

impl Rate {
    /// The rate of a body with this state and this acceleration u'.
    pub fn of(state: &State, acceleration: &Vector6<f64>) -> Self {
        let (p, q) = state.rate();
        Rate { p, q, v: linear(acceleration), omega: angular(acceleration) }
    }

    fn plus(self, h: f64, other: &Rate) -> Self {
        Rate {
            p: self.p + other.p * h,
            q: self.q + other.q * h,
            v: self.v + other.v * h,
            omega: self.omega + other.omega * h,
        }
    }

    fn size(&self) -> f64 {
        [self.p.amax(), self.q.coords.amax(), self.v.amax(), self.omega.amax()]
            .into_iter()
            .fold(0.0, f64::max)
    }
}

/// y + h f(y).
pub(super) fn explicit_euler(h: f64, states: &[State], field: Field) -> Result<Vec<State>, Cause> {
    Ok(normalised(&moved(states, h, &field(0.0, states)?)))
}

/// The classical Runge-Kutta step.
pub(super) fn rk4(h: f64, y: &[State], field: Field) -> Result<Vec<State>, Cause> {
    let k1 = field(0.0, y)?;
    let k2 = field(h / 2.0, &moved(y, h / 2.0, &k1))?;
    let k3 = field(h / 2.0, &moved(y, h / 2.0, &k2))?;
    let k4 = field(h, &moved(y, h, &k3))?;
    let mean = |i: usize| k1[i].plus(2.0, &k2[i]).plus(2.0, &k3[i]).plus(1.0, &k4[i]);
    let sum: Vec<Rate> = (0..y.len()).map(mean).collect();
    Ok(normalised(&moved(y, h / 6.0, &sum)))
}

/// The implicit midpoint step.
///
/// # Errors
/// [`Cause::Unsettled`] if repetition does not converge: the step is too long.
pub(super) fn implicit_midpoint(h: f64, y: &[State], field: Field) -> Result<Vec<State>, Cause> {
    let size = y.iter().map(size).fold(0.0, f64::max);
    let mut k = field(h / 2.0, y)?;
    let mut change = f64::INFINITY;
    for _ in 0..MAX_REPETITIONS {
        let next = field(h / 2.0, &moved(y, h / 2.0, &k))?;
        let differences = next.iter().zip(&k).map(|(a, b)| a.plus(-1.0, b).size());
        change = h * differences.fold(0.0, f64::max) / size;
        k = next;
        if change <= CONVERGED || !(change <= DIVERGED) {
            break;
        }
    }
    if !(change <= ACCEPTED_CHANGE) {
        return Err(Cause::Unsettled { change });
    }
    Ok(normalised(&moved(y, h, &k)))
}

/// The largest number in a state; at least ½, which the quaternion has.
fn size(state: &State) -> f64 {
    let State { pose, v, omega } = state;
    [pose.p.amax(), pose.q.coords.amax(), v.amax(), omega.amax()].into_iter().fold(0.0, f64::max)
}

/// y + h k with quaternions as they come.
fn moved(states: &[State], h: f64, rates: &[Rate]) -> Vec<State> {
    let one = |(state, rate): (&State, &Rate)| State {
        pose: Pose {
            p: state.pose.p + rate.p * h,
            q: UnitQuaternion::new_unchecked(state.pose.q.into_inner() + rate.q * h),
        },
        v: state.v + rate.v * h,
        omega: state.omega + rate.omega * h,
    };
    states.iter().zip(rates).map(one).collect()
}

/// The same with unit quaternions.
pub(super) fn normalised(states: &[State]) -> Vec<State> {
    let one = |state: &State| {
        let q = UnitQuaternion::new_normalize(state.pose.q.into_inner());
        State { pose: Pose { q, ..state.pose }, ..*state }
    };
    states.iter().map(one).collect()
}
