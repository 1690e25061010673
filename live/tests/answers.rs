//! What the module answers, compared with closed forms.

use std::f64::consts::PI;

use lcplab_judge::{ConeProof, cone_proof};
use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law};
use lcplab_lcp::{Lcp, Matrix};
use serde_json::{Value, json};

fn ask(question: Value) -> Value {
    serde_json::from_str(&lcplab_live::answer(&question.to_string())).unwrap()
}

fn column(masses: &[f64]) -> Value {
    ask(json!({ "ask": "column", "masses": masses, "dt": 0.01 }))["problem"].clone()
}

#[test]
fn a_sweep_of_a_column_leaves_what_the_formula_says() {
    for n in 1..=12 {
        let problem = column(&vec![1.0; n]);
        let found =
            ask(json!({ "ask": "trace", "solver": "pgs", "sweeps": 1, "problem": problem }));
        // All rows are free in the answer; after one sweep from 0 all of them push already.
        let rho = (PI / (2 * n) as f64).cos().powi(2);
        assert!((found["rate"].as_f64().unwrap() - rho).abs() < 1e-6, "{n}: {}", found["rate"]);
    }
}

#[test]
fn two_bodies_obey_the_law_of_the_mass_ratio() {
    for ratio in [0.1, 1.0, 10.0, 100.0] {
        let problem = column(&[1.0, ratio]);
        let found =
            ask(json!({ "ask": "trace", "solver": "pgs", "sweeps": 1, "problem": problem }));
        let rho = ratio / (1.0 + ratio);
        assert!((found["rate"].as_f64().unwrap() - rho).abs() < 1e-6, "{ratio}: {}", found["rate"]);
    }
}

#[test]
fn every_method_finds_what_each_contact_of_a_column_carries() {
    let masses = [1.0, 2.0, 3.0];
    for solver in ["pgs", "sor", "jacobi", "dantzig", "lemke", "murty"] {
        let question =
            json!({ "ask": "trace", "solver": solver, "omega": 1.2, "problem": column(&masses) });
        let found = ask(question);
        for (i, above) in [6.0, 5.0, 3.0].into_iter().enumerate() {
            let x = found["x"][i].as_f64().unwrap();
            assert!((x - 9.81 * 0.01 * above).abs() < 1e-6, "{solver}: {x}");
        }
        assert_eq!(found["status"], "solved", "{solver}");
    }
}

#[test]
fn a_column_that_is_solved_stands_and_one_that_is_not_sinks() {
    let motion = |solver: &str, sweeps: Option<usize>, warm: bool| {
        let question = json!({ "ask": "motion", "masses": [1, 1, 1, 1, 1], "dt": 0.01, "steps": 200,
            "solver": solver, "sweeps": sweeps, "warm": warm });
        ask(question)["frames"][199]["z"][4].as_f64().unwrap()
    };
    assert!(motion("dantzig", None, false).abs() < 1e-12);
    let (cold, warm) = (motion("pgs", Some(10), false), motion("pgs", Some(10), true));
    assert!(cold < -0.1 && warm > cold / 100.0, "{cold} {warm}");
}

#[test]
fn a_sliding_block_stops_where_the_law_says_and_under_the_box_axis_by_axis() {
    let question = json!({ "ask": "slide", "mu": 0.5, "speed": [2.4, 1.8], "directions": 4, "dt": 0.001, "steps": 2000 });
    let found = ask(question);
    let end = |k: usize| {
        let path = found["models"][k]["path"].as_array().unwrap();
        [0, 1].map(|i| path[path.len() - 1][i].as_f64().unwrap())
    };
    let reach = |v: f64| v * v / (2.0 * 0.5 * 9.81);
    // Half a step short, for the velocity is updated before the place.
    let near = |p: [f64; 2], q: [f64; 2]| (0..2).all(|i| (p[i] - q[i]).abs() < 2e-3);
    assert!(near(end(0), [reach(2.4), reach(1.8)]), "{:?}", end(0));
    assert!(near(end(2), [0.8 * reach(3.0), 0.6 * reach(3.0)]), "{:?}", end(2));
}

#[test]
fn a_rod_has_one_force_below_the_critical_friction_and_none_or_two_above() {
    // tan θ = 2: the critical friction is 4/3, and ω² sin θ − 1 decides between none and two.
    let theta = 2f64.atan().to_degrees();
    let rod = |mu: f64, omega: f64| {
        ask(json!({ "ask": "rod", "mu": mu, "theta": theta, "omega": omega }))
    };
    assert!((rod(1.0, 0.0)["critical"].as_f64().unwrap() - 4.0 / 3.0).abs() < 1e-12);
    for (mu, omega, count) in [(1.3, 0.0, 1), (1.4, 0.0, 0), (1.4, 1.5, 2), (1.3, 1.5, 1)] {
        assert_eq!(rod(mu, omega)["forces"].as_array().unwrap().len(), count, "{mu} {omega}");
    }
    // Without a force the impulse of a short step does not vanish with it: x_n → ¾ sin θ cos θ =
    // 0.3.
    let last = &rod(2.0, 0.0)["steps"][2];
    assert!((last["x"][0].as_f64().unwrap() - 0.3).abs() < 1e-3, "{last}");
    // Where there is one it is (1 − ω² sin θ) dt / a = dt / 0.4 for μ = 1.
    let last = &rod(1.0, 0.0)["steps"][2];
    assert!((last["x"][0].as_f64().unwrap() - 1e-3 / 0.4).abs() < 1e-9, "{last}");
}

