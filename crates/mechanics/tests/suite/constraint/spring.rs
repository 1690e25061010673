//! Springs and dampers compared with the closed form of their own step.

use lcplab_mechanics::scene::{Scene, Scheme};
use nalgebra::{UnitQuaternion, Vector3};

use super::{angle, assert_near, simulation, start};

const DT: f64 = 0.01;
const MASS: f64 = 2.0;
const STIFFNESS: f64 = 50.0;

/// A point mass hanging from the origin by a spring of length 1 with this stretch.
fn hung(gravity: f64, stretch: f64, spring: &str) -> String {
    let z = -1.0 - stretch;
    format!(
        "gravity = [0, 0, -{gravity}]\n\
         [step]\ndt = {DT}\n\
         [[bodies]]\nname = \"bob\"\nshape = \"point\"\nmass = {MASS}\nposition = [0, 0, {z}]\n\
         [[constraints]]\nkind = \"spring\"\nbodies = [\"bob\"]\npoints = [[0, 0, 0], [0, 0, {z}]]\n\
         length = 1\n{spring}\n"
    )
}

/// The stretch after n steps from rest at a stretch of 1: with a = h ω0, the step (y, v/ω0) → [1,
/// a; −a, 1]/(1 + a²) (y, v/ω0) rotates by atan a and scales by 1/√(1 + a²).
fn swing(omega0: f64, n: i32) -> f64 {
    let a = DT * omega0;
    (1.0 + a * a).sqrt().powi(-n) * (f64::from(n) * a.atan()).cos()
}

#[test]
fn a_spring_swings_as_its_step_says_at_both_levels() {
    for level in Scheme::LEVELS {
        let mut spring = simulation(&hung(0.0, 0.2, &format!("stiffness = {STIFFNESS}")), level);
        for n in 1..=400 {
            spring.step().unwrap();
            let stretch = -1.0 - spring.states()[0].pose.p.z;
            assert_near(stretch, 0.2 * swing((STIFFNESS / MASS).sqrt(), n), 1e-12);
        }
    }
}

#[test]
fn a_torsion_spring_swings_likewise() {
    // I of a ball is ⅖ m r² = 0.2 kg m²; a step turns by exactly ωh.
    let text = format!(
        "gravity = [0, 0, 0]\n[step]\ndt = {DT}\n\
         [[bodies]]\nname = \"wheel\"\nshape = {{ sphere = 0.5 }}\nmass = {MASS}\n\
         [[constraints]]\nkind = \"hinge\"\nbodies = [\"wheel\"]\naxis = [0, 1, 0]\n\
         [[constraints]]\nkind = \"spring_rotation\"\nbodies = [\"wheel\"]\naxis = [0, 1, 0]\nstiffness = 5\n"
    );
    for level in Scheme::LEVELS {
        let mut scene = Scene::from_toml("torsion.toml", &text).unwrap();
        scene.step.scheme = level;
        scene.states[0].pose.q = UnitQuaternion::from_scaled_axis(Vector3::y() * 0.01);
        let mut wheel = start(scene);
        for n in 1..=200 {
            wheel.step().unwrap();
            let exact = 0.01 * swing((5.0_f64 / 0.2).sqrt(), n);
            assert_near(angle(&wheel.states()[0], &Vector3::y()), exact, 1e-8);
        }
    }
}

#[test]
fn a_damper_alone_divides_the_speed_each_step() {
    for level in Scheme::LEVELS {
        let mut scene =
            Scene::from_toml("damper.toml", &hung(0.0, 0.0, "stiffness = 0\ndamping = 8")).unwrap();
        scene.step.scheme = level;
        scene.states[0].v.z = -3.0;
        let mut damper = start(scene);
        for n in 1..=100 {
            damper.step().unwrap();
            assert_near(damper.states()[0].v.z, -3.0 / (1.0 + DT * 8.0 / MASS).powi(n), 1e-12);
        }
    }
}

#[test]
fn a_damped_spring_comes_to_rest_where_it_carries_the_weight() {
    for level in Scheme::LEVELS {
        let mut spring = simulation(&hung(9.81, 0.0, "stiffness = 50\ndamping = 20"), level);
        // Critical damping: a decay of e^(−5 t); e^(−50) of 0.4 m is left after 10 s.
        for _ in 0..1000 {
            spring.step().unwrap();
        }
        assert_near(spring.states()[0].pose.p.z, -1.0 - MASS * 9.81 / STIFFNESS, 1e-12);
    }
}
