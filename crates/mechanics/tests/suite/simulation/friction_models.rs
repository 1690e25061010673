//! The friction models in complete motions, compared with closed forms.

use std::f64::consts::{FRAC_1_SQRT_2, PI, SQRT_2};

use lcplab_judge::{Demand, judge};
use lcplab_lcp::friction::Model;
use lcplab_mechanics::scene::{Persistence, Scene, Scheme, Sliding};
use lcplab_mechanics::simulation::{Simulation, Step};
use lcplab_solver::{Registry, Settings, Status};
use nalgebra::Vector3;

use super::{assert_near, simulation};

const G: f64 = 9.81;
const MU: f64 = 0.5;
const DT: f64 = 0.01;
const POLYGON_4: Model = Model::Polyhedral { directions: 4 };
const POLYGON_8: Model = Model::Polyhedral { directions: 8 };

/// A point of 2 kg on a level floor, with gravity tilted by a slope's angle towards `degrees`:
/// equivalent to a ramp rotated against its tangents by exactly that angle.
fn point(model: Model, slope: f64, degrees: f64) -> Scene {
    let text = "[step]\ndt = 0.01\n[contact]\nfriction = 0.5\n[solver]\ntolerance = 1e-11\n\
                [[bodies]]\nname = \"floor\"\nfixed = true\nshape = { plane = [0, 0, 1] }\n\
                [[bodies]]\nname = \"point\"\nshape = \"point\"\nmass = 2\n";
    let mut scene = Scene::from_toml("point.toml", text).unwrap();
    let down = along(degrees) * slope.sin();
    scene.gravity = G * Vector3::new(down.x, down.y, -slope.cos());
    scene.contact.model = model;
    scene
}

fn along(degrees: f64) -> Vector3<f64> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    Vector3::new(cos, sin, 0.0)
}

/// The point with a speed in a direction; in models where sliding bodies float, at the floating
/// height.
fn slider(model: Model, speed: f64, degrees: f64) -> Scene {
    let mut scene = point(model, 0.0, 0.0);
    scene.states[1].v = speed * along(degrees);
    if model == Model::AssociatedCone {
        scene.states[1].pose.p.z = DT * MU * speed;
    }
    scene
}

fn scene(name: &str, model: Model) -> Scene {
    let mut scene = Scene::load(name).unwrap();
    scene.contact.model = model;
    scene
}

fn velocity(simulation: &Simulation) -> Vector3<f64> {
    simulation.states()[1].v
}

fn steps(simulation: &mut Simulation, count: usize) -> Vec<Step> {
    (0..count).map(|_| simulation.step().unwrap()).collect()
}

/// Friction on the sliding point in its third step, relative to μ m g, and its direction (degrees).
fn friction(model: Model, degrees: f64) -> (f64, f64) {
    let mut slider = simulation(slider(model, 5.0, degrees));
    steps(&mut slider, 2); // a frozen box needs a step to know the load
    let before = velocity(&slider);
    slider.step().unwrap();
    let lost = (before - velocity(&slider)) / (MU * G * DT);
    (lost.xy().norm(), lost.y.atan2(lost.x).to_degrees())
}

/// A body floating at dt μ v sinks as it slows down, which reduces the load: in step n x_n
/// (1 + μ²) = m g dt + μ² times the x_n of the previous step, which is 1 − (μ²/(1 + μ²))ⁿ of m g
/// dt.
fn sinking() -> f64 {
    1.0 - (MU * MU / (1.0 + MU * MU)).powi(3)
}

#[test]
fn friction_on_an_oblique_slider_is_what_each_models_figure_allows() {
    let eighth = (PI / 8.0).cos();
    for (model, degrees, size, direction) in [
        (Model::CoulombCone, 30.0, 1.0, 30.0),
        (Model::CoulombCone, 45.0, 1.0, 45.0),
        (Model::AssociatedCone, 30.0, sinking(), 30.0),
        (Model::CoupledBox, 45.0, SQRT_2, 45.0),
        (Model::CoupledBox, 30.0, SQRT_2, 45.0),
        (Model::FrozenBox, 30.0, SQRT_2, 45.0),
        (POLYGON_4, 45.0, FRAC_1_SQRT_2, 45.0),
        (POLYGON_4, 30.0, 1.0, 0.0),
        (POLYGON_8, 22.5, eighth, 22.5),
        (POLYGON_8, 30.0, 1.0, 45.0),
    ] {
        let (found, points) = friction(model, degrees);
        assert!((found - size).abs() < 1e-6, "{model} at {degrees}°: {found}, not {size}");
        assert!((points - direction).abs() < 1e-3, "{model} at {degrees}°: {points}");
    }
}

