//! A hanging rope: the discrete catenary.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Structure, point, rod, rod_to_world};
use crate::scene::description::Description;

/// Point masses p1, p2, … on rods between the origin and (span, 0, 0), in equilibrium in the x–z
/// plane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rope {
    /// The number of rods, at least 2; one more than the number of masses.
    pub links: usize,
    /// The length of the whole rope (m).
    pub length: f64,
    /// The distance between its ends (m), less than the length.
    pub span: f64,
    /// The mass of each point (kg).
    pub mass: f64,
}

impl Rope {
    /// The slope of each rod, and the ratio κ = m g / H of a mass's weight to the horizontal force.
    ///
    /// The horizontal force H is the same everywhere and each mass adds m g to the vertical one. By
    /// symmetry rod i of n has the slope κ (i − (n + 1)/2), i = 1 … n, where κ satisfies Σ l
    /// cos(atan slope) = span. The force in rod i is H / cos(atan slope).
    ///
    /// ```
    /// use lcplab_mechanics::scene::generate::{Bridge, Rope};
    ///
    /// // Two rods of 1 m, their ends √2 m apart: 45° down and up. The mass between weighs 2 H.
    /// let rope = Rope { links: 2, length: 2.0, span: 2f64.sqrt(), mass: 1.0 };
    /// let (slopes, ratio) = rope.catenary();
    /// assert!((slopes[0] + 1.0).abs() < 1e-9 && (slopes[1] - 1.0).abs() < 1e-9);
    /// assert!((ratio - 2.0).abs() < 1e-9);
    ///
    /// // A bridge of two planks of 1 m hangs in the same shape.
    /// let bridge = Bridge { planks: 2, size: [1.0, 0.5, 0.1], span: 2f64.sqrt(), mass: 1.0 };
    /// assert_eq!(bridge.rope(), rope);
    /// ```
    pub fn catenary(&self) -> (Vec<f64>, f64) {
        let n = self.links as f64;
        let link = self.length / n;
        let slopes = |kappa: f64| -> Vec<f64> {
            (1..=self.links).map(|i| kappa * (i as f64 - 0.5 * (n + 1.0))).collect()
        };
        let width =
            |kappa: f64| slopes(kappa).iter().map(|slope| link / slope.hypot(1.0)).sum::<f64>();
        // The width decreases from the length to that of a horizontal middle rod, or 0.
        let (mut low, mut high) = (0.0, 1.0);
        while width(high) > self.span && high < 1e12 {
            high *= 2.0;
        }
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if width(middle) > self.span { low = middle } else { high = middle }
        }
        (slopes(high), high)
    }
}

impl Structure for Rope {
    fn bodies(&self) -> usize {
        self.links.saturating_sub(1)
    }

    fn numbers(&self) -> Vec<(&'static str, f64)> {
        vec![("length", self.length), ("span", self.span), ("mass", self.mass)]
    }

    fn fault(&self) -> Option<(&'static str, String)> {
        if self.links < 2 {
            return Some(("links", format!("must be at least 2, is {}", self.links)));
        }
        let taut = self.span >= self.length;
        taut.then(|| ("span", format!("{} is not less than the length", self.span)))
    }

    fn add_to(&self, scene: &mut Description) {
        let link = self.length / self.links as f64;
        let [mut x, mut z] = [0.0, 0.0];
        let (slopes, _) = self.catenary();
        for (k, slope) in slopes.iter().enumerate() {
            let from = [x, 0.0, z];
            let across = link / slope.hypot(1.0);
            (x, z) = (x + across, z + slope * across);
            let (name, before) = (format!("p{}", k + 1), format!("p{k}"));
            if k + 1 == self.links {
                scene.constraints.push(rod_to_world([self.span, 0.0, 0.0], from, before));
                break;
            }
            scene.bodies.push(point(name.clone(), self.mass, [x, 0.0, z]));
            scene.constraints.push(match k {
                0 => rod_to_world(from, [x, 0.0, z], name),
                _ => rod([before, name]),
            });
        }
    }
}
