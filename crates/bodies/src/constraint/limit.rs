//! Limits of a coordinate: the stops of a slider or a hinge.
//!
//! ```text
//! c_lower = y − lower ≥ 0,   c_upper = upper − y ≥ 0,   x ≥ 0 each;   J, J'u = ± those of y
//! ```
//!
//! y is the [`Coordinate`], 0 at the start. Both rows are always present, and at most one of them
//! acts; an infinite stop has no row. An angle is known only up to whole turns, so it is measured
//! from the middle between the stops: if a body passes a stop by more than half of the forbidden
//! range, it appears beyond the other stop.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use nalgebra::RealField;

use super::{
    Bodies, Bounds, Constraint, Coordinate, Degenerate, Fault, Field, Joint, Placement, Position,
    Row, constant, plain, wrapped,
};
use crate::body::{Pose, State};

/// Two stops of a coordinate: a row for each that is finite, the lower first.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// The limited coordinate.
    pub coordinate: Coordinate,
    /// The lower and the upper stop (m or rad); for an angle they are finite and less than a turn
    /// apart.
    pub stops: [f64; 2],
}

/// Limits along an axis.
pub(super) const TRANSLATION: Joint = Joint {
    name: "limit_translation",
    title: "two stops for the motion along an axis",
    bodies: (1, 2),
    turns: 0,
    needs: &[Field::Axis, Field::Limits],
    takes: &[Field::Point],
    build: |at| Ok(Arc::new(Limit { coordinate: Coordinate::along(at)?, stops: stops(at)? })),
};

/// Limits about an axis.
pub(super) const ROTATION: Joint = Joint {
    name: "limit_rotation",
    title: "two stops for the rotation about an axis",
    bodies: (1, 2),
    turns: 2,
    needs: &[Field::Axis, Field::Limits],
    takes: &[],
    build: |at| {
        let stops = stops(at)?;
        if !(stops[1] - stops[0] < TAU) {
            return Err(Field::Limits.fault("must be less than a turn apart, 2π"));
        }
        Ok(Arc::new(Limit { coordinate: Coordinate::about(at)?, stops }))
    },
};

fn stops(at: &Placement) -> Result<[f64; 2], Fault> {
    let [lower, upper] = Field::Limits.given(at.limits)?;
    if lower < upper {
        return Ok([lower, upper]);
    }
    Err(Field::Limits.fault(format!("the lower one must be below the upper, are {lower}, {upper}")))
}

impl Limit {
    /// The correction that measures the coordinate from the middle between the stops.
    fn turns(&self, value: f64) -> f64 {
        if !self.coordinate.is_angle() {
            return 0.0;
        }
        let middle = 0.5 * (self.stops[0] + self.stops[1]);
        middle + wrapped(value - middle, PI) - value
    }
}

impl Constraint for Limit {
    fn bodies(&self) -> Bodies {
        self.coordinate.bodies
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let row = self.coordinate.row(states)?;
        let row = Row { c: row.c + self.turns(row.c), bounds: Bounds::Unilateral, ..row };
        let from = |stop: f64| stop.is_finite().then_some(Row { c: row.c - stop, ..row });
        let [lower, upper] = self.stops.map(from);
        Ok(lower.into_iter().chain(upper.map(Row::negated)).collect())
    }
}

impl Position for Limit {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        let value: T = self.coordinate.value(poses);
        let value = value + constant(self.turns(plain(value)));
        let from = |stop: f64| stop.is_finite().then_some(value - constant(stop));
        let [lower, upper] = self.stops.map(from);
        lower.into_iter().chain(upper.map(|c| -c)).collect()
    }
}
