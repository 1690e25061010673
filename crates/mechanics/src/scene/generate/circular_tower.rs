//! The chapter's Figure 12: a round tower of cubes laid like bricks.

use std::f64::consts::{PI, TAU};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Structure, solid};
use crate::scene::description::{Description, Rotation, Shape};

/// The distance between the centers of neighboring cubes, in edge lengths: large enough that inner
/// edges stay apart.
const PITCH: f64 = 1.15;

/// Cubes `cube1`, `cube2`, … ring by ring from z = 0 up; every other ring is rotated by half a
/// cube.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CircularTower {
    /// The number of cubes; the last ring may be incomplete.
    pub count: usize,
    /// The number of cubes per ring, at least 3.
    #[serde(default = "thirty_five")]
    pub ring: usize,
    /// The edge of a cube (m).
    pub size: f64,
    /// The mass of each cube (kg).
    pub mass: f64,
}

fn thirty_five() -> usize {
    35
}

impl Structure for CircularTower {
    fn bodies(&self) -> usize {
        self.count
    }

    fn numbers(&self) -> Vec<(&'static str, f64)> {
        vec![("size", self.size), ("mass", self.mass)]
    }

    fn fault(&self) -> Option<(&'static str, String)> {
        (self.ring < 3).then(|| ("ring", format!("must be at least 3, is {}", self.ring)))
    }

    fn add_to(&self, scene: &mut Description) {
        let radius = PITCH * self.size / (2.0 * libm::sin(PI / self.ring as f64));
        for k in 0..self.count {
            let (layer, place) = (k / self.ring, k % self.ring);
            let turn = (place as f64 + 0.5 * (layer % 2) as f64) / self.ring as f64;
            let (sin, cos) = libm::sincos(TAU * turn);
            let position = [radius * cos, radius * sin, (layer as f64 + 0.5) * self.size];
            let cube = Shape::Box([self.size; 3]);
            let mut body = solid(format!("cube{}", k + 1), cube, self.mass, position);
            body.rotation = Some(Rotation::Z(360.0 * turn));
            scene.bodies.push(body);
        }
    }
}
