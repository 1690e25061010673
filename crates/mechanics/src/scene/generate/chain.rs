//! A chain of point masses; longer chains are stiffer problems.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Structure, point, rod, rod_to_world};
use crate::scene::description::Description;

/// Point masses p1, p2, … along x from the origin; rods between neighbors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Chain {
    /// The number of rods and of masses.
    pub links: usize,
    /// The length of a rod (m).
    pub spacing: f64,
    /// The mass of each point (kg).
    pub mass: f64,
}

impl Structure for Chain {
    fn bodies(&self) -> usize {
        self.links
    }

    fn numbers(&self) -> Vec<(&'static str, f64)> {
        vec![("spacing", self.spacing), ("mass", self.mass)]
    }

    fn add_to(&self, scene: &mut Description) {
        for k in 1..=self.links {
            let position = [k as f64 * self.spacing, 0.0, 0.0];
            scene.bodies.push(point(format!("p{k}"), self.mass, position));
            let rod = match k {
                1 => rod_to_world([0.0; 3], position, "p1".into()),
                _ => rod([format!("p{}", k - 1), format!("p{k}")]),
            };
            scene.constraints.push(rod);
        }
    }
}
