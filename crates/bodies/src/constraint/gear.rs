//! Two wheels that turn about axes at rest in the world mesh: z0 and z1 teeth.
//!
//! ```text
//! c   = φ1 + (z0/z1) φ0                        φ_k: the twist of body k against the world
//! J   = [0, (z0/z1) t0, 0, t1],   J'u likewise
//! ```
//!
//! so ω1 = −(z0/z1) ω0, as wheels that touch from outside turn, and the torques are (z0/z1) x on
//! body 0 and x on body 1, their ratio that of the teeth. For wheels that turn the same way (one
//! inside the other, or a chain) give one axis the other sign.
//!
//! The state knows each φ only up to a turn, 2π, so it knows c only up to 2π/z1 when z0 and z1 have
//! no common factor: one tooth of body 1. That is how wheels mesh, too; c is wrapped to within half
//! a tooth, −π/z1 ≤ c ≤ π/z1. A gear that slips farther in one step is on the next tooth. With a
//! common factor more would be known; the wheels would mesh all the same.

use std::f64::consts::PI;
use std::sync::Arc;

use nalgebra::{RealField, UnitQuaternion, Vector3};

use super::{
    Bodies, Constraint, Coordinate, Degenerate, Field, Joint, Kind, Motion, Orientation, Position,
    Row, constant, plain, wrapped,
};
use crate::body::{Pose, State};

/// Two wheels that mesh: 1 row.
#[derive(Debug, Clone, PartialEq)]
pub struct Gear {
    /// Body 0, then body 1.
    pub bodies: Bodies,
    /// The angle of each about its axis, against the world.
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

    /// c to within half a tooth of body 1.
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
