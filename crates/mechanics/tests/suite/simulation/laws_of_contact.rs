//! The reports of a step on friction and impacts, compared with closed forms.

use lcplab_lcp::friction::Model;
use lcplab_mechanics::scene::{Scene, Scheme};
use lcplab_mechanics::simulation::{Impact, Impacts, Simulation, Slips, Step};
use nalgebra::{UnitQuaternion, Vector3};

use super::{assert_near, simulation};

const SCHEMES: [Scheme; 4] =
    [Scheme::Velocity, Scheme::SplitImpulse, Scheme::GaussSeidel, Scheme::SequentialImpulses];

/// A bar in a right-angled groove with μ = 0.5, which Coulomb's cone holds up to 35.26 degrees.
fn groove(angle: f64, scheme: Scheme) -> Scene {
    let text = format!(
        "tilt = {{ y = {angle} }}\ncontact.friction = 0.5\n[step]\nscheme = \"{}\"\n\
         [[bodies]]\nname = \"left\"\nfixed = true\nshape = {{ plane = [0, 1, 1] }}\n\
         [[bodies]]\nname = \"right\"\nfixed = true\nshape = {{ plane = [0, -1, 1] }}\n\
         [[bodies]]\nname = \"bar\"\nmass = 3\nshape = {{ box = [0.6, 0.2, 0.2] }}\n\
         position = [0, 0, 0.14142135623730951]\nrotation = {{ x = 45 }}\n",
        scheme.name()
    );
    Scene::from_toml("groove.toml", &text).unwrap()
}

/// Two billiard balls without friction, e = 1; the first one hits the second off-center.
fn billiards(scheme: Scheme) -> Scene {
    let text = format!(
        "gravity = [0, 0, 0]\ncontact.restitution = 1\n[step]\nscheme = \"{}\"\n[[bodies]]\n\
         name = \"a\"\nmass = 1\nshape = {{ sphere = 0.5 }}\nvelocity = [3, 0, 0]\n[[bodies]]\n\
         name = \"b\"\nmass = 1\nshape = {{ sphere = 0.5 }}\nposition = [2.3, 0.6, 0]\n",
        scheme.name()
    );
    Scene::from_toml("billiards.toml", &text).unwrap()
}

/// Takes this number of steps, passing each with the scene to `show`.
fn run(scene: Scene, steps: usize, mut show: impl FnMut(&Scene, &Step)) -> Simulation {
    let mut running = simulation(scene.clone());
    for _ in 0..steps {
        show(&scene, &running.step().unwrap());
    }
    running
}

/// The largest angle between friction and the direction opposite to sliding; 0 if nothing slides.
fn angle(slips: &Slips) -> f64 {
    slips.friction_angle.and_then(|slip| slip.angle).unwrap_or(0.0)
}

fn slips(scene: &Scene, steps: usize) -> (Slips, Simulation) {
    let mut slips = Slips::default();
    let running = run(scene.clone(), steps, |_, step| slips.add(step));
    (slips, running)
}

/// g (sin α − √2 μ cos α) (m/s²), the acceleration of the bar under Coulomb's cone; below 0 it
/// rests.
fn due(angle: f64) -> f64 {
    let (sin, cos) = angle.to_radians().sin_cos();
    9.81 * (sin - std::f64::consts::SQRT_2 * 0.5 * cos)
}

#[test]
fn a_bar_that_slides_where_the_cone_holds_it_tells_the_error_of_its_speed() {
    // At 34 degrees it may rest: friction across the groove takes load from the faces, and so
    // friction along it is too weak. All the speed of the bar is an error, and friction at its
    // limit would reduce it even further: −due t.
    for scheme in [Scheme::Soft, Scheme::SequentialImpulses] {
        let scene = groove(34.0, scheme);
        let (slips, running) = slips(&scene, 100);
        let speed = running.states()[2].v.x;
        assert!(speed > 1.0, "{scheme:?}: {speed}");
        let (body, error) = slips.speed_error(&scene).unwrap();
        assert_eq!(body, 2);
        // Below the resting speed, 2 g dt = 0.196 m/s, contacts count as sticking: they are
        // measured only by the cone, for up to 0.15 s at 1.3 m/s², in which the error grows by 1.9
        // m/s².
        assert_near(error, speed - due(34.0), 0.3);
        let worst = slips.friction_angle.unwrap();
        assert_eq!(worst.bodies[0], 2);
        // Both tangents at their limits, in nearly all contacts.
        assert_near(worst.angle.unwrap().to_degrees(), 45.0, 0.5);
    }
}

