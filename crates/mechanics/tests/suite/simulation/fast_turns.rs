//! Bodies on hinges that turn by radians in a substep, and springs too stiff for it.

use lcplab_mechanics::scene::{Scene, Scheme};
use lcplab_mechanics::simulation::{JointWork, Simulation, spring_growth};

use super::assert_near;

/// A disk on a hinge through its center, without gravity.
fn wheel(axis: [f64; 3], speed: f64, scheme: Scheme) -> Scene {
    wheel_with(axis, speed, scheme, "")
}

/// The same with another constraint.
fn wheel_with(axis: [f64; 3], speed: f64, scheme: Scheme, more: &str) -> Scene {
    let text = format!(
        "gravity = [0, 0, 0]
        step.dt = 1
        [[bodies]]
        name = \"wheel\"
        shape = {{ cylinder = {{ length = 0.1, radius = 0.5 }} }}
        mass = 2
        [[constraints]]
        kind = \"hinge\"
        bodies = [\"wheel\"]
        axis = {axis:?}
        start_speed = {speed}
        {more}"
    );
    let mut scene = Scene::from_toml("wheel.toml", &text).unwrap();
    scene.step.scheme = scheme;
    scene
}

/// The work of joints in the first step that is reported.
fn first_work(scene: &Scene) -> Option<JointWork> {
    Simulation::of(scene).unwrap().step().ok()?.joint_work
}

const SUBSTEPPED: [Scheme; 3] = [Scheme::Xpbd, Scheme::Soft, Scheme::Penalty];

#[test]
fn the_work_of_joints_of_a_fast_unbalanced_wheel_is_reported() {
    // Its hinge turns the axis of the disk around: 30 rad in 8 substeps.
    for scheme in [Scheme::Xpbd, Scheme::Penalty] {
        let scene = wheel([1.0, 2.0, 3.0], 30.0, scheme);
        let Some(work) = first_work(&scene) else { panic!("{}", scheme.name()) };
        assert_near(work.angle, 30.0 / 8.0, 1e-9);
        assert_near(work.energy[0], Simulation::of(&scene).unwrap().motion().kinetic, 1e-12);
    }
    // The angle of an axis-aligned wheel is exact, and slow wheels are accurate.
    for scheme in SUBSTEPPED {
        assert_eq!(first_work(&wheel([0.0, 0.0, 1.0], 30.0, scheme)), None, "{}", scheme.name());
        assert_eq!(first_work(&wheel([1.0, 2.0, 3.0], 0.5, scheme)), None, "{}", scheme.name());
    }
    assert_eq!(first_work(&wheel([1.0, 2.0, 3.0], 30.0, Scheme::Velocity)), None);
}

/// A stop takes energy from a wheel, and a rope from a ball, as they should.
#[test]
fn the_energy_that_a_stop_or_a_rope_takes_is_not_reported() {
    let stop = "[[constraints]]
        kind = \"limit_rotation\"
        bodies = [\"wheel\"]
        axis = [0, 0, 1]
        limits = [-0.5, 0.5]";
    let ball = "gravity = [0, 0, 0]
        step.dt = 0.1
        [[bodies]]
        name = \"ball\"
        shape = { sphere = 0.1 }
        mass = 1
        velocity = [3, 0, 0]
        angular_velocity = [0, 0, 40]
        [[constraints]]
        kind = \"rope\"
        bodies = [\"ball\"]
        points = [[0, 0, 0], [-1, 0, 0]]
        length = 1.1";
    for scheme in SUBSTEPPED {
        let mut wheel = wheel_with([0.0, 0.0, 1.0], 30.0, scheme, stop);
        wheel.step.dt = 0.03;
        let mut ball = Scene::from_toml("ball.toml", ball).unwrap();
        ball.step.scheme = scheme;
        for scene in [wheel, ball] {
            let mut simulation = Simulation::of(&scene).unwrap();
            let start = simulation.motion().kinetic;
            for _ in 0..2 {
                assert_eq!(simulation.step().unwrap().joint_work, None, "{}", scheme.name());
            }
            // The penalty method's springs give it back.
            let is_taken = simulation.motion().kinetic < 0.99 * start;
            assert!(is_taken || scheme == Scheme::Penalty, "{}", scheme.name());
        }
    }
}

/// A point mass of 1 kg on a nail of this stiffness, with one substep a step.
fn nailed(stiffness: f64, damping: f64, h: f64) -> Scene {
    let text = format!(
        "gravity = [0, 0, 0]
        step = {{ scheme = \"penalty\", substeps = 1, dt = {h},
                  penalty = {{ stiffness = {stiffness}, damping = {damping} }} }}
        [[bodies]]
        name = \"bob\"
        shape = \"point\"
        mass = 1
        position = [1, 0, 0]
        velocity = [1e-6, 0, 0]
        [[constraints]]
        kind = \"nail\"
        bodies = [\"bob\"]
        point = [1, 0, 0]"
    );
    Scene::from_toml("nailed.toml", &text.replace("\n                  ", " ")).unwrap()
}

#[test]
fn an_unstable_spring_multiplies_errors_by_the_factor_of_theory() {
    // With d = 0 and h² k = 5: λ² + 3 λ + 1 = 0. With h² k = 1, h d = 2: λ² + λ − 1 = 0.
    let root = |p: f64, q: f64| 0.5 * (p + (p * p - 4.0 * q).sqrt());
    for (stiffness, damping, growth) in
        [(500.0, 0.0, root(3.0, 1.0)), (100.0, 20.0, root(1.0, -1.0))]
    {
        let scene = nailed(stiffness, damping, 0.1);
        assert_near(spring_growth(&scene).unwrap(), growth, 1e-9);
        let mut simulation = Simulation::of(&scene).unwrap();
        let mut offset = || {
            simulation.step().unwrap();
            (simulation.states()[0].pose.p.x - 1.0).abs()
        };
        (0..20).for_each(|_| _ = offset());
        let [before, after] = [offset(), offset()];
        assert_near(after / before, growth, 1e-6);
    }
}

#[test]
fn a_stable_spring_is_not_reported() {
    // h² k + 2 h d is just below and just above 4.
    for (stiffness, damping) in [(399.0, 0.0), (0.0, 19.9), (199.0, 10.0)] {
        assert_eq!(spring_growth(&nailed(stiffness, damping, 0.1)), None);
    }
    for (stiffness, damping) in [(401.0, 0.0), (0.0, 20.1), (201.0, 10.0)] {
        assert!(spring_growth(&nailed(stiffness, damping, 0.1)).unwrap() > 1.0);
    }
    let scene =
        Scene { step: wheel([0.0, 0.0, 1.0], 1.0, Scheme::Soft).step, ..nailed(1e9, 0.0, 1.0) };
    assert_eq!(spring_growth(&scene), None);
}
