//! Motions compared with closed forms.

mod acceleration;
mod anisotropic;
mod columns;
mod demonstrations;
mod driven;
mod failures;
mod fast_turns;
mod free;
mod friction;
mod friction_models;
mod impact;
mod impact_energy;
mod integrators;
mod interpenetration;
mod laws_of_contact;
mod ledger;
mod over_time;
mod painleve;
mod pendulum;
mod polygons;
mod redundant;
mod resting;
mod rounds;
mod schemes;
mod shipped;
mod stacking;
mod stepper;
mod surfaces;
mod symmetry;

use lcplab_mechanics::scene::{Scene, Scheme, catalogue};
use lcplab_mechanics::simulation::{Simulation, Step};
use lcplab_solver as solver;

/// A ball of 1 cm that flies at a wall of 2 cm with 300 m/s, 3 m per step.
fn bullet() -> Scene {
    let text = "
        gravity = [0, 0, 0]
        [[bodies]]
        name = \"wall\"
        fixed = true
        shape = { box = [0.02, 2, 2] }
        [[bodies]]
        name = \"bullet\"
        shape = { sphere = 0.01 }
        mass = 0.01
        position = [-1.234, 0, 0]
        velocity = [300, 0, 0]
    ";
    Scene::from_toml("bullet.toml", text).unwrap()
}

/// The shipped scene of this name at this level.
fn scene(name: &str, scheme: Scheme) -> Scene {
    let mut scene = Scene::load(name).unwrap();
    scene.step.scheme = scheme;
    scene
}

/// The shipped scene with this name with words of its file replaced.
fn changed(name: &str, words: &[(&str, &str)]) -> Scene {
    let mut text = catalogue::text(name).unwrap().to_string();
    for (old, new) in words {
        assert!(text.contains(old), "{name} has no {old:?}");
        text = text.replace(old, new);
    }
    Scene::from_toml(&format!("{name}.toml"), &text).unwrap()
}

/// A shipped scene; sixty cubes of the tower go through the same code as its seven hundred.
fn shipped(name: &str) -> Scene {
    match name {
        "tower" => changed(name, &[("count = 700", "count = 60"), ("ring = 35", "ring = 30")]),
        name => Scene::load(name).unwrap(),
    }
}

/// A simulation of the scene with Dantzig's method.
fn simulation(scene: Scene) -> Simulation {
    scene.validate().unwrap();
    Simulation::new(scene, Box::new(solver::Dantzig::default()))
}

/// The x of the last solve of a step.
fn x(step: &Step) -> &[f64] {
    &step.solves.last().unwrap().solution.x
}

/// Whether two numbers agree to this relative or absolute difference.
#[track_caller]
fn assert_near(ours: f64, exact: f64, tolerance: f64) {
    assert!((ours - exact).abs() <= tolerance * exact.abs().max(1.0), "{ours}, exactly {exact}");
}