#[test]
fn all_models_agree_on_a_slider_along_a_tangent() {
    for model in Model::ALL {
        let (size, direction) = friction(model, 0.0);
        let exact = if model == Model::AssociatedCone { sinking() } else { 1.0 };
        assert!((size - exact).abs() < 1e-6 && direction.abs() < 1e-3, "{model}: {size}");
    }
}

#[test]
fn under_the_disc_the_path_is_straight_and_as_long_as_energy_allows() {
    let speed = 3.0;
    let mut slider = simulation(slider(Model::CoulombCone, speed, 30.0));
    steps(&mut slider, 100);
    let end = slider.states()[1].pose.p;
    // Σ dt (v − k μ g dt) over the whole steps until it stops: v²/(2μg) except for the last part.
    let whole = (speed / (MU * G * DT)).floor();
    let exact = DT * (whole * speed - MU * G * DT * whole * (whole + 1.0) / 2.0);
    assert!((end - exact * along(30.0)).norm() < 1e-6, "{end}");
    assert_near(exact, speed * speed / (2.0 * MU * G), speed * DT);
    assert!(velocity(&slider).norm() < 1e-9);
}

#[test]
fn the_shipped_block_stops_where_geometry_says() {
    // In units of v²/(2μg), without the error of the step: with a box each axis stops separately;
    // with four directions x slows down until both speeds are equal, then both together at half the
    // rate.
    let (sin, cos) = 30f64.to_radians().sin_cos();
    let reach = 9.0 / (2.0 * MU * G);
    for (model, x, y) in [
        (Model::CoupledBox, cos * cos, sin * sin),
        (POLYGON_4, 1.0, 2.0 * sin * cos),
        (Model::CoulombCone, cos, sin),
    ] {
        let mut scene = scene("sliding", model);
        scene.step.dt = 0.0025;
        let mut block = simulation(scene);
        steps(&mut block, 400);
        let end = block.states()[1].pose.p;
        // Semi-implicit Euler falls short by v dt/2 along each leg of the path.
        let short = 2.0 * 3.0 * 0.0025 / 2.0;
        assert!((end.x - reach * x).abs() < short && (end.y - reach * y).abs() < short, "{end}");
        assert!(velocity(&block).norm() < 1e-6, "{model}");
    }
}

#[test]
fn a_ramp_holds_up_to_what_the_models_figure_reaches_uphill() {
    for (model, degrees, reach) in [
        (Model::CoulombCone, 0.0, 1.0),
        (Model::CoulombCone, 45.0, 1.0),
        (Model::AssociatedCone, 0.0, 1.0),
        (Model::AssociatedCone, 45.0, 1.0),
        (Model::CoupledBox, 0.0, 1.0),
        (Model::CoupledBox, 45.0, SQRT_2),
        (Model::FrozenBox, 0.0, 1.0),
        (Model::FrozenBox, 45.0, SQRT_2),
        (POLYGON_4, 0.0, 1.0),
        (POLYGON_4, 45.0, FRAC_1_SQRT_2),
        (POLYGON_8, 45.0, 1.0),
        (POLYGON_8, 22.5, (PI / 8.0).cos()),
    ] {
        let speed = |part: f64| {
            let mut ramp = simulation(point(model, (part * MU * reach).atan(), degrees));
            steps(&mut ramp, 150);
            velocity(&ramp).xy().norm()
        };
        let (below, above) = (speed(0.99), speed(1.01));
        assert!(below < 1e-9, "{model} at {degrees}°: slides with {below}");
        assert!(above > 1e-2, "{model} at {degrees}°: sticks with {above}");
    }
}

#[test]
fn what_slides_in_an_associated_cone_floats_at_h_mu_v_and_on_coulombs_not_at_all() {
    for (model, floats) in [(Model::AssociatedCone, 1.0), (Model::CoulombCone, 0.0)] {
        let mut slider = simulation(slider(model, 3.0, 30.0));
        for number in 1..=40 {
            slider.step().unwrap();
            let (height, speed) = (slider.states()[1].pose.p.z, velocity(&slider).xy().norm());
            let exact = floats * DT * MU * speed;
            assert!((height - exact).abs() < 1e-8, "{model}, step {number}: {height}");
        }
    }
}

