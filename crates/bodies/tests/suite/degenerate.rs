//! States in which a constraint has no direction are named, not computed with.

use lcplab_bodies::body::State;
use lcplab_bodies::constraint::{Constraint, Contact, Distance, Normal};
use nalgebra::Vector3;

#[test]
fn the_distance_of_coincident_points_is_an_error() {
    let rod = Distance { bodies: [None, Some(0)], anchors: [Vector3::zeros(); 2], length: 1.0 };
    let error = rod.rows([&State::WORLD; 2]).unwrap_err();
    assert_eq!(error.to_string(), "the two points coincide, so their distance has no direction");
}

#[test]
fn parallel_edges_are_an_error() {
    let contact = Contact {
        bodies: [Some(0), Some(1)],
        anchors: [Vector3::zeros(), Vector3::z()],
        radii: [0.0; 2],
        normal: Normal::Edges([Vector3::x(); 2]),
        friction: 0.0,
        anisotropy: None,
    };
    assert!(contact.rows([&State::WORLD; 2]).is_err());
}
