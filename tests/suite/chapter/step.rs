//! E28 to E39, the step of Code 7: the figures that theory gives.

use lcplab::chapter::exhibit::{self, Finding, Outcome};
use lcplab::scene::{Scene, Scheme};
use lcplab::simulation::Simulation;
use lcplab::solver;

const DT: f64 = 1.0 / 60.0;
const G: f64 = 9.81;

fn found(id: &str) -> Finding {
    let finding = exhibit::named(id).unwrap().found().unwrap().unwrap();
    assert!(finding.is_shown(), "{id}");
    finding
}

/// What a measure found in print.
fn printed(finding: &Finding, measure: usize) -> Vec<f64> {
    match &finding.measures[measure].printed {
        Outcome::Numbers(values) => values.clone(),
        Outcome::Impossible(reason) => panic!("{reason}"),
    }
}

#[track_caller]
fn assert_near(ours: f64, theory: f64) {
    assert!((ours - theory).abs() <= 1e-9 * theory.abs().max(1.0), "{ours}, by theory {theory}");
}

#[test]
fn e28_an_impulse_in_the_equation_stops_a_sixtieth_of_the_fall() {
    let finding = found("E28");
    let free = -1.0 - G * DT;
    assert_near(printed(&finding, 0)[0], free * (1.0 - DT)); // −1.1441
    assert_near(printed(&finding, 1)[0], free * (1.0 - 1.0 / DT));
}

#[test]
fn e29_the_comments_force_in_the_codes_step_pulls() {
    let lambda = 1.0 / DT + G; // 69.81 N
    assert_near(printed(&found("E29"), 0)[0], -1.0 - G * DT - lambda); // −70.97
}

/// By hand: x = Π(−s_b s_J u*) and u⁺ = u* + s_u s_J x. An x that is not clamped stops the body if
/// s_u s_b = 1, and doubles its speed if not; s_J s_b and the bound decide whether approach is
/// clamped or parting.
#[test]
fn e30_four_of_sixteen_combinations_are_right() {
    let finding = found("E30");
    let rows = &finding.tables[0].rows;
    assert_eq!(rows.len(), 16);
    for row in rows {
        let sign = |cell: &str| if cell.contains('−') { -1.0 } else { 1.0 };
        let [jacobian, b, step] = [0, 1, 2].map(|k| sign(&row[k]));
        let bound = if row[3].contains('≥') { 1.0 } else { -1.0 };
        let stops = step * b > 0.0;
        let opens_for_approach = jacobian * b * bound > 0.0;
        assert_eq!(row[5].contains("right"), stops && opens_for_approach, "{row:?}");
    }
    assert_eq!(rows.iter().filter(|row| row[5].contains('✓')).count(), 4);
    assert_eq!(printed(&finding, 0), [-1.0, 0.0]); // falls through, and is sucked back
    assert_eq!(printed(&finding, 1), [-1.0, 0.0]);
    assert_eq!(printed(&finding, 2), [-1.0, 2.0]); // pushed off what it leaves
}

#[test]
fn e31_a_nail_by_default_falls_freely() {
    let finding = found("E31");
    assert_eq!(printed(&finding, 0), [0.0]); // glued
    assert_near(printed(&finding, 1)[0], G * DT * DT * 1830.0); // 4.987 m
}

#[test]
fn e32_the_weight_of_sixty_frames_acts_at_once() {
    let finding = found("E32");
    assert_eq!(printed(&finding, 0), [10.0]);
    assert_near(printed(&finding, 1)[0], -60.0 * G); // −588.60 N
    assert_near(printed(&finding, 2)[0], -61.0 * G * DT); // −9.9735 m/s
}

#[test]
fn e33_two_bodies_get_twice_the_feedback() {
    let finding = found("E33");
    assert_near(printed(&finding, 0)[0] / (0.1 * 1.4f64.powi(60)), 1.0); // 5.86e7 m
    assert_near(printed(&finding, 1)[0], 0.8);
    assert_near(printed(&finding, 3)[0], 1.0 - 0.2 * DT); // 0.996667
}