#[test]
fn an_associated_cone_throws_up_what_it_finds_sliding_on_the_floor() {
    // From no gap w_n = μ |w_t| is a speed: x_n = m (g dt + μ v⁺), v⁺ = v − μ x_n/m.
    let mut scene = slider(Model::AssociatedCone, 3.0, 30.0);
    scene.states[1].pose.p.z = 0.0;
    let mut slider = simulation(scene);
    slider.step().unwrap();
    let after = (3.0 - MU * G * DT) / (1.0 + MU * MU);
    assert_near(velocity(&slider).xy().norm(), after, 1e-8);
    assert_near(velocity(&slider).z, MU * after, 1e-8);
}

#[test]
fn regularised_friction_creeps_at_the_load_over_its_damping_and_hard_friction_stays() {
    // Below μ N the penalty method's friction is d v: half the greatest load gives W/d (with d = 2
    // μ N/ε that is u = W ε/(2 μ N)).
    let slope = (0.5 * MU).atan();
    let mut soft = point(Model::CoupledBox, slope, 30.0);
    soft.step.scheme = Scheme::Penalty;
    soft.step.penalty.damping = 200.0; // settles within m/d = 10 ms
    let damping = soft.step.penalty.damping;
    let mut creeping = simulation(soft);
    steps(&mut creeping, 100);
    let load = 2.0 * G * slope.sin();
    assert!((velocity(&creeping).xy().norm() * damping / load - 1.0).abs() < 1e-6);
    for model in Model::ALL {
        if model == Model::FrozenBox {
            continue; // slips in its first step, and then stays: see the ramps
        }
        let mut hard = simulation(point(model, slope, 30.0));
        steps(&mut hard, 20);
        let moved = hard.states()[1].pose.p.norm();
        assert!(moved < 1e-11, "{model}: {moved}");
    }
}

#[test]
fn friction_takes_energy_out_and_leaves_momentum_alone_under_every_model() {
    let text = "[step]\ndt = 0.01\n[[bodies]]\nname = \"ice\"\nfixed = true\n\
                shape = { plane = [0, 0, 1] }\n\
                [[bodies]]\nname = \"plank\"\nshape = { box = [4, 4, 0.2] }\nmass = 3\n\
                position = [0, 0, 0.1]\nfriction = 0.5\n\
                [[bodies]]\nname = \"block\"\nshape = { box = [0.5, 0.5, 0.2] }\nmass = 1\n\
                position = [0, 0, 0.3]\nvelocity = [1.6, 1.0, 0]\nfriction = 0.5\n";
    for model in Model::ALL {
        let mut scene = Scene::from_toml("plank.toml", text).unwrap();
        scene.contact.model = model;
        let mut plank = simulation(scene);
        for step in steps(&mut plank, 30) {
            let p = step.motion.linear_momentum;
            assert!((p.x - 1.6).abs() < 1e-9 && (p.y - 1.0).abs() < 1e-9, "{model}: {p}");
            let ledger = step.ledger.unwrap();
            assert!(ledger.friction < 1e-9, "{model}: {ledger:?}");
            assert!(ledger.remainder().abs() < 1e-10, "{model}: {ledger:?}");
            assert!(step.laws.internal_impulse < 1e-12 && step.laws.attraction < 1e-12, "{model}");
        }
    }
}

/// Drake's "pizza saver", a plate that rotates on feet at a distance of 1.5 m: here four feet, at
/// 45° to the tangents or aligned with them. Returns its angular speed after a tenth of a second
/// under a torque.
fn turning(model: Model, torque: f64, turned: f64) -> f64 {
    let text = format!(
        "gravity = [0, 0, -10]\n[step]\ndt = 0.01\n[contact]\nfriction = {}\n\
         [[bodies]]\nname = \"floor\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n\
         [[bodies]]\nname = \"plate\"\nmass = 3\nrotation = {{ z = {turned} }}\n\
         position = [0, 0, 0.05]\nshape = {{ box = [{edge}, {edge}, 0.1] }}\n\
         [[constraints]]\nkind = \"motor_rotation\"\nbodies = [\"plate\"]\naxis = [0, 0, 1]\n\
         speed = 100\neffort = {torque}\n",
        2.0 / 3.0,
        edge = 1.5 * SQRT_2
    );
    let mut scene = Scene::from_toml("plate.toml", &text).unwrap();
    scene.contact.model = model;
    let mut plate = simulation(scene);
    steps(&mut plate, 10);
    plate.states()[1].omega.z
}

