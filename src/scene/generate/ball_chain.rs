//! A chain of rigid boxes.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Structure, joint, solid};
use crate::scene::description::{Description, Shape};

/// Boxes link1, link2, … along x from the origin.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BallChain {
    /// The number of boxes and of joints.
    pub links: usize,
    /// The edge lengths of a box (m); joints lie at its ends in x.
    pub size: [f64; 3],
    /// The mass of each box (kg).
    pub mass: f64,
}

impl Structure for BallChain {
    fn bodies(&self) -> usize {
        self.links
    }

    fn numbers(&self) -> Vec<(&'static str, f64)> {
        self.size.map(|size| ("size", size)).into_iter().chain([("mass", self.mass)]).collect()
    }

    fn add_to(&self, scene: &mut Description) {
        let length = self.size[0];
        for k in 1..=self.links {
            let position = [(k as f64 - 0.5) * length, 0.0, 0.0];
            let link = solid(format!("link{k}"), Shape::Box(self.size), self.mass, position);
            scene.bodies.push(link);
            let end = Some([(k - 1) as f64 * length, 0.0, 0.0]);
            scene.constraints.push(match k {
                1 => joint("nail", vec!["link1".into()], end),
                _ => joint("ball", vec![format!("link{}", k - 1), format!("link{k}")], end),
            });
        }
    }
}