#[test]
fn a_rod_without_friction_falls_straight_down_and_no_rod_sinks_in() {
    let run = |mu: f64, slip: f64| {
        let question = json!({ "ask": "run", "mu": mu, "theta": 60.0, "omega": 0.0, "slip": slip, "dt": 0.001, "steps": 1000 });
        ask(question)["frames"].as_array().unwrap().clone()
    };
    let at = |frame: &Value, k: usize| frame["at"][k].as_f64().unwrap();
    let frames = run(0.0, 0.0);
    assert!(frames.iter().all(|frame| (at(frame, 0) - at(&frames[0], 0)).abs() < 1e-12));
    // Its height becomes motion: (½ cos²θ + ⅙) θ̇² + sin θ stays what it was.
    let (before, after) = (at(&frames[998], 2), at(&frames[999], 2));
    let kinetic = (0.5 * after.cos().powi(2) + 1.0 / 6.0) * ((after - before) / 0.001).powi(2);
    assert!((kinetic + after.sin() - 60f64.to_radians().sin()).abs() < 2e-3 && kinetic > 0.1);
    // No end sinks in: the middle is at least as high as half the rod reaches down.
    for (mu, slip) in [(0.0, 0.0), (0.5, 0.6), (2.0, 0.6)] {
        for frame in run(mu, slip) {
            assert!(at(&frame, 1) - at(&frame, 2).sin().abs() > -1e-3, "{mu}: {frame}");
        }
    }
}

#[test]
fn a_box_proves_a_contact_where_the_judge_proves_it() {
    let mut seed = 1_u64;
    let mut random = |low: f64, high: f64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let (radius, mut counts) = (1e-4, [0; 4]);
    for k in 0..100 {
        let factor: [f64; 9] = std::array::from_fn(|_| random(-1.0, 1.0));
        let product =
            |i: usize, j: usize| (0..3).map(|l| factor[3 * i + l] * factor[3 * j + l]).sum();
        let a: [f64; 9] = std::array::from_fn(|k| {
            let product: f64 = product(k / 3, k % 3);
            product + f64::from(u8::from(k % 4 == 0))
        });
        let (mu, b) = (random(0.1, 1.0), [random(-4.0, 0.5), random(-3.0, 3.0), random(-3.0, 3.0)]);
        // Every second x is farther from the solution than the sides of the box.
        let distance = if k % 2 == 0 { radius / 4.0 } else { 4.0 * radius };
        let turn = random(0.0, 2.0 * PI);
        let error = [0.0, distance * turn.cos(), distance * turn.sin()];
        let found = ask(
            json!({ "ask": "enclose", "a": a, "b": b, "mu": mu, "error": error, "radius": radius }),
        );
        let vector = |value: &Value| -> Vec<f64> {
            value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
        };
        let (problem, x) = (contact(&a, mu, b), vector(&found["x"]));
        let proof = cone_proof(&problem, &x, Some(&[radius; 3]));
        let state = ["open", "sticks", "slides"].iter().position(|own| found["state"] == *own);
        // The x of an open contact is 0 in every box.
        let is_near = proof.is_some() || state == Some(0);
        assert_eq!(found["reason"].is_null(), is_near, "{k}: {found}");
        counts[if is_near { state.unwrap() } else { 3 }] += 1;
        let exact = cone_proof(&problem, &vector(&found["solution"]), None).unwrap();
        for own in found["boxes"].as_array().unwrap() {
            let (center, radius) = (vector(&own["center"]), vector(&own["radius"]));
            let most = radius.into_iter().fold(1e-15, f64::max);
            assert!(!is_near || exact.distance(&center) <= 2.0 * most, "{k}: {own}");
        }
    }
    assert!(counts.iter().all(|&count| count > 5), "{counts:?}");
}

#[test]
fn no_box_proves_a_contact_between_sticking_and_sliding() {
    let a = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let between = contact(&a, 0.5, [-2.0, -1.0, 0.0]);
    for power in 1..15 {
        let radius = 10_f64.powi(-power);
        let question = json!({ "ask": "enclose", "a": a, "b": [-2, -1, 0], "mu": 0.5, "error": [0, 0, 0], "radius": radius });
        let reason = ask(question)["reason"].to_string();
        assert!(reason.contains("inequality"), "{radius}: {reason}");
    }
    let proof = cone_proof(&between, &[2.0, 1.0, 0.0], None);
    assert!(matches!(proof, Some(ConeProof::Point(_))), "{proof:?}");
}

