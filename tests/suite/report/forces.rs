//! What `simulate --out` writes, added up as a reader of the tables would.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use lcplab::report::recording::Record;
use lcplab::scene::{Integrator, Scene, Scheme};
use lcplab::simulation::Simulation;
use lcplab_testing::{cases, pile};
use nalgebra::Vector3;
use proptest::prelude::*;

const STEPS: usize = 10;

/// The lines of a table, each by the names of its columns.
fn table(path: &Path) -> Vec<BTreeMap<String, String>> {
    let text = fs::read_to_string(path).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').map(String::from).collect::<Vec<_>>());
    let heading = lines.next().unwrap();
    lines.map(|cells| heading.iter().cloned().zip(cells).collect()).collect()
}

fn vector(line: &BTreeMap<String, String>, columns: [&str; 3]) -> Vector3<f64> {
    Vector3::from(columns.map(|name| line[name].parse().unwrap()))
}

/// The impulse (N s) of all contacts on each body in each step, and the sum of their sizes.
fn impulses(folder: &Path) -> BTreeMap<(String, String), (Vector3<f64>, f64)> {
    let mut sums = BTreeMap::new();
    for line in table(&folder.join("forces.csv")) {
        let (Ok(impulse), true) = (line["impulse"].parse::<f64>(), !line["direction x"].is_empty())
        else {
            continue; // a correction of positions, or a row that only turns
        };
        let push = vector(&line, ["direction x", "direction y", "direction z"]) * impulse;
        for (body, push) in [(&line["first body"], -push), (&line["second body"], push)] {
            let (sum, size) =
                sums.entry((line["step"].clone(), body.clone())).or_insert((Vector3::zeros(), 0.0));
            *sum += push;
            *size += push.norm();
        }
    }
    sums
}

/// m Δv − m g dt of each body in each step (N s), and m |v|.
fn gains(folder: &Path, scene: &Scene) -> BTreeMap<(String, String), (Vector3<f64>, f64)> {
    let mut last = BTreeMap::new();
    let mut gains = BTreeMap::new();
    for line in table(&folder.join("trajectory.csv")) {
        let v = vector(&line, ["vx (m/s)", "vy (m/s)", "vz (m/s)"]);
        let name = line["body"].clone();
        let body = scene.bodies.iter().find(|body| body.name == name).unwrap();
        let mass = body.mass.mass();
        if let Some(before) = last.insert(name.clone(), v).filter(|_| mass > 0.0) {
            let gain = mass * (v - before - scene.gravity * scene.step.dt);
            gains.insert((line["step"].clone(), name), (gain, mass * v.norm()));
        }
    }
    gains
}

fn written(scene: &Scene) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut simulation = Simulation::of(scene).unwrap();
    let mut record = Record::start(scene, &simulation).with_tables(&simulation, 1);
    for _ in 0..STEPS {
        let Ok(step) = simulation.step() else { break };
        record.add(&step);
    }
    record.write(folder.path()).unwrap();
    folder
}

proptest! {
    #![proptest_config(cases(12))]

    /// Newton's law, by the tables alone: the impulses of all rows of a body are what its momentum
    /// gained beside gravity.
    #[test]
    fn the_impulses_of_the_rows_of_a_body_are_what_its_momentum_gains(
        text in pile(),
        scheme in prop_oneof![
            Just(Scheme::Velocity),
            Just(Scheme::Acceleration),
            Just(Scheme::SplitImpulse),
            Just(Scheme::GaussSeidel),
            Just(Scheme::SequentialImpulses),
        ],
        restitution in prop_oneof![Just(0.0), Just(0.5)],
        integrator in prop_oneof![Just(Integrator::SemiImplicitEuler), Just(Integrator::Rk4)],
    ) {
        let mut scene = Scene::from_toml("pile.toml", &text).unwrap();
        scene.step.scheme = scheme;
        scene.contact.restitution = restitution;
        if scheme == Scheme::Acceleration {
            scene.step.integrator = integrator;
        }
        let folder = written(&scene);
        let impulses = impulses(folder.path());
        for (place, (gain, momentum)) in gains(folder.path(), &scene) {
            let (impulse, size) = impulses.get(&place).copied().unwrap_or_default();
            let off = (impulse - gain).norm();
            let rounding = 1e-11 * (size + momentum + gain.norm());
            prop_assert!(off <= rounding, "{scheme:?} {place:?}: {impulse:?} for {gain:?}");
        }
    }
}

/// 100 kg on three cubes, whose corners touch it from below and whose faces it touches from above.
#[test]
fn the_rows_of_a_body_on_three_others_carry_its_weight() {
    let cube = |name: &str, x: f64, y: f64| {
        format!(
            "[[bodies]]\nname = {name:?}\nshape = {{ box = [0.4, 0.4, 0.4] }}\nmass = 20\nposition = [{x}, {y}, 0.2]\n"
        )
    };
    let text = "[step]\ndt = 0.002\n[contact]\nfriction = 0.8\n\
                [[bodies]]\nname = \"ground\"\nfixed = true\nshape = { plane = [0, 0, 1] }\n"
        .to_string()
        + &cube("c1", -0.5, -0.5)
        + &cube("c2", 0.5, -0.5)
        + &cube("c3", 0.0, 0.5)
        + "[[bodies]]\nname = \"test\"\nshape = { box = [1.4, 1.4, 0.6] }\nmass = 100\nposition = [0, 0, 0.7]\n";
    let scene = Scene::from_toml("three.toml", &text).unwrap();
    let folder = written(&scene);
    let impulses = impulses(folder.path());
    for step in 1..=STEPS {
        let force = impulses[&(step.to_string(), "test".to_string())].0.z / scene.step.dt;
        assert!((force - 981.0).abs() < 1e-5, "step {step}: {force} N");
    }
}
