//! Along a motion, a contact's gap changes according to J u and J'u of its row, and its identifier
//! stays: this tests that the row describes the geometry, beyond its own consistency.

use lcplab_mechanics::body::State;
use lcplab_mechanics::constraint::{Constraint, Normal};
use lcplab_mechanics::scene::{DetectedContact, Feature, contacts};
use nalgebra::UnitQuaternion;
use proptest::prelude::*;

use super::{CUBE, Pose, SPHERE, pair, pose, solids, turned, vector};
use lcplab_testing::cases;

/// p + v t and exp(ω t) q.
fn moved(state: &State, t: f64) -> State {
    let pose = Pose {
        p: state.pose.p + state.v * t,
        q: UnitQuaternion::from_scaled_axis(state.omega * t) * state.pose.q,
    };
    State { pose, ..*state }
}

/// Whether a crossing of edges has the normal of a face, because the edges are nearly parallel or
/// the faces are not: its anchor is treated as material although the crossing moves.
fn approximate(found: &DetectedContact) -> bool {
    let edges = found.id.features.iter().all(|feature| matches!(feature, Feature::Edge(_)));
    edges && matches!(found.contact.normal, Normal::Face(_))
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn the_gap_changes_as_the_row_says(
        names in solids(), poses in [pose(), pose()], u in [vector(1.0), vector(1.0), vector(1.0), vector(1.0)],
    ) {
        let scene = pair(names);
        let states = [0, 1].map(|k| State { pose: poses[k], v: u[k], omega: u[k + 2] });
        let h = 1e-4;
        let at = |t: f64| contacts(&scene, &states.map(|state| moved(&state, t)), 0.5);
        let [before, now, after] = [-h, 0.0, h].map(at);
        for found in now.iter().filter(|found| !approximate(found) && found.gap.abs() > 1e-2) {
            let same = |others: &[DetectedContact]| {
                let kind = |f: &DetectedContact| std::mem::discriminant(&f.contact.normal);
                others.iter().find(|o| o.id == found.id && kind(o) == kind(found)).map(|o| o.gap)
            };
            let (Some(before), Some(after)) = (same(&before), same(&after)) else { continue };
            let [k0, k1] = found.contact.bodies.map(Option::unwrap);
            let row = &found.contact.rows([&states[k0], &states[k1]]).unwrap()[0];
            let [j0, j1] = row.jacobian;
            let rate = j0.dot(&states[k0].velocity()) + j1.dot(&states[k1].velocity());
            // Third-order terms are larger where the normal rotates fast: near a small distance d
            // or between edges at a small angle.
            prop_assert!(((after - before) / (2.0 * h) - rate).abs() < 1e-4 * (1.0 + rate.abs()));
            let bend = (after - 2.0 * found.gap + before) / (h * h);
            let bound = 1e-2 * (1.0 + row.velocity_product.abs());
            prop_assert!((bend - row.velocity_product).abs() < bound,
                "{bend} {} {:?}", row.velocity_product, found.id);
        }
    }
}

#[test]
fn contacts_keep_their_names_while_their_features_touch() {
    // A tumbling motion of a box over another, within its clearances: the same corners stay over
    // the same face, for any order of rotations.
    let scene = pair([CUBE, CUBE]);
    let names = |k: usize| {
        let t = k as f64 * 0.01;
        let q =
            UnitQuaternion::from_euler_angles(1e-3 * (7.0 * t).sin(), 1e-3 * (5.0 * t).cos(), 0.1);
        let place = Pose { p: [0.1 + 0.05 * t, 0.07, 1.0].into(), q };
        let states = [State::WORLD, State { pose: place, ..State::WORLD }];
        contacts(&scene, &states, 0.05).iter().map(|c| c.id).collect::<Vec<_>>()
    };
    let first = names(0);
    assert_eq!(first.len(), 4);
    assert!((1..100).all(|k| names(k) == first));
}

#[test]
fn a_ball_that_rolls_over_a_box_changes_its_name_at_the_rim_only() {
    let scene = pair([CUBE, SPHERE]);
    let name = |x: f64| {
        let place = Pose { p: [x, 0.0, 1.0].into(), q: turned([0.0, 1.0, 0.0].into(), 100.0 * x) };
        let states = [State::WORLD, State { pose: place, ..State::WORLD }];
        let found = contacts(&scene, &states, 0.1);
        assert_eq!(found.len(), 1);
        found[0].id.features
    };
    let names: Vec<_> = (-60..60).map(|k| name((f64::from(k) + 0.5) / 100.0)).collect();
    let changes: Vec<usize> = (1..names.len()).filter(|&k| names[k] != names[k - 1]).collect();
    assert_eq!(changes, [10, 110]); // at x = −½ and ½
    assert!(names.iter().all(|[_, ball]| *ball == Feature::Vertex(0)));
}