/// The cone |x_t| ≤ μ x_n is its own dual only with a separation: the nearest point of it to
/// (g dt, −v) has x_n = (g dt + μ v)/(1 + μ²), which is more than gravity's g dt.
#[test]
fn a_point_that_slides_separates_under_an_associated_cone_and_under_no_other_model() {
    let (v, mu, push) = (2.0, 0.3, 9.81 * 0.01);
    let text = "contact.friction = 0.3\n[[bodies]]\nname = \"ground\"\nfixed = true\n\
                shape = { plane = [0, 0, 1] }\n[[bodies]]\nname = \"point\"\nshape = \"point\"\n\
                mass = 2\nvelocity = [1.2, 1.6, 0]\n";
    for model in Model::ALL {
        let mut scene = Scene::from_toml("point.toml", text).unwrap();
        (scene.contact.model, scene.solver.tolerance) = (model, 1e-10);
        let (slips, _) = slips(&scene, 20);
        let separation = slips.separation.map_or(0.0, |slip| slip.separation);
        match model {
            Model::AssociatedCone => {
                assert_near(separation, mu * (v - mu * push) / (1.0 + mu * mu), 1e-6);
                assert_eq!(slips.notable_separation(&scene).unwrap().bodies[0], 1);
            }
            _ => {
                assert!(separation < 1e-6, "{model}: {separation}");
                assert!(slips.notable_separation(&scene).is_none());
            }
        }
    }
}

#[test]
fn a_bar_that_rests_where_the_cone_holds_it_tells_nothing() {
    // Its four contacts per face share the load arbitrarily; their sum is within the cone.
    let scene = groove(34.0, Scheme::Velocity);
    let (slips, _) = slips(&scene, 50);
    assert!(slips.cone_excess.is_none_or(|slip| slip.excess < 1e-6), "{slips:?}");
    assert!(angle(&slips) < 1e-6 && slips.speed_error(&scene).is_none(), "{slips:?}");
}

#[test]
fn a_bar_that_slides_under_the_box_as_the_cone_has_it_tells_nothing() {
    // Above 35.26 degrees. The box would allow it to rest, too: a bar clamped into the groove by μ
    // x_n across it is held up to arctan(√2 μ/(1 − μ)) = 54.7 degrees. This one is not clamped.
    let scene = groove(40.0, Scheme::Velocity);
    let (slips, running) = slips(&scene, 100);
    assert_near(running.states()[2].v.x, due(40.0), 1e-9);
    assert!(angle(&slips) < 1e-6, "{slips:?}");
    assert!(slips.speed_error(&scene).is_none(), "{slips:?}");
}

#[test]
fn cones_miss_nothing_of_coulombs_law() {
    for degrees in [35.0, 36.0] {
        let mut scene = groove(degrees, Scheme::Velocity);
        scene.contact.model = Model::CoulombCone;
        let (slips, _) = slips(&scene, 50);
        assert!(angle(&slips) < 1e-3, "{degrees}: {slips:?}");
        assert!(slips.cone_excess.is_none_or(|slip| slip.excess < 1e-3), "{degrees}: {slips:?}");
        assert!(slips.speed_error(&scene).is_none(), "{degrees}: {slips:?}");
    }
}

/// A point of 2 kg on a floor, pulled along it at an angle (degrees) by a part of μ m g, μ = 0.5.
fn pulled(model: Model, scheme: Scheme, part: f64, degrees: f64) -> Scene {
    let text = "contact.friction = 0.5\n[[bodies]]\nname = \"floor\"\nfixed = true\n\
                shape = { plane = [0, 0, 1] }\n[[bodies]]\nname = \"point\"\nshape = \"point\"\n\
                mass = 2\n";
    let mut scene = Scene::from_toml("pulled.toml", text).unwrap();
    (scene.contact.model, scene.step.scheme) = (model, scheme);
    let (sin, cos) = degrees.to_radians().sin_cos();
    scene.bodies[1].force = part * 0.5 * 2.0 * 9.81 * Vector3::new(cos, sin, 0.0);
    scene
}

#[test]
fn a_polygon_that_holds_less_than_the_cone_between_its_corners_lets_a_body_creep() {
    // At 22.5° to its corners, friction reaches cos 22.5° = 0.924 of μ m g in the direction of the
    // pull. The point accelerates by a = μ g (0.97 − 0.924): a dt k in step k, far below the 0.196
    // m/s from which on contacts count as sliding.
    let polygon = Model::Polyhedral { directions: 8 };
    let scene = pulled(polygon, Scheme::Velocity, 0.97, 22.5);
    let (slips, _) = slips(&scene, 60);
    let creep = slips.notable_creep(&scene).unwrap();
    let reach = 22.5_f64.to_radians().cos();
    assert_eq!(creep.bodies, [1, 0]);
    assert_near(creep.strength(), reach, 1e-6);
    let way = 0.5 * 9.81 * (0.97 - reach) * 1e-4 * (60.0 * 61.0 / 2.0);
    assert_near(creep.path.norm(), way, 1e-6);
    assert_near(creep.path.y.atan2(creep.path.x).to_degrees(), 22.5, 1e-3);
}

