//! What goes to and fro.

use std::time::Duration;

use lcplab_lcp::friction::{ConeProblem, Law};
use lcplab_plugin::{Declaration, Plugin};
use lcplab_solver::{MatrixClass, Options, Registry, Settings, Start, Status};
use lcplab_testing::{Iterates, pushed_mass};
use serde_json::Value;

use super::{LONG, Script, cone_entry, entry, pushed, solve};

/// A script that names models in its first answer and keeps the problem that comes after it.
fn naming(name: &str, models: &str) -> Script {
    let lines = format!(
        "import json, sys\nfor k, line in enumerate(sys.stdin):\n    p = json.loads(line)\n    \
         if k: open(sys.argv[0] + '.json', 'w').write(line)\n    \
         print(json.dumps({{'x': [1] + [0] * (len(p['b']) - 1), 'models': {models}}}), flush=True)\n"
    );
    Script::new(name, &lines)
}

#[test]
fn a_plug_in_that_names_a_cone_gets_its_model_and_its_contacts() {
    let script = naming("says_cones", "['coulomb-cone', 'coupled-box']");
    let plugin = script.start(LONG);
    let entry = cone_entry(&plugin).expect("a solver of cones");
    assert_eq!(*entry.laws, [Law::Coulomb]);
    let problem = ConeProblem::new(pushed_mass(2.0, 3.0, 30.0), Law::Coulomb);
    let solution = entry.build(&Settings::default()).solve(&problem, &Start::default(), &mut ());
    assert_eq!((solution.x, solution.status), (vec![1.0, 0.0, 0.0], Status::Solved));
    let output = std::fs::read_to_string(script.path("says_cones.py.json")).unwrap();
    let output: Value = serde_json::from_str(&output).unwrap();
    assert_eq!(output["model"], "coulomb-cone");
    assert_eq!(output["friction_index"], serde_json::json!([-1, 0, 0]));
    assert_eq!(output["mu"], serde_json::json!([0.0, 0.5, 0.5]));
    assert_eq!(output["lo"], serde_json::json!([0.0, "-inf", "-inf"]));
}

#[test]
fn a_plug_in_that_names_no_cone_gets_none() {
    let script = naming("boxes", "['coupled-box']");
    let silent = Script::answering("silent", "print('{\"x\": [0, 0]}', flush=True)");
    for plugin in [script.start(LONG), silent.start(LONG)] {
        assert!(cone_entry(&plugin).is_none(), "{}", plugin.name());
        assert_eq!(entry(&plugin).name, plugin.name());
    }
}

#[test]
fn coupled_rows_come_with_the_model_that_bounds_them() {
    let script = naming("coupled", "[]");
    let plugin = script.start(LONG);
    solve(&plugin, &pushed_mass(2.0, 3.0, 30.0).coupled_box());
    let output = std::fs::read_to_string(script.path("coupled.py.json")).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&output).unwrap()["model"], "coupled-box");
}

#[test]
fn models_that_a_plug_in_cannot_get_are_refused_at_the_start() {
    let refusal = |name: &str, models: &str| {
        let script = naming(name, models);
        let command = format!("python3 '{}'", script.path(&format!("{name}.py")).display());
        Plugin::start(&command, LONG.as_secs_f64()).unwrap_err().to_string()
    };
    let polygon = refusal("polygons", "['polygon-8']");
    let reason =
        "name polygon-8, but plug-ins are sent only boxes, associated-cone and coulomb-cone";
    assert!(
        polygon.starts_with("plug-in polygons: start: its \"models\"") && polygon.ends_with(reason)
    );
    let unknown = refusal("unknown", "['cone']");
    assert!(unknown.contains("there is no friction model named \"cone\""), "{unknown}");
    assert!(refusal("word", "'coulomb-cone'").ends_with("\"models\" is not a list of strings"));
}

