//! An upright grid of balls, each joined to its horizontal and vertical neighbors.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Structure, joint, solid};
use crate::scene::description::{Description, Shape};

/// Balls `node r c`, row 0 on top, in the x–z plane. Neighbors are joined halfway by ball joints,
/// and the middle of the top row hangs from the world.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointGrid {
    /// The number of rows.
    pub rows: usize,
    /// The number of columns.
    pub columns: usize,
    /// The distance between neighboring centers (m).
    pub spacing: f64,
    /// The radius of a ball (m).
    pub radius: f64,
    /// The mass of each ball (kg).
    pub mass: f64,
}

impl Structure for JointGrid {
    fn bodies(&self) -> usize {
        self.rows.saturating_mul(self.columns)
    }

    fn numbers(&self) -> Vec<(&'static str, f64)> {
        vec![("spacing", self.spacing), ("radius", self.radius), ("mass", self.mass)]
    }

    fn add_to(&self, scene: &mut Description) {
        let name = |r: usize, c: usize| format!("node {r} {c}");
        let place = |r: f64, c: f64| [c * self.spacing, 0.0, -r * self.spacing];
        let held = (self.columns / 3, self.columns - self.columns / 3);
        for r in 0..self.rows {
            for c in 0..self.columns {
                let (row, column) = (r as f64, c as f64);
                let ball = Shape::Sphere(self.radius);
                scene.bodies.push(solid(name(r, c), ball, self.mass, place(row, column)));
                if c > 0 {
                    let at = Some(place(row, column - 0.5));
                    scene.constraints.push(joint("ball", vec![name(r, c - 1), name(r, c)], at));
                }
                if r > 0 {
                    let at = Some(place(row - 0.5, column));
                    scene.constraints.push(joint("ball", vec![name(r - 1, c), name(r, c)], at));
                } else if (held.0..held.1).contains(&c) {
                    scene.constraints.push(joint("nail", vec![name(r, c)], None));
                }
            }
        }
    }
}
