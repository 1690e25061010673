//! An upright triangle of boxes, each resting on two.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Structure, solid};
use crate::scene::description::{Description, Shape};

/// Cubes `box r c`, row r from the ground up, in the x–z plane. Each row has one cube less.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pyramid {
    /// The number of cubes in the lowest row.
    pub base: usize,
    /// The edge of a cube (m).
    pub size: f64,
    /// The distance between neighboring centers (m), at least the size.
    pub spacing: f64,
    /// The mass of each cube (kg).
    pub mass: f64,
}

impl Structure for Pyramid {
    fn bodies(&self) -> usize {
        self.base.saturating_mul(self.base.saturating_add(1)) / 2
    }

    fn numbers(&self) -> Vec<(&'static str, f64)> {
        vec![("size", self.size), ("spacing", self.spacing), ("mass", self.mass)]
    }

    fn fault(&self) -> Option<(&'static str, String)> {
        let narrow = self.spacing < self.size;
        narrow.then(|| ("spacing", format!("{} is less than the size", self.spacing)))
    }

    fn add_to(&self, scene: &mut Description) {
        for r in 0..self.base {
            let row = self.base - r;
            for c in 0..row {
                let x = (c as f64 - 0.5 * (row - 1) as f64) * self.spacing;
                let position = [x, 0.0, (r as f64 + 0.5) * self.size];
                let cube = Shape::Box([self.size; 3]);
                scene.bodies.push(solid(format!("box {r} {c}"), cube, self.mass, position));
            }
        }
    }
}
