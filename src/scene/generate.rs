//! Regular structures whose size is a number that a user can change.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::description::{Body, Constraint, Description, Shape};
use super::settings::positive;
use crate::error::Defects;

/// More bodies than this are refused: a typing error should not fill the memory.
const MOST_BODIES: usize = 10_000;

/// A structure to add to a scene, for example `chain = { links = 10, spacing = 0.1, mass = 0.5 }`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Generator {
    /// Point masses in a line along x, joined by rods; the first rod hangs from the world.
    Chain(Chain),
    /// A horizontal net of point masses joined by rods along x and y, its corners hung on rods.
    Net(Net),
    /// Equal cubes on top of each other, from z = 0 up.
    Stack(Stack),
    /// Equal boxes along x, joined end to end by balls and sockets; the first hangs from the world.
    BallChain(BallChain),
}

/// Point masses p1, p2, … along x from the origin; rods between neighbours.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Chain {
    /// The number of rods and of masses.
    pub links: usize,
    /// The length of a rod (m).
    pub spacing: f64,
    /// The mass of each point (kg).
    pub mass: f64,
}

/// Point masses `node r c` at x = c spacing, y = r spacing, z = 0. The four corners hang on upright
/// rods that let them swing inwards: nailed corners would leave no net between them to sag.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Net {
    /// The number of masses along y.
    pub rows: usize,
    /// The number of masses along x.
    pub columns: usize,
    /// The length of a rod (m).
    pub spacing: f64,
    /// The length of the rods that the corners hang on (m).
    pub hang: f64,
    /// The mass of each point (kg).
    pub mass: f64,
}

/// Cubes box1, box2, … from the bottom up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stack {
    /// The number of cubes.
    pub count: usize,
    /// The edge of a cube (m).
    pub size: f64,
    /// The mass of each cube (kg).
    pub mass: f64,
}

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

impl Generator {
    fn bodies(&self) -> usize {
        match self {
            Generator::Chain(chain) => chain.links,
            Generator::Net(net) => net.rows.saturating_mul(net.columns),
            Generator::Stack(stack) => stack.count,
            Generator::BallChain(chain) => chain.links,
        }
    }

    /// The lengths (m) and masses (kg), which must be positive.
    fn numbers(&self) -> Vec<(&'static str, f64)> {
        match self {
            Generator::Chain(chain) => vec![("spacing", chain.spacing), ("mass", chain.mass)],
            Generator::Net(net) => {
                vec![("spacing", net.spacing), ("hang", net.hang), ("mass", net.mass)]
            }
            Generator::Stack(stack) => vec![("size", stack.size), ("mass", stack.mass)],
            Generator::BallChain(chain) => {
                let sizes = chain.size.map(|size| ("size", size));
                sizes.into_iter().chain([("mass", chain.mass)]).collect()
            }
        }
    }

    fn name(&self) -> &'static str {
        match self {
            Generator::Chain(_) => "chain",
            Generator::Net(_) => "net",
            Generator::Stack(_) => "stack",
            Generator::BallChain(_) => "ball_chain",
        }
    }

    fn add_to(&self, scene: &mut Description) {
        match self {
            Generator::Chain(chain) => chain.add_to(scene),
            Generator::Net(net) => net.add_to(scene),
            Generator::Stack(stack) => stack.add_to(scene),
            Generator::BallChain(chain) => chain.add_to(scene),
        }
    }
}

/// The description with its structures written out after its own bodies and constraints.
pub(super) fn expand(description: &Description, defects: &mut Defects) -> Description {
    let mut whole = description.clone();
    for (k, generator) in description.generate.iter().enumerate() {
        let (place, bodies) = (format!("generate[{k}].{}", generator.name()), generator.bodies());
        let mut numbers = generator.numbers();
        for &(field, value) in &numbers {
            positive(defects, format!("{place}.{field}"), value);
        }
        numbers.retain(|&(_, value)| !(value > 0.0 && value.is_finite()));
        if bodies > MOST_BODIES {
            let reason = format!("makes {bodies} bodies, at most {MOST_BODIES} are allowed");
            defects.add(place, reason);
        } else if numbers.is_empty() {
            generator.add_to(&mut whole);
        }
    }
    whole
}

impl Chain {
    fn add_to(&self, scene: &mut Description) {
        for k in 1..=self.links {
            let position = [k as f64 * self.spacing, 0.0, 0.0];
            scene.bodies.push(point(format!("p{k}"), self.mass, position));
            let rod = match k {
                1 => rod_to_world([0.0; 3], position, "p1".into()),
                _ => rod([format!("p{}", k - 1), format!("p{k}")]),
            };
            scene.constraints.push(rod);
        }
    }
}

impl Net {
    fn add_to(&self, scene: &mut Description) {
        let name = |r: usize, c: usize| format!("node {r} {c}");
        let last = |n: usize| n.saturating_sub(1);
        for r in 0..self.rows {
            for c in 0..self.columns {
                let position = [c as f64 * self.spacing, r as f64 * self.spacing, 0.0];
                scene.bodies.push(point(name(r, c), self.mass, position));
                if c > 0 {
                    scene.constraints.push(rod([name(r, c - 1), name(r, c)]));
                }
                if r > 0 {
                    scene.constraints.push(rod([name(r - 1, c), name(r, c)]));
                }
                if (r == 0 || r == last(self.rows)) && (c == 0 || c == last(self.columns)) {
                    let [x, y, z] = position;
                    scene.constraints.push(rod_to_world(
                        [x, y, z + self.hang],
                        position,
                        name(r, c),
                    ));
                }
            }
        }
    }
}

impl Stack {
    fn add_to(&self, scene: &mut Description) {
        for k in 1..=self.count {
            scene.bodies.push(Body {
                name: format!("box{k}"),
                shape: Shape::Box([self.size; 3]),
                mass: Some(self.mass),
                position: [0.0, 0.0, (k as f64 - 0.5) * self.size],
                ..Body::default()
            });
        }
    }
}

impl BallChain {
    fn add_to(&self, scene: &mut Description) {
        let length = self.size[0];
        for k in 1..=self.links {
            scene.bodies.push(Body {
                name: format!("link{k}"),
                shape: Shape::Box(self.size),
                mass: Some(self.mass),
                position: [(k as f64 - 0.5) * length, 0.0, 0.0],
                ..Body::default()
            });
            let end = Some([(k - 1) as f64 * length, 0.0, 0.0]);
            scene.constraints.push(match k {
                1 => joint("nail", vec!["link1".into()], end),
                _ => joint("ball", vec![format!("link{}", k - 1), format!("link{k}")], end),
            });
        }
    }
}

fn point(name: String, mass: f64, position: [f64; 3]) -> Body {
    Body { name, shape: Shape::Point, mass: Some(mass), position, ..Body::default() }
}

fn joint(kind: &str, bodies: Vec<String>, point: Option<[f64; 3]>) -> Constraint {
    Constraint { kind: kind.into(), bodies, point, ..Constraint::default() }
}

fn rod(bodies: [String; 2]) -> Constraint {
    joint("distance", bodies.into(), None)
}

fn rod_to_world(from: [f64; 3], to: [f64; 3], body: String) -> Constraint {
    Constraint { points: Some([from, to]), ..joint("distance", vec![body], None) }
}