#[test]
fn regularized_friction_lets_a_body_creep_with_the_force_of_its_pull() {
    // The damper of 200 N s/m slips at 4.9 N/(200 N s/m) = 0.0245 m/s.
    let mut scene = pulled(Model::CoupledBox, Scheme::Penalty, 0.5, 0.0);
    scene.step.penalty.damping = 200.0;
    let (slips, _) = slips(&scene, 100);
    let creep = slips.notable_creep(&scene).unwrap();
    assert_near(creep.path.norm(), 0.0245, 0.001);
    assert_near(creep.strength(), 0.5, 0.02);
}

#[test]
fn what_rests_or_comes_to_rest_as_the_cone_has_it_does_not_creep() {
    let polygon = Model::Polyhedral { directions: 8 };
    let models = [Model::CoulombCone, Model::CoupledBox, polygon];
    let held = models.map(|model| pulled(model, Scheme::Velocity, 0.9, 22.5));
    let schemes = [Scheme::Velocity, Scheme::Acceleration, Scheme::SplitImpulse, Scheme::Xpbd];
    let schemes = schemes.into_iter().chain([Scheme::Soft, Scheme::SequentialImpulses]);
    let stopped = schemes.map(|scheme| {
        let mut scene = pulled(Model::CoupledBox, scheme, 0.5, 0.0);
        scene.states[1].v.x = 0.5;
        scene
    });
    for scene in held.into_iter().chain(stopped) {
        let (slips, _) = slips(&scene, 100);
        let name = (scene.step.scheme, scene.contact.model);
        assert_eq!(slips.notable_creep(&scene), None, "{name:?}");
    }
}

#[test]
fn a_bounce_across_a_gap_names_the_pair_and_by_how_much_its_velocity_is_off() {
    // At the impact the line between their centers has the sine 0.6: they separate at a right
    // angle.
    let exact = Vector3::new(3.0 * 0.64, 3.0 * 0.48, 0.0);
    for scheme in SCHEMES {
        for dt in [0.01, 0.004] {
            let mut scene = billiards(scheme);
            scene.step.dt = dt;
            let mut found = Vec::new();
            let steps = (1.0 / dt).round() as usize;
            let running = run(scene, steps, |_, step| found.extend(step.unlocated.clone()));
            let off = (running.states()[1].v - exact).norm();
            let [own] = found[..] else { panic!("{scheme:?}: {found:?}") };
            assert_eq!(own.bodies, [0, 1]);
            assert!(own.gap > 0.0 && own.gap < 3.0 * dt, "{own:?}");
            assert_near(own.speed, off, 1e-6);
        }
    }
}

#[test]
fn a_bounce_that_is_located_or_straight_is_no_error() {
    let mut straight = billiards(Scheme::Velocity);
    straight.states[1].pose.p.y = 0.0;
    for scene in [billiards(Scheme::Acceleration), straight] {
        let name = scene.step.scheme;
        run(scene, 100, |_, step| assert!(step.unlocated.is_empty(), "{name:?}"));
    }
}

/// A ball that falls to the ground with this restitution.
fn falling(restitution: f64, scheme: Scheme) -> Scene {
    let text = format!(
        "gravity = [0, 0, 0]\ncontact.restitution = {restitution}\n[step]\nscheme = \"{}\"\n\
         [[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n\
         [[bodies]]\nname = \"ball\"\nmass = 1\nshape = {{ sphere = 0.1 }}\n\
         position = [0, 0, 0.135]\nvelocity = [0, 0, -2]\n",
        scheme.name()
    );
    Scene::from_toml("falling.toml", &text).unwrap()
}

fn impacts(scene: Scene, steps: usize) -> (Vec<Impact>, Simulation) {
    let (mut impacts, mut found) = (Impacts::default(), Vec::new());
    let running = run(scene, steps, |scene, step| found.extend(impacts.add(scene, step)));
    (found, running)
}

#[test]
fn an_impact_shows_the_restitution_that_its_speeds_have() {
    for scheme in Scheme::ALL {
        let (found, running) = impacts(falling(0.5, scheme), 30);
        let [impact] = found[..] else { panic!("{scheme:?}: {found:?}") };
        let parting = running.states()[1].v.z;
        assert_near(impact.approach, 2.0, 1e-9);
        assert_near(impact.parting, parting, 1e-9);
        assert_near(impact.error(), (parting - 1.0) / 2.0, 1e-9);
        match scheme {
            Scheme::Penalty => assert!(impact.error().abs() > 0.05, "{impact:?}"), // damping decides
            _ => assert_near(impact.error(), 0.0, 1e-6),
        }
    }
}

