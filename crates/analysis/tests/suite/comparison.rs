//! The measurements of a comparison of solvers and levels, compared with closed forms.

use lcplab_analysis::comparison::{
    Comparison, EXACT, Energy, LAW_TOLERANCE, LevelRefinement, Phase, Run, best, compare,
};
use lcplab_mechanics::scene::{Integrator, Scene, Scheme};
use lcplab_mechanics::simulation::Simulation;
use lcplab_solver::{Entry, Method, Registry, Stop};
use nalgebra::Vector3;

fn compared(scene: &Scene, schemes: &[Scheme], solvers: &[&str], steps: usize) -> Comparison {
    let solvers: Vec<Entry> =
        solvers.iter().map(|name| Registry::standard().entry(name).unwrap().clone()).collect();
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
        assert!(run.laws.keeps_energy());
        assert!(run.laws.momentum.unwrap() < 1e-9 && run.laws.restitution.unwrap() < 1e-9);
    }
}

/// The billiard balls, the second one in the way of the first by this offset (m), so that they meet
/// this part of a step of 0.01 s after the start.
fn meeting_after(part: f64, offset: f64) -> Scene {
    let mut scene = of(BILLIARDS);
    let along = (1.0 - offset * offset).sqrt() + 3.0 * 0.01 * part;
    scene.states[1].pose.p = Vector3::new(along, offset, 0.0);
    scene
}

/// The two levels.
fn levels(scene: &Scene, steps: usize) -> [LevelRefinement; 2] {
    let levels = compared(scene, &Scheme::LEVELS, &["dantzig"], steps).levels.unwrap();
    levels.levels.try_into().unwrap()
}

#[test]
fn an_impact_that_is_taken_too_early_shows_in_any_part_of_the_step_as_an_error_of_time() {
    // The balls meet this part of the step after its beginning. Halves and thirds of the step take
    // an impact in their first part just as early.
    let meet = |level: &LevelRefinement| level.errors[Phase::Meet as usize].unwrap();
    for part in [0.02, 0.1, 0.3, 0.6, 0.95] {
        let straight = levels(&meeting_after(part, 0.0), 1);
        assert!(straight.iter().all(|level| meet(level) < EXACT), "{part}: {straight:?}");
        let [velocity, acceleration] = straight.map(|level| level.mistimed.unwrap());
        assert!((velocity - part).abs() < 1e-6, "{part}: {velocity}");
        assert!(acceleration < EXACT, "{part}: {acceleration}");
        // Off the centers the normal turns as well: b should leave along the line at the impact.
        let scene = meeting_after(part, 0.6);
        let due = Vector3::new(3.0 * 0.64, 3.0 * 0.48, 0.0);
        let levels = levels(&scene, 1);
        let [velocity, acceleration] = levels.each_ref().map(meet);
        let off = {
            let method = Method::Boxed(Registry::standard().entry("dantzig").unwrap().clone());
            let mut simulation = Simulation::by(&scene, &method);
            (simulation.step().unwrap().states[1].v - due).norm()
        };
        // A velocity error below half a percent of the approach is not reported.
        assert!(velocity > 0.99 * off / 3.0 || off < 5e-3 * 3.0, "{part}: {velocity}, {off}");
        assert!(acceleration < EXACT, "{part}: {acceleration}");
        let early = levels[0].mistimed.unwrap();
        assert!((early / part - 1.0).abs() < 0.03, "{part}: {early}");
    }
}

#[test]
fn a_bounce_in_one_step_or_the_next_is_no_error_of_velocity() {
    // Falling balls reach the ground at any part of a step. The gap at the start of a step can
    // close within it at the speed of its end, and not at those of two halves: the divided step
    // bounces later, and is then 1 + e times the approach away. The bounce is not wrong by that.
    for e in [0.3, 1.0] {
        for k in 0..40 {
            let height = 1.0 + 0.0037 * f64::from(k);
            let text = format!(
                "contact.restitution = {e}\n[[bodies]]\nname = \"ground\"\nfixed = true\n\
                 shape = {{ plane = [0, 0, 1] }}\n[[bodies]]\nname = \"ball\"\nmass = 2\n\
                 shape = {{ sphere = 0.1 }}\nposition = [0, 0, {height}]\n"
            );
            // At most g dt of the approach, 4.2 m/s at least, is gravity's in a divided step.
            let [velocity, _] = levels(&of(&text), 60);
            let error = velocity.errors[Phase::Meet as usize].unwrap();
            assert!(error < 2.0 * 9.81 * 0.01 / 4.2, "{e}, {height}: {error}");
            assert!(velocity.mistimed.unwrap() <= 1.03, "{e}, {height}: {velocity:?}");
        }
    }
}

