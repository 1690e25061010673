//! A bridge of planks.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Structure, joint, solid};
use crate::scene::description::{Constraint, Description, Shape};

/// Planks `plank1`, `plank2`, … along x from the origin, joined end to end by hinges about y; the
/// first and the last are hinged to the world.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Bridge {
    /// The number of planks.
    pub planks: usize,
    /// The edge lengths of a plank (m); hinges lie at its ends in x.
    pub size: [f64; 3],
    /// The mass of each plank (kg).
    pub mass: f64,
}

impl Structure for Bridge {
    fn bodies(&self) -> usize {
        self.planks
    }

    fn numbers(&self) -> Vec<(&'static str, f64)> {
        self.size.map(|size| ("size", size)).into_iter().chain([("mass", self.mass)]).collect()
    }

    fn add_to(&self, scene: &mut Description) {
        let (length, name) = (self.size[0], |k: usize| format!("plank{k}"));
        let mut hinge = |bodies: Vec<String>, end: usize| {
            let at = Some([end as f64 * length, 0.0, 0.0]);
            let axis = Some([0.0, 1.0, 0.0]);
            scene.constraints.push(Constraint { axis, ..joint("hinge", bodies, at) });
        };
        for k in 1..=self.planks {
            match k {
                1 => hinge(vec![name(1)], 0),
                _ => hinge(vec![name(k - 1), name(k)], k - 1),
            }
        }
        if self.planks > 0 {
            hinge(vec![name(self.planks)], self.planks);
        }
        scene.bodies.extend((1..=self.planks).map(|k| {
            let position = [(k as f64 - 0.5) * length, 0.0, 0.0];
            solid(name(k), Shape::Box(self.size), self.mass, position)
        }));
    }
}