#[test]
fn a_box_that_lands_flat_bounces_straight() {
    for scheme in Scheme::ALL {
        let text = format!(
            "gravity = [0, 0, 0]\ncontact.restitution = 0.6\n[step]\nscheme = \"{}\"\n[[bodies]]\n\
             name = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n[[bodies]]\n\
             name = \"box\"\nmass = 1\nshape = {{ box = [0.4, 0.4, 0.2] }}\n\
             position = [0, 0, 0.14]\nvelocity = [0, 0, -2]\n",
            scheme.name()
        );
        let scene = Scene::from_toml("flat.toml", &text).unwrap();
        let running = run(scene, 20, |_, _| ());
        let state = running.states()[1];
        assert!(state.omega.norm() < 1e-6, "{scheme:?}: {}", state.omega);
        if scheme != Scheme::Penalty {
            assert_near(state.v.z, 1.2, 1e-6);
        }
    }
}

/// The gap is a whole number of substeps' distances: after the last substep the corners are within
/// 10⁻¹⁷ m of a plane in any orientation, some above it and some below.
#[test]
fn a_box_that_lands_flat_exactly_at_the_end_of_a_substep_bounces_straight() {
    let speed = 2.5;
    for scheme in [Scheme::Velocity, Scheme::Acceleration, Scheme::Soft, Scheme::Xpbd] {
        for (k, ways) in [12.0, 13.0, 3.0, 8.0, 21.0].into_iter().enumerate() {
            let turn = UnitQuaternion::from_euler_angles(0.3 + k as f64, -0.7, 1.1 * k as f64);
            let normal = turn * Vector3::z();
            let mut scene = Scene::from_toml(
                "flat.toml",
                "gravity = [0, 0, 0]\ncontact.restitution = 0.4\nstep.dt = 0.008\n[[bodies]]\n\
                 name = \"ground\"\nfixed = true\nshape = { plane = [0, 0, 1] }\n[[bodies]]\n\
                 name = \"box\"\nmass = 4\nshape = { box = [0.5, 0.3, 0.2] }\n",
            )
            .unwrap();
            scene.step.scheme = scheme;
            scene.states[0].pose.q = turn * scene.states[0].pose.q;
            scene.states[1].pose.q = turn;
            scene.states[1].pose.p = (0.1 + ways * 0.001 * speed) * normal;
            scene.states[1].v = -speed * normal;
            let box_ = run(scene, 12, |_, _| ()).states()[1];
            assert!(box_.omega.norm() < 1e-6, "{scheme:?}, {ways}: {}", box_.omega);
            assert!(
                (box_.v - 0.4 * speed * normal).norm() < 1e-6,
                "{scheme:?}, {ways}: {}",
                box_.v
            );
        }
    }
}

#[test]
fn friction_in_a_blow_is_mu_times_all_of_its_impulse() {
    // μ (1 + e) v_n = 0.3 m/s, and 5/2 of it over r is the spin.
    for scheme in Scheme::ALL.into_iter().filter(|scheme| *scheme != Scheme::Penalty) {
        let mut scene = falling(0.5, scheme);
        scene.bodies.iter_mut().for_each(|body| body.friction = 0.1);
        scene.states[1].v.x = 3.0;
        let running = run(scene, 20, |_, _| ());
        let state = running.states()[1];
        assert_near(state.v.x, 2.7, 1e-6);
        assert_near(state.omega.y, 7.5, 1e-6);
    }
}

#[test]
fn a_motor_holds_its_speed_against_a_force_under_every_scheme() {
    for scheme in Scheme::ALL {
        let text = format!(
            "gravity = [0, 0, 0]\n[step]\nscheme = \"{}\"\n[[bodies]]\nname = \"cart\"\nmass = 1\n\
             shape = {{ sphere = 0.1 }}\nforce = [-50, 0, 0]\n[[constraints]]\n\
             kind = \"motor_translation\"\nbodies = [\"cart\"]\naxis = [1, 0, 0]\nspeed = 2\n\
             effort = 1000\n",
            scheme.name()
        );
        let scene = Scene::from_toml("motor.toml", &text).unwrap();
        let running = run(scene, 20, |_, _| ());
        assert_near(running.states()[0].v.x, 2.0, 1e-6);
    }
}

#[test]
fn a_body_that_diverges_names_the_row_that_threw_it() {
    // A spring of 1e12 N/m on 1 kg is unstable for any substep above 2e-6 s.
    let mut scene = falling(0.0, Scheme::Penalty);
    scene.step.penalty.stiffness = 1e14;
    scene.states[1].pose.p.z = 0.05;
    let mut running = simulation(scene);
    let failure = (0..100).find_map(|_| running.step().err()).expect("a step that fails");
    let said = failure.to_string();
    assert!(
        said.contains("the row with the largest impulse on it is \"normal ground ball 0\""),
        "{said}"
    );
}