#[test]
fn half_the_step_moves_a_body_that_only_turns() {
    // A torque of 0.02 N m on a ball of 0.1 kg m²: α = 0.2 rad/s². A step too early, it turns by
    // α dt T/2 too far, and by half of that with half the step. Its surface moves by r times that.
    let text = "
        gravity = [0, 0, 0]
        [[bodies]]
        name = \"ball\"
        mass = 1
        shape = { sphere = 0.5 }
        torque = [0, 0, 0.02]
    ";
    for level in levels(&of(text), 50) {
        let due = 0.5 * 0.2 * 0.01 * 0.5 / 4.0;
        assert!((level.halved - due).abs() < 1e-9, "{level:?}");
    }
}

#[test]
fn a_body_spins_freely_only_without_torque_and_with_more_than_rounding() {
    let mut brick = Scene::load("dzhanibekov").unwrap();
    brick.step.integrator = Integrator::SemiImplicitEuler;
    let spin =
        |scene: &Scene| levels(scene, 3).map(|level| level.errors[Phase::Spin as usize].is_some());
    assert_eq!(spin(&brick), [true; 2]);
    let mut pushed = brick.clone();
    pushed.bodies[0].torque = Vector3::new(0.0, 0.1, 0.0);
    assert_eq!(spin(&pushed), [false; 2]);
    let mut thrown = brick;
    thrown.states[0].omega *= 1e-12;
    thrown.states[0].v = Vector3::x();
    assert_eq!(spin(&thrown), [false; 2]);
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
    assert_eq!(run.tally.accepted, run.tally.solves);
    assert_eq!(run.laws.passages, 1);
    let criterion = run.failing_criterion(3, found.thinnest);
    assert_eq!(criterion, Some("a body passed through another one"));
}

#[test]
fn a_solver_that_refuses_every_problem_is_no_candidate() {
    let found = compared(&Scene::load("stack").unwrap(), &[Scheme::Velocity], &["enumeration"], 2);
    let run = only(&found);
    assert!(run.tally.solves > 0 && run.tally.claimed == 0, "{run:?}");
    assert!(!run.is_candidate(), "{run:?}");
    assert_eq!(best(&found.runs), None);
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
    assert_eq!(run.laws.energy_error, run.energy_at_end());
    assert!(!run.laws.keeps_energy());
    let (account, energy) = run.laws.account.clone().unwrap();
    assert_eq!(account, "gap");
    assert!(energy < 0.0);
    let impact = run.laws.impact.as_ref().unwrap();
    assert!(impact.starts_with("impacts lost"), "{impact}");
    assert!(impact.contains("closed this gap within the step"), "{impact}");
}