#[test]
fn e34_feedback_without_dt_is_sixty_times_weaker() {
    let finding = found("E34");
    assert_near(printed(&finding, 0)[0], 100.0 * (1.0 - 0.1 * DT).powi(60)); // 90.5 mm
    assert_eq!(printed(&finding, 1)[0], (0.5f64.ln() / (1.0 - 0.1 * DT).ln()).ceil()); // 416
    assert_near(printed(&finding, 3)[0], (1.0 - 0.1 * DT / 4.0).powi(10));
}

#[test]
fn e35_the_printed_sign_lets_the_error_grow() {
    let finding = found("E35");
    assert_near(printed(&finding, 0)[0], 0.1 * 1.1f64.powi(60)); // 30.4 m
    assert_near(printed(&finding, 1)[0], 1.0 + 0.2 * DT); // 1.00333
    assert_near(printed(&finding, 2)[0], 1.1);
}

#[test]
fn e37_the_printed_ball_never_rises() {
    let finding = found("E37");
    assert!(printed(&finding, 0)[0].abs() < 1e-12);
    assert_eq!(printed(&finding, 1), [0.0]);
}

#[test]
fn e38_the_strict_test_costs_one_step_of_fall() {
    let finding = found("E38");
    let step = -1e3 * G * DT * DT; // −2.725 mm
    for measure in 0..3 {
        assert_near(printed(&finding, measure)[0], step);
    }
}

#[test]
fn e39_feedback_ignores_the_mass_and_a_spring_does_not() {
    let finding = found("E39");
    for measure in [0, 1] {
        assert_near(printed(&finding, measure)[0], -0.2 * 0.1 / DT); // −1.2 m/s
    }
    for measure in [2, 3] {
        assert_near(printed(&finding, measure)[0], 0.1 * 0.8f64.powi(10)); // 0.010737 m
    }
    assert_near(printed(&finding, 4)[0], 1.2);
    // (2 · 0.4 − dt · 300 · 0.1)/(2 + 20 dt + 300 dt²) = 0.3/(2 + 1/3 + 1/12)
    assert_near(finding.measures[0].truth[0], 0.3 / (2.0 + 1.0 / 3.0 + 1.0 / 12.0)); // 0.124138
}

/// The height above the ground that a body at rest so deep reaches with β = 0.2.
fn thrown_from(depth: f64) -> f64 {
    let text = format!(
        "[step]\ndt = {DT}\nbaumgarte = 0.2\n\
         [[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n\
         [[bodies]]\nname = \"body\"\nmass = 1\nshape = \"point\"\nposition = [0, 0, -{depth}]\n"
    );
    let mut scene = Scene::from_toml("overlap.toml", &text).unwrap();
    scene.step.scheme = Scheme::Velocity;
    let solver =
        solver::Registry::standard().entry("dantzig").unwrap().build(&solver::Options::default());
    let mut simulation = Simulation::new(scene, solver);
    let mut top = f64::NEG_INFINITY;
    simulation.run(300, |step| {
        top = top.max(step.states[1].pose.p.z);
        std::ops::ControlFlow::Continue(())
    });
    top
}

/// By hand: after the first step the body is at −0.8 d and rises at 12 d; the flight of the steps
/// after it takes it up by at most (12 d)²/2g − 12 d dt/2 and an eighth of g dt². That is more than
/// 0.8 d from d = 0.9 · 2g/144 = 0.1226 on. From 0.1 m it goes no further than the ground.
#[test]
fn e39_only_a_deep_overlap_throws_a_body_out() {
    assert!(thrown_from(0.1) <= 1e-12, "{}", thrown_from(0.1));
    assert!(thrown_from(0.12) <= 1e-12, "{}", thrown_from(0.12));
    assert!(thrown_from(0.125) > 1e-3, "{}", thrown_from(0.125));
    let speed = 12.0 * 0.3;
    let top = -0.24 + speed * speed / (2.0 * G) - speed * DT / 2.0;
    assert!((thrown_from(0.3) - top).abs() <= G * DT * DT / 8.0);
}
