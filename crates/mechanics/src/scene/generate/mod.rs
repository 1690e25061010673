//! Regular structures with a size that the user chooses, one per file.
//!
//! ```toml
//! [generate]
//! kind = "stack"
//! count = 5
//! size = 1
//! mass = 1
//! ```

mod arch;
mod ball_chain;
mod bridge;
mod card_house;
mod chain;
mod circular_tower;
mod dominoes;
mod joint_grid;
mod net;
mod pyramid;
mod rope;
mod rush;
mod stack;

pub use arch::Arch;
pub use ball_chain::{Along, BallChain};
pub use bridge::Bridge;
pub use card_house::CardHouse;
pub use chain::Chain;
pub use circular_tower::CircularTower;
pub use dominoes::Dominoes;
pub use joint_grid::JointGrid;
pub use net::Net;
pub use pyramid::Pyramid;
pub use rope::Rope;
pub use rush::Rush;
pub use stack::Stack;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::description::{Body, Constraint, Description, Shape};
use super::range;
use lcplab_lcp::error::Defects;

/// Maximum number of bodies, so that a typing error does not fill the memory.
const MOST_BODIES: usize = 50_000;

/// A structure to add to a scene: `[generate]` for one, `[[generate]]` for several.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Generator {
    /// Wedges of stone in half a circle.
    Arch(Arch),
    /// Equal boxes in a line, joined end to end by ball joints; the first hangs from the world.
    BallChain(BallChain),
    /// Planks joined by hinges between two fixed ends.
    Bridge(Bridge),
    /// Cards that lean on each other.
    CardHouse(CardHouse),
    /// Point masses in a line along x, joined by rods; the first rod hangs from the world.
    Chain(Chain),
    /// Rings of cubes on top of each other, each rotated by half a cube: the chapter's Figure 12.
    CircularTower(CircularTower),
    /// Upright slabs in a row.
    Dominoes(Dominoes),
    /// Balls in an upright grid, each joined to its neighbors.
    JointGrid(JointGrid),
    /// A horizontal net of point masses joined by rods along x and y, its corners hung from rods.
    Net(Net),
    /// Boxes in an upright triangle.
    Pyramid(Pyramid),
    /// Point masses on rods between two fixed points, hanging in equilibrium.
    Rope(Rope),
    /// Balls on rings, pulled to the origin by springs.
    Rush(Rush),
    /// Equal cubes on top of each other, from z = 0 up.
    Stack(Stack),
}

/// The interface of a structure.
trait Structure {
    /// The number of bodies.
    fn bodies(&self) -> usize;

    /// The lengths (m) and masses (kg), which must be positive.
    fn numbers(&self) -> Vec<(&'static str, f64)>;

    /// Any other defect, as a field and a reason.
    fn fault(&self) -> Option<(&'static str, String)> {
        None
    }

    /// Adds its bodies and constraints.
    fn add_to(&self, scene: &mut Description);
}

impl Generator {
    fn structure(&self) -> &dyn Structure {
        match self {
            Generator::Arch(arch) => arch,
            Generator::BallChain(chain) => chain,
            Generator::Bridge(bridge) => bridge,
            Generator::CardHouse(house) => house,
            Generator::Chain(chain) => chain,
            Generator::CircularTower(tower) => tower,
            Generator::Dominoes(dominoes) => dominoes,
            Generator::JointGrid(grid) => grid,
            Generator::Net(net) => net,
            Generator::Pyramid(pyramid) => pyramid,
            Generator::Rope(rope) => rope,
            Generator::Rush(rush) => rush,
            Generator::Stack(stack) => stack,
        }
    }
}

/// The description with its structures expanded after its own bodies and constraints.
pub(super) fn expand(description: &Description, defects: &mut Defects) -> Description {
    let mut whole = description.clone();
    for (k, generator) in description.generate.iter().enumerate() {
        let (place, structure) = (format!("generate[{k}]"), generator.structure());
        let bodies = structure.bodies();
        let count = defects.len();
        for (field, value) in structure.numbers() {
            check(defects, &place, field, value);
        }
        let are_sound = defects.len() == count;
        if bodies > MOST_BODIES {
            let reason = format!("makes {bodies} bodies, at most {MOST_BODIES} are allowed");
            defects.add(place, reason);
        } else if are_sound {
            match structure.fault() {
                Some((field, reason)) => defects.add(format!("{place}.{field}"), reason),
                None => structure.add_to(&mut whole),
            }
        }
    }
    whole
}

/// Checks a number of a structure: positive, and within the numerical range.
fn check(defects: &mut Defects, place: &str, field: &str, value: f64) {
    let unit = match field {
        "mass" => "kg",
        "density" => "kg/m³",
        "stiffness" => "N/m",
        "damping" => "N s/m",
        "lean" => "degrees",
        _ => {
            range::length(defects, format!("{place}.{field}"), value);
            return;
        }
    };
    range::divisor(defects, format!("{place}.{field}"), [field, unit], value);
}

fn point(name: String, mass: f64, position: [f64; 3]) -> Body {
    Body { name, shape: Shape::Point, mass: Some(mass), position, ..Body::default() }
}

fn solid(name: String, shape: Shape, mass: f64, position: [f64; 3]) -> Body {
    Body { name, shape, mass: Some(mass), position, ..Body::default() }
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
