//! A gear: two meshing wheels with z0 and z1 teeth and axes at rest in the world.
//!
//! ```text
//! c   = φ1 + (z0/z1) φ0                        φ_k: the twist of body k against the world
//! J   = [0, (z0/z1) t0, 0, t1],   J'u likewise
//! ```
//!
//! so ω1 = −(z0/z1) ω0, as for wheels that touch externally, and the torques are (z0/z1) x on body
//! 0 and x on body 1; their ratio is that of the teeth. For wheels that rotate in the same sense
//! (one inside the other, or a chain) give one axis the other sign.
//!
//! The state determines each φ only up to a turn, 2π, and therefore c only up to 2π/z1 (one tooth
//! of body 1) if z0 and z1 have no common factor. This is also how wheels mesh: c is wrapped to
//! −π/z1 ≤ c ≤ π/z1, half a tooth. A gear that slips farther in one step engages at the next tooth.
//! With a common factor c would be determined over a longer period; it is wrapped to half a tooth
//! anyway.

use std::f64::consts::PI;
use std::sync::Arc;

use nalgebra::{RealField, UnitQuaternion, Vector3};

use super::{
    Bodies, Constraint, Coordinate, Degenerate, Field, Joint, Kind, Motion, Orientation, Position,
    Row, constant, plain, wrapped,
};
use crate::body::{Pose, State};

/// Two meshing wheels: 1 row.
#[derive(Debug, Clone, PartialEq)]
pub struct Gear {
    /// Body 0, then body 1.
    pub bodies: Bodies,
    /// The angle of each about its axis, relative to the world.
    pub wheels: [Coordinate; 2],
    /// The numbers of their teeth z0, z1.
    pub teeth: [u32; 2],
}

/// A pair of gear wheels.
pub(super) const GEAR: Joint = Joint {
    name: "gear",
    title: "two gear wheels that mesh, on axes at rest in the world",
    bodies: (2, 2),
    turns: 2,
    needs: &[Field::Axes, Field::Teeth],
    takes: &[],
    build: |at| {
        let axes = Field::Axes.given(at.axes)?;
        let wheel = |k: usize| {
            let bodies = [None, at.bodies[k]];
            let relative = Orientation { bodies, relative: at.poses[k].q };
            Coordinate { bodies, axis: axes[k], motion: Motion::Rotation { relative } }
        };
        let teeth = Field::Teeth.given(at.teeth)?;
        Ok(Arc::new(Gear { bodies: at.bodies, wheels: [wheel(0), wheel(1)], teeth }))
    },
};

impl Gear {
    /// z0/z1.
    fn ratio(&self) -> f64 {
        f64::from(self.teeth[0]) / f64::from(self.teeth[1])
    }

    /// c wrapped to within half a tooth of body 1.
    fn meshed(&self, c: f64) -> f64 {
        wrapped(c, PI / f64::from(self.teeth[1]))
    }
}

impl Constraint for Gear {
    fn bodies(&self) -> Bodies {
        self.bodies
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let wheel = |k: usize| self.wheels[k].row([&State::WORLD, states[k]]);
        let (first, second) = (wheel(0)?, wheel(1)?);
        let ratio = self.ratio();
        Ok(vec![Row::equation(
            Kind::Rotation,
            self.meshed(second.c + ratio * first.c),
            [ratio * first.jacobian[1], second.jacobian[1]],
            second.velocity_product + ratio * first.velocity_product,
        )])
    }
}

impl Position for Gear {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        let world = Pose { p: Vector3::zeros(), q: UnitQuaternion::identity() };
        let angle = |k: usize| self.wheels[k].value([&world, poses[k]]);
        let c = angle(1) + angle(0) * constant(self.ratio());
        vec![c + constant(self.meshed(plain(c)) - plain(c))]
    }
}
