//! A chain of rigid boxes.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Structure, joint, solid};
use crate::scene::description::{Body, Description, Rotation, Shape};

/// Boxes link1, link2, … from the origin along x or straight down.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BallChain {
    /// The number of boxes and of joints.
    pub links: usize,
    /// The edge lengths of a box (m), the first along the chain; joints are at its ends.
    pub size: [f64; 3],
    /// The mass of each box (kg).
    pub mass: f64,
    /// The direction of the chain.
    #[serde(default)]
    pub along: Along,
}

/// A direction from the origin.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
pub enum Along {
    /// Horizontal, along +x.
    #[default]
    #[serde(rename = "x")]
    X,
    /// Straight down.
    #[serde(rename = "-z")]
    Down,
}

impl Along {
    /// The point at this distance (m) in this direction.
    fn point(self, distance: f64) -> [f64; 3] {
        match self {
            Along::X => [distance, 0.0, 0.0],
            Along::Down => [0.0, 0.0, -distance],
        }
    }

    /// The rotation that turns x into this direction.
    fn rotation(self) -> Option<Rotation> {
        match self {
            Along::X => None,
            Along::Down => Some(Rotation::Y(90.0)),
        }
    }
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
            let position = self.along.point((k as f64 - 0.5) * length);
            let link = solid(format!("link{k}"), Shape::Box(self.size), self.mass, position);
            scene.bodies.push(Body { rotation: self.along.rotation(), ..link });
            let end = Some(self.along.point((k - 1) as f64 * length));
            scene.constraints.push(match k {
                1 => joint("nail", vec!["link1".into()], end),
                _ => joint("ball", vec![format!("link{}", k - 1), format!("link{k}")], end),
            });
        }
    }
}
