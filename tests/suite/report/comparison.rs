//! What a comparison says: nothing that was not measured.

use lcplab::report::study::comparison::{Comparison, LevelRefinement, Levels, Plan, Run, compare};
use lcplab::report::view::{View, comparison_answer, comparison_table};
use lcplab::scene::{Scene, Scheme};
use lcplab::solver::Registry;

/// Three steps of three bodies, the top one heavy, at velocity level.
fn compared(solvers: &[&str]) -> Comparison {
    let solvers: Vec<_> =
        solvers.iter().map(|name| Registry::standard().entry(name).unwrap().clone()).collect();
    compare(&Scene::load("mass_ratio3").unwrap(), &[Scheme::Velocity], &solvers, 3, &|| ()).0
}

/// What is said of a run after this change.
fn said(change: impl Fn(&mut Run)) -> String {
    let mut comparison = compared(&["dantzig"]);
    change(&mut comparison.runs[0]);
    comparison_answer(&comparison)
}

#[test]
fn a_run_that_keeps_its_laws_says_so_with_its_support() {
    let text = said(|_| ());
    assert!(
        text.contains("velocity: gaps and joints within tolerance for 1 of 1 solver ("),
        "{text}"
    );
    assert!(text.contains("; average support force 100 % of the weight; "), "{text}");
    assert!(text.contains(" J); no energy was added."), "{text}");
}

#[test]
fn a_fault_of_energy_is_explained_only_by_what_was_measured() {
    let fault = |run: &mut Run| {
        (run.laws.energy_error, run.laws.energy_tolerance) = (2.0, 1.0);
        run.laws.impact = Some("impacts added 2 J in step 1.".into());
    };
    let unexplained = said(fault);
    let wrong = "2 J were added, although nothing drives the bodies; no single account explains it";
    assert!(unexplained.contains(wrong), "{unexplained}");
    assert!(unexplained.contains(". First, impacts added 2 J in step 1."), "{unexplained}");
    let explained = said(|run| {
        fault(run);
        run.laws.account = Some(("bias".into(), 1.9));
    });
    let cause = "the largest contribution is the account bias: +1.9 J";
    assert!(explained.contains(cause), "{explained}");
    let without = said(|run| {
        fault(run);
        run.laws.has_ledger = false;
    });
    assert!(without.contains("; velocity has no energy ledger"), "{without}");
    let at_end = said(|run| run.scheme = "penalty".into());
    assert!(at_end.contains(" J); no energy was added at the end."), "{at_end}");
}

#[test]
fn the_matrix_of_schemes_has_each_error_in_multiples_of_its_tolerance() {
    let schemes = vec![Scheme::Velocity, Scheme::SplitImpulse, Scheme::Soft];
    let plan = Plan { solvers: Vec::new(), schemes, scenes: Vec::new() };
    let mut comparison = compared(&["dantzig"]);
    let run = comparison.runs[0].clone();
    let named = |scheme: &str| Run { scheme: scheme.into(), ..run.clone() };
    comparison.runs = ["velocity", "split-impulse", "soft"].map(named).to_vec();
    // One hundredth of the thinnest body is allowed; three are as far as the joint drifts.
    comparison.runs[1].motion[2].drift = 0.03 * comparison.thinnest;
    (comparison.runs[1].laws.energy_error, comparison.runs[1].laws.energy_tolerance) = (-5.0, 2.0);
    comparison.runs[2].steps = 2;
    let headline = plan.headline(std::slice::from_ref(&comparison));
    let csv = headline.figure.unwrap().csv();
    let rows: Vec<&str> = csv.lines().skip(1).collect();
    let expected = [
        "velocity,gaps and joints,mass ratio3,0",
        "velocity,energy,mass ratio3,0",
        "split-impulse,gaps and joints,mass ratio3,3",
        "split-impulse,energy,mass ratio3,2.5",
        "soft,gaps and joints,mass ratio3,inf",
        "soft,energy,mass ratio3,inf",
    ];
    assert_eq!(rows, expected);
    let answer = headline.answer.unwrap();
    let words = "**Of 3 time-stepping schemes use *velocity*: it keeps gaps and joints within 1 % of a body's thickness";
    assert!(answer.starts_with(words), "{answer}");
    // Who begins with larger errors is not judged: to correct them changes the energy.
    for run in &mut comparison.runs {
        run.motion[0].penetration = 0.02 * comparison.thinnest;
    }
    assert!(plan.headline(&[comparison]).figure.is_none());
}

#[test]
fn a_run_that_ended_early_is_measured_for_its_steps_alone() {
    let some = said(|run| run.steps = 2);
    assert!(some.contains("(ended early: 1); in 2 steps: average support force"), "{some}");
    let none = said(|run| run.steps = 0);
    let first = none.lines().next().unwrap();
    assert!(first.ends_with("within tolerance for 0 of 1 solver (ended early: 1)."), "{none}");
}

#[test]
fn a_solver_out_of_tolerance_counts_under_the_criterion_that_it_fails() {
    let text = comparison_answer(&compared(&["jacobi", "dantzig"]));
    assert!(text.contains("within tolerance for 1 of 2 solvers (errors up to "), "{text}");
    assert!(text.contains(", answers rejected: 1)"), "{text}");
}

#[test]
fn no_level_is_called_exact() {
    let level = |scheme: &str, error: f64| LevelRefinement {
        scheme: scheme.into(),
        solver: "dantzig".into(),
        halved: 0.0,
        errors: [Some(error); 3],
        mistimed: Some(2.0 * error),
    };
    let mut comparison = compared(&["dantzig"]);
    let levels = vec![level("velocity", 0.25), level("acceleration", 0.0)];
    comparison.levels = Some(Levels { levels, apart: 0.0 });
    let text = comparison_answer(&comparison);
    for sentence in [
        "At velocity level, impacts come up to 50 % of a step too early or too late and are off by \
         25 % of the approach in a step. At acceleration level, impacts do not change when the step is \
         divided (to 1e-6).",
        "At velocity level, bodies that spin freely are off by 25 % of the angular momentum or energy \
         in a step. At acceleration level, bodies that spin freely keep their angular momentum and \
         energy (to 1e-6).",
        "At velocity level, resting bodies are off by 25 % of the thinnest body, by gaps or overlaps. At \
         acceleration level, resting bodies stay in contact (to 1e-6).",
    ] {
        assert!(text.contains(sentence), "{text}");
    }
    assert!(!text.contains("exact"), "{text}");
}

#[test]
fn the_trouble_of_a_solver_stands_left_of_the_measures() {
    let table = comparison_table(&compared(&["jacobi", "dantzig"]));
    let titles: Vec<&str> = table.columns.iter().map(|column| column.title.as_str()).collect();
    assert_eq!(titles[5..8], ["accepted", "reason", "iterations per problem"]);
    assert!(table.rows.iter().all(|row| row.len() == titles.len()));
    assert!(table.rows[0][6].text.starts_with("step "), "{}", table.rows[0][6].text);
    assert_eq!(table.rows[1][6].text, "");
}

#[test]
fn the_top_of_a_report_counts_confirmed_answers() {
    let plan = Plan { solvers: Vec::new(), schemes: Vec::new(), scenes: Vec::new() };
    let mut comparison = compared(&["dantzig"]);
    let run = &mut comparison.runs[0];
    (run.tally.solves, run.tally.claimed, run.tally.rejected_claims) = (10, 8, 1);
    let headline = plan.headline(&[comparison]);
    let label =
        "answers accepted by an independent judge; 2 of 10 problems are left unanswered: dantzig";
    assert_eq!(headline.result, Some(([7, 8], label.to_string())));
}