#[test]
fn an_x_without_a_status_is_a_claim_that_is_only_implied() {
    let implied = |name: &str, answer: &str| {
        let script = Script::answering(name, &format!("print('{answer}', flush=True)"));
        solve(&script.start(LONG), &pushed()).0.is_claim_implied
    };
    assert!(implied("bare", r#"{"x": [0.5, 0]}"#));
    assert!(implied("null", r#"{"x": [0.5, 0], "status": null}"#));
    assert!(!implied("stated", r#"{"x": [0.5, 0], "status": "solved"}"#));
}

#[test]
fn a_plug_in_receives_the_problem_and_the_demands() {
    let script = Script::answering(
        "echo",
        "open(sys.argv[0] + '.json', 'w').write(line); print('{\"x\": [0.5, 0]}', flush=True)",
    );
    let plugin = script.start(Duration::from_secs(7));
    let settings = Settings::default().with_tolerance(1e-9).with_max_iterations(50);
    let solver = entry(&plugin).build(&Options::default().with_settings(settings));
    let solution = solver.solve(&pushed(), &Start::at(&[1.0, 2.0]), &mut ());
    assert_eq!((solution.x, solution.status), (vec![0.5, 0.0], Status::Solved));
    let output = std::fs::read_to_string(script.path("echo.py.json")).unwrap();
    assert_eq!(
        output.trim(),
        "{\"A\":{\"dense\":[[2.0,-1.0],[-1.0,2.0]]},\"b\":[-1.0,2.0],\"lo\":[0.0,0.0],\"hi\":[\"inf\",\"inf\"],\
         \"tolerance\":1e-9,\"max_iterations\":50,\"time_limit\":7.0,\"start\":[1.0,2.0]}"
    );
    drop(plugin);
}

#[test]
fn what_a_plug_in_reports_besides_x_is_kept() {
    let says = |name: &str, answer: &str| {
        let script = Script::answering(name, &format!("print('{answer}', flush=True)"));
        solve(&script.start(LONG), &pushed()).0
    };
    let stopped =
        says("stopped", r#"{"x": [0, 0], "status": "iteration_limit", "iterations": 12}"#);
    assert_eq!((stopped.status, stopped.iterations), (Status::IterationLimit, 12));
    let without = says("without", r#"{"status": "iteration_limit"}"#);
    let reason = "it reached its iteration limit and gives no x".to_string();
    assert_eq!(without.status, Status::NoAnswer { reason });
    let outside = says("outside", r#"{"status": "outside_class"}"#);
    assert!(matches!(outside.status, Status::OutsideClass { .. }));
    let none = says("none", r#"{"status": "infeasible", "vector": [0, -1]}"#);
    assert_eq!(none.status, Status::Ray { row: 1, direction: vec![0.0, -1.0] });
    let failed = says("failed", r#"{"x": [0, 0], "status": "out of luck"}"#);
    assert_eq!(failed.status, Status::NoAnswer { reason: "it says \"out of luck\"".into() });
}

#[test]
fn iterations_are_a_whole_number() {
    let says = |name: &str, answer: &str| {
        let script = Script::answering(name, &format!("print('{answer}', flush=True)"));
        solve(&script.start(LONG), &pushed()).0
    };
    for (name, answer, reason) in [
        ("fewer", r#"{"x": [0, 0], "iterations": -1}"#, "its iterations are -1, not an integer"),
        ("parts", r#"{"x": [0, 0], "iterations": 2.5}"#, "its iterations are 2.5, not an integer"),
        (
            "many",
            r#"{"x": [0, 0], "iterations": 1e30}"#,
            "its iterations are 1e+30, not an integer",
        ),
    ] {
        match says(name, answer).status {
            Status::NoAnswer { reason: own } => assert!(own.starts_with(reason), "{own}"),
            other => panic!("{answer}: {other}"),
        }
    }
    assert_eq!(says("whole", r#"{"x": [0.5, 0], "iterations": 20.0}"#).iterations, 20);
}

#[test]
fn iterates_are_seen_as_those_of_any_solver() {
    let answer = "print('{\"x\": [0.5, 0], \"iterates\": [[1, 1], [0.5, 0]]}', flush=True)";
    let script = Script::answering("iterates", answer);
    let plugin = script.start(LONG);
    let mut seen = Iterates::default();
    let solver = entry(&plugin).build(&Options::default());
    let solution = solver.solve(&pushed(), &Start::default(), &mut seen);
    assert_eq!(seen.0, [vec![0.0, 0.0], vec![1.0, 1.0], vec![0.5, 0.0]]);
    assert_eq!(solution.iterations, 2);
}

#[test]
fn an_answer_without_iterates_is_one_iteration() {
    let script = Script::answering("answer", "print('{\"x\": [0.5, 0]}', flush=True)");
    let plugin = script.start(LONG);
    let mut seen = Iterates::default();
    let solver = entry(&plugin).build(&Options::default());
    assert_eq!(solver.solve(&pushed(), &Start::default(), &mut seen).iterations, 1);
    assert_eq!(seen.0, [vec![0.0, 0.0], vec![0.5, 0.0]]);
}

#[test]
fn a_declared_plug_in_has_a_class_and_receives_its_settings() {
    let answer = "c = p['settings']['root']; print(json.dumps({'x': [c, c]}), flush=True)";
    let script = Script::answering("settings", answer);
    let command = format!("python3 '{}'", script.path("settings.py").display());
    let json =
        serde_json::json!({ "command": command, "class": "definite", "settings": { "root": 3 } });
    let declaration: Declaration = serde_json::from_value(json).unwrap();
    let plugin = Plugin::declared("told", &declaration).unwrap();
    assert_eq!(entry(&plugin).class.matrix, MatrixClass::Definite);
    assert_eq!(solve(&plugin, &pushed()).0.x, [3.0, 3.0]);
    let wrong = Declaration { class: Some("nice".into()), ..declaration };
    let refusal = Plugin::declared("wrong", &wrong).unwrap_err().to_string();
    assert!(
        refusal.starts_with("plug-in wrong: class: there is no class of matrices"),
        "{refusal}"
    );
}

#[test]
fn one_process_a_problem_is_a_plug_in_too() {
    let once = "import json, sys\np = json.loads(sys.stdin.readline())\nprint('{\"x\": [0.5, 0]}' if len(p['b']) == 2 else '{\"x\": [1]}')\n";
    let script = Script::new("once", once);
    let plugin = script.start(LONG);
    for _ in 0..3 {
        assert_eq!(solve(&plugin, &pushed()).0.status, Status::Solved);
    }
}

#[test]
fn a_plug_in_is_named_after_its_program_or_script_and_not_after_an_argument() {
    let script = Script::answering("lame", "print('{\"x\": [0]}', flush=True)");
    let path = script.path("lame.py").display().to_string();
    for (command, name) in [
        (format!("python3 '{path}' --sweeps 10"), "lame"),
        (format!("first=python3 '{path}' 10"), "first"),
    ] {
        let plugin = Plugin::start(&command, LONG.as_secs_f64()).unwrap();
        assert_eq!(plugin.name(), name, "{command}");
    }
}

#[test]
fn a_command_that_cannot_be_a_plug_in_is_refused_in_a_line() {
    let refusal = |spec: &str| Plugin::start(spec, LONG.as_secs_f64()).unwrap_err().to_string();
    assert_eq!(refusal(""), "plug-in: command: \"\" is not a command");
    assert_eq!(
        refusal("a=nobody-knows-it"),
        "plug-in a: start: nobody-knows-it cannot be run: No such file or directory (os error 2)"
    );
    assert_eq!(refusal("pgs=cat"), "plug-in pgs: start: its answer has no \"x\"");
    let dumb = Script::answering("dantzig", "pass");
    let dantzig = format!("python3 '{}'", dumb.path("dantzig.py").display());
    let named = Plugin::start(&dantzig, LONG.as_secs_f64()).unwrap();
    assert_eq!(
        named.add_to(&mut Registry::default()).unwrap_err().to_string(),
        "solvers: name: there is a solver named \"dantzig\" already"
    );
}
