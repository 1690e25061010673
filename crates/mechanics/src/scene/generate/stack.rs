//! A stack of cubes.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Structure, solid};
use crate::scene::description::{Description, Shape};

/// Cubes box1, box2, … from the bottom up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stack {
    /// The number of cubes.
    pub count: usize,
    /// The edge of a cube (m).
    pub size: f64,
    /// The mass of each cube (kg).
    pub mass: f64,
}

impl Structure for Stack {
    fn bodies(&self) -> usize {
        self.count
    }

    fn numbers(&self) -> Vec<(&'static str, f64)> {
        vec![("size", self.size), ("mass", self.mass)]
    }

    fn add_to(&self, scene: &mut Description) {
        let cube = || Shape::Box([self.size; 3]);
        scene.bodies.extend((1..=self.count).map(|k| {
            let position = [0.0, 0.0, (k as f64 - 0.5) * self.size];
            solid(format!("box{k}"), cube(), self.mass, position)
        }));
    }
}
