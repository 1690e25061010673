//! A rope wound on a wheel, or a rack and pinion: a body moves along an axis as the wheel rotates.
//!
//! ```text
//! c   = s1 − s0 − r φ         φ: the twist of body 0 about its axis, s: the displacements of body 1 and of the wheel's
//! J   = [−n, −r t, n, 0],     center of mass along n, r: the radius; J'u likewise
//! ```
//!
//! so s1' − s0' = r φ', and x exerts the force −x n at the wheel's center and the torque −r x on
//! it. A yo-yo is a wheel whose rope is tied to a fixed body. Two racks on one wheel, with n = ±z,
//! are a pulley with mass. The wheel's axis and n are fixed in the world. The state determines φ
//! only up to a turn but s fully, so c is wrapped to −π r ≤ c ≤ π r, half a turn, as in a
//! [gear](super::Gear). The row is an equation: the rope is assumed to be taut.

use std::f64::consts::PI;
use std::sync::Arc;

use nalgebra::{RealField, UnitQuaternion, Vector3};

use super::{
    Bodies, Constraint, Coordinate, Degenerate, Field, Joint, Kind, Motion, Orientation, Position,
    Row, constant, plain, wrapped,
};
use crate::body::{Pose, State};

/// A wheel and the body that it moves: 1 row.
#[derive(Debug, Clone, PartialEq)]
pub struct Rack {
    /// The wheel, then the moved body.
    pub bodies: Bodies,
    /// The angle of the wheel about its axis, relative to the world.
    pub wheel: Coordinate,
    /// The displacement of the moved body along its direction.
    pub way: Coordinate,
    /// The displacement of the wheel's center along the same direction.
    pub center: Coordinate,
    /// The radius r (m), positive.
    pub radius: f64,
}

/// A rope on a wheel.
pub(super) const RACK: Joint = Joint {
    name: "rack",
    title: "a rope on a wheel, a rack on a pinion: the second body moves along its axis as the first turns",
    bodies: (2, 2),
    turns: 1,
    needs: &[Field::Axes, Field::Length],
    takes: &[],
    build: |at| {
        let [axis, direction] = Field::Axes.given(at.axes)?;
        let radius = Field::Length.given(at.length)?;
        let of_world = |k: usize| [None, at.bodies[k]];
        let relative = Orientation { bodies: of_world(0), relative: at.poses[0].q };
        let wheel = Coordinate { bodies: of_world(0), axis, motion: Motion::Rotation { relative } };
        let along = |k: usize| {
            let anchors = [at.poses[k].p, Vector3::zeros()];
            let motion = Motion::Translation { anchors, offset: 0.0 };
            Coordinate { bodies: of_world(k), axis: direction, motion }
        };
        let (center, way) = (along(0), along(1));
        Ok(Arc::new(Rack { bodies: at.bodies, wheel, way, center, radius }))
    },
};

impl Rack {
    /// c wrapped to within half a turn of the wheel.
    fn wound(&self, c: f64) -> f64 {
        wrapped(c, PI * self.radius)
    }
}

impl Constraint for Rack {
    fn bodies(&self) -> Bodies {
        self.bodies
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let wheel = self.wheel.row([&State::WORLD, states[0]])?;
        let way = self.way.row([&State::WORLD, states[1]])?;
        let center = self.center.row([&State::WORLD, states[0]])?;
        Ok(vec![Row::equation(
            Kind::Translation,
            self.wound(way.c - center.c - self.radius * wheel.c),
            [-self.radius * wheel.jacobian[1] - center.jacobian[1], way.jacobian[1]],
            way.velocity_product - center.velocity_product - self.radius * wheel.velocity_product,
        )])
    }

    /// The rope as it leaves the wheel at the start.
    fn lines(&self) -> Vec<(Bodies, [Vector3<f64>; 2])> {
        let (
            Motion::Translation { anchors: [body, end], .. },
            Motion::Translation { anchors: [hub, _], .. },
        ) = (&self.way.motion, &self.center.motion)
        else {
            return Vec::new();
        };
        let axis = self.way.axis.normalize();
        vec![([None, self.bodies[1]], [body + axis * axis.dot(&(hub - body)), *end])]
    }
}

impl Position for Rack {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        let world = Pose { p: Vector3::zeros(), q: UnitQuaternion::identity() };
        let turned = self.wheel.value([&world, poses[0]]) * constant(self.radius);
        let moved = self.way.value([&world, poses[1]]) - self.center.value([&world, poses[0]]);
        let c = moved - turned;
        vec![c + constant(self.wound(plain(c)) - plain(c))]
    }
}
