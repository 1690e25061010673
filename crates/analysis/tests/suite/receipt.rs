//! Receipts of steps with answers in closed form, and of steps in which one thing was changed.

use std::sync::Arc;

use lcplab_analysis::receipt::{Baseline, EngineStep, Receipt, Run, StepVerdict};
use serde_json::{Value, json};

/// 2 kg fall at 3 m/s on a row of compliance ½ s/kg: x = 3 N s, v = −1.5 m/s.
fn stop() -> Value {
    json!({"motion": {"mass": [[0, 0, 2.0]], "jacobian": [[0, 0, 1.0]], "bias": [0.0],
        "compliance": [0.5], "target": [-3.0]}})
}

fn read(problem: &Value, answer: &Value) -> EngineStep {
    EngineStep::read(problem, answer, "a.json").unwrap()
}

fn receipt(problem: &Value, answer: &Value) -> Receipt {
    Receipt::new(read(problem, answer), None, None).unwrap()
}

fn stage(receipt: &Receipt) -> Option<&'static str> {
    receipt.stage().map(|stage| stage.name())
}

#[test]
fn the_stage_of_an_error_is_the_one_that_made_it() {
    let answered = |x: f64, v: f64| receipt(&stop(), &json!({"x": [x], "motion": [v]}));
    assert_eq!(answered(3.0, -1.5).verdict(), StepVerdict::Ok);
    assert_eq!(stage(&answered(2.0, -2.0)), Some("solver"));
    assert_eq!(stage(&answered(3.0, -1.4)), Some("write-back"));
    assert_eq!(stage(&answered(1.5, -1.5)), Some("write-back"));
    let with_push = |push: f64| {
        let answer = json!({"x": [3.0], "motion": [-1.5], "reported_push": [push]});
        receipt(&stop(), &answer)
    };
    assert_eq!((stage(&with_push(3.0)), stage(&with_push(0.0))), (None, Some("write-back")));
}

/// 1 kg on an associated cone of slope 0.6 with compliance ½: x = (2.5, −1.5) is on the cone, and w
/// = v + x/2 = (0.6, 1) is on the dual cone and orthogonal to x, so that both are the solution.
fn slide() -> (Value, Value) {
    let (force, remains) = ([2.5, -1.5], [0.6, 1.0]);
    let motion = [0, 1].map(|i| remains[i] - 0.5 * force[i]);
    let target = [0, 1].map(|i| motion[i] - force[i]);
    let problem = json!({
        "motion": {"mass": [[0, 0, 1.0], [1, 1, 1.0]], "jacobian": [[0, 0, 1.0], [1, 1, 1.0]],
            "bias": [0.0, 0.0], "compliance": [0.5, 0.5], "target": target},
        "lo": [0.0, "-inf"], "friction_index": [-1, 0], "mu": [0.0, 0.6],
        "model": "associated-cone",
    });
    (problem, json!({"x": force, "motion": motion}))
}

#[test]
fn a_cone_in_closed_form_is_accepted_and_a_force_outside_it_is_not() {
    let (problem, answer) = slide();
    assert_eq!(receipt(&problem, &answer).verdict(), StepVerdict::Ok);
    // The friction bound is missing: the slip is stopped by x_t = −v_t / (1 + ½).
    let target = problem["motion"]["target"].as_array().unwrap();
    let target: Vec<f64> = target.iter().map(|value| value.as_f64().unwrap()).collect();
    let forces = [2.5, -target[1] / 1.5];
    let motion = [target[0] + forces[0], target[1] + forces[1]];
    let wrong = receipt(&problem, &json!({"x": forces, "motion": motion}));
    assert_eq!(stage(&wrong), Some("solver"));
}

/// 2 kg are pressed on a floor at 3 m/s and slide at 4 m/s on a coupled box or Coulomb's cone: x =
/// (6, −½ · 6) N s stops them on the floor and leaves 2.5 m/s.
fn pressed(model: Option<&str>) -> Value {
    let mut problem = json!({
        "motion": {"mass": [[0, 0, 2.0], [1, 1, 2.0]], "jacobian": [[0, 0, 1.0], [1, 1, 1.0]],
            "bias": [0.0, 0.0], "compliance": [0.0, 0.0], "target": [-3.0, 4.0]},
        "lo": [0.0, "-inf"], "friction_index": [-1, 0], "mu": [0.0, 0.5],
    });
    if let Some(model) = model {
        problem["model"] = json!(model);
    }
    problem
}

