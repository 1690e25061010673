//! Settings that are overridden, that have no effect, and that cannot work.

use lcplab_mechanics::body::Mass;
use lcplab_mechanics::scene::{Integrator, Scene, Scheme, catalogue};
use lcplab_mechanics::simulation::Simulation;
use lcplab_solver as solver;
use nalgebra::Vector3;

fn simulation_of(scene: Scene) -> Simulation {
    Simulation::new(scene, Box::new(solver::Dantzig::default()))
}

fn changed(scene: &str, changes: &[(&str, &str)]) -> lcplab_lcp::error::Result<Scene> {
    let changes: Vec<_> =
        changes.iter().map(|(key, value)| (key.to_string(), value.to_string())).collect();
    Scene::load_with(scene, &changes)
}

#[test]
fn a_field_is_set_by_its_name_whatever_it_is_in() {
    let scene = changed(
        "sliding",
        &[
            ("mu", "0.25"),
            ("dt", "0.002"),
            ("step.scheme", "soft"),
            ("step.soft.relax", "0"),
            ("bodies.1.velocity", "[1, 2, 0]"),
        ],
    );
    let scene = scene.unwrap();
    assert_eq!((scene.contact.friction, scene.step.dt), (0.25, 0.002));
    assert_eq!((scene.step.scheme, scene.step.soft.relax), (Scheme::Soft, 0));
    assert_eq!(scene.states[1].v, Vector3::new(1.0, 2.0, 0.0));
}

#[test]
fn a_field_that_is_not_there_is_refused_by_its_name() {
    for (key, value, word) in [
        ("contact.fricton", "0.3", "fricton"),
        ("bodies.nobody.mass", "1", "nobody"),
        ("contact.friction", "-1", "contact.friction"),
        ("contact.friction.x", "1", "friction"),
        ("title", "[", "title"),
    ] {
        let outcome = changed("sliding", &[(key, value)]);
        match outcome {
            Ok(scene) => assert!(key == "title" && scene.title == "[", "{key}"),
            Err(error) => assert!(error.to_string().contains(word), "{error}"),
        }
    }
}

#[test]
fn a_scene_that_leans_is_a_slope() {
    // tan 17° > 0.25: the block slides down along x with g (sin 17° − 0.25 cos 17°).
    let still = ("bodies.1.velocity", "[0, 0, 0]");
    let scene = changed("sliding", &[("mu", "0.25"), ("angle", "17"), still]).unwrap();
    let (sin, cos) = 17f64.to_radians().sin_cos();
    assert!((scene.gravity - Vector3::new(9.81 * sin, 0.0, -9.81 * cos)).norm() < 1e-14);
    let mut block = simulation_of(scene);
    for _ in 0..100 {
        block.step().unwrap();
    }
    let exact = 9.81 * (sin - 0.25 * cos) * block.time();
    assert!((block.states()[1].v.x - exact).abs() < 1e-6, "{} {exact}", block.states()[1].v.x);
}

const CRATE: &str = "
    gravity = [0, 0, 0]
    [[bodies]]
    name = \"crate\"
    shape = { box = [1, 2, 3] }
    mass = 6
";

#[test]
fn a_force_at_a_point_turns_a_body_as_its_torque_does() {
    // I_z = 6 (1 + 4)/12 = 2.5; a force of 5 N along y at (0.5, 0, 0) has the torque 2.5 N m about
    // z.
    let at_point = format!("{CRATE}force = [0, 5, 0]\nforce_at = [0.5, 0, 0]\n");
    let torque = format!("{CRATE}force = [0, 5, 0]\ntorque = [0, 0, 2.5]\n");
    for text in [at_point, torque] {
        let mut crate_ = simulation_of(Scene::from_toml("crate.toml", &text).unwrap());
        let step = crate_.step().unwrap();
        let state = step.states[0];
        assert!((state.omega - Vector3::new(0.0, 0.0, 0.01)).norm() < 1e-15, "{}", state.omega);
        assert!((state.v - Vector3::new(0.0, 5.0 / 600.0, 0.0)).norm() < 1e-15);
        assert!(step.ledger.unwrap().closes());
    }
}

#[test]
fn a_pair_bounces_with_the_geometric_mean() {
    let text = "
        contact.restitution = 0.3
        [[bodies]]
        name = \"ground\"
        fixed = true
        shape = { plane = [0, 0, 1] }
        restitution = 0.9
        [[bodies]]
        name = \"ball\"
        shape = { sphere = 0.5 }
        mass = 1
        position = [0, 0, 0.5]
        velocity = [0, 0, -3]
        restitution = 0.4
    ";
    let mut scene = Scene::from_toml("pair.toml", text).unwrap();
    scene.gravity = Vector3::zeros();
    for scheme in [Scheme::Velocity, Scheme::Acceleration, Scheme::Soft] {
        scene.step.scheme = scheme;
        let mut ball = simulation_of(scene.clone());
        ball.step().unwrap();
        assert!((ball.states()[1].v.z - 1.8).abs() < 1e-9, "{scheme:?} {}", ball.states()[1].v.z);
    }
}

