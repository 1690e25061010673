//! A row of dominoes.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Structure, solid};
use crate::scene::description::{Description, Rotation, Shape};

/// Slabs `domino1`, `domino2`, … along x, standing on z = 0; the first may lean towards the second.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Dominoes {
    /// The number of slabs.
    pub count: usize,
    /// Thickness along x, width along y and height (m).
    pub size: [f64; 3],
    /// The distance between neighboring centers (m).
    pub spacing: f64,
    /// The mass of each slab (kg).
    pub mass: f64,
    /// The inclination of the first slab towards the second (degrees), less than 90.
    #[serde(default)]
    pub lean: f64,
}

impl Structure for Dominoes {
    fn bodies(&self) -> usize {
        self.count
    }

    fn numbers(&self) -> Vec<(&'static str, f64)> {
        let sizes = self.size.map(|size| ("size", size)).into_iter();
        sizes.chain([("spacing", self.spacing), ("mass", self.mass)]).collect()
    }

    fn fault(&self) -> Option<(&'static str, String)> {
        let leans = (0.0..90.0).contains(&self.lean);
        (!leans).then(|| ("lean", format!("must be at least 0 and below 90, is {}", self.lean)))
    }

    fn add_to(&self, scene: &mut Description) {
        let [thickness, _, height] = self.size;
        for k in 0..self.count {
            let position = [k as f64 * self.spacing, 0.0, 0.5 * height];
            let name = format!("domino{}", k + 1);
            let mut body = solid(name, Shape::Box(self.size), self.mass, position);
            if k == 0 && self.lean > 0.0 {
                // It rotates about its lower front edge, which does not move.
                let (sin, cos) = libm::sincos(self.lean.to_radians());
                let [edge, middle] = [0.5 * thickness, 0.5 * height];
                let x = edge - edge * cos + middle * sin;
                body.position = [x, 0.0, edge * sin + middle * cos];
                body.rotation = Some(Rotation::Y(self.lean));
            }
            scene.bodies.push(body);
        }
    }
}
