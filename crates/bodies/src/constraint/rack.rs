//! A rope wound on a wheel, or a rack on a pinion: a body moves along an axis as the wheel turns.
//!
//! ```text
//! c   = s − r φ               φ: the twist of body 0 about its axis, s: the way of body 1 along n, r: the radius
//! J   = [0, −r t, n, 0],   J'u likewise
//! ```
//!
//! so s' = r φ', and under x the wheel feels the torque −r x. Two of them on one wheel, with n = ±z, are a
//! pulley with mass. The wheel's axis and n are at rest in the world. The state knows φ only up to a
//! turn and s wholly, so that c is wrapped to within half a turn, −π r ≤ c ≤ π r, as in a [gear](super::Gear).
//! The row is an equation: the rope is taken as taut.

use std::f64::consts::PI;
use std::sync::Arc;

use nalgebra::{RealField, UnitQuaternion, Vector3};

use super::{
    Bodies, Constraint, Coordinate, Degenerate, Field, Joint, Kind, Motion, Orientation, Position,
    Row, constant, plain, wrapped,
};
use crate::body::{Pose, State};

/// A wheel and what it winds up: 1 row.
#[derive(Debug, Clone, PartialEq)]
pub struct Rack {
    /// The wheel, then the body that moves.
    pub bodies: Bodies,
    /// The angle of the wheel against the world, about its axis.
    pub wheel: Coordinate,
    /// The way of the body, along its direction.
    pub way: Coordinate,
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
        let motion =
            Motion::Translation { anchors: [at.poses[1].p, Vector3::zeros()], offset: 0.0 };
        let way = Coordinate { bodies: of_world(1), axis: direction, motion };
        Ok(Arc::new(Rack { bodies: at.bodies, wheel, way, radius }))
    },
};

impl Rack {
    /// c to within half a turn of the wheel.
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
        Ok(vec![Row::equation(
            Kind::Translation,
            self.wound(way.c - self.radius * wheel.c),
            [-self.radius * wheel.jacobian[1], way.jacobian[1]],
            way.velocity_product - self.radius * wheel.velocity_product,
        )])
    }
}

impl Position for Rack {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        let world = Pose { p: Vector3::zeros(), q: UnitQuaternion::identity() };
        let turned = self.wheel.value([&world, poses[0]]) * constant(self.radius);
        let c = self.way.value([&world, poses[1]]) - turned;
        vec![c + constant(self.wound(plain(c)) - plain(c))]
    }
}
