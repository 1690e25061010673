//! The measurements of a comparison of solvers and levels, compared with closed forms.

use lcplab_mechanics::scene::{Integrator, Scene, Scheme};
use lcplab_solver::{Entry, Method, Stop, entry};
use lcplab_study::comparison::{Comparison, EXACT, Energy, Phase, Run, compare};

fn compared(scene: &Scene, schemes: &[Scheme], solvers: &[&str], steps: usize) -> Comparison {
    let solvers: Vec<Entry> = solvers.iter().map(|name| *entry(name).unwrap()).collect();
    let (mut comparison, _) = compare(scene, schemes, &solvers, steps, &|| ());
    let methods: Vec<Method> = solvers.into_iter().map(Method::Boxed).collect();
    comparison.add_levels(scene, &methods, &Stop::default());
    comparison
}

fn of(text: &str) -> Scene {
    Scene::from_toml("compared.toml", text).unwrap()
}

/// Two billiard balls without friction, e = 1; they meet off-center within a step.
const BILLIARDS: &str = "
    gravity = [0, 0, 0]
    contact.restitution = 1
    [[bodies]]
    name = \"a\"
    mass = 1
    shape = { sphere = 0.5 }
    velocity = [3, 0, 0]
    [[bodies]]
    name = \"b\"
    mass = 1
    shape = { sphere = 0.5 }
    position = [2.3, 0.6, 0]
";

#[test]
fn where_bodies_meet_the_acceleration_level_is_exact_and_the_velocity_level_is_not() {
    let scene = of(BILLIARDS);
    let found = compared(&scene, &Scheme::LEVELS, &["dantzig"], 100);
    let levels = found.levels.unwrap();
    let [velocity, acceleration] = &levels.levels[..] else { panic!("{levels:?}") };
    assert_eq!(
        [velocity.scheme.as_str(), acceleration.scheme.as_str()],
        ["velocity", "acceleration"]
    );
    let meet = Phase::Meet as usize;
    assert!(velocity.errors[meet].unwrap() > 1e-3, "{levels:?}");
    assert!(acceleration.errors[meet].unwrap() < EXACT, "{levels:?}");
    assert!(acceleration.halved < 1e-9 && velocity.halved > 1e-3, "{levels:?}");
    assert!(levels.apart > 1e-3);
    for run in &found.runs {
        assert_eq!(run.laws.energy, Energy::Stays);
        assert!(run.laws.keeps_energy(run.energy_at_end()));
        assert!(run.laws.momentum.unwrap() < 1e-9 && run.laws.restitution.unwrap() < 1e-9);
    }
}

#[test]
fn where_a_body_spins_the_velocity_level_is_exact() {
    // Dzhanibekov's brick: Euler's equations conserve L and the energy, an Euler step does not.
    let mut scene = Scene::load("dzhanibekov").unwrap();
    scene.step.integrator = Integrator::SemiImplicitEuler;
    let found = compared(&scene, &Scheme::LEVELS, &["dantzig"], 50);
    let levels = found.levels.unwrap();
    let spin = levels.levels.iter().map(|level| level.errors[Phase::Spin as usize].unwrap());
    let [velocity, acceleration] = spin.collect::<Vec<_>>()[..] else { panic!("{levels:?}") };
    assert!(velocity < EXACT && acceleration > EXACT, "{levels:?}");
}

fn only(found: &Comparison) -> &Run {
    let [run] = &found.runs[..] else { panic!() };
    run
}

#[test]
fn a_body_that_passes_through_another_one_has_not_kept_gaps_closed() {
    let text = "
        gravity = [0, 0, 0]
        contact.margin = 0.001
        [[bodies]]
        name = \"wall\"
        fixed = true
        shape = { box = [0.02, 2, 2] }
        position = [0.5, 0, 0]
        [[bodies]]
        name = \"bullet\"
        mass = 0.01
        shape = { sphere = 0.01 }
        velocity = [300, 0, 0]
    ";
    let found = compared(&of(text), &[Scheme::Velocity], &["dantzig"], 3);
    let run = only(&found);
    assert_eq!(run.accepted, run.solves);
    assert_eq!(run.laws.passages, 1);
    assert!(!run.closes(3, found.thinnest));
}

#[test]
fn a_solver_that_refuses_every_problem_is_no_candidate() {
    let found = compared(&Scene::load("stack").unwrap(), &[Scheme::Velocity], &["enumeration"], 2);
    let run = only(&found);
    assert!(run.solves > 0 && run.claimed == 0, "{run:?}");
    assert!(!run.is_candidate(), "{run:?}");
}

#[test]
fn energy_that_nothing_may_take_is_named_with_its_account() {
    // Three balls in contact, e = 1: one impulse for both contacts conserves the energy; two
    // impacts within one step, across a gap, do not.
    let text = "
        gravity = [0, 0, 0]
        contact.restitution = 1
        bodies = [
            { name = \"a\", mass = 1, shape = { sphere = 0.5 }, velocity = [3, 0, 0] },
            { name = \"b\", mass = 1, shape = { sphere = 0.5 }, position = [1.01, 0, 0] },
            { name = \"c\", mass = 1, shape = { sphere = 0.5 }, position = [2.02, 0, 0] },
        ]
    ";
    let found = compared(&of(text), &[Scheme::Velocity], &["dantzig"], 5);
    let run = only(&found);
    assert_eq!(run.laws.energy, Energy::Stays);
    assert!(run.energy_at_end() < -0.1, "{run:?}");
    assert!(!run.laws.keeps_energy(run.energy_at_end()));
    let (account, energy) = run.laws.account.clone().unwrap();
    assert_eq!(account, "gap");
    assert!(energy < 0.0);
    assert!(run.laws.impact.as_ref().unwrap().contains("closed this gap within the step"));
}
