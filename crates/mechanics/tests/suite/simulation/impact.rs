//! Bodies that hit the ground.

use lcplab_mechanics::formulation::Stage;
use lcplab_mechanics::scene::{Scene, Scheme};
use lcplab_mechanics::simulation::{LostBounces, Simulation, Warnings};
use lcplab_solver as solver;
use nalgebra::{UnitQuaternion, Vector3};

use super::{assert_near, bullet, simulation};

fn drop_from(height: f64, restitution: f64, dt: f64, level: Scheme) -> Scene {
    let text = format!(
        "[step]\ndt = {dt}\nscheme = \"{}\"\n[contact]\nrestitution = {restitution}\n\
         [[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n\
         [[bodies]]\nname = \"ball\"\nshape = {{ sphere = 0.5 }}\nmass = 2\nposition = [0, 0, {}]\n",
        level.name(),
        0.5 + height
    );
    Scene::from_toml("drop.toml", &text).unwrap()
}

#[test]
fn a_speculative_contact_closes_its_gap_and_no_more() {
    // 0.03 m at 5 m/s: within a step of 0.01 s the ball may only reach the ground.
    let mut scene = drop_from(0.03, 0.0, 0.01, Scheme::Velocity);
    scene.states[1].v.z = -5.0;
    let mut ball = simulation(scene);
    ball.step().unwrap();
    assert_near(ball.states()[1].pose.p.z, 0.5, 1e-14);
    ball.step().unwrap();
    assert_near(ball.states()[1].pose.p.z, 0.5, 1e-14);
    assert_near(ball.states()[1].v.z, 0.0, 1e-13);
}

#[test]
fn a_ball_bounces_to_e_squared_of_its_height() {
    let (height, e) = (1.0, 0.8);
    for level in Scheme::LEVELS {
        let error = |dt: f64| {
            let mut ball = simulation(drop_from(height, e, dt, level));
            let mut bounced = false;
            let mut top = 0.0f64;
            for _ in 0..(0.9 / dt) as usize {
                let step = ball.step().unwrap();
                bounced |=
                    step.solves.iter().any(|solve| solve.problem.stage == Stage::Restitution);
                if bounced {
                    top = top.max(ball.states()[1].pose.p.z - 0.5);
                }
            }
            (top - e * e * height).abs()
        };
        // The impact is found to within a step, so the height is first order in dt.
        assert!(error(1e-3) < 0.02, "{}", error(1e-3));
        assert!(error(1e-4) < 0.002, "{}", error(1e-4));
    }
}

#[test]
fn restitution_reverses_exactly_e_of_the_approach() {
    // Touching at −3 m/s without gravity: +0.5 · 3 m/s after the step, in both schemes.
    for level in Scheme::LEVELS {
        let mut scene = drop_from(0.0, 0.5, 0.01, level);
        scene.gravity.z = 0.0;
        scene.states[1].v.z = -3.0;
        let mut ball = simulation(scene);
        ball.step().unwrap();
        assert_near(ball.states()[1].v.z, 1.5, 1e-14);
    }
}

#[test]
fn slow_approach_does_not_bounce() {
    let mut scene = drop_from(0.0, 0.5, 0.01, Scheme::Velocity);
    scene.gravity.z = 0.0;
    scene.states[1].v.z = -0.09; // below bounce_speed = 0.1 m/s
    let mut ball = simulation(scene);
    ball.step().unwrap();
    assert_eq!(ball.states()[1].v.z, 0.0);
}

#[test]
fn an_approach_at_exactly_the_threshold_bounces_and_a_slower_one_does_not() {
    let schemes = [Scheme::Velocity, Scheme::Acceleration, Scheme::Soft, Scheme::Xpbd];
    for scheme in schemes.into_iter().chain([Scheme::SplitImpulse, Scheme::SequentialImpulses]) {
        // It touches, or it closes a gap within the third step.
        for (height, speed) in [0.0, 0.0125].iter().flat_map(|h| [(*h, 0.5), (*h, 0.499)]) {
            let mut scene = drop_from(height, 1.0, 0.01, scheme);
            scene.gravity.z = 0.0;
            scene.states[1].v.z = -speed;
            scene.contact.bounce_speed = 0.5;
            let mut warnings = Warnings::default();
            let mut ball = simulation(scene.clone());
            for _ in 0..6 {
                warnings.add(&scene, &ball.step().unwrap());
            }
            let after = if speed == 0.5 { speed } else { 0.0 };
            let what = format!("{scheme:?}, {height} m, {speed} m/s: {:?}", warnings.texts());
            assert!((ball.states()[1].v.z - after).abs() < 1e-9, "{what}");
            assert!(warnings.as_slice().is_empty(), "{what}");
        }
    }
}

