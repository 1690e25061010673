//! Bodies that pass through each other or stay overlapped are always reported, and sound scenes
//! cause no report.

use lcplab_mechanics::body::{Pose, State};
use lcplab_mechanics::scene::{Scene, Scheme, catalogue, contacts, step_contacts};
use lcplab_mechanics::simulation::{
    Interpenetration, InterpenetrationKind, LASTING, Simulation, Warnings,
};
use nalgebra::{UnitQuaternion, Vector3};
use proptest::prelude::*;

use super::{assert_near, simulation};

/// A plate of 2 m × 2 m × `thickness`, and a ball of 5 cm.
fn plate(thickness: f64) -> Scene {
    let text = format!(
        "gravity = [0, 0, 0]\n\
         [[bodies]]\nname = \"plate\"\nfixed = true\nshape = {{ box = [2, 2, {thickness}] }}\n\
         [[bodies]]\nname = \"ball\"\nshape = {{ sphere = 0.05 }}\nmass = 1\n"
    );
    Scene::from_toml("plate.toml", &text).unwrap()
}

fn named(simulation: &mut Simulation, steps: usize) -> Vec<Interpenetration> {
    (0..steps).flat_map(|_| simulation.step().unwrap().interpenetrations).collect()
}

/// Where a straight path crosses the plane z = 0 within the plate, if it does.
fn crosses(from: Vector3<f64>, to: Vector3<f64>) -> bool {
    let theta = from.z / (from.z - to.z);
    let at = from.lerp(&to, theta);
    from.z * to.z < 0.0 && at.x.abs() < 1.0 && at.y.abs() < 1.0
}

