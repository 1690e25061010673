//! Many bodies, and few: neither the tree of boxes nor the pairwise comparison misses a pair.

use lcplab_mechanics::body::{Pose, State};
use lcplab_mechanics::scene::{Scene, contacts};
use nalgebra::UnitQuaternion;
use proptest::prelude::*;

use super::{SOLIDS, pair, pose};
use lcplab_testing::cases;

fn crowd(count: usize) -> Scene {
    let body = |k: usize| {
        format!("[[bodies]]\nname = \"{k}\"\nshape = {}\nmass = 1\n", SOLIDS[k % SOLIDS.len()])
    };
    let ground = "[[bodies]]\nname = \"ground\"\nshape = { plane = [0, 0, 1] }\nfixed = true\n";
    let text: String = (0..count).map(body).chain([ground.into()]).collect();
    Scene::from_toml("crowd.toml", &text).unwrap()
}

proptest! {
    #![proptest_config(cases(20))]

    #[test]
    fn a_crowd_has_the_contacts_of_its_pairs_in_their_order(
        poses in proptest::collection::vec(pose(), 20..50), // up to 32 without a tree
    ) {
        let scene = crowd(poses.len());
        let spread = |pose: &Pose| State { pose: Pose { p: pose.p * 2.0, ..*pose }, ..State::WORLD };
        let states: Vec<State> = poses.iter().map(spread).chain([State::WORLD]).collect();
        let found = contacts(&scene, &states, 0.1);
        let mut alone = Vec::new();
        for i in 0..poses.len() {
            for j in i + 1..poses.len() {
                let two = pair([SOLIDS[i % 4], SOLIDS[j % 4]]);
                let among_two = contacts(&two, &[states[i], states[j]], 0.1);
                alone.extend(among_two.iter().map(|f| ([i, j], f.id.features, f.gap)));
            }
            let ground = poses.len();
            let on_ground = found.iter().filter(|f| f.id.bodies == [i, ground]);
            alone.extend(on_ground.map(|f| (f.id.bodies, f.id.features, f.gap)));
        }
        let together: Vec<_> = found.iter().map(|f| (f.id.bodies, f.id.features, f.gap)).collect();
        prop_assert_eq!(together, alone);
    }
}

#[test]
fn a_body_alone_and_no_body_at_all_touch_nothing() {
    let alone = crowd(1);
    let high = State {
        pose: Pose { p: [0.0, 0.0, 9.0].into(), q: UnitQuaternion::identity() },
        ..State::WORLD
    };
    assert!(contacts(&alone, &[high, State::WORLD], 0.1).is_empty());
    assert!(contacts(&crowd(0), &[State::WORLD], 0.1).is_empty());
}