/// What is said of lost bounces after a number of steps.
fn lost(scene: &Scene, steps: usize) -> Option<String> {
    let (mut running, mut lost) = (simulation(scene.clone()), LostBounces::default());
    (0..steps).for_each(|_| lost.add(scene, &running.step().unwrap()));
    lost.in_words(scene)
}

#[test]
fn an_impact_that_loses_its_bounce_is_named() {
    let schemes = [Scheme::Velocity, Scheme::Acceleration, Scheme::Soft, Scheme::Xpbd];
    for scheme in schemes.into_iter().chain([Scheme::SplitImpulse, Scheme::SequentialImpulses]) {
        // It closes 0.0225 m at 0.9 m/s within the third step.
        let mut scene = drop_from(0.0225, 0.8, 0.01, scheme);
        scene.gravity.z = 0.0;
        scene.states[1].v.z = -0.9;
        scene.contact.bounce_speed = 1.0;
        let words = "restitution 0.8 was not applied to an impact below contact.bounce_speed = 1 m/s; \
                     it had 0.9 m/s (\"ball\" on \"ground\", step 3)";
        assert_eq!(lost(&scene, 20).as_deref(), Some(words), "{scheme:?}");
        scene.contact.bounce_speed = 0.9;
        assert_eq!(lost(&scene, 20), None, "{scheme:?}: it bounces");
    }
}

#[test]
fn a_rest_and_the_last_bounces_before_it_lose_nothing() {
    for scheme in Scheme::ALL {
        for (height, e, dt) in [(0.0, 0.8, 0.01), (0.3, 0.5, 0.001), (0.3, 0.5, 0.01)] {
            let scene = drop_from(height, e, dt, scheme);
            assert_eq!(lost(&scene, (1.0 / dt) as usize), None, "{scheme:?}, {height} m, {dt} s");
        }
        let mut scene = drop_from(0.01, 0.0, 0.001, scheme);
        scene.contact.bounce_speed = 1.0;
        assert_eq!(lost(&scene, 100), None, "{scheme:?}: without restitution");
    }
}

#[test]
fn every_scheme_that_bounces_gives_back_e_of_the_approach_wherever_in_a_step_it_hits() {
    let schemes = [Scheme::Velocity, Scheme::Acceleration, Scheme::Soft];
    for scheme in schemes.into_iter().chain([Scheme::Xpbd, Scheme::SequentialImpulses]) {
        for (e, dt) in [(0.5, 0.01), (1.0, 0.004), (0.8, 1.0 / 60.0)] {
            for k in 0..6 {
                let mut ball = simulation(drop_from(0.5 + 0.037 * f64::from(k), e, dt, scheme));
                let (mut down, mut up) = (0.0f64, 0.0f64);
                for _ in 0..(0.55 / dt) as usize {
                    let speed = ball.step().unwrap().states[1].v.z;
                    (down, up) = (down.max(-speed), up.max(speed));
                }
                // Gravity acts for a step or two between the two speeds.
                let slack = 2.0 * 9.81 * dt;
                assert!((up - e * down).abs() < slack, "{scheme:?} e {e} dt {dt} {k}: {up} {down}");
            }
        }
    }
}