fn unit() -> impl Strategy<Value = Vector3<f64>> {
    [-1.0..1.0f64, -1.0..1.0, -1.0..1.0].prop_map(Vector3::from)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// For any margin, scheme and speed: a ball whose center passes to the other side of a plate is
    /// reported.
    #[test]
    fn a_fast_ball_that_gets_through_a_thin_plate_is_never_silent(
        aim in unit(),
        from in unit(),
        height in 0.06..3.0f64,
        speed in 1.0..2000.0f64,
        thickness in 0.002..0.2f64,
        margin in prop_oneof![Just(None), (0.0..0.1f64).prop_map(Some)],
        scheme in prop_oneof![
            Just(Scheme::Velocity), Just(Scheme::Acceleration), Just(Scheme::SplitImpulse), Just(Scheme::Xpbd)
        ],
    ) {
        let mut scene = plate(thickness);
        scene.contact.margin = margin;
        scene.step.scheme = scheme;
        scene.step.events = false;
        let start = Vector3::new(from.x, from.y, 0.5 * thickness + height);
        let target = Vector3::new(0.9 * aim.x, 0.9 * aim.y, 0.0);
        scene.states[1].pose.p = start;
        scene.states[1].v = (target - start).normalize() * speed;
        let mut ball = simulation(scene);
        let (mut at, mut has_crossed, mut names) = (start, false, Vec::new());
        for _ in 0..30 {
            let Ok(step) = ball.step() else { break }; // xpbd may throw it out faster than anything should be
            has_crossed |= crosses(at, step.states[1].pose.p);
            at = step.states[1].pose.p;
            names.extend(step.interpenetrations);
        }
        prop_assert!(!has_crossed || !names.is_empty(), "silent");
        prop_assert!(names.iter().all(|name| name.bodies == [1, 0] && name.depth > 0.0));
    }

    /// A bar of 2 m turns about its center by `swept` in a step, beside a peg at the angle `at`: it
    /// strikes the peg as soon as one of its arms has that angle, however often it turns.
    #[test]
    fn a_bar_that_turns_through_a_peg_is_reported_after_any_number_of_turns(
        at in 0.5..2.6f64,
        distance in 0.3..0.9f64,
        swept in prop_oneof![0.0..3.1f64, 3.2..40.0f64],
    ) {
        let text = "gravity = [0, 0, 0]
            contact.margin = 0.001
            step.dt = 0.01
            [[bodies]]
            name = \"bar\"
            mass = 1
            shape = { box = [2, 0.04, 0.04] }
            [[bodies]]
            name = \"peg\"
            fixed = true
            shape = { sphere = 0.02 }";
        let mut scene = Scene::from_toml("bar.toml", text).unwrap();
        scene.states[0].omega = Vector3::new(0.0, 0.0, swept / 0.01);
        scene.states[1].pose.p = distance * Vector3::new(at.cos(), at.sin(), 0.0);
        let step = simulation(scene).step().unwrap();
        let (found, q) = (step.interpenetrations, step.states[0].pose.q);
        // The integrator turns the bar by a little less.
        let swept = if swept < 3.15 { q.angle() } else { 0.9 * swept };
        // Half the width of the bar and the radius of the peg, seen from the center.
        let width = 0.04 / distance;
        if swept < at - width {
            prop_assert!(found.is_empty(), "{found:?}");
        } else if swept > at + width {
            let is_passage = |one: &&Interpenetration| {
                matches!(one.kind, InterpenetrationKind::PassedThrough { .. })
            };
            let passages = found.iter().filter(is_passage);
            prop_assert_eq!(passages.map(|one| one.bodies).collect::<Vec<_>>(), [[0, 1]]);
        }
    }

    /// With the margin that depends on the speed nothing passes through at all.
    #[test]
    fn a_margin_that_follows_the_speed_stops_a_ball_at_a_thin_plate(
        from in unit(), height in 0.06..3.0f64, speed in 1.0..2000.0f64, thickness in 0.002..0.2f64,
    ) {
        let mut scene = plate(thickness);
        let start = Vector3::new(from.x, from.y, 0.5 * thickness + height);
        scene.states[1].pose.p = start;
        scene.states[1].v = Vector3::new(-0.5 * from.x, 0.3 * from.y, -1.0).normalize() * speed;
        let mut ball = simulation(scene);
        let mut at = start;
        for _ in 0..30 {
            let step = ball.step().unwrap();
            prop_assert!(!crosses(at, step.states[1].pose.p));
            prop_assert!(step.interpenetrations.is_empty());
            at = step.states[1].pose.p;
        }
    }

    /// The property of the margin: bodies that overlap after a free step had a contact before it.
    #[test]
    fn no_gap_that_a_free_step_closes_is_beyond_the_margin(
        a in unit(), b in unit(), va in unit(), vb in unit(), wa in unit(), wb in unit(), turn in unit(),
        dt in 0.001..0.1f64, fast in 0.0..50.0f64,
    ) {
        let text = "
            [[bodies]]
            name = \"rod\"
            shape = { capsule = { length = 1, radius = 0.02 } }
            mass = 1
            force = [3, 0, 0]
            [[bodies]]
            name = \"box\"
            shape = { box = [0.6, 0.1, 0.3] }
            mass = 1
        ";
        let mut scene = Scene::from_toml("pair.toml", text).unwrap();
        scene.step.dt = dt;
        let state = |p: Vector3<f64>, v: Vector3<f64>, omega: Vector3<f64>| {
            let pose = Pose { p, q: UnitQuaternion::from_scaled_axis(3.0 * turn) };
            State { pose, v: fast * v, omega: fast * omega }
        };
        scene.states = [state(a, va, wa), state(b, vb, wb)].into();
        let mut free = scene.clone();
        free.pairs.entry([0, 1]).or_default().without_contact = true;
        let after = simulation(free).step().unwrap().states;
        let overlaps = !contacts(&scene, &after, -1e-9).is_empty();
        prop_assert!(!overlaps || !step_contacts(&scene, &scene.states).is_empty());
    }

    /// A ball that passes a post at a distance is not deflected, at any speed.
    #[test]
    fn a_ball_that_passes_a_post_is_not_turned_away(
        x in -1.0..-0.2f64, y in 0.102..0.4f64, speed in 0.1..100.0f64, dt in 0.001..0.05f64,
    ) {
        let text = "
            gravity = [0, 0, 0]
            [[bodies]]
            name = \"post\"
            fixed = true
            shape = { sphere = 0.05 }
            [[bodies]]
            name = \"ball\"
            shape = { sphere = 0.05 }
            mass = 1
        ";
        let mut scene = Scene::from_toml("post.toml", text).unwrap();
        scene.step.dt = dt;
        scene.states[1].pose.p = Vector3::new(x, y, 0.0);
        scene.states[1].v = Vector3::new(speed, 0.0, 0.0);
        let mut ball = simulation(scene);
        // Within 5 cm a contact counts whatever the path; if it has no effect, the speed is
        // unchanged.
        let is_near = |p: Vector3<f64>| p.norm() < 0.15;
        let mut at = Vector3::new(x, y, 0.0);
        for _ in 0..20 {
            let step = ball.step().unwrap();
            if is_near(at) {
                return Ok(());
            }
            prop_assert_eq!(step.states[1].v, Vector3::new(speed, 0.0, 0.0));
            at = step.states[1].pose.p;
        }
    }

    /// Slow bodies have exactly the contacts of the minimum margin.
    #[test]
    fn slow_bodies_have_the_contacts_of_the_least_margin(
        p in unit(), v in unit(), omega in unit(), turn in unit(),
    ) {
        let text = "
            [[bodies]]
            name = \"ground\"
            fixed = true
            shape = { plane = [0, 0, 1] }
            [[bodies]]
            name = \"box\"
            shape = { box = [0.6, 0.1, 0.3] }
            mass = 1
            [[bodies]]
            name = \"ball\"
            shape = { sphere = 0.3 }
            mass = 1
        ";
        let mut scene = Scene::from_toml("slow.toml", text).unwrap();
        let pose = Pose { p: 0.4 * p, q: UnitQuaternion::from_scaled_axis(3.0 * turn) };
        scene.states[1] = State { pose, v, omega };
        scene.states[2].v = -v;
        let names = |found: Vec<lcplab_mechanics::scene::DetectedContact>| -> Vec<_> {
            found.iter().map(|own| (own.id, own.gap.to_bits())).collect()
        };
        let least = names(contacts(&scene, &scene.states, 0.05));
        prop_assert_eq!(names(step_contacts(&scene, &scene.states)), least);
    }
}

