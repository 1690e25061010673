//! One law: status, verdict, diagnosis, message and exit code never contradict each other, whoever
//! answers.

use serde_json::{Value, json};

use super::{out, run, run_with};
use lcplab::hunt;
use lcplab::lcp::file::Problem;
use lcplab::lcp::library;

/// Problems that have led to contradictions, and whether they have a solution.
const CASES: [(&str, bool); 15] = [
    // Solvable, though a sweep would divide by zero or A has a negative eigenvalue
    (r#"{"A":{"dense":[[-1]]},"b":[1]}"#, true),
    (r#"{"A":{"dense":[[0]]},"b":[1]}"#, true),
    (r#"{"A":{"dense":[[1,2],[2,1]]},"b":[-1,-1]}"#, true),
    (
        r#"{"A":{"dense":[[2,1],[1,0]]},"b":[-1,-1],"lo":[0,"-inf"],"hi":["inf","inf"],"friction_index":[-1,0],"mu":[0,0.5]}"#,
        true,
    ),
    // (2, 1) with friction at its bound
    (r#"{"A":{"dense":[[1,-1],[-1,1]]},"b":[-1,-5],"friction_index":[-1,0],"mu":[0,0.5]}"#, true),
    (r#"{"A":{"dense":[[1,-1],[-1,1]]},"b":[-1,-0.5],"friction_index":[-1,0],"mu":[0,1]}"#, false),
    (r#"{"A":{"dense":[[1,-1],[-1,1]]},"b":[-1e-9,-1],"friction_index":[-1,0],"mu":[0,1]}"#, false),
    (
        r#"{"A":{"dense":[[27,21,21],[21,17,17],[21,17,17]]},"b":[-1,-1,-2],"friction_index":[-1,0,0],"mu":[0,2,2]}"#,
        true,
    ),
    (r#"{"A":{"dense":[[10,8],[8,8]]},"b":[1,3],"friction_index":[-1,0],"mu":[0,2]}"#, true),
    (r#"{"A":{"dense":[[0,1],[1,1]]},"b":[-1.000000001,0],"lo":[0,1],"hi":["inf",1]}"#, false),
    (r#"{"A":{"dense":[[1,-1],[-1,1]]},"b":[-1,-1]}"#, false),
    (
        r#"{"A":{"dense":[[5,-6,-4,-1,-3],[-6,8,4,0,4],[-4,4,4,2,2],[-1,0,2,2,0],[-3,4,2,0,2]]},
            "b":[-2,-2,3,3,1],"lo":["-inf",-1,-1,"-inf","-inf"],"hi":[0,-1,-1,"inf",2]}"#,
        false,
    ),
    (
        r#"{"A":{"dense":[[1,1],[1,1.0000000000009095]]},"b":[-2,-2.000000001],"lo":["-inf","-inf"]}"#,
        true,
    ),
    // Two equations for one motion: apart by rounding, and by half of the scale
    (
        r#"{"A":{"dense":[[2,2],[2,2]]},"b":[-2,-2.0000000000000004],"lo":["-inf","-inf"],"scale":0.001}"#,
        true,
    ),
    (r#"{"A":{"dense":[[2,2],[2,2]]},"b":[-2,-2.001],"lo":["-inf","-inf"],"scale":0.001}"#, false),
];

const SOLVERS: [&str; 8] = [
    "pgs",
    "dantzig",
    "lemke",
    "block-pivoting",
    "spectral",
    "interior-point",
    "newton",
    "enumeration",
];

fn object(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

/// Checks an answer against the law; returns whether it is accepted.
fn holds(answer: &Value, code: Option<i32>, reported: &str) -> bool {
    let verdict = answer["verdict"].as_str().unwrap();
    let accepts = verdict != "not_a_solution";
    assert_eq!(code, Some(i32::from(!accepts)), "{reported}");
    let certificate = &answer["certificate"];
    let denies =
        certificate.get("no_solution").is_some() || certificate.get("case_split").is_some();
    assert!(!(denies && accepts), "{reported}");
    assert_eq!(
        answer["status"] == "infeasible",
        denies && answer["message"].as_str().unwrap().starts_with("no solution exists"),
        "{reported}"
    );
    if answer["status"] == "solved" && !accepts {
        assert!(denies || answer["amount"].as_f64().unwrap() <= 1e-8, "{reported}");
    }
    accepts
}

#[test]
fn status_verdict_diagnosis_message_and_exit_code_agree() {
    for (problem, is_solvable) in CASES {
        let diagnosis = object(&out(&run_with(problem, &["diagnose", "-", "--json"])));
        let is_impossible = diagnosis["causes"]
            .as_array()
            .unwrap()
            .iter()
            .any(|cause| cause["name"] == "impossible" && cause["is_proved"] == true);
        assert_eq!(is_impossible, !is_solvable, "{problem} {diagnosis}");
        assert_eq!(diagnosis["is_sound"], is_solvable, "{problem} {diagnosis}");
        for solver in SOLVERS {
            let arguments = ["solve", "-", "--solver", solver, "--json"];
            let output = run_with(problem, &arguments);
            let answer = object(&out(&output));
            let reported = format!("{solver} of {problem}: {answer}");
            let accepts = holds(&answer, output.status.code(), &reported);
            assert!(is_solvable || !accepts, "{reported}");
            // The same answer, judged by itself, has the same verdict.
            let x = json!({ "x": answer["x"] }).to_string();
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("answer.json");
            std::fs::write(&path, x).unwrap();
            let judged = run_with(problem, &["judge", "-", path.to_str().unwrap(), "--json"]);
            let again = object(&out(&judged));
            assert_eq!(again["verdict"] != "not_a_solution", accepts, "{reported} {again}");
            assert_eq!(judged.status.code(), output.status.code(), "{reported}");
            let text = out(&run_with(problem, &arguments[..4]));
            let words = text.contains("verdict    not a solution");
            assert_eq!(words, !accepts, "{text}");
        }
    }
}

#[test]
fn hostile_problems_and_the_library_agree_with_themselves() {
    let hostile = (0..hunt::KINDS.len())
        .map(|k| Problem::new("hostile", hunt::problem(3, k).0).to_json().to_string());
    let library = library::all().map(|family| family.generate(&[]).unwrap());
    let library = library.filter(|problem| problem.lcp.len() <= 12);
    let library: Vec<String> = library.map(|problem| problem.to_json().to_string()).collect();
    assert!(library.len() > 10, "{}", library.len());
    for problem in hostile.chain(library) {
        let diagnosis = object(&out(&run_with(&problem, &["diagnose", "-", "--json"])));
        let is_impossible = diagnosis["causes"]
            .as_array()
            .unwrap()
            .iter()
            .any(|cause| cause["name"] == "impossible" && cause["is_proved"] == true);
        let (mut any, mut denied) = (false, is_impossible);
        for solver in ["dantzig", "lemke", "pgs", "enumeration"] {
            let output = run_with(&problem, &["solve", "-", "--solver", solver, "--json"]);
            let answer = object(&out(&output));
            let reported = format!("{solver} of {problem}: {answer}");
            any |= holds(&answer, output.status.code(), &reported) && answer["verdict"] == "proved";
            denied |= answer["status"] == "infeasible";
        }
        assert!(!(any && denied), "{problem}");
    }
}

/// A gate on two hinges with one axis, out of the axes of the world, and a motor.
const GATE: &str = "
    [[bodies]]
    name = \"gate\"
    shape = { box = [1.7, 0.08, 0.9] }
    mass = 33
    position = [0.85, 0.1, 0.2]
    rotation = { y = 13 }
    [[constraints]]
    kind = \"hinge\"
    bodies = [\"gate\"]
    axis = [-0.3, 0.17, 0.9]
    point = [0.21, -0.119, -0.63]
    [[constraints]]
    kind = \"hinge\"
    bodies = [\"gate\"]
    axis = [-0.3, 0.17, 0.9]
    point = [-0.18, 0.102, 0.54]
    [[constraints]]
    kind = \"motor_rotation\"
    bodies = [\"gate\"]
    axis = [-0.3, 0.17, 0.9]
    speed = -1.3
    effort = 900
";

#[test]
fn a_step_that_simulate_accepts_is_accepted_as_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let (scene, answer) = (at("gate.toml"), at("answer.json"));
    std::fs::write(&scene, GATE).unwrap();
    let mut inexact = 0;
    for settings in [
        &["step.baumgarte=0.2", "step.dt=0.001"][..],
        &["step.baumgarte=0.1"],
        &["step.scheme=\"acceleration\"", "step.alpha=20", "step.dt=0.002"],
    ] {
        let set: Vec<&str> = settings.iter().flat_map(|set| ["--set", set]).collect();
        let simulated = run(&[&["simulate", &scene, "--steps", "16"], &set[..]].concat());
        assert_eq!(simulated.status.code(), Some(0), "{}", out(&simulated));
        for step in 1..=16 {
            let step = step.to_string();
            let exported = out(&run(&[&["export", &scene, "--step", &step], &set[..]].concat()));
            let solved = run_with(&exported, &["solve", "-", "--json"]);
            let reported = out(&solved);
            assert!(holds(&object(&reported), solved.status.code(), &reported), "{reported}");
            inexact += usize::from(reported.contains("no_exact_solution"));
            std::fs::write(&answer, &reported).unwrap();
            let judged = run_with(&exported, &["judge", "-", &answer]);
            assert_eq!(judged.status.code(), Some(0), "{}", out(&judged));
            let diagnosis = object(&out(&run_with(&exported, &["diagnose", "-", "--json"])));
            assert_eq!(diagnosis["is_sound"], true, "{diagnosis}");
        }
    }
    assert!(inexact > 0, "some of these rows contradict each other by rounding");
}

/// A bob at 1 m/s between two rods of 1 m and 2 m, which require the accelerations v²/1 m and
/// −v²/2 m along x, and a motor against a lock.
const TWO_RODS: &str = "
    step.scheme = \"acceleration\"
    [[bodies]]
    name = \"bob\"
    shape = \"point\"
    mass = 1
    position = [1, 0, 0]
    velocity = [0, 0, 1]
    [[constraints]]
    kind = \"distance\"
    bodies = [\"bob\"]
    points = [[0, 0, 0], [1, 0, 0]]
    [[constraints]]
    kind = \"distance\"
    bodies = [\"bob\"]
    points = [[3, 0, 0], [1, 0, 0]]
    [[constraints]]
    kind = \"motor_translation\"
    bodies = [\"bob\"]
    axis = [0, 0, 1]
    speed = 2
    effort = 1e9
    [[constraints]]
    kind = \"lock_translation\"
    bodies = [\"bob\"]
    axis = [0, 0, 1]
";

#[test]
fn a_step_without_solution_is_accepted_by_no_command() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("rods.toml").to_str().unwrap().to_string();
    std::fs::write(&scene, TWO_RODS).unwrap();
    let exported = out(&run(&["export", &scene]));
    for solver in ["dantzig", "newton", "block-pivoting"] {
        // Forces of 10⁹ N make a contradiction of 1.5 m/s² look small.
        let simulated = run(&["simulate", &scene, "--steps", "1", "--solver", solver]);
        assert_eq!(simulated.status.code(), Some(1), "{}", out(&simulated));
        let solved = run_with(&exported, &["solve", "-", "--solver", solver, "--json"]);
        let reported = out(&solved);
        assert!(!holds(&object(&reported), solved.status.code(), &reported), "{reported}");
    }
    assert_eq!(object(&out(&run(&["diagnose", &scene, "--json"])))["is_sound"], false);
}
