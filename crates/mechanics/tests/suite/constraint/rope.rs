//! Ropes and rods: slack or taut, by length or by its square.

use lcplab_mechanics::body::State;
use lcplab_mechanics::constraint::{Constraint, Distance, SquaredDistance};
use lcplab_mechanics::scene::Scheme;
use nalgebra::Vector3;
use proptest::prelude::*;

use super::dual::state;
use super::{assert_near, forces, simulation};
use lcplab_testing::cases;

/// A point mass of 2 kg on a rope or rod of length 1 to the origin.
fn bob(kind: &str, position: &str) -> String {
    format!(
        "[step]\ndt = 0.01\nbaumgarte = 0.2\n\
         [[bodies]]\nname = \"bob\"\nshape = \"point\"\nmass = 2\nposition = {position}\n\
         [[constraints]]\nkind = \"{kind}\"\nbodies = [\"bob\"]\nlength = 1\n\
         points = [[0, 0, 0], {position}]\n"
    )
}

#[test]
fn a_slack_rope_lets_fall_freely_and_a_taut_one_carries() {
    let mut rope = simulation(&bob("rope", "[0, 0, -0.5]"), Scheme::Velocity);
    for n in 1..=200 {
        let step = rope.step().unwrap();
        // Symplectic Euler: n (n + 1)/2 g h² after n steps.
        let fallen = 0.5 + 9.81e-4 * f64::from(n * (n + 1)) / 2.0;
        assert_near(rope.states()[0].pose.p.z, -fallen.min(1.0), 1e-12);
        if fallen < 1.0 {
            assert_eq!(forces(&step, &rope, 0), [0.0]);
        }
    }
    let step = rope.step().unwrap();
    assert_near(forces(&step, &rope, 0)[0], 2.0 * 9.81, 1e-10);
}

#[test]
fn a_taut_rope_swings_as_a_rod() {
    // A step along the tangent lengthens both, so the rope stays taut and its row is the rod's.
    let mut pair =
        ["rope", "distance"].map(|kind| simulation(&bob(kind, "[0.6, 0, -0.8]"), Scheme::Velocity));
    for _ in 0..300 {
        let [rope, rod] = pair.each_mut().map(|bob| {
            let step = bob.step().unwrap();
            forces(&step, bob, 0)[0]
        });
        assert_near(rope, -rod, 1e-9);
    }
    let [rope, rod] = pair.each_ref().map(|bob| bob.states()[0].pose.p);
    assert!((rope - rod).norm() < 1e-10);
}

/// How far apart two kinds of bob are after a second at acceleration level, without feedback.
fn apart(kinds: [&str; 2], dt: f64) -> f64 {
    let [one, other] = kinds.map(|kind| {
        let text = bob(kind, "[0.6, 0, -0.8]").replace("dt = 0.01", &format!("dt = {dt}"));
        let mut bob = simulation(&text, Scheme::Acceleration);
        for _ in 0..(1.0 / dt).round() as usize {
            bob.step().unwrap();
        }
        bob.states()[0].pose.p
    });
    (one - other).norm()
}

#[test]
fn forces_of_a_rope_and_of_a_rod_by_squares_swing_as_those_of_a_rod_in_first_order() {
    // The rope takes the outward speed that a step leaves as an impact, the rod keeps it; by
    // squares, the same forces at |d| = l part with the drift. Both differences are of first order.
    for kind in ["rope", "squared_distance"] {
        let (coarse, fine) = (apart([kind, "distance"], 4e-3), apart([kind, "distance"], 2e-3));
        assert!(coarse < 0.05 && fine < 0.6 * coarse, "{kind} {coarse} {fine}");
    }
}

proptest! {
    #![proptest_config(cases(128))]

    #[test]
    fn the_squared_length_pulls_the_same_way_by_the_scale_of_the_chapter(
        a in state(), b in state(), length in 0.2..3.0,
    ) {
        // c² = |d|² − l² of the chapter: J² = 2 |d| J of the rod, so at |d| = l x² = x/(2 l); ours
        // is c²/(2l).
        let (bodies, anchors) = ([Some(0), Some(1)], [Vector3::x(), Vector3::y()]);
        let apart = (b.pose.point(&anchors[1]) - a.pose.point(&anchors[0])).norm();
        prop_assume!(apart > 0.1);
        let rod = &Distance { bodies, anchors, length }.rows([&a, &b]).unwrap()[0];
        let squared = &SquaredDistance { bodies, anchors, length }.rows([&a, &b]).unwrap()[0];
        prop_assert!((2.0 * length * squared.c - (apart * apart - length * length)).abs() < 1e-12 * (1.0 + apart * apart));
        for k in 0..2 {
            let chapter = 2.0 * length * squared.jacobian[k];
            prop_assert!((chapter - 2.0 * apart * rod.jacobian[k]).norm() < 1e-12 * chapter.norm());
        }
    }
}

#[test]
fn a_squared_rod_without_length_has_no_direction() {
    let rod =
        SquaredDistance { bodies: [None, Some(0)], anchors: [Vector3::zeros(); 2], length: 1.0 };
    assert!(rod.rows([&State::WORLD; 2]).is_err());
}
