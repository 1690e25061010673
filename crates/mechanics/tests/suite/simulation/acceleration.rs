//! Contacts at acceleration level: they rest, they separate, and no bodies overlap.

use lcplab_mechanics::formulation::Stage;
use lcplab_mechanics::scene::catalogue::bounce::Drop;
use lcplab_mechanics::scene::{Integrator, Scene, Scheme};

use super::{assert_near, bullet, scene, simulation};

const GROUND: &str = "
    step = { dt = 0.001, scheme = \"acceleration\" }
    [[bodies]]
    name = \"ground\"
    fixed = true
    shape = { plane = [0, 0, 1] }
";

/// Bodies on the ground at acceleration level.
fn on_ground(bodies: &str, friction: f64) -> Scene {
    let text = format!("contact.friction = {friction}\n{GROUND}{bodies}");
    Scene::from_toml("ground.toml", &text).unwrap()
}

#[test]
fn a_box_that_lies_a_little_askew_comes_to_rest_and_stays() {
    // Tilted by 1e-5 rad: it lands, and from then on no corner moves by 1e-6 m.
    let mut scene = on_ground(
        "[[bodies]]\nname = \"box\"\nshape = { box = [1, 1, 0.2] }\nmass = 3\nposition = [0, 0, 0.1]\n",
        0.5,
    );
    scene.states[1].omega.x = 0.01;
    let mut boxes = simulation(scene);
    (0..500).for_each(|_| drop(boxes.step().unwrap()));
    let settled = boxes.states()[1].pose.p.z;
    for _ in 0..1000 {
        let step = boxes.step().unwrap();
        assert_near(step.states[1].pose.p.z, settled, 1e-6);
        assert!(step.motion.penetration < 1e-5, "{}", step.motion.penetration);
    }
}

#[test]
fn a_sliding_box_stops_after_its_way_and_does_not_sink() {
    // v²/(2 μ g) = 4/(2 · 0.3 · 9.81) m after v/(μ g) s.
    let mut scene = on_ground(
        "[[bodies]]\nname = \"box\"\nshape = { box = [1, 1, 0.5] }\nmass = 2\nposition = [0, 0, 0.25]\n\
         velocity = [2, 0, 0]\n",
        0.3,
    );
    scene.step.dt = 0.002;
    let mut slider = simulation(scene);
    for _ in 0..1000 {
        let step = slider.step().unwrap();
        assert!(step.motion.penetration < 1e-6, "{}", step.motion.penetration);
    }
    let state = slider.states()[1];
    assert_near(state.pose.p.x, 4.0 / (2.0 * 0.3 * 9.81), 5e-3);
    assert!(state.v.norm() < 1e-9, "{}", state.v.norm());
}

#[test]
fn a_fast_ball_hits_the_ground_where_it_is_and_enters_by_nothing() {
    for integrator in [Integrator::SemiImplicitEuler, Integrator::ExplicitEuler, Integrator::Rk4] {
        let ball = Drop { height: 1.0, restitution: 0.8, gravity: 9.81 };
        let mut scene = on_ground(
            "[[bodies]]\nname = \"ball\"\nshape = { sphere = 0.1 }\nmass = 2\nposition = [0, 0, 1.1]\n",
            0.0,
        );
        (scene.step.dt, scene.step.integrator) = (0.01, integrator);
        scene.contact.restitution = ball.restitution;
        let mut drop = simulation(scene);
        let (mut top, mut deepest) = ([0.0f64; 3], 0.0f64);
        for _ in 0..150 {
            let step = drop.step().unwrap();
            deepest = deepest.max(step.motion.penetration);
            let bounce = (1..3).take_while(|&k| step.motion.time > ball.time_of(k)).count();
            top[bounce] = top[bounce].max(step.states[1].pose.p.z - 0.1);
        }
        assert!(deepest < 1e-8, "{integrator:?} {deepest:e}");
        // With Euler's methods a fall or rise at the speed v loses v dt/2 of its height, and a
        // bounce preserves e² of that. Between steps the top is missed by at most g dt²/8.
        let (mut lost, mut speed, e) = (0.0, (2.0 * 9.81f64).sqrt(), ball.restitution);
        for bounce in [1, 2] {
            let half = if integrator == Integrator::Rk4 { 0.0 } else { 0.5 * speed * 0.01 };
            lost = e * e * (lost + half) + e * half;
            speed *= e;
            let height = ball.height_after(bounce as i32);
            let error = 1.1 * lost + 9.81 * 0.01 * 0.01 / 8.0;
            assert!((top[bounce] - height).abs() < error, "{integrator:?} {top:?} {height}");
        }
    }
}

#[test]
fn a_ball_that_has_nearly_stopped_bouncing_comes_to_rest() {
    use Integrator::{ImplicitMidpoint, Rk4, SemiImplicitEuler};
    for integrator in [SemiImplicitEuler, Rk4, ImplicitMidpoint] {
        for dt in [0.05, 0.01, 0.002] {
            let mut scene = on_ground(
                "[[bodies]]\nname = \"ball\"\nshape = { sphere = 0.1 }\nmass = 1\nposition = [0, 0, 0.6]\n",
                0.0,
            );
            (scene.step.dt, scene.step.integrator) = (dt, integrator);
            scene.contact.restitution = 0.5;
            let mut drop = simulation(scene);
            // All bounces are over √(2h/g) (1 + e)/(1 − e) = 0.96 s after the release.
            for _ in 0..(1.5 / dt) as usize {
                drop.step().unwrap();
            }
            let state = drop.states()[1];
            assert!(state.v.norm() < 1e-12, "{integrator:?} {dt} {}", state.v);
            assert!((state.pose.p.z - 0.1).abs() < 2e-4, "{integrator:?} {dt} {}", state.pose.p);
        }
    }
}

#[test]
fn a_bullet_hits_a_wall_that_is_thinner_than_its_step() {
    let mut scene = bullet();
    scene.step.scheme = Scheme::Acceleration;
    let mut bullet = simulation(scene);
    for _ in 0..3 {
        bullet.step().unwrap();
    }
    assert_near(bullet.states()[1].pose.p.x, -0.02, 1e-6);
    assert!(bullet.states()[1].v.norm() < 1e-9);
}

#[test]
fn a_particle_leaves_a_ball_at_two_thirds_of_its_height() {
    // From the top with v0: it leaves where cos θ = 2/3 + v0²/(3 g r).
    let (r, v0) = (1.0, 0.3);
    let text = format!(
        "step = {{ dt = 0.0005, scheme = \"acceleration\", integrator = \"rk4\" }}
        [[bodies]]
        name = \"ball\"
        fixed = true
        shape = {{ sphere = {r} }}
        [[bodies]]
        name = \"particle\"
        shape = \"point\"
        mass = 1
        position = [0, 0, {r}]
        velocity = [{v0}, 0, 0]"
    );
    let mut particle = simulation(Scene::from_toml("leaving.toml", &text).unwrap());
    let leaves = loop {
        let step = particle.step().unwrap();
        let p = step.states[1].pose.p;
        assert!(step.motion.penetration < 1e-5, "{}", step.motion.penetration);
        if p.norm() > r + 1e-3 {
            break p;
        }
        assert!(p.z > 0.0, "it never left");
    };
    let cos: f64 = 2.0 / 3.0 + v0 * v0 / (3.0 * 9.81 * r);
    // It is 1 mm away somewhat later than it left: c ≈ t³ g sin θ cos θ … / r, about 6 degrees.
    let angle = leaves.x.atan2(leaves.z).to_degrees();
    let exact = cos.acos().to_degrees();
    assert!(angle > exact - 0.5 && angle < exact + 8.0, "{angle} {exact}");
}

#[test]
fn every_shipped_scene_at_rest_stays_at_rest_at_this_level() {
    for name in ["stack", "sphere_plane", "arch", "capstan"] {
        let scene = scene(name, Scheme::Acceleration);
        let start = scene.states.clone();
        let mut rest = simulation(scene);
        for _ in 0..100 {
            let step = rest.step().unwrap();
            let forces = step.solves.iter().filter(|s| s.problem.stage == Stage::Acceleration);
            assert_eq!(forces.count(), 1, "{name}, step {}", step.number);
        }
        for (state, start) in rest.states().iter().zip(&start) {
            let way = (state.pose.p - start.pose.p).norm();
            assert!(way < 2e-6, "{name}: {way:e}");
        }
    }
}

/// A point on two rods at x = ±1 that starts at the height y₀ = 0.1 with the speed v₀ = 1 toward
/// the line between their ends. The rods allow no motion. J u' = −J'u keeps the rates J u that are
/// there: both lengths are l₀ − y₀ v₀ t/l₀, so y² = (l₀ − y₀ v₀ t/l₀)² − 1. At t* = l₀ (l₀ − 1)/(y₀
/// v₀) = 0.0501 s this is 0: no position has both lengths after it, and the speed is infinite.
#[test]
fn independent_rows_keep_their_rates_until_no_position_satisfies_them() {
    let rod = |x: f64| {
        format!(
            "[[constraints]]\nkind = \"distance\"\nbodies = [\"bob\"]\n\
             points = [[{x}, 0, 0], [0, 0, 0.1]]\n"
        )
    };
    let text = "gravity = [0, 0, 0]\n[step]\ndt = 0.0005\nscheme = \"acceleration\"\n\
        integrator = \"rk4\"\nalpha = 0\n[[bodies]]\nname = \"bob\"\nshape = \"point\"\nmass = 1\n\
        position = [0, 0, 0.1]\nvelocity = [0, 0, -1]\n";
    let toggle = format!("{text}{}{}", rod(-1.0), rod(1.0));
    let mut bob = simulation(Scene::from_toml("toggle.toml", &toggle).unwrap());
    let start = f64::sqrt(1.01);
    let height = |t: f64| ((start - 0.1 * t / start).powi(2) - 1.0).sqrt();
    while bob.time() < 0.0449 {
        bob.step().unwrap();
        assert_near(bob.states()[0].pose.p.z, height(bob.time()), 1e-7);
    }
    assert!(bob.states()[0].v.z.abs() < 4.0, "{}", bob.states()[0].v.z);
    while bob.time() < 0.0509 {
        bob.step().unwrap();
    }
    assert!(bob.states()[0].v.z.abs() > 1e3, "{}", bob.states()[0].v.z);
}