fn contact(a: &[f64; 9], mu: f64, b: [f64; 3]) -> ConeProblem {
    let free = f64::INFINITY;
    let lcp = Lcp::new(Matrix::dense(3, a), b.to_vec(), vec![0.0, -free, -free], vec![free; 3]);
    let contact = Contact { rows: [0, 1, 2], mu };
    let friction = FrictionProblem::new(lcp.unwrap(), vec![contact]).unwrap();
    ConeProblem::new(friction, Law::Coulomb)
}

#[test]
fn all_solutions_are_given_as_fractions() {
    let two = json!({ "A": { "dense": [[2, -3], [-3, 2]] }, "b": [1, 1.5] });
    let found = ask(json!({ "ask": "solutions", "problem": two }));
    let fractions: Vec<&Value> =
        found["solutions"].as_array().unwrap().iter().map(|own| &own["fractions"]).collect();
    assert_eq!(fractions, [&json!(["0", "0"]), &json!(["13/10", "6/5"])]);
}

#[test]
fn a_question_that_makes_no_sense_is_answered_with_the_reason() {
    let problem = column(&[1.0]);
    for (question, reason) in [
        (json!({ "ask": "weather" }), "unknown variant"),
        (json!({ "ask": "column", "masses": [], "dt": 0.01 }), "masses"),
        (json!({ "ask": "trace", "problem": problem, "solver": "oracle" }), "oracle"),
        (json!({ "ask": "trace", "problem": problem, "solver": "sor", "omega": 2.5 }), "omega"),
        (json!({ "ask": "trace", "problem": {}, "solver": "pgs" }), "missing"),
        (json!({ "ask": "trace", "problem": problem, "solver": "pgs", "start": [1, 2] }), "start"),
    ] {
        let answer = ask(question.clone());
        let output = answer["error"].as_str().unwrap_or_else(|| panic!("{question}: {answer}"));
        assert!(output.contains(reason), "{output}");
    }
}

#[test]
fn the_three_functions_of_a_page_take_a_question_and_give_its_answer() {
    use lcplab_live::abi::{ask, back, room};
    let question = br#"{"ask": "column", "masses": [1], "dt": 0.01}"#;
    // SAFETY: the room is filled and given back as the functions ask for.
    let output = unsafe {
        let place = room(question.len());
        std::ptr::copy_nonoverlapping(question.as_ptr(), place, question.len());
        let answer = ask(place, question.len());
        let length =
            u32::from_le_bytes(std::slice::from_raw_parts(answer, 4).try_into().unwrap()) as usize;
        let output = std::slice::from_raw_parts(answer.add(4), length).to_vec();
        back(answer, length);
        output
    };
    assert_eq!(
        String::from_utf8(output).unwrap(),
        lcplab_live::answer(std::str::from_utf8(question).unwrap())
    );
}

mod study {
    use super::*;

    const FIG7: &str =
        r#"{"A": {"dense": [[1, -1, 0], [-1, 2, -1], [0, -1, 2]]}, "b": [-1, -1, 1]}"#;

    fn fig7() -> Value {
        serde_json::from_str(FIG7).unwrap()
    }

    #[test]
    fn every_method_of_the_registry_can_be_selected() {
        let first = ask(json!({ "ask": "solve", "problem": fig7() }));
        for own in first["solvers"].as_array().unwrap() {
            let found = ask(json!({ "ask": "solve", "problem": fig7(), "solver": own[0] }));
            for (x, exact) in found["answer"]["x"].as_array().unwrap().iter().zip([4.0, 3.0, 1.0]) {
                assert!((x.as_f64().unwrap() - exact).abs() < 1e-4, "{own}: {}", found["answer"]);
            }
        }
    }

    #[test]
    fn a_proof_of_the_page_is_one_for_the_checker() {
        let found = ask(json!({ "ask": "prove", "problem": fig7(), "x": [4, 3, 1] }));
        let problem = lcplab_lcp::file::Problem::parse(FIG7, "fig7").unwrap();
        let proof =
            lcplab_proof::Proof::parse(&found["proof"]["file"].to_string(), "proof").unwrap();
        let question = lcplab_lcp::Question::new(&problem, None, "fig7").unwrap();
        assert_eq!(lcplab_proof::check(&question, &proof), Ok(()));
        assert_eq!(found["proof"]["kind"], "unique");
    }

    #[test]
    fn what_this_page_does_not_treat_is_said() {
        let large: Vec<Vec<f64>> =
            (0..61).map(|i| (0..61).map(|j| f64::from(u8::from(i == j))).collect()).collect();
        let large = json!({ "A": { "dense": large }, "b": vec![-1.0; 61] });
        let found = ask(json!({ "ask": "solve", "problem": large }));
        assert!(found["error"].as_str().unwrap().contains("61 rows"), "{found}");
        let found = ask(json!({ "ask": "judge", "problem": fig7(), "x": [1, 2] }));
        assert_eq!(found["error"], "x: 2 numbers for 3 rows");
    }
}
