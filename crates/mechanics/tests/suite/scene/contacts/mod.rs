//! Contact points: compared with closed forms, with parry, and along motions.

mod broad;
mod closed_forms;
mod manifold;
mod motion;
mod oracle;
mod persistence;
mod points;

use lcplab_mechanics::body::{Pose, State};
use lcplab_mechanics::scene::{DetectedContact, Scene, contacts};
use nalgebra::{UnitQuaternion, Vector3};
use proptest::prelude::*;

/// The shapes of the pairs, as in scene files; the octahedron has its corners at 1 m.
const POINT: &str = "\"point\"";
const SPHERE: &str = "{ sphere = 0.5 }";
const CUBE: &str = "{ box = [1, 1, 1] }";
const CAPSULE: &str = "{ capsule = { length = 1, radius = 0.25 } }";
const OCTAHEDRON: &str =
    "{ hull = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]] }";
const PLANE: &str = "{ plane = [0, 0, 1] }";

/// The shapes that have a volume.
const SOLIDS: [&str; 4] = [SPHERE, CUBE, CAPSULE, OCTAHEDRON];

/// Two bodies of 1 kg; a plane is fixed.
fn pair(shapes: [&str; 2]) -> Scene {
    let body = |shape: &str| {
        let mass = if shape == PLANE { "fixed = true" } else { "mass = 1" };
        format!("[[bodies]]\nname = {shape:?}\nshape = {shape}\n{mass}\n")
    };
    let [first, second] = shapes.map(body);
    let text = format!("{first}{}", second.replacen("name = \"", "name = \"second ", 1));
    Scene::from_toml("pair.toml", &text).unwrap()
}

/// The contact points of two shapes in two poses.
fn found(shapes: [&str; 2], poses: [Pose; 2], margin: f64) -> Vec<DetectedContact> {
    let states = poses.map(|pose| State { pose, ..State::WORLD });
    contacts(&pair(shapes), &states, margin)
}

fn nearest(found: &[DetectedContact]) -> &DetectedContact {
    found.iter().min_by(|a, b| a.gap.total_cmp(&b.gap)).expect("a contact")
}

fn turned(axis: Vector3<f64>, degrees: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_scaled_axis(axis * degrees.to_radians())
}

fn vector(reach: f64) -> impl Strategy<Value = Vector3<f64>> {
    [-reach..reach, -reach..reach, -reach..reach].prop_map(Vector3::from)
}

fn pose() -> impl Strategy<Value = Pose> {
    (vector(1.5), vector(3.0))
        .prop_map(|(p, turn)| Pose { p, q: UnitQuaternion::from_scaled_axis(turn) })
}

fn solids() -> impl Strategy<Value = [&'static str; 2]> {
    (0..4usize, 0..4usize).prop_map(|(i, j)| [SOLIDS[i], SOLIDS[j]])
}