#[test]
fn a_ball_thrown_at_a_thin_plate_comes_to_rest_on_it_or_is_named() {
    let text = "
        step = { dt = 0.0166666 }
        contact = { friction = 0.5 }
        [[bodies]]
        name = \"plate\"
        fixed = true
        shape = { box = [2, 2, 0.05] }
        [[bodies]]
        name = \"ball\"
        shape = { sphere = 0.05 }
        mass = 1
        position = [0, 0, 1]
        velocity = [0, 0, -20]
    ";
    let mut scene = Scene::from_toml("thin.toml", text).unwrap();
    let mut ball = simulation(scene.clone());
    assert!(named(&mut ball, 60).is_empty());
    assert_near(ball.states()[1].pose.p.z, 0.075, 1e-9); // half of the plate and the radius
    scene.contact.margin = Some(0.05);
    let mut ball = simulation(scene.clone());
    let (mut names, mut warnings) = (Vec::new(), Warnings::default());
    for _ in 0..60 {
        let step = ball.step().unwrap();
        warnings.add(&scene, &step);
        names.extend(step.interpenetrations.iter().map(|own| (step.number, *own)));
    }
    // It falls slightly more than 0.3333 m per step: from 1 m it is at 0 after the third.
    let (step, name) = names[0];
    assert_eq!((step, name.bodies), (3, [1, 0]));
    assert!(ball.states()[1].pose.p.z < -10.0 || names.len() > 1);
    let message = &warnings.as_slice()[0].message;
    for word in ["\"ball\"", "\"plate\"", "step 3", " m, ", "contact.margin", "step.dt"] {
        assert!(message.contains(word), "{message}");
    }
}

#[test]
fn a_rod_that_turns_through_a_post_in_one_step_is_named() {
    // 100 rad/s in steps of 10 ms: from 29° before the post to 29° after it.
    let text = "
        gravity = [0, 0, 0]
        contact = { margin = 0.01 }
        [[bodies]]
        name = \"post\"
        fixed = true
        shape = { box = [0.02, 0.02, 1] }
        position = [0.8, 0, 0]
        [[bodies]]
        name = \"rod\"
        shape = { box = [2, 0.02, 0.02] }
        mass = 1
        rotation = { z = -28.6 }
        angular_velocity = [0, 0, 100]
    ";
    let mut rod = simulation(Scene::from_toml("rod.toml", text).unwrap());
    let names = named(&mut rod, 1);
    let [Interpenetration { kind: InterpenetrationKind::PassedThrough { .. }, .. }] = names[..]
    else {
        panic!("{names:?}")
    };
}