#[test]
fn a_plate_turns_on_its_feet_above_mu_m_g_r_and_off_the_tangents_above_what_a_polygon_reaches() {
    // μ m g R = 30 N m.
    for (model, turned, most) in [
        (Model::CoulombCone, 0.0, 30.0),
        (Model::CoulombCone, 45.0, 30.0),
        (Model::CoupledBox, 0.0, 30.0 * SQRT_2),
        (Model::CoupledBox, 45.0, 30.0),
        (POLYGON_4, 0.0, 30.0 * FRAC_1_SQRT_2),
        (POLYGON_4, 45.0, 30.0),
    ] {
        let (below, above) =
            (turning(model, 0.98 * most, turned), turning(model, 1.02 * most, turned));
        assert!(below.abs() < 1e-7, "{model}, {turned}°: turns with {below} rad/s");
        assert!(above > 1e-3, "{model}, {turned}°: does not turn, {above} rad/s");
    }
}

/// 25 balls of 1 kg on a box of 10 kg that is pushed with 150 N at 45° to the tangents.
fn pushed_box_with_balls() -> Scene {
    let mut text = String::from(
        "[step]\ndt = 0.01\n\
         [[bodies]]\nname = \"ground\"\nfixed = true\nshape = { plane = [0, 0, 1] }\nfriction = 0.4\n\
         [[bodies]]\nname = \"box\"\nmass = 10\nshape = { box = [2, 2, 0.4] }\n\
         position = [0, 0, 0.2]\nfriction = 0.4\n",
    );
    for k in 0..25 {
        let (x, y) = (0.4 * f64::from(k % 5) - 0.8, 0.4 * f64::from(k / 5) - 0.8);
        text += &format!(
            "[[bodies]]\nname = \"ball {k}\"\nmass = 1\nshape = {{ sphere = 0.1 }}\n\
             position = [{x}, {y}, 0.5]\nfriction = 1.6\n" // √(0.4 · 1.6) = 0.8 on the box
        );
    }
    text += "[[constraints]]\nkind = \"motor_translation\"\nbodies = [\"box\"]\naxis = [1, 1, 0]\n\
             speed = 100\neffort = 150\n";
    Scene::from_toml("balls.toml", &text).unwrap()
}

#[test]
fn a_box_pushed_with_more_than_friction_moves_under_coulombs_law_and_not_under_a_box_at_45_degrees()
{
    // SimBenchmark's "rolling": friction holds 0.4 · 35 g = 137.34 N, the box model √2 times that.
    // A ball that rolls on a surface with the acceleration a follows with 2a/7.
    let a = (150.0 - 0.4 * 35.0 * G) / (10.0 + 25.0 * 2.0 / 7.0);
    for (model, a) in [(Model::CoulombCone, a), (Model::CoupledBox, 0.0)] {
        let mut scene = pushed_box_with_balls();
        scene.contact.model = model;
        let mut pushed = simulation(scene);
        steps(&mut pushed, 5);
        let speed = |body: usize| pushed.states()[body].v.dot(&along(45.0));
        assert!((speed(1) - 0.05 * a).abs() < 1e-5, "{model}: {}", speed(1));
        for ball in 2..27 {
            assert!((speed(ball) - 0.05 * a * 2.0 / 7.0).abs() < 1e-5, "{model}");
        }
    }
}

#[test]
fn in_a_cone_friction_never_reaches_out_of_it() {
    for model in [Model::AssociatedCone, Model::CoulombCone, POLYGON_4, POLYGON_8] {
        let mut block = simulation(scene("sliding", model));
        for step in steps(&mut block, 80) {
            assert!(step.laws.cone_excess < 1e-6, "{model}: {:?}", step.laws);
        }
    }
}

#[test]
fn answers_are_judged_by_the_problem_that_was_posed() {
    let demand = Demand { tolerance: 1e-8, prove_up_to: 0 };
    for model in Model::ALL {
        let mut block = simulation(scene("sliding", model));
        for step in steps(&mut block, 80) {
            for solve in &step.solves {
                assert_eq!(solve.solution.status, Status::Solved, "{model} by {}", solve.solver);
                assert!(solve.judged(&demand).verdict.is_solution(), "{model}");
                let rubs = solve.problem.lcp.coupling().is_some_and(|c| !c.is_empty());
                assert_eq!(solve.posing.is_some(), rubs && model != Model::CoupledBox);
                if step.number == 1 && model != Model::CoupledBox {
                    // It slides at an angle to the tangents: no other model's answer solves the
                    // coupled box.
                    let boxed = judge(&solve.problem.lcp, &solve.solution.x, &demand);
                    assert!(!boxed.verdict.is_solution(), "{model}");
                }
            }
        }
    }
}