/// A ball of 1 kg between a ground and a ceiling without friction, e = 1, no weight.
fn between_planes(height: f64, ceiling: f64, speed: f64) -> Scene {
    of(&format!(
        "gravity = [0, 0, 0]
        contact.restitution = 1
        step.baumgarte = 0.2
        bodies = [
            {{ name = \"ground\", fixed = true, shape = {{ plane = [0, 0, 1] }} }},
            {{ name = \"ceiling\", fixed = true, shape = {{ plane = [0, 0, -1] }}, position = [0, 0, {ceiling}] }},
            {{ name = \"ball\", mass = 1, shape = {{ sphere = 0.5 }}, position = [0, 0, {height}], velocity = [0, 0, {speed}] }},
        ]"
    ))
}

#[test]
fn energy_that_was_added_and_lost_again_is_named() {
    // Feedback pushes an overlap of 2.5 mm apart with 0.2 · 2.5 mm/10 ms = 0.05 m/s, which adds
    // ½ m v². The ceiling stops the ball, for 0.05 m/s is too slow to bounce: at the end nothing
    // is left.
    let found = compared(&between_planes(0.4975, 1.01, 0.0), &[Scheme::Velocity], &["dantzig"], 60);
    let run = only(&found);
    assert!(run.energy_at_end().abs() < 1e-12, "{run:?}");
    assert!((run.laws.energy_error - 0.5 * 0.05 * 0.05).abs() < 1e-12, "{:?}", run.laws);
    assert!(!run.laws.keeps_energy());
    assert_eq!(run.laws.account.as_ref().unwrap().0, "bias");
    // From an overlap of 50 mm it comes with 1 m/s, and bounces: at e = 1 that takes and gives the
    // same, so bias remains the cause.
    let found = compared(&between_planes(0.45, 1.51, 0.0), &[Scheme::Velocity], &["dantzig"], 200);
    let (account, energy) = only(&found).laws.account.clone().unwrap();
    assert_eq!(account, "bias");
    assert!((energy - 0.5).abs() < 1e-9, "{energy}");
    assert!(only(&found).laws.restitution.unwrap() < 1e-9);
}

#[test]
fn an_impact_too_slow_to_bounce_may_lose_its_energy_and_a_fast_one_may_not() {
    let run = |speed: f64| {
        let scene = between_planes(0.502, 2.0, -speed);
        compared(&scene, &[Scheme::Velocity], &["dantzig"], 20).runs.remove(0)
    };
    let slow = run(0.05);
    assert_eq!(slow.laws.energy, Energy::Stays);
    assert!((slow.energy_at_end() + 0.5 * 0.05 * 0.05).abs() < 1e-12, "{slow:?}");
    assert!(slow.laws.keeps_energy(), "{:?}", slow.laws);
    let fast = run(0.5);
    assert!(fast.energy_at_end().abs() < 1e-12 && fast.laws.keeps_energy(), "{fast:?}");
    assert!(fast.laws.energy_tolerance < 1.01 * LAW_TOLERANCE * 0.125, "{:?}", fast.laws);
}

#[test]
fn energy_may_be_off_by_the_weight_over_a_resting_gap() {
    let mut scene = between_planes(0.5, 2.0, 0.0);
    scene.gravity.z = -10.0;
    let run = compared(&scene, &[Scheme::Acceleration], &["dantzig"], 10).runs.remove(0);
    let due = 10.0 * scene.at_level(Scheme::Acceleration).resting().gap;
    assert!((run.laws.energy_tolerance - due).abs() < 1e-9, "{:?}", run.laws);
    assert!(run.laws.keeps_energy(), "{:?}", run.laws);
}

#[test]
fn momenta_that_cancel_are_compared_with_their_sizes() {
    // Head on, along a line through the origin: P and L are rounding before and after.
    let mut scene = of(BILLIARDS);
    let line = Vector3::new(1.0, 0.3, 0.7);
    for (state, side) in scene.states.iter_mut().zip([-1.0, 1.0]) {
        (state.pose.p, state.v) = (0.9 * side * line, -1.1 * side * line);
    }
    let found = compared(&scene, &[Scheme::Velocity], &["dantzig"], 100);
    let laws = &only(&found).laws;
    assert!(laws.restitution.unwrap() < 1e-9, "{laws:?}");
    assert!(laws.momentum.unwrap() < 1e-12 && laws.angular_momentum.unwrap() < 1e-12, "{laws:?}");
}

#[test]
fn an_impact_that_has_not_ended_counts() {
    // e = 0.5, and the run ends with the step of the impact.
    let mut scene = between_planes(0.502, 2.0, -0.5);
    scene.contact.restitution = 0.5;
    let found = compared(&scene, &[Scheme::Velocity], &["dantzig"], 1);
    assert!(only(&found).laws.restitution.unwrap() < 1e-9, "{found:?}");
}

#[test]
fn the_best_solver_has_the_fewest_rejected_answers() {
    let scene = Scene::load("mass_ratio3").unwrap();
    let found = compared(&scene, &[Scheme::Velocity], &["jacobi", "enumeration", "dantzig"], 3);
    let [jacobi, ..] = &found.runs[..] else { panic!() };
    assert!(jacobi.tally.accepted < jacobi.tally.solves, "{jacobi:?}");
    assert_eq!(jacobi.failing_criterion(3, found.thinnest), Some("answers rejected"));
    assert_eq!(best(&found.runs).unwrap().solver, "dantzig");
    // More impacts are more problems: a count of accepted answers would prefer their solver.
    let [mut more, mut fewer] = [found.runs[0].clone(), found.runs[2].clone()];
    (more.tally.solves, more.tally.accepted) = (10, 9);
    (fewer.tally.solves, fewer.tally.accepted) = (8, 8);
    assert_eq!(best(&[more, fewer]).unwrap().solver, "dantzig");
}