#[test]
fn a_coupled_box_is_judged_with_the_friction_limits_of_the_answer() {
    let problem = pressed(None);
    let right = receipt(&problem, &json!({"x": [6.0, -3.0], "motion": [0.0, 2.5]}));
    assert_eq!(right.verdict(), StepVerdict::Ok);
    assert!(right.motion_error().unwrap() < 1e-7 && right.difference().unwrap() < 1e-7);
    let stuck = receipt(&problem, &json!({"x": [6.0, -8.0], "motion": [0.0, 0.0]}));
    assert_eq!((stuck.verdict(), stage(&stuck)), (StepVerdict::Wrong, Some("solver")));
    // 2.5 m/s too slow, where the constraints change (3, 4) m/s.
    assert!(stuck.motion_error().unwrap() >= 0.5 - 1e-12);
    assert!((stuck.difference().unwrap() - 0.5).abs() < 1e-7);
    // Without friction: 1.5 m/s too fast, where the constraints change 3 m/s.
    let slips = receipt(&problem, &json!({"x": [6.0, 0.0], "motion": [0.0, 4.0]}));
    assert_eq!(stage(&slips), Some("solver"));
    assert!(slips.motion_error().unwrap() >= 0.5 - 1e-12);
}

#[test]
fn rigid_rows_whose_motion_is_not_that_of_the_forces_are_rejected_at_write_back() {
    // The impulse is applied twice; as an answer to the problem, it is also wrong.
    let twice = receipt(&pressed(None), &json!({"x": [6.0, -8.0], "motion": [3.0, -4.0]}));
    assert_eq!(stage(&twice), Some("write-back"));
}

#[test]
fn an_answer_without_a_motion_is_compared_with_the_law_and_not_with_itself() {
    let wrong = receipt(&pressed(None), &json!({"x": [6.0, 0.0]}));
    assert_eq!(stage(&wrong), Some("solver"));
    assert!(wrong.text().contains("not checked   write-back: the motion"), "{}", wrong.text());
    assert!(wrong.findings().iter().all(|own| own.stage.name() != "write-back"));
}

#[test]
fn coulombs_cone_is_judged_with_the_slip_of_the_answer() {
    // With compliance ½ of both rows: x_n = 6 / (1 + ½ · 2) = 3, v_n = −1.5, and |x_t| = ½ · 3.
    let mut problem = pressed(Some("coulomb-cone"));
    problem["motion"]["compliance"] = json!([0.5, 0.5]);
    let right = receipt(&problem, &json!({"x": [3.0, -1.5], "motion": [-1.5, 3.25]}));
    assert_eq!(right.verdict(), StepVerdict::Ok);
    assert!(right.motion_error().unwrap() < 1e-7);
    // The associated law lifts the mass until w_n = μ w_t; its answer is not one of Coulomb's law.
    problem["model"] = json!("associated-cone");
    let [x_n, x_t] = [4.0, -2.0];
    let associated = json!({"x": [x_n, x_t], "motion": [-3.0 + x_n / 2.0, 4.0 + x_t / 2.0]});
    assert_eq!(receipt(&problem, &associated).verdict(), StepVerdict::Ok);
    problem["model"] = json!("coulomb-cone");
    assert_eq!(stage(&receipt(&problem, &associated)), Some("solver"));
}

#[test]
fn the_iteration_cap_excuses_a_method_that_needs_the_iterations_and_no_other() {
    let with = |method: &str| {
        let mut problem = stop();
        problem["source"] = json!({"engine": "mine", "method": method, "iterations": 100,
            "has_converged": false});
        receipt(&problem, &json!({"x": [2.0], "motion": [-2.0]})).verdict()
    };
    assert_eq!((with("pgs"), with("newton")), (StepVerdict::Unconverged, StepVerdict::Wrong));
}

