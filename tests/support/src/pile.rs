//! Random piles of bodies, as text in the scene format.

use proptest::prelude::*;

/// A body of a pile: its shape, how tall it is (m), its mass (kg), its place beside the axis of the
/// pile (m), how it is turned (degrees).
type Piece = (usize, f64, f64, [f64; 2], [f64; 2]);

fn piece() -> impl Strategy<Value = Piece> {
    let turn = prop_oneof![Just([0.0, 0.0]), [0.0..90.0, -20.0..20.0]];
    let place = prop_oneof![Just([0.0, 0.0]), [-0.3..0.3, -0.3..0.3]];
    (0..4_usize, 0.4..1.2, -1.0..2.0, place, turn).prop_map(|(shape, size, mass, place, turn)| {
        (shape, size, 10.0_f64.powf(mass), place, turn)
    })
}

/// Stacks and heaps of boxes, balls and capsules on the ground or on a slab, straight or turned,
/// their masses up to a thousand times apart. The bodies are listed in any order, what they stand
/// on anywhere among them.
pub fn pile() -> impl Strategy<Value = String> {
    let pieces = proptest::collection::vec(piece(), 1..6);
    (pieces, any::<bool>(), 0..6_usize, any::<bool>(), 0.0..1.0).prop_map(
        |(pieces, is_slab, place, is_reversed, mu)| {
            let mut height = 0.0;
            let mut bodies: Vec<String> = Vec::new();
            for (k, piece) in pieces.iter().enumerate() {
                bodies.push(body(k, piece, height));
                height += piece.1;
            }
            if is_reversed {
                bodies.reverse();
            }
            let shape = match is_slab {
                true => "{ box = [4, 4, 1] }\nposition = [0, 0, -0.5]",
                false => "{ plane = [0, 0, 1] }",
            };
            let ground = format!("[[bodies]]\nname = \"ground\"\nfixed = true\nshape = {shape}\n");
            bodies.insert(place.min(bodies.len()), ground);
            format!("[contact]\nfriction = {mu}\n{}", bodies.concat())
        },
    )
}

fn body(k: usize, &(shape, size, mass, [x, y], [about_z, about_x]): &Piece, height: f64) -> String {
    let shape = match shape {
        0 | 1 => format!("{{ box = [{}, {}, {size}] }}", 1.5 * size, 0.8 + 0.3 * k as f64),
        2 => format!("{{ sphere = {} }}", size / 2.0),
        _ => format!("{{ capsule = {{ length = {size}, radius = {} }} }}", size / 4.0),
    };
    let z = height + size / 2.0;
    let rotation = match about_x {
        0.0 => format!("{{ z = {about_z} }}"),
        _ => format!("{{ x = {about_x} }}"),
    };
    format!(
        "[[bodies]]\nname = \"body{k}\"\nshape = {shape}\nmass = {mass}\nposition = [{x}, {y}, {z}]\nrotation = {rotation}\n"
    )
}
