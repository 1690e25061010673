//! `docs/scenes.md` documents every field of the scene format, and its example is a valid scene.

use lcplab_mechanics::scene::{Scene, schema};
use serde_json::Value;

const PAGE: &str = include_str!("../../../../../docs/scenes.md");

#[test]
fn every_field_has_its_line() {
    let schema = schema();
    let fields = |part: &Value| -> Vec<String> {
        part["properties"].as_object().unwrap().keys().cloned().collect()
    };
    let mut all = fields(&schema);
    for part in ["Step", "Contacts", "Solver", "Body", "Xpbd", "Soft", "Penalty"] {
        all.extend(fields(&schema["$defs"][part]));
    }
    for field in all.iter().filter(|field| !["step", "contact", "solver"].contains(&&***field)) {
        assert!(PAGE.contains(&format!("`{field}`")), "docs/scenes.md lacks {field}");
    }
}

#[test]
fn the_example_slides_up_and_then_down_its_slope() {
    let example = PAGE.split("```toml").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    let scene = Scene::from_toml("crate.toml", example).unwrap();
    // Up: v²/(2 g (sin 17° + 0.25 cos 17°)), after which tan 17° = 0.306 > 0.25 takes it down
    // again.
    let (sin, cos) = 17f64.to_radians().sin_cos();
    let top = -4.0 / (2.0 * 9.81 * (sin + 0.25 * cos));
    let solver = lcplab_solver::Registry::standard()
        .entry("dantzig")
        .unwrap()
        .build(&lcplab_solver::Options::default());
    let mut simulation = lcplab_mechanics::simulation::Simulation::new(scene, solver);
    let mut least = 0.0f64;
    for _ in 0..100 {
        least = least.min(simulation.step().unwrap().states[1].pose.p.x);
    }
    assert!((least - top).abs() < 0.01, "{least} {top}");
    assert!(simulation.states()[1].v.x > 0.0);
}