#[test]
fn a_bound_above_the_limit_is_tightened_by_an_accurate_motion() {
    // Three masses in a chain of compliant rows, one of them 10⁸ times as soft as the others. The
    // solution by elimination: x = (J M⁻¹ Jᵀ + R)⁻¹ (−J u* − bias), all rows being equations.
    let problem = json!({
        "motion": {"mass": [[0, 0, 1.0], [1, 1, 100.0]], "jacobian": [[0, 0, 1.0], [1, 0, -1.0],
            [1, 1, 1.0]], "bias": [0.0, 0.0], "compliance": [1e-8, 1.0], "target": [-3.0, -3.0]},
        "lo": ["-inf", "-inf"],
    });
    let (a, b, c) = (1.0 + 1e-8, -1.0, 1.0 + 0.01 + 1.0);
    let right = [3.0, 0.0];
    let determinant = a * c - b * b;
    let x =
        [(c * right[0] - b * right[1]) / determinant, (a * right[1] - b * right[0]) / determinant];
    let motion = [-3.0 + x[0] - x[1], -3.0 + 0.01 * x[1]];
    // v is off by 10⁻⁷ along the stiff row: the gap alone multiplies that by the stiffness.
    let off = json!({"x": x, "motion": [motion[0] + 1e-7, motion[1]]});
    let checked = Receipt::new(read(&problem, &off), None, Some(1e-9)).unwrap();
    let bound = checked.bound().unwrap();
    assert!((1e-7..2e-7).contains(&bound), "{bound}");
}

#[test]
fn a_bound_is_tightened_for_cones_with_different_coefficients_along_their_axes() {
    // M = J = compliance = 1. x = (5, 1 · 3, ¼ · 4) is on the surface of the cone with
    // coefficients 1 and ¼, and w = (5, −3 / 1, −4 / ¼) on that of its dual, with x·w = 0: they are
    // the solution, v = w − x = (0, −6, −17) and u* = v − x.
    let unit = json!([[0, 0, 1.0], [1, 1, 1.0], [2, 2, 1.0]]);
    let problem = json!({
        "motion": {"mass": unit, "jacobian": unit, "bias": [0.0, 0.0, 0.0],
            "compliance": [1.0, 1.0, 1.0], "target": [-5.0, -9.0, -18.0]},
        "lo": [0.0, "-inf", "-inf"], "friction_index": [-1, 0, 0], "mu": [0.0, 1.0, 0.25],
        "model": "associated-cone",
    });
    // On the surface of a cone a rounding error of x or w is the square of one of the bound.
    let rounding = 1e-6;
    for error in [1e-1, 1e-3, 1e-5] {
        let answer = json!({"x": [5.0, 3.0, 1.0], "motion": [error, -6.0, -17.0]});
        let bound = receipt(&problem, &answer).bound().unwrap();
        assert!(bound >= error && bound < error + rounding, "{bound:e} of {error:e}");
    }
}

#[test]
fn a_negative_compliance_or_coefficient_of_friction_is_invalid() {
    let answer = json!({"x": [3.0], "motion": [-1.5]});
    let mut negative = stop();
    negative["motion"]["compliance"] = json!([-1.0]);
    let error = EngineStep::read(&negative, &answer, "a.json").unwrap_err().to_string();
    assert!(error.contains("compliance: is -1 in row 0, must not be negative"), "{error}");
    let mut rough = pressed(None);
    rough["mu"] = json!([0.0, -0.5]);
    let answer = json!({"x": [6.0, -3.0], "motion": [0.0, 2.5]});
    let error = EngineStep::read(&rough, &answer, "a.json").unwrap_err().to_string();
    assert!(error.contains("mu: is -0.5 in row 1, must not be negative"), "{error}");
}

/// What a step without a bound on its motion gives: the stage, and whether a residual is stated.
fn unbounded(problem: &Value, forces: [f64; 2], motion: [f64; 2]) -> (Option<&'static str>, bool) {
    let checked = receipt(problem, &json!({"x": forces, "motion": motion}));
    assert_eq!(checked.motion_error(), None, "{}", checked.text());
    assert_eq!(checked.verdict() == StepVerdict::Ok, checked.stage().is_none());
    (stage(&checked), checked.residual().is_some())
}

#[test]
fn a_rigid_contact_is_judged_by_coulombs_law() {
    let rigid = pressed(Some("coulomb-cone"));
    // By hand, as for the coupled box; then without friction, with twice the friction, pulling, and
    // a mass that moves into the floor.
    assert_eq!(unbounded(&rigid, [6.0, -3.0], [0.0, 2.5]), (None, true));
    for (forces, motion) in [
        ([6.0, 0.0], [0.0, 4.0]),
        ([6.0, -6.0], [0.0, 1.0]),
        ([-6.0, 0.0], [-6.0, 4.0]),
        ([0.0, 0.0], [-3.0, 4.0]),
    ] {
        assert_eq!(unbounded(&rigid, forces, motion), (Some("solver"), true), "{forces:?}");
    }
    // The impulse is applied twice.
    assert_eq!(unbounded(&rigid, [6.0, -3.0], [3.0, 1.0]), (Some("write-back"), false));
    // The associated law lifts the mass until w = (1, 2) is orthogonal to x = (8, −4).
    let associated = pressed(Some("associated-cone"));
    assert_eq!(unbounded(&associated, [8.0, -4.0], [1.0, 2.0]), (None, true));
    assert_eq!(unbounded(&associated, [6.0, -3.0], [0.0, 2.5]), (Some("solver"), true));
}

