//! A net of point masses: many rows, each coupled to a few.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Structure, point, rod, rod_to_world};
use crate::scene::description::Description;

/// Point masses `node r c` at x = c spacing, y = r spacing, z = 0. The four corners hang from
/// upright rods that let them swing inwards: with fixed corners the net could not sag.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Net {
    /// The number of masses along y.
    pub rows: usize,
    /// The number of masses along x.
    pub columns: usize,
    /// The length of a rod (m).
    pub spacing: f64,
    /// The length of the rods that hold the corners (m).
    pub hang: f64,
    /// The mass of each point (kg).
    pub mass: f64,
}

impl Structure for Net {
    fn bodies(&self) -> usize {
        self.rows.saturating_mul(self.columns)
    }

    fn numbers(&self) -> Vec<(&'static str, f64)> {
        vec![("spacing", self.spacing), ("hang", self.hang), ("mass", self.mass)]
    }

    fn add_to(&self, scene: &mut Description) {
        let name = |r: usize, c: usize| format!("node {r} {c}");
        let is_end = |k: usize, count: usize| k == 0 || k + 1 == count;
        for r in 0..self.rows {
            for c in 0..self.columns {
                let [x, y] = [c as f64 * self.spacing, r as f64 * self.spacing];
                scene.bodies.push(point(name(r, c), self.mass, [x, y, 0.0]));
                if c > 0 {
                    scene.constraints.push(rod([name(r, c - 1), name(r, c)]));
                }
                if r > 0 {
                    scene.constraints.push(rod([name(r - 1, c), name(r, c)]));
                }
                if is_end(r, self.rows) && is_end(c, self.columns) {
                    let rod = rod_to_world([x, y, self.hang], [x, y, 0.0], name(r, c));
                    scene.constraints.push(rod);
                }
            }
        }
    }
}
