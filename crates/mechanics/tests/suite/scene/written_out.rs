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

#[test]
fn an_infinite_effort_or_stop_is_written_out_in_json_and_read_back() {
    let text = r#"
        title = "a motor that always keeps its speed, and a stop on one side"

        [[bodies]]
        name = "wheel"
        shape = { sphere = 0.1 }
        mass = 1

        [[constraints]]
        kind = "motor_rotation"
        bodies = ["wheel"]
        axis = [0, 0, 1]
        speed = 1
        effort = inf

        [[constraints]]
        kind = "limit_translation"
        bodies = ["wheel"]
        axis = [1, 0, 0]
        limits = [-inf, 2]
    "#;
    let whole = Description::from_toml("scene", text).unwrap().written_out("scene").unwrap();
    let json = serde_json::to_value(&whole).unwrap();
    assert_eq!(json["constraints"][0]["effort"], "inf");
    assert_eq!(json["constraints"][1]["limits"], serde_json::json!(["-inf", 2.0]));
    assert_eq!(serde_json::from_value::<Description>(json).unwrap(), whole);
}