#[test]
fn the_residual_of_a_rigid_contact_is_that_of_its_row_alone() {
    // 2 kg move into the floor at 3 m/s with no impulse: √A (w / A) = √½ · 6, of 3 √2 by gravity.
    let mut problem = pressed(Some("coulomb-cone"));
    problem["motion"]["target"] = json!([-3.0, 0.0]);
    problem["source"] = json!({"gravity": 3.0 * 2f64.sqrt()});
    let sinks = receipt(&problem, &json!({"x": [0.0, 0.0], "motion": [-3.0, 0.0]}));
    assert!((sinks.residual().unwrap() - 1.0).abs() < 1e-12, "{}", sinks.text());
    assert!(sinks.text().contains(" of the change by gravity (limit"), "{}", sinks.text());
}

#[test]
fn a_contact_with_compliance_along_its_normal_only_is_judged_too() {
    // x_n = 6 / (1 + ½ · 2) = 3 and v_n = −1.5.
    let mut problem = pressed(Some("coulomb-cone"));
    problem["motion"]["compliance"] = json!([0.5, 0.0]);
    assert_eq!(unbounded(&problem, [3.0, -1.5], [-1.5, 3.25]), (None, true));
    assert_eq!(unbounded(&problem, [3.0, 0.0], [-1.5, 4.0]), (Some("solver"), true));
    assert_eq!(unbounded(&problem, [3.0, -1.5], [-1.5, 3.0]), (Some("write-back"), false));
}

#[test]
fn equations_that_depend_on_each_other_are_judged() {
    let problem = json!({"motion": {"mass": [[0, 0, 2.0]], "jacobian": [[0, 0, 1.0], [1, 0, 1.0]],
        "bias": [0.0, 0.0], "compliance": [0.0, 0.0], "target": [-3.0]}, "lo": ["-inf", "-inf"]});
    let answered = |x: [f64; 2], v: f64| receipt(&problem, &json!({"x": x, "motion": [v]}));
    assert_eq!(answered([3.0, 3.0], 0.0).verdict(), StepVerdict::Ok);
    assert_eq!(stage(&answered([3.0, 2.0], -0.5)), Some("solver"));
}

#[test]
fn forces_outside_their_bounds_are_rejected_in_a_problem_that_is_not_known_completely() {
    let of = |forces: [f64; 2]| {
        let answer = json!({"x": forces, "motion": [0.0, 0.0]});
        let mut problem = pressed(Some("associated-cone"));
        problem["motion"]["compliance"] = json!([0.1, 0.1]);
        let step = read(&problem, &answer);
        let step = EngineStep { no_bound: Some("because of a closed loop".into()), ..step };
        Receipt::new(step, None, None).unwrap()
    };
    assert_eq!(of([6.0, -3.0]).verdict(), StepVerdict::NotChecked);
    assert_eq!(
        (stage(&of([6.0, -3.1])), stage(&of([-1.0, 0.0]))),
        (Some("solver"), Some("solver"))
    );
}

#[test]
fn a_mass_matrix_that_is_not_positive_definite_is_an_error_of_assembly() {
    for mass in [json!([[0, 0, -2.0]]), json!([[0, 0, 0.0]]), json!([])] {
        let mut problem = stop();
        problem["motion"]["mass"] = mass;
        let wrong = receipt(&problem, &json!({"x": [3.0], "motion": [-1.5]}));
        assert_eq!((stage(&wrong), wrong.findings().len()), (Some("assembly"), 1));
        assert!(wrong.text().contains("M is not positive definite: mass[0, 0] is "));
    }
    // [1 2; 2 1] has the eigenvalue −1.
    let mut problem = pressed(None);
    problem["motion"]["mass"] = json!([[0, 0, 1.0], [0, 1, 2.0], [1, 1, 1.0]]);
    let wrong = receipt(&problem, &json!({"x": [6.0, -3.0], "motion": [0.0, 2.5]}));
    assert_eq!(stage(&wrong), Some("assembly"), "{}", wrong.text());
}

