//! A round arch of stones.

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Structure;
use crate::scene::description::{Body, Description, Shape};

/// Wedges `stone1`, `stone2`, … in half a circle in the x–z plane, from +x over the top to −x,
/// standing on z = 0.
///
/// Under its own weight, with enough friction to prevent sliding, a round arch stands if its
/// thickness is more than 0.1075 of its mean radius: Milankovitch, *Theorie der Druckkurven*, 1907.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Arch {
    /// The number of stones.
    pub stones: usize,
    /// The radius of the center line (m).
    pub radius: f64,
    /// The thickness of the arch (m), less than twice the radius.
    pub thickness: f64,
    /// Its depth along y (m).
    pub depth: f64,
    /// The density of the stones (kg/m³).
    pub density: f64,
}

impl Structure for Arch {
    fn bodies(&self) -> usize {
        self.stones
    }

    fn numbers(&self) -> Vec<(&'static str, f64)> {
        vec![
            ("radius", self.radius),
            ("thickness", self.thickness),
            ("depth", self.depth),
            ("density", self.density),
        ]
    }

    fn fault(&self) -> Option<(&'static str, String)> {
        let solid = self.thickness >= 2.0 * self.radius;
        solid
            .then(|| ("thickness", format!("{} is not less than twice the radius", self.thickness)))
    }

    fn add_to(&self, scene: &mut Description) {
        let radii = [self.radius - 0.5 * self.thickness, self.radius + 0.5 * self.thickness];
        let depths = [-0.5 * self.depth, 0.5 * self.depth];
        // The last joint is exactly as level as the first; sin π is not 0 in floating point.
        let joint = |k: usize| {
            let (sin, cos) = libm::sincos(PI * k as f64 / self.stones as f64);
            (cos, if k == self.stones { 0.0 } else { sin })
        };
        for k in 1..=self.stones {
            let corners = [joint(k - 1), joint(k)].into_iter().flat_map(|(cos, sin)| {
                radii.into_iter().flat_map(move |r| depths.map(|y| [r * cos, y, r * sin]))
            });
            scene.bodies.push(Body {
                name: format!("stone{k}"),
                shape: Shape::Hull(corners.collect()),
                density: Some(self.density),
                ..Body::default()
            });
        }
    }
}
