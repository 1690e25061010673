//! A bridge of planks.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Rope, Structure, joint, solid};
use crate::scene::description::{Body, Constraint, Description, Rotation, Shape};

/// Planks `plank1`, `plank2`, … joined end to end by hinges about y, between the origin and
/// (span, 0, 0), where the first and the last are hinged to the world.
///
/// They hang in equilibrium. Half of a plank's weight acts at each of its ends, so the planks have
/// the slopes of the links of a [`Rope`] with the same number of links and the same masses. A
/// straight bridge could not support any load: the forces at its hinges would be infinite.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Bridge {
    /// The number of planks, at least 2.
    pub planks: usize,
    /// The edge lengths of a plank (m); hinges are at its ends in x.
    pub size: [f64; 3],
    /// The distance between the banks (m), less than the total length of the planks.
    pub span: f64,
    /// The mass of each plank (kg).
    pub mass: f64,
}

impl Bridge {
    /// The rope with the same shape.
    pub fn rope(&self) -> Rope {
        let length = self.planks as f64 * self.size[0];
        Rope { links: self.planks, length, span: self.span, mass: self.mass }
    }
}

impl Structure for Bridge {
    fn bodies(&self) -> usize {
        self.planks
    }

    fn numbers(&self) -> Vec<(&'static str, f64)> {
        let sizes = self.size.map(|size| ("size", size)).into_iter();
        sizes.chain([("span", self.span), ("mass", self.mass)]).collect()
    }

    fn fault(&self) -> Option<(&'static str, String)> {
        if self.planks < 2 {
            return Some(("planks", format!("must be at least 2, is {}", self.planks)));
        }
        self.rope().fault()
    }

    fn add_to(&self, scene: &mut Description) {
        let name = |k: usize| format!("plank{k}");
        let mut hinge = |bodies: Vec<String>, at: [f64; 3]| {
            let axis = Some([0.0, 1.0, 0.0]);
            scene.constraints.push(Constraint { axis, ..joint("hinge", bodies, Some(at)) });
        };
        let (slopes, _) = self.rope().catenary();
        let [mut x, mut z] = [0.0, 0.0];
        for (k, slope) in (1..).zip(&slopes) {
            match k {
                1 => hinge(vec![name(1)], [x, 0.0, z]),
                _ => hinge(vec![name(k - 1), name(k)], [x, 0.0, z]),
            }
            let across = self.size[0] / slope.hypot(1.0);
            let middle = [x + 0.5 * across, 0.0, z + 0.5 * slope * across];
            let plank = solid(name(k), Shape::Box(self.size), self.mass, middle);
            let rotation = Some(Rotation::Y(-slope.atan().to_degrees()));
            scene.bodies.push(Body { rotation, ..plank });
            (x, z) = (x + across, z + slope * across);
        }
        hinge(vec![name(self.planks)], [x, 0.0, z]);
    }
}