#[test]
fn a_box_that_is_hit_at_a_corner_leaves_with_the_velocity_of_newtons_impulse() {
    // Without gravity and friction: P = (1 + e) v/(1/m + (r×n)·I⁻¹(r×n)) along n = z at the corner
    // r from the center. A step of 10 ms turns the box by up to 0.2 rad after the impact.
    let cases = [
        ([0.3, 0.5, 0.2], [0.5, -0.3, 0.2], 0.5, 3.0, 0.0),
        ([0.6, 0.2, 0.4], [-0.4, 0.6, 0.0], 0.8, 2.0, 0.013),
        ([0.4, 0.4, 0.6], [0.3, 0.5, 1.0], 1.0, 4.0, 0.002),
        ([0.2, 0.5, 0.5], [0.7, 0.2, -0.5], 0.2, 1.5, 0.007),
    ];
    for (scheme, near) in [
        (Scheme::Velocity, 1e-6),
        (Scheme::Acceleration, 1e-6),
        (Scheme::Xpbd, 0.02),
        (Scheme::Soft, 0.02),
    ] {
        for (edges, turn, e, speed, gap) in cases {
            let q = UnitQuaternion::from_scaled_axis(Vector3::from(turn));
            let half = Vector3::from(edges) / 2.0;
            let corners = (0..8).map(|k| {
                let sign = |bit: usize| if k >> bit & 1 == 1 { 1.0_f64 } else { -1.0 };
                q * half.component_mul(&Vector3::new(sign(0), sign(1), sign(2)))
            });
            let arm = corners.min_by(|a, b| a.z.total_cmp(&b.z)).unwrap();
            let (mass, squares) = (2.0, Vector3::from(edges).map(|edge| edge * edge));
            let moments = (Vector3::from_element(squares.sum()) - squares) * (mass / 12.0);
            let lever = q.inverse() * arm.cross(&Vector3::z());
            let turns = lever.component_div(&moments);
            let impulse = (1.0 + e) * speed / (1.0 / mass + lever.dot(&turns));
            let text = format!(
                "gravity = [0, 0, 0]\ncontact.restitution = {e}\n[step]\ndt = 0.01\nscheme = {:?}\n\
                 [[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n\
                 [[bodies]]\nname = \"box\"\nmass = {mass}\nshape = {{ box = {edges:?} }}\n\
                 position = [0, 0, {}]\nvelocity = [0, 0, -{speed}]\n\
                 rotation = {{ quaternion = [{}, {}, {}, {}] }}\n",
                scheme.name(),
                gap - arm.z,
                q.w,
                q.i,
                q.j,
                q.k
            );
            let mut falling = simulation(Scene::from_toml("corner.toml", &text).unwrap());
            while falling.states()[1].v.z <= -speed {
                falling.step().unwrap();
            }
            let state = falling.states()[1];
            let error = (state.v.z - (impulse / mass - speed)).abs() / speed;
            assert!(error < near, "{scheme:?}, {edges:?}: {} of {impulse}, {error:e}", state.v.z);
        }
    }
}

/// A box that falls flat with a small rotation: its corners arrive at different speeds, and four of
/// them can share the impact in many ways.
#[test]
fn what_bounces_does_not_depend_on_how_a_solver_shares_the_impulse() {
    let text = "
        [step]
        dt = 0.01
        [contact]
        restitution = 0.5
        [[bodies]]
        name = \"ground\"
        fixed = true
        shape = { plane = [0, 0, 1] }
        [[bodies]]
        name = \"box\"
        shape = { box = [1, 2, 0.4] }
        mass = 2
        position = [0, 0, 0.2]
        velocity = [0, 0, -2]
        angular_velocity = [0.3, 0.5, 0]
    ";
    let scene = Scene::from_toml("flat.toml", text).unwrap();
    let after = |solver: &str| {
        let solver =
            solver::Registry::standard().entry(solver).unwrap().build(&solver::Options::default());
        let mut flat = Simulation::new(scene.clone(), solver);
        flat.step().unwrap().states[1].velocity()
    };
    let dantzig = after("dantzig");
    // v − 2 at each corner, at (±½, ±1): 1.5 times that speed back, by Newton's law for each.
    assert_near(dantzig[2], 1.0, 1e-7);
    for other in ["pgs", "block-pivoting", "lemke", "enumeration"] {
        assert!((after(other) - dantzig).norm() < 1e-6, "{other}: {} {dantzig}", after(other));
    }
}

#[test]
fn a_bullet_that_goes_through_a_wall_in_one_step_is_named() {
    let mut scene = bullet();
    let passed = |scene: &Scene| -> Vec<[usize; 2]> {
        let step = simulation(scene.clone()).step().unwrap();
        step.interpenetrations.iter().map(|own| own.bodies).collect()
    };
    // The margin depends on the speed and finds the wall in time.
    assert!(passed(&scene).is_empty());
    scene.contact.margin = Some(0.05);
    assert_eq!(passed(&scene), [[1, 0]]);
    // Next to the wall there is nothing to pass through.
    scene.states[1].pose.p.y = 1.5;
    assert!(passed(&scene).is_empty());
}

#[test]
fn two_balls_with_one_centre_are_a_penetration_of_both_radii() {
    let text = "
        gravity = [0, 0, 0]
        step.scheme = \"split-impulse\"
        step.baumgarte = 0.2
        bodies = [
            { name = \"a\", shape = { sphere = 0.5 }, mass = 1 },
            { name = \"b\", shape = { sphere = 0.25 }, mass = 1 },
        ]
    ";
    let mut balls = simulation(Scene::from_toml("one.toml", text).unwrap());
    assert_near(balls.motion().penetration, 0.75, 1e-12);
    for _ in 0..50 {
        balls.step().unwrap();
    }
    let [a, b] = [0, 1].map(|k| balls.states()[k].pose.p);
    assert!((a - b).norm() > 0.7, "{a} {b}");
}