#[test]
fn an_overlap_that_lasts_is_named_once_with_its_depth_and_one_that_is_pushed_out_is_not() {
    let cube = |baumgarte: f64| {
        let text = format!(
            "step.baumgarte = {baumgarte}\n\
             [[bodies]]\nname = \"plate\"\nfixed = true\nshape = {{ box = [4, 4, 0.1] }}\n\
             [[bodies]]\nname = \"cube\"\nshape = {{ box = [0.5, 0.5, 0.5] }}\nmass = 1\nposition = [0, 0, 0.213]\n"
        );
        simulation(Scene::from_toml("cube.toml", &text).unwrap())
    };
    let names = named(&mut cube(0.0), 200);
    let [Interpenetration { kind: InterpenetrationKind::LastingOverlap, bodies: [1, 0], depth }] =
        names[..]
    else {
        panic!("{names:?}")
    };
    assert_near(depth, 0.087, 1e-9); // 0.05 + 0.25 − 0.213
    assert!(named(&mut cube(0.2), 200).is_empty());
    assert!(named(&mut cube(0.0), LASTING - 1).is_empty());
}

#[test]
fn a_body_that_gets_deep_into_another_one_is_named_at_once() {
    // Onto its edge from above, with a margin that is too small: 5 m/s are 50 mm a step.
    let text = "
        contact = { margin = 0 }
        [[bodies]]
        name = \"ground\"
        fixed = true
        shape = { plane = [0, 0, 1] }
        [[bodies]]
        name = \"square\"
        shape = { box = [0.1, 0.1, 0.1] }
        mass = 1
        position = [0, 0, 0.08]
        rotation = { y = 45 }
        velocity = [0, 0, -5]
    ";
    let mut square = simulation(Scene::from_toml("square.toml", text).unwrap());
    let names = named(&mut square, 60);
    assert!(matches!(names[0].kind, InterpenetrationKind::DeepOverlap { .. }), "{names:?}");
    assert!(names[0].depth > 0.025 && names[0].bodies == [1, 0]);
    assert!(matches!(names[1].kind, InterpenetrationKind::LastingOverlap), "{names:?}");
}

#[test]
fn the_same_event_at_several_pairs_of_bodies_is_one_text_that_names_them() {
    let ball = |name: &str, x: f64| {
        format!(
            "[[bodies]]\nname = \"{name}\"\nshape = {{ sphere = 0.5 }}\nmass = 1\nposition = [{x}, 0, 0.3]\n"
        )
    };
    let plane = "[[bodies]]\nname = \"floor\"\nfixed = true\nshape = { plane = [0, 0, 1] }\n";
    let text = [plane.into(), ball("left", -2.0), ball("right", 2.0)].concat();
    let scene = Scene::from_toml("balls.toml", &text).unwrap();
    let (mut simulation, mut warnings) = (simulation(scene.clone()), Warnings::default());
    for _ in 0..40 {
        warnings.add(&scene, &simulation.step().unwrap());
    }
    let texts = warnings.texts();
    let words: Vec<&str> = warnings.as_slice().iter().map(|own| own.word).collect();
    let count = |word: &str| words.iter().filter(|own| **own == word).count();
    assert_eq!((count("lasting_overlap"), count("deep_overlap")), (2, 0), "{words:?}");
    assert_eq!(texts.len(), 1, "{texts:?}");
    assert!(texts[0].contains("\"left\" has been inside \"floor\""), "{texts:?}");
    assert!(texts[0].ends_with("The same happened to right–floor."), "{texts:?}");
}

#[test]
fn no_shipped_scene_has_a_warning() {
    for shipped in catalogue::SHIPPED {
        let scene = Scene::load(shipped.name).unwrap();
        let mut simulation = Simulation::of(&scene).unwrap();
        let mut warnings = Warnings::default();
        let most = if scene.bodies.len() > 40 { 5 } else { 120 };
        for _ in 0..scene.step.count.min(most) {
            let Ok(step) = simulation.step() else { break }; // painleve has no solution at some instant
            warnings.add(&scene, &step);
        }
        assert!(warnings.as_slice().is_empty(), "{}: {:?}", shipped.name, warnings.as_slice());
    }
}