#[test]
fn a_coefficient_of_friction_that_is_not_a_number_is_named_and_nothing_else() {
    let mut problem = pressed(Some("coulomb-cone"));
    problem["mu"] = json!([0.0, "nan"]);
    let wrong = receipt(&problem, &json!({"x": [6.0, -3.0], "motion": [0.0, 2.5]}));
    assert_eq!(wrong.rejected().map(|own| own.what.as_str()), Some("mu[1] is nan"));
}

#[test]
fn a_solver_that_stopped_at_its_own_loose_tolerance_is_unconverged_and_not_wrong() {
    // v is 0.1 m/s off, of 1.6 m/s; the engine's tolerance is 0.01 of that.
    let with = |tolerance: f64, limit: Option<f64>| {
        let mut problem = stop();
        problem["source"] = json!({"method": "cg", "own_tolerance": tolerance});
        let step = read(&problem, &json!({"x": [3.2], "motion": [-1.4]}));
        Receipt::new(step, None, limit).unwrap()
    };
    let loose = with(0.014 * 2f64.sqrt(), None);
    assert_eq!(loose.verdict(), StepVerdict::Unconverged, "{}", loose.text());
    assert!(loose.text().contains("of the engine: 0.009 of the change by the constraints, looser"));
    assert_eq!(with(1e-9, None).verdict(), StepVerdict::Wrong);
    assert_eq!(with(0.014 * 2f64.sqrt(), Some(1e-3)).verdict(), StepVerdict::Wrong);
}

#[test]
fn the_divisor_of_an_error_is_named() {
    let named = |gravity: f64, x: f64| {
        let mut problem = stop();
        problem["source"] = json!({"gravity": gravity});
        let checked = receipt(&problem, &json!({"x": [x], "motion": [-3.0 + x / 2.0]}));
        checked.text().lines().nth(2).unwrap().to_string()
    };
    assert!(named(0.0, 3.0).contains(" of the change by the constraints (limit"));
    assert!(named(9.0, 3.0).contains(" of the change by gravity (limit"));
    let nothing = named(0.0, 0.0);
    assert!(nothing.contains(" of a millionth of the motion without constraints"), "{nothing}");
}

/// A run of frames with these errors of v (m/s), named by their places.
fn run(errors: &[f64], baseline: Option<&Run>) -> Run {
    let answer = |error: f64| json!({"x": [3.0], "motion": [-1.5 + error]});
    let frame = |(k, error): (usize, &f64)| {
        (format!("frame {k}"), Arc::new(receipt(&stop(), &answer(*error))))
    };
    let text = baseline.map(|run| Value::Object(run.to_json()).to_string());
    let baseline = text.map(|text| Baseline::from_json("base.json", &text).unwrap());
    Run::new(errors.iter().enumerate().map(frame).collect(), baseline)
}

/// Frames whose motions have these errors, with the names of the first ones.
fn spread(count: u32) -> Vec<f64> {
    (0..count).map(|k| 1e-9 * f64::from(k % 7)).collect()
}

#[test]
fn a_run_is_worse_if_more_errors_exceed_a_quantile_of_the_baseline_than_chance_explains() {
    let base = run(&spread(100), None);
    assert!(run(&spread(100), Some(&base)).is_ok());
    let worse = run(&[1e-7; 100], Some(&base));
    assert!(!worse.is_ok() && !worse.worse().is_empty(), "{}", worse.text());
    assert!(worse.junit().contains("failures=\"1\""));
}

#[test]
fn nine_of_a_hundred_errors_above_the_largest_of_the_baseline_are_found_and_five_are_not() {
    let base = run(&[3e-9; 100], None);
    let with = |count: usize| {
        let mut errors = vec![3e-9; 100];
        errors[..count].fill(3e-7);
        run(&errors, Some(&base))
    };
    assert!(!with(9).is_ok() && with(5).is_ok());
    let text = with(9).text();
    assert!(text.contains("9 of 100 errors are above the baseline's 50 % quantile"), "{text}");
    assert!(text.contains("compared with 100 errors in the baseline: how many are above"));
}

#[test]
fn errors_below_a_thousandth_of_the_limit_never_count_as_worse() {
    // The limit of a direct solver is 1e-6.
    let base = run(&[1e-12; 100], None);
    assert!(run(&[5e-10; 100], Some(&base)).is_ok());
}

