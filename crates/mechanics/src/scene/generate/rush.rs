//! Balls pulled to one point by springs.

use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Structure, solid};
use crate::scene::description::{Constraint, Description, Shape};

/// Balls `ball1`, `ball2`, … on rings about the origin in the x–z plane, each pulled to it by a
/// spring with a rest length of the ball's radius.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rush {
    /// The number of balls.
    pub count: usize,
    /// The radius of a ball (m).
    pub radius: f64,
    /// The radius of the innermost ring (m), at least twice that of a ball.
    pub distance: f64,
    /// The mass of each ball (kg).
    pub mass: f64,
    /// The stiffness of each spring (N/m).
    pub stiffness: f64,
    /// The damping of each spring (N s/m).
    pub damping: f64,
}

/// The distance between neighbors in a ring, and between rings, in ball diameters.
const PITCH: f64 = 1.25;

impl Structure for Rush {
    fn bodies(&self) -> usize {
        self.count
    }

    fn numbers(&self) -> Vec<(&'static str, f64)> {
        vec![
            ("radius", self.radius),
            ("distance", self.distance),
            ("mass", self.mass),
            ("stiffness", self.stiffness),
            ("damping", self.damping),
        ]
    }

    fn fault(&self) -> Option<(&'static str, String)> {
        let near = self.distance < 2.0 * self.radius;
        near.then(|| ("distance", format!("{} is less than a ball's diameter", self.distance)))
    }

    fn add_to(&self, scene: &mut Description) {
        let pitch = PITCH * 2.0 * self.radius;
        let (mut ring, mut place) = (self.distance, 0);
        for k in 1..=self.count {
            let around = (TAU * ring / pitch).floor();
            let (sin, cos) = libm::sincos(TAU * place as f64 / around);
            let position = [ring * cos, 0.0, ring * sin];
            let name = format!("ball{k}");
            scene.bodies.push(solid(name.clone(), Shape::Sphere(self.radius), self.mass, position));
            scene.constraints.push(Constraint {
                kind: "spring".into(),
                bodies: vec![name],
                points: Some([[0.0; 3], position]),
                length: Some(self.radius),
                stiffness: Some(self.stiffness),
                damping: Some(self.damping),
                ..Constraint::default()
            });
            place += 1;
            if place as f64 >= around {
                (ring, place) = (ring + pitch, 0);
            }
        }
    }
}
