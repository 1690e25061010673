//! Compliant constraints: the rows of any constraint with a stiffness k and a damping d.
//!
//! ```text
//! x = −(k c + d ċ);   c, J, J'u those of the constraint that it softens
//! ```
//!
//! The force is evaluated at the end of the step, see [`Spring`], or exactly by integrators that
//! can. A compliant rod is a spring with a parallel damper, a compliant orientation a torsion
//! spring. The static deflection under a load f is f/k for any step; an oscillation at ω0 = √(k/m)
//! with step h has the frequency atan(h ω0)/h and decays by 1/√(1 + h²ω0²) per step, so it never
//! gains energy. Catto, *Soft Constraints*, GDC 2011.

use std::sync::Arc;

use nalgebra::{RealField, Vector3};

use super::{
    Bodies, Constraint, Coordinate, Degenerate, Distance, Fault, Field, Joint, Placement, Position,
    Row, Spring,
};
use crate::body::{Pose, State};

/// A compliant constraint.
#[derive(Debug, Clone, PartialEq)]
pub struct Elastic<C> {
    /// The constraint whose c the spring returns to 0.
    pub held: C,
    /// The spring and damper of each of its rows.
    pub spring: Spring,
}

/// A spring and damper between two points.
pub(super) const SPRING: Joint = Joint {
    name: "spring",
    title: "a spring and a damper between two points",
    bodies: (1, 2),
    turns: 0,
    needs: &[Field::Stiffness],
    takes: &[Field::Points, Field::Length, Field::Damping],
    build: |at| Ok(Arc::new(Elastic { held: Distance::of(at)?, spring: spring(at)? })),
};

/// A torsion spring and damper.
pub(super) const TORSION: Joint = Joint {
    name: "spring_rotation",
    title: "a torsion spring and a damper about an axis",
    bodies: (1, 2),
    turns: 2,
    needs: &[Field::Axis, Field::Stiffness],
    takes: &[Field::Damping],
    build: |at| Ok(Arc::new(Elastic { held: Coordinate::about(at)?, spring: spring(at)? })),
};

fn spring(at: &Placement) -> Result<Spring, Fault> {
    let stiffness = Field::Stiffness.given(at.stiffness)?;
    let damping = at.damping.unwrap_or(0.0);
    if stiffness > 0.0 || damping > 0.0 {
        return Ok(Spring { stiffness, damping });
    }
    Err(Field::Stiffness
        .fault("is 0, and the damping is 0 too, so the spring would have no effect"))
}

impl<C: Constraint> Constraint for Elastic<C> {
    fn bodies(&self) -> Bodies {
        self.held.bodies()
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let soft = |row| Row { spring: Some(self.spring), ..row };
        Ok(self.held.rows(states)?.into_iter().map(soft).collect())
    }

    fn anchors(&self) -> Option<[Vector3<f64>; 2]> {
        self.held.anchors()
    }
}

impl<C: Position> Position for Elastic<C> {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        self.held.c(poses)
    }
}