#[test]
fn a_run_that_is_too_short_to_be_compared_says_so() {
    let base = run(&[1e-9; 4], None);
    let short = run(&[3e-7; 4], Some(&base));
    assert!(short.text().contains("too few errors to compare with the baseline: 4, there 4"));
}

#[test]
fn frames_of_the_baseline_that_are_missing_fail_a_run() {
    let base = run(&spread(100), None);
    let shorter = run(&spread(98), Some(&base));
    assert_eq!(shorter.missing(), ["frame 98", "frame 99"]);
    let text = shorter.text();
    assert!(text.starts_with("not ok"), "{text}");
    assert!(text.contains("2 frames of the baseline are missing: frame 98, frame 99"), "{text}");
    assert!(run(&spread(102), Some(&base)).is_ok());
}

/// A run of frames, each with the generalized force that the engine reports, if it does.
fn reported(pushes: &[Option<f64>], baseline: Option<&Run>) -> Run {
    let frame = |(k, push): (usize, &Option<f64>)| {
        let mut answer = json!({"x": [3.0], "motion": [-1.5]});
        if let Some(push) = push {
            answer["reported_push"] = json!([push]);
        }
        (format!("frame {k}"), Arc::new(receipt(&stop(), &answer)))
    };
    let text = baseline.map(|run| Value::Object(run.to_json()).to_string());
    let baseline = text.map(|text| Baseline::from_json("base.json", &text).unwrap());
    Run::new(pushes.iter().enumerate().map(frame).collect(), baseline)
}

#[test]
fn a_check_of_the_baseline_that_is_lost_fails_a_run() {
    let base = reported(&[Some(3.0); 20], None);
    assert!(reported(&[Some(3.0); 20], Some(&base)).is_ok());
    let lost = reported(&[None; 20], Some(&base));
    assert!(!lost.is_ok() && lost.lost().len() == 1, "{}", lost.text());
    let sentence = "no longer checked in 20 of 20 frames: write-back: generalized forces";
    assert!(lost.text().contains(sentence), "{}", lost.text());
    let one = reported(&[None], Some(&reported(&[Some(3.0)], None)));
    assert!(!one.is_ok(), "{}", one.text());
    // More than the baseline checked is no loss.
    assert!(reported(&[Some(3.0); 20], Some(&reported(&[None; 20], None))).is_ok());
}

#[test]
fn a_baseline_without_the_frames_is_to_be_recorded_again() {
    let old = r#"{"frames": 1, "rejected": {}, "spreads": {}}"#;
    let error = Baseline::from_json("base.json", old).unwrap_err().to_string();
    assert!(error.contains("record it again"), "{error}");
}

/// A run with one good frame and frames at the iteration limit.
fn capped(count: usize, baseline: Option<&Run>) -> Run {
    let mut problem = stop();
    problem["source"] = json!({"method": "pgs", "iterations": 9, "has_converged": false});
    let frame = |k: usize| {
        let (x, v) = if k == 0 { (3.0, -1.5) } else { (2.0, -2.0) };
        let answer = json!({"x": [x], "motion": [v]});
        (format!("frame {k}"), Arc::new(receipt(&problem, &answer)))
    };
    let text = baseline.map(|run| Value::Object(run.to_json()).to_string());
    let baseline = text.map(|text| Baseline::from_json("base.json", &text).unwrap());
    Run::new((0..=count).map(frame).collect(), baseline)
}

#[test]
fn a_run_whose_solver_was_checked_in_less_than_half_of_its_frames_is_not_ok_without_a_baseline() {
    assert!(capped(1, None).is_ok());
    let mostly = capped(19, None);
    assert!(!mostly.is_ok());
    let reason = mostly.unchecked().unwrap();
    assert!(
        reason.contains("in 1 of 20 frames with rows, which is less than half: 19 unconverged")
    );
    // A baseline accepts this, and not more.
    assert!(capped(19, Some(&mostly)).is_ok());
    let good = run(&[0.0; 20], None);
    let text = capped(19, Some(&good)).text();
    let lost =
        "the solver was checked in 1 of 20 frames, in the baseline in 20 of 20: 19 unconverged";
    assert!(text.starts_with("not ok") && text.contains(lost), "{text}");
}

#[test]
fn a_run_that_checked_nothing_is_not_ok() {
    let reason = run(&[], None).unchecked().unwrap();
    assert_eq!(reason, "no frame is ok or wrong: there are no frames");
    assert!(!run(&[], None).is_ok());
}
