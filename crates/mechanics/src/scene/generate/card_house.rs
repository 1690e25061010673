//! A house of cards, held by friction alone.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Structure, solid};
use crate::scene::description::{Body, Description, Rotation, Shape};

/// Levels of tents, each of two cards that lean on each other, with horizontal cards between; the
/// top level has one tent. In the x–z plane, standing on z = 0.
///
/// ```text
/// a card of thickness t and height h, leaning by α, reaches from its lower front edge
/// h sin α + t cos α sideways and h cos α + t sin α up
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CardHouse {
    /// The number of levels, which is also the number of tents in the lowest.
    pub levels: usize,
    /// Thickness, depth along y and height of a card (m).
    pub size: [f64; 3],
    /// The inclination of the cards (degrees), below 45.
    pub lean: f64,
    /// The mass of each card (kg).
    pub mass: f64,
}

/// The distance between the centers of neighboring tents, in tent widths.
const PITCH: f64 = 1.1;

impl Structure for CardHouse {
    fn bodies(&self) -> usize {
        let n = self.levels;
        let upright = n.saturating_mul(n.saturating_add(1));
        upright.saturating_add(n.saturating_mul(n.saturating_sub(1)) / 2)
    }

    fn numbers(&self) -> Vec<(&'static str, f64)> {
        let sizes = self.size.map(|size| ("size", size)).into_iter();
        sizes.chain([("lean", self.lean), ("mass", self.mass)]).collect()
    }

    fn fault(&self) -> Option<(&'static str, String)> {
        (self.lean >= 45.0).then(|| ("lean", format!("must be below 45, is {}", self.lean)))
    }

    fn add_to(&self, scene: &mut Description) {
        let [t, depth, h] = self.size;
        let (sin, cos) = libm::sincos(self.lean.to_radians());
        let (height, width) = (h * cos + t * sin, 2.0 * h * sin);
        let pitch = PITCH * width;
        let card = |name: String, shape, x: f64, z: f64, rotation| Body {
            rotation,
            ..solid(name, shape, self.mass, [x, 0.0, z])
        };
        for level in 0..self.levels {
            let tents = self.levels - level;
            let ground = level as f64 * (height + t);
            for k in 0..tents {
                let middle = (k as f64 - 0.5 * (tents - 1) as f64) * pitch;
                for (side, turn) in [("left", 1.0), ("right", -1.0)] {
                    let x = middle - turn * 0.5 * (t * cos + h * sin);
                    let lean = Some(Rotation::Y(turn * self.lean));
                    let name = format!("{side} {level} {k}");
                    let upright = Shape::Box(self.size);
                    scene.bodies.push(card(name, upright, x, ground + 0.5 * height, lean));
                }
                if k > 0 {
                    let level_card = Shape::Box([pitch, depth, t]);
                    let (x, z) = (middle - 0.5 * pitch, ground + height + 0.5 * t);
                    scene.bodies.push(card(format!("level {level} {k}"), level_card, x, z, None));
                }
            }
        }
    }
}
