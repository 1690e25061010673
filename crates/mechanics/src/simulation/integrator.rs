//! From rates to motion: one step of y' = f(y), y = (p, q, v, ω) of all bodies.
//!
//! ```text
//! explicit Euler      y⁺ = y + h f(y)
//! Runge-Kutta         k1 = f(y), k2 = f(y + h/2 k1), k3 = f(y + h/2 k2), k4 = f(y + h k3),
//!                     y⁺ = y + h/6 (k1 + 2 k2 + 2 k3 + k4)
//! implicit midpoint   k = f(y + h/2 k);   y⁺ = y + h k
//! ```
//!
//! The midpoint's equation is solved by repetition with the secant of the last two iterates
//! (Anderson acceleration, depth 1): g = f(y + h/2 k), r = g − k, and
//!
//! ```text
//! k ← g − θ (g − g'),   θ = r·(r − r') / |r − r'|²;   g', r' of the previous iterate
//! ```
//!
//! This halves the repetitions where constraint errors are fed back. Walker & Ni, *SIAM J. Numer.
//! Anal.* 49 (2011).
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

    fn dot(&self, other: &Rate) -> f64 {
        self.p.dot(&other.p)
            + self.q.coords.dot(&other.q.coords)
            + self.v.dot(&other.v)
            + self.omega.dot(&other.omega)
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
    let total = sum(&sum(&sum(&k1, 2.0, &k2), 2.0, &k3), 1.0, &k4);
    Ok(normalised(&moved(y, h / 6.0, &total)))
}

/// The implicit midpoint step.
///
/// # Errors
/// [`Cause::Unsettled`] if repetition does not converge: the step is too long.
pub(super) fn implicit_midpoint(h: f64, y: &[State], field: Field) -> Result<Vec<State>, Cause> {
    let size = y.iter().map(size).fold(0.0, f64::max);
    let mut k = field(h / 2.0, y)?;
    let mut change = f64::INFINITY;
    let mut previous: Option<(Vec<Rate>, Vec<Rate>)> = None;
    for _ in 0..MAX_REPETITIONS {
        let image = field(h / 2.0, &moved(y, h / 2.0, &k))?;
        let residual = sum(&image, -1.0, &k);
        change = h * residual.iter().map(Rate::size).fold(0.0, f64::max) / size;
        k.clone_from(&image);
        if change <= CONVERGED || !(change <= DIVERGED) {
            break;
        }
        if let Some((old_image, old_residual)) = &previous {
            let theta = secant(&residual, old_residual);
            k = sum(&k, -theta, &sum(&image, -1.0, old_image));
        }
        previous = Some((image, residual));
    }
    if !(change <= ACCEPTED_CHANGE) {
        return Err(Cause::Unsettled { change });
    }
    Ok(normalised(&moved(y, h, &k)))
}

/// θ of the secant through two residuals; 0 if they are equal.
fn secant(residual: &[Rate], old: &[Rate]) -> f64 {
    let difference = sum(residual, -1.0, old);
    let product = |a: &[Rate]| a.iter().zip(&difference).map(|(a, b)| a.dot(b)).sum::<f64>();
    let square = product(&difference);
    if square > 0.0 { product(residual) / square } else { 0.0 }
}

/// a + h b.
fn sum(a: &[Rate], h: f64, b: &[Rate]) -> Vec<Rate> {
    a.iter().zip(b).map(|(a, b)| a.plus(h, b)).collect()
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
