//! Scenes for other programs, with all defaults written out.

use lcplab_mechanics::body::State;
use lcplab_mechanics::scene::catalogue::SHIPPED;
use lcplab_mechanics::scene::{Description, Scene};

/// The difference of two states (m, rad, m/s, rad/s).
fn apart(a: &State, b: &State) -> f64 {
    let turn = a.pose.q.angle_to(&b.pose.q);
    let moves = [a.pose.p - b.pose.p, a.v - b.v, a.omega - b.omega].map(|d| d.norm());
    moves.into_iter().fold(turn, f64::max)
}

#[test]
fn a_scene_that_is_written_out_is_the_same_scene_also_by_way_of_json() {
    for shipped in SHIPPED {
        let plain = Description::load_with(shipped.name, &[]).unwrap();
        let whole = plain.written_out(shipped.name).unwrap();
        assert!(whole.generate.is_empty() && whole.tilt.is_none(), "{}", shipped.name);
        let text = serde_json::to_string(&whole).unwrap();
        let again: Description = serde_json::from_str(&text).unwrap();
        let (scene, again) = (shipped.scene().unwrap(), Scene::new(shipped.name, &again).unwrap());
        assert_eq!(scene.bodies.len(), again.bodies.len(), "{}", shipped.name);
        assert_eq!(scene.constraints.len(), again.constraints.len(), "{}", shipped.name);
        assert!((scene.gravity - again.gravity).norm() < 1e-15);
        let states = scene.states.iter().zip(&again.states);
        for ((one, other), (a, b)) in scene.bodies.iter().zip(&again.bodies).zip(states) {
            assert_eq!((&one.name, one.friction), (&other.name, other.friction));
            assert!((one.mass.mass() - other.mass.mass()).abs() <= 1e-12 * one.mass.mass());
            assert!(apart(a, b) < 1e-7, "{}: {}", shipped.name, one.name);
        }
    }
}