#[test]
fn a_model_is_solved_by_a_solver_that_takes_it_and_named() {
    for (model, solver) in [
        (Model::FrozenBox, "dantzig"),
        (Model::CoupledBox, "dantzig"),
        (POLYGON_8, "lemke"),
        (Model::AssociatedCone, "apgd"),
        (Model::CoulombCone, "apgd"),
    ] {
        let step = simulation(scene("sliding", model)).step().unwrap();
        assert_eq!(step.solves[0].solver, solver, "{model}");
    }
    let sweeps = Registry::standard()
        .cone_entries()
        .find(|cone| cone.name == "cone-pgs")
        .unwrap()
        .build(&Settings::default().with_max_iterations(100_000));
    let mut block = simulation(scene("sliding", Model::CoulombCone)).with_cone_solver(sweeps);
    let mut same = simulation(scene("sliding", Model::CoulombCone));
    for _ in 0..30 {
        let step = block.step().unwrap();
        assert_eq!(step.solves[0].solver, "cone-pgs");
        same.step().unwrap();
        assert!((velocity(&block) - velocity(&same)).norm() < 1e-6);
    }
}

#[test]
fn at_acceleration_level_the_models_rub_alike() {
    for (model, size, direction) in [
        (Model::CoupledBox, SQRT_2, 45.0),
        (Model::FrozenBox, SQRT_2, 45.0),
        (POLYGON_4, 1.0, 0.0),
        (Model::CoulombCone, 1.0, 30.0),
    ] {
        let mut scene = slider(model, 5.0, 30.0);
        scene.step.scheme = Scheme::Acceleration;
        let mut slider = simulation(scene);
        steps(&mut slider, 2);
        let before = velocity(&slider);
        slider.step().unwrap();
        let lost = (before - velocity(&slider)) / (MU * G * DT);
        assert!((lost.xy().norm() - size).abs() < 1e-6, "{model}: {lost}");
        assert!((lost.y.atan2(lost.x).to_degrees() - direction).abs() < 1e-3, "{model}");
    }
}

#[test]
fn a_model_that_a_scheme_cannot_pose_is_refused() {
    let refused = |scheme: Scheme, model: Model, change: &dyn Fn(&mut Scene)| {
        let mut scene = scene("sliding", model);
        scene.step.scheme = scheme;
        change(&mut scene);
        scene.validate().map_err(|error| error.to_string()).err()
    };
    let plain: &dyn Fn(&mut Scene) = &|_| {};
    for scheme in Scheme::ALL {
        for model in Model::ALL {
            let able = model == Model::CoupledBox
                || scheme.solves_lcps()
                    && (scheme, model) != (Scheme::Acceleration, Model::AssociatedCone);
            let message = refused(scheme, model, plain);
            assert_eq!(message.is_none(), able, "{scheme:?}, {model}: {message:?}");
            assert!(message.is_none_or(|text| text.contains("contact.model: ")));
        }
    }
    let substituted: &dyn Fn(&mut Scene) = &|scene| scene.contact.sliding = Sliding::Substituted;
    let forgetful: &dyn Fn(&mut Scene) = &|scene| scene.contact.persistence = Persistence::None;
    assert!(refused(Scheme::Acceleration, Model::CoulombCone, substituted).is_some());
    assert!(refused(Scheme::Acceleration, POLYGON_8, substituted).is_none());
    assert!(refused(Scheme::Velocity, Model::FrozenBox, forgetful).is_some());
    let six = refused(Scheme::Velocity, Model::Polyhedral { directions: 6 }, plain).unwrap();
    assert!(six.contains("contact.model: polygon-6: directions: must be a multiple of 4"), "{six}");
}

#[test]
fn a_model_is_a_word_in_the_scene_file() {
    for (text, model) in [
        ("model = \"frozen-box\"", Model::FrozenBox),
        ("model = \"polygon-16\"", Model::Polyhedral { directions: 16 }),
        ("model = \"associated-cone\"", Model::AssociatedCone),
        ("model = \"coulomb-cone\"", Model::CoulombCone),
        ("", Model::CoupledBox),
    ] {
        let scene = Scene::from_toml("word.toml", &format!("[contact]\n{text}")).unwrap();
        assert_eq!(scene.contact.model, model);
    }
}
