//! Receipts of steps with answers in closed form, and of steps in which one thing was changed.

use std::sync::Arc;

use lcplab_study::receipt::{Baseline, EngineStep, Receipt, Run, StepVerdict};
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

fn run(errors: &[f64], baseline: Option<&Run>) -> Run {
    let answer = |error: f64| json!({"x": [3.0], "motion": [-1.5 + error]});
    let frame = |(k, error): (usize, &f64)| {
        (format!("frame {k}"), Arc::new(receipt(&stop(), &answer(*error))))
    };
    let text = baseline.map(|run| Value::Object(run.to_json()).to_string());
    let baseline = text.map(|text| Baseline::from_json("base.json", &text).unwrap());
    Run::new(errors.iter().enumerate().map(frame).collect(), baseline)
}

#[test]
fn a_run_is_worse_if_a_quantile_exceeds_that_of_the_baseline_by_more_than_its_spread() {
    let spread: Vec<f64> = (0..100).map(|k| 1e-9 * f64::from(k % 7)).collect();
    let base = run(&spread, None);
    assert!(run(&spread[..50], Some(&base)).is_ok());
    let worse = run(&[1e-7; 50], Some(&base));
    assert!(!worse.is_ok() && worse.worse().len() == 2, "{:?}", worse.worse());
    assert!(worse.junit().contains("failures=\"1\""));
}

#[test]
fn a_run_that_checked_nothing_is_not_ok() {
    assert_eq!(run(&[], None).unchecked().unwrap(), "no frame was checked: there are no frames");
    assert!(!run(&[], None).is_ok());
}