#[test]
fn a_cylinder_has_the_mass_and_the_moments_of_a_round_one() {
    let text = "
        [[bodies]]
        name = \"drum\"
        shape = { cylinder = { length = 2, radius = 0.5 } }
        density = 3
    ";
    let drum = Scene::from_toml("drum.toml", text).unwrap().bodies[0].mass;
    let Mass::Rigid { mass, moments } = drum else { panic!() };
    let exact = 3.0 * std::f64::consts::PI * 0.25 * 2.0;
    assert!((mass - exact).abs() < 1e-12 * exact, "{mass} {exact}");
    let across = exact * (0.25 / 4.0 + 4.0 / 12.0);
    assert!((moments - Vector3::new(across, across, exact / 8.0)).norm() < 1e-12);
}

#[test]
fn a_setting_that_is_read_in_vain_is_noted_and_one_that_has_a_part_is_not() {
    let notes = |changes: &[(&str, &str)]| changed("sliding", changes).unwrap().notes();
    let usual = [("step.alpha", "0"), ("step.baumgarte", "0")];
    assert!(notes(&usual).is_empty());
    assert!(notes(&[("step.alpha", "20"), ("step.baumgarte", "0")])[0].contains("step.alpha"));
    assert!(notes(&[("step.alpha", "20"), ("step.baumgarte", "0.2")]).is_empty());
    assert!(notes(&[usual[0], usual[1], ("step.integrator", "rk4")])[0].contains("integrator"));
}

#[test]
fn no_setting_of_a_shipped_scene_is_noted_as_without_effect() {
    for shipped in catalogue::SHIPPED {
        let notes = Scene::load(shipped.name).unwrap().notes();
        assert!(
            !notes.iter().any(|note| note.contains("no effect")),
            "{}: {notes:?}",
            shipped.name
        );
    }
    let stack = changed("stack", &[("step.alpha", "30")]).unwrap();
    assert!(stack.notes()[0].contains("step.alpha has no effect"), "{:?}", stack.notes());
}

#[test]
fn a_file_named_as_a_shipped_scene_has_no_note_on_a_setting_that_it_does_not_state() {
    let text = "
        [[bodies]]
        name = \"bead\"
        shape = \"point\"
        mass = 1
    ";
    assert_eq!(Scene::from_toml("stack.toml", text).unwrap().notes(), [""; 0]);
}

/// The remaining fraction of a separated nail's error after 100 steps of 10 ms.
fn left_of_error(alpha: f64, integrator: Integrator) -> f64 {
    let text = "
        gravity = [0, 0, 0]
        step = { dt = 0.01, scheme = \"acceleration\" }
        [[bodies]]
        name = \"bead\"
        shape = \"point\"
        mass = 1
        position = [0.001, 0, 0]
        [[constraints]]
        kind = \"nail\"
        bodies = [\"bead\"]
        point = [0.001, 0, 0]
    ";
    let mut scene = Scene::from_toml("nail.toml", text).unwrap();
    scene.states[0].pose.p.x = 0.002;
    (scene.step.alpha, scene.step.integrator) = (alpha, integrator);
    let is_noted = scene.notes().iter().any(|note| note.contains("errors grow"));
    let mut bead = simulation_of(scene);
    let has_diverged = (0..100).any(|_| bead.step().is_err());
    let left = if has_diverged {
        f64::INFINITY
    } else {
        (bead.states()[0].pose.p.x - 0.001).abs() / 0.001
    };
    assert_eq!(is_noted, left > 1.0, "{alpha} {integrator:?}: {left:e}");
    left
}

#[test]
fn errors_grow_where_alpha_dt_is_said_to_be_too_large_and_nowhere_else() {
    for (integrator, limit) in [
        (Integrator::SemiImplicitEuler, 0.828),
        (Integrator::ExplicitEuler, 2.0),
        (Integrator::Rk4, 2.785),
    ] {
        assert!(left_of_error(95.0 * limit, integrator) < 0.5);
        assert!(left_of_error(105.0 * limit, integrator) > 10.0);
    }
}

#[test]
fn every_shipped_scene_can_be_changed() {
    for shipped in lcplab_mechanics::scene::catalogue::SHIPPED {
        let scene = changed(shipped.name, &[("mu", "0.35"), ("step.dt", "0.002")]).unwrap();
        assert_eq!((scene.contact.friction, scene.step.dt), (0.35, 0.002), "{}", shipped.name);
    }
    let three = changed("stack", &[("generate.count", "3")]).unwrap();
    assert_eq!(three.bodies.len(), 4);
    let error = changed("stack", &[("dt", "0.1"), ("mu", "rough")]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "stack.toml: mu: invalid type: string \"rough\", expected a number"
    );
}
