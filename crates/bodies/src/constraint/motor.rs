//! A motor: drives a coordinate at a speed, with a limited force or torque.
//!
//! ```text
//! w = J u − v,   |x| ≤ effort;   J, J'u those of the coordinate y;   c = 0: any position is allowed
//! ```
//!
//! Below the limit the motor reaches the speed within one step; at the limit it pushes with its
//! full effort, a = effort/m, until then. A speed of 0 is a brake. The effort is a force (N) along
//! an axis or a torque (N m) about one; at velocity level the impulse is limited to effort × dt. An
//! infinite effort makes the row an equation: the motor always keeps its speed.
//! K&M: bounds on λ (T25); Catto, *Soft Constraints*, GDC 2011.

use std::sync::Arc;

use nalgebra::RealField;

use super::{
    Bodies, Bounds, Constraint, Coordinate, Degenerate, Field, Joint, Placement, Position, Row,
};
use crate::body::{Pose, State};

/// A motor: 1 row.
#[derive(Debug, Clone, PartialEq)]
pub struct Motor {
    /// The driven coordinate.
    pub coordinate: Coordinate,
    /// The speed v (m/s or rad/s) of body 1 relative to body 0.
    pub speed: f64,
    /// The largest force (N) or torque (N m), positive.
    pub effort: f64,
}

/// A motor along an axis.
pub(super) const TRANSLATION: Joint = Joint {
    name: "motor_translation",
    title: "a motor along an axis: a speed, and a force that it cannot exceed",
    bodies: (1, 2),
    turns: 0,
    needs: &[Field::Axis, Field::Speed, Field::Effort],
    takes: &[Field::Point],
    build: |at| Ok(Arc::new(motor(at, Coordinate::along(at)?)?)),
};

/// A motor about an axis.
pub(super) const ROTATION: Joint = Joint {
    name: "motor_rotation",
    title: "a motor about an axis: a speed, and a torque that it cannot exceed",
    bodies: (1, 2),
    turns: 2,
    needs: &[Field::Axis, Field::Speed, Field::Effort],
    takes: &[],
    build: |at| Ok(Arc::new(motor(at, Coordinate::about(at)?)?)),
};

fn motor(at: &Placement, coordinate: Coordinate) -> Result<Motor, super::Fault> {
    let (speed, effort) = (Field::Speed.given(at.speed)?, Field::Effort.given(at.effort)?);
    Ok(Motor { coordinate, speed, effort })
}

impl Constraint for Motor {
    fn bodies(&self) -> Bodies {
        self.coordinate.bodies
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let bounds = Bounds::Effort(self.effort);
        Ok(vec![Row { c: 0.0, speed: self.speed, bounds, ..self.coordinate.row(states)? }])
    }
}

impl Position for Motor {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        self.coordinate.c(poses)
    }
}
