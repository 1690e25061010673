//! The theoretical behavior of an error as the step length decreases, and the reason.

use serde::{Deserialize, Serialize};

use super::Problem;
use crate::scene::{Integrator, Scheme};

/// The required behavior of an error.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Expected {
    /// It decreases like dt to this power; with 0 it does not decrease.
    Order {
        /// The power.
        order: f64,
        /// The reason.
        because: String,
    },
    /// It is rounding at every step length.
    Exact {
        /// The reason.
        because: String,
    },
    /// There is no claim.
    Open {
        /// The reason.
        because: String,
    },
}

fn order(order: f64, because: &str) -> Expected {
    Expected::Order { order, because: because.into() }
}

fn exact(because: &str) -> Expected {
    Expected::Exact { because: because.into() }
}

fn open(because: &str) -> Expected {
    Expected::Open { because: because.into() }
}

const KICK: &str =
    "the position changes with the velocity at the end of the step: the error is g t h/2";
const SPRING: &str =
    "the extension of a spring is its load divided by its stiffness, for any time step";
const SWEPT: &str = "no order is claimed, because a fixed number of sweeps leaves an error";

/// The required behavior of a quantity of a problem with a scheme and integrator.
pub(super) fn expected(
    problem: Problem,
    quantity: &str,
    family: Scheme,
    integrator: Integrator,
) -> Expected {
    let euler = family != Scheme::Acceleration || integrator == Integrator::SemiImplicitEuler;
    match problem {
        Problem::Fall if euler => order(1.0, KICK),
        Problem::Fall => exact("a parabola, which second-order methods reproduce exactly"),
        Problem::Swing if !euler => of_stages(integrator),
        Problem::Swing => of_pendulum(quantity, family),
        Problem::Bounce => of_bounce(family, euler),
        Problem::Slide => of_slide(family, euler),
    }
}

/// A pendulum with multi-stage methods.
fn of_stages(integrator: Integrator) -> Expected {
    let power = if integrator == Integrator::Rk4 { 4.0 } else { 2.0 };
    order(power, "the order of the integrator, because the rows are conditions on accelerations")
}

/// A pendulum with one impulse per step.
fn of_pendulum(quantity: &str, family: Scheme) -> Expected {
    use Scheme::{GaussSeidel, Penalty, Soft, SplitImpulse, Xpbd};
    match (quantity, family) {
        ("length of the rod", SplitImpulse | GaussSeidel | Xpbd) => {
            exact("the rod is corrected along its own direction, in which its length is linear")
        }
        ("length of the rod", Penalty) => order(0.0, SPRING),
        (_, Soft) => open(
            "no order is claimed, because the frequency of the springs depends on the step: it rises as the step \
             becomes shorter, up to 60 Hz",
        ),
        (_, Penalty) => open(
            "no order is claimed, because the error tends to that of the springs, whose extension does not \
                 depend on the step",
        ),
        ("length of the rod", _) => order(
            1.0,
            "each step moves along the tangent of the circle, so the length grows by (v dt)²/2l",
        ),
        _ => order(1.0, "semi-implicit Euler, of first order"),
    }
}

fn of_bounce(family: Scheme, euler: bool) -> Expected {
    use Scheme::{Acceleration, GaussSeidel, SequentialImpulses, SplitImpulse, Velocity};
    match family {
        Velocity | SplitImpulse | GaussSeidel | SequentialImpulses => order(
            1.0,
            "the fall lasts a whole number of steps, and the velocity at its end is too large by g dt/2",
        ),
        Acceleration if !euler => exact("the ball touches the ground at the end of a step"),
        Scheme::Penalty => order(0.0, "the damping determines the bounce; e is not used"),
        _ => open(
            "no order is claimed, because the bounce occurs below the ground, at a fraction of a step that is not a \
             smooth function of dt",
        ),
    }
}

fn of_slide(family: Scheme, euler: bool) -> Expected {
    use Scheme::{Acceleration, GaussSeidel, SplitImpulse, Velocity};
    match family {
        Velocity | SplitImpulse | GaussSeidel => order(1.0, KICK),
        Acceleration if euler => order(1.0, KICK),
        Acceleration => {
            exact("a constant acceleration, which second-order methods reproduce exactly")
        }
        Scheme::SequentialImpulses => open(SWEPT),
        _ => open(
            "no order is claimed, because the box settles on its springs, or its sweeps converge, before it slides \
             steadily",
        ),
    }
}
