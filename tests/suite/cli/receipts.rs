//! `lcplab receipts`: recorded steps of an engine, and a recorded run.

use std::path::Path;
use std::process::Command;

use serde_json::{Value, json};

use super::{err, out, run};

/// 2 kg fall at 3 m/s on a row of compliance ½ s/kg: x = 3 N s, v = −1.5 m/s.
fn problem() -> Value {
    json!({
        "A": {"dense": [[1.0]]}, "b": [-3.0],
        "motion": {"mass": [[0, 0, 2.0]], "jacobian": [[0, 0, 1.0]], "bias": [0.0],
            "compliance": [0.5], "target": [-3.0], "level": "velocity"},
        "rows": [{"label": "normal ground box", "bodies": ["ground", "box"]}],
    })
}

const RIGHT: (f64, f64) = (3.0, -1.5);
const WRONG: (f64, f64) = (2.0, -2.0);

fn write(folder: &Path, name: &str, value: &Value) {
    std::fs::create_dir_all(folder).unwrap();
    std::fs::write(folder.join(name), value.to_string()).unwrap();
}

/// Writes a frame: the impulse x and the velocity v that the engine returned.
fn frame(folder: &Path, stem: &str, (x, v): (f64, f64)) {
    write(folder, &format!("{stem}.json"), &problem());
    write(folder, &format!("{stem}.x.json"), &json!({"x": [x], "motion": [v]}));
}

/// The JSON and the exit code of a run.
fn checked(arguments: &[&str]) -> (Value, Option<i32>) {
    let output = run(&[&["receipts", "--json"], arguments].concat());
    (serde_json::from_str(&out(&output)).unwrap_or(Value::Null), output.status.code())
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

#[test]
fn a_wrong_answer_is_rejected_at_its_stage_and_a_right_one_accepted() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path();
    for (stem, answer) in [("right", RIGHT), ("solver", WRONG), ("motion", (3.0, -1.4))] {
        frame(place, stem, answer);
    }
    let (report, code) = checked(&[text(place)]);
    assert_eq!((code, &report["ok"], &report["frames"]), (Some(1), &json!(false), &json!(3)));
    let of = |stem: &str| &report["receipts"][place.join(format!("{stem}.json")).to_str().unwrap()];
    assert_eq!(of("right")["verdict"], "ok");
    assert_eq!((&of("solver")["stage"], &of("solver")["row"]), (&json!("solver"), &json!(0)));
    assert_eq!(of("motion")["stage"], "write-back");
    // |v − û|_M = √2 · 0.5, relative to |v − u*|_M = √2 · 1: the bound must not be below it.
    let error = of("solver")["motion_error"].as_f64().unwrap();
    assert!((0.5..1.0).contains(&error), "{error}");
}

#[test]
fn an_answer_may_be_inside_the_problem() {
    let folder = tempfile::tempdir().unwrap();
    let mut inside = problem();
    inside["answer"] = json!({"x": [3.0]});
    write(folder.path(), "a.json", &inside);
    let (report, code) = checked(&[text(&folder.path().join("a.json"))]);
    assert_eq!(code, Some(0), "{report}");
    let receipt = report["receipts"].as_object().unwrap().values().next().unwrap();
    let missing = json!("write-back: the motion, which the engine does not report");
    assert!(receipt["not_checked"].as_array().unwrap().contains(&missing));
    // The judge takes the file without a warning.
    let judged =
        run(&["judge", text(&folder.path().join("a.json")), text(&folder.path().join("a.json"))]);
    assert!(!err(&judged).contains("warning"), "{}", err(&judged));
}

/// Writes an archive of one frame as NumPy does: each array as .npy of version 1.
const NUMPY: &str = r#"
import struct, sys, zipfile
path, x, v = sys.argv[1], float(sys.argv[2]), float(sys.argv[3])
floats = {"J_data": [1], "M_data": [2], "R": [0.5], "u_star": [-3], "bias": [0], "x": [x], "v": [v]}
whole = {"J_indices": [0], "J_indptr": [0, 1], "M_indices": [0], "M_indptr": [0, 1]}
words = {"cone": "box", "level": "velocity", "source": '{"engine": "mine"}'}
with zipfile.ZipFile(path, "w") as archive:
    def add(name, descr, shape, data):
        header = f"{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}".encode()
        header += b" " * (-(len(header) + 11) % 64) + b"\n"
        archive.writestr(f"{name}.npy", b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header + data)
    for name, values in floats.items():
        add(name, "<f8", f"({len(values)},)", struct.pack(f"<{len(values)}d", *values))
    for name, values in whole.items():
        add(name, "<i8", f"({len(values)},)", struct.pack(f"<{len(values)}q", *values))
    for name, value in (("dt", 0.01), ("scale", 1e-9)):
        add(name, "<f8", "()", struct.pack("<d", value))
    for name, word in words.items():
        add(name, f"<U{len(word)}", "()", word.encode("utf-32-le"))
"#;

#[test]
fn a_frame_of_numpy_has_its_answer_in_the_arrays_x_and_v() {
    let folder = tempfile::tempdir().unwrap();
    for ((x, v), accepted) in [(RIGHT, 0), (WRONG, 1)] {
        let path = folder.path().join("a.npz");
        let numbers = [x.to_string(), v.to_string()];
        let made = Command::new("python3").args(["-c", NUMPY, text(&path)]).args(numbers).status();
        assert!(made.unwrap().success());
        let (report, code) = checked(&[text(folder.path())]);
        assert_eq!(code, Some(accepted), "{report}");
        assert_eq!(report["versions"], json!(["mine"]));
    }
}

#[test]
fn a_frame_that_the_baseline_lists_does_not_fail_and_one_that_it_does_not_list_does() {
    let folder = tempfile::tempdir().unwrap();
    let (frames, known) = (folder.path().join("frames"), folder.path().join("known.json"));
    frame(&frames, "a", WRONG);
    frame(&frames, "b", RIGHT);
    let baseline = ["--baseline", text(&known)];
    let with = |more: &[&str]| checked(&[&[text(&frames)], &baseline[..], more].concat());
    assert_eq!(with(&["--update"]).1, Some(0));
    let (report, code) = with(&[]);
    assert_eq!((code, report["known"].as_array().unwrap().len()), (Some(0), 1));
    frame(&frames, "b", WRONG);
    assert_eq!(with(&[]).1, Some(1));
    frame(&frames, "a", RIGHT);
    frame(&frames, "b", RIGHT);
    let (report, code) = with(&[]);
    assert_eq!((code, report["fixed"].as_array().unwrap().len()), (Some(0), 1));
    // Rejected at another stage than the recorded one.
    frame(&frames, "a", (3.0, -1.4));
    assert_eq!(with(&[]).1, Some(1));
}

#[test]
fn junit_and_sarif_name_the_failed_frame_and_its_stage() {
    let folder = tempfile::tempdir().unwrap();
    let frames = folder.path().join("frames");
    frame(&frames, "a&b", WRONG);
    frame(&frames, "c", RIGHT);
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let (junit, sarif, worst) = (path("r.xml"), path("r.sarif"), path("worst"));
    let more = ["--junit", &junit, "--sarif", &sarif, "--out", &worst];
    assert_eq!(checked(&[&[text(&frames)], &more[..]].concat()).1, Some(1));
    let xml = std::fs::read_to_string(&junit).unwrap();
    assert!(xml.contains(r#"tests="2" failures="1" skipped="0""#), "{xml}");
    assert!(xml.contains("a&amp;b.json") && xml.contains("<failure message=\"solver: "), "{xml}");
    let sarif: Value = serde_json::from_str(&std::fs::read_to_string(&sarif).unwrap()).unwrap();
    let results = sarif["runs"][0]["results"].as_array().unwrap();
    assert_eq!((results.len(), &results[0]["ruleId"]), (1, &json!("receipt/solver")));
    // The folder of the worst frame can be checked again.
    let (again, code) = checked(&[&worst]);
    assert_eq!(
        (code, &again["frames"], &again["stages"]),
        (Some(1), &json!(1), &json!({"solver": 1}))
    );
}

#[test]
fn frames_without_a_partner_are_all_named() {
    let folder = tempfile::tempdir().unwrap();
    for stem in ["a", "b", "c"] {
        frame(folder.path(), stem, RIGHT);
    }
    std::fs::remove_file(folder.path().join("b.x.json")).unwrap();
    std::fs::remove_file(folder.path().join("c.json")).unwrap();
    let output = run(&["receipts", text(folder.path())]);
    assert_eq!(output.status.code(), Some(2));
    let message = err(&output);
    assert!(message.contains("b.json: its answer b.x.json is missing"), "{message}");
    assert!(message.contains("c.x.json: its problem c.json is missing"), "{message}");
    let empty = folder.path().join("empty");
    std::fs::create_dir(&empty).unwrap();
    let output = run(&["receipts", text(&empty)]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("has no frames"), "{}", err(&output));
}

#[test]
fn a_baseline_of_the_other_command_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path();
    frame(&place.join("frames"), "a", RIGHT);
    write(place, "one.json", &json!({"A": {"dense": [[1.0]]}, "b": [-2.0]}));
    let (engine, solver) = (place.join("engine.json"), place.join("solver.json"));
    let receipts = |baseline: &Path, more: &[&str]| {
        let frames = place.join("frames");
        let arguments = ["receipts", text(&frames), "--baseline", text(baseline)];
        run(&[&arguments[..], more].concat())
    };
    let test = |baseline: &Path, more: &[&str]| {
        let problem = place.join("one.json");
        let arguments =
            ["test", text(&problem), "--solver", "dantzig", "--baseline", text(baseline)];
        run(&[&arguments[..], more].concat())
    };
    assert_eq!(receipts(&engine, &["--update"]).status.code(), Some(0));
    assert_eq!(test(&solver, &["--update"]).status.code(), Some(0));
    let wrong = receipts(&solver, &[]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(err(&wrong).contains("recorded run of the command test"), "{}", err(&wrong));
    let wrong = test(&engine, &[]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(err(&wrong).contains("recorded run of the command receipts"), "{}", err(&wrong));
}

#[test]
fn a_number_that_is_not_finite_is_a_wrong_step_and_a_missing_key_bad_input() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "a.json", &problem());
    write(folder.path(), "a.x.json", &json!({"x": ["nan"], "motion": [-1.5]}));
    let (report, code) = checked(&[text(folder.path())]);
    assert_eq!((code, &report["stages"]), (Some(1), &json!({"solver": 1})));
    let mut broken = problem();
    broken["motion"].as_object_mut().unwrap().remove("bias");
    write(folder.path(), "a.json", &broken);
    let output = run(&["receipts", text(folder.path())]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("a.json: motion.bias: is missing"), "{}", err(&output));
}

#[test]
fn frames_that_disappeared_and_a_negative_compliance_fail() {
    let folder = tempfile::tempdir().unwrap();
    let (frames, known) = (folder.path().join("frames"), folder.path().join("known.json"));
    frame(&frames, "a", RIGHT);
    frame(&frames, "b", RIGHT);
    let arguments = [text(&frames), "--baseline", text(&known)];
    assert_eq!(checked(&[&arguments[..], &["--update"]].concat()).1, Some(0));
    for name in ["b.json", "b.x.json"] {
        std::fs::remove_file(frames.join(name)).unwrap();
    }
    let (report, code) = checked(&arguments);
    assert_eq!((code, report["missing"].as_array().unwrap().len()), (Some(1), 1), "{report}");
    let mut negative = problem();
    negative["motion"]["compliance"] = json!([-1.0]);
    write(&frames, "a.json", &negative);
    let output = run(&["receipts", text(&frames)]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("compliance: is -1 in row 0"), "{}", err(&output));
}

#[test]
fn a_folder_whose_solver_answers_were_not_checked_is_not_ok() {
    let folder = tempfile::tempdir().unwrap();
    let mut capped = problem();
    capped["source"] = json!({"method": "pgs", "iterations": 9, "has_converged": false});
    write(folder.path(), "a.json", &capped);
    write(folder.path(), "a.x.json", &json!({"x": [WRONG.0], "motion": [WRONG.1]}));
    let (report, code) = checked(&[text(folder.path())]);
    let why = "no frame is ok or wrong: 1 unconverged";
    assert_eq!((code, &report["unchecked"]), (Some(1), &json!(why)), "{report}");
}

/// Four balls of 2 kg fall at 3 m/s on rows of compliance ½ s/kg; the impulse of the third is 2
/// instead of 3 N s.
#[test]
fn the_folder_of_a_rejected_frame_has_a_page_with_a_picture_and_the_row_that_shows_the_error() {
    let folder = tempfile::tempdir().unwrap();
    let (frames, worst) = (folder.path().join("frames"), folder.path().join("worst"));
    let diagonal = |value: f64| (0..4).map(|i| json!([i, i, value])).collect::<Value>();
    let rows = |i: usize| json!({"label": format!("ball <{i}>"), "bodies": [format!("ball {i}")]});
    let balls = json!({
        "b": [-3.0, -3.0, -3.0, -3.0],
        "motion": {"mass": diagonal(2.0), "jacobian": diagonal(1.0), "bias": [0.0, 0.0, 0.0, 0.0],
            "compliance": [0.5, 0.5, 0.5, 0.5], "target": [-3.0, -3.0, -3.0, -3.0]},
        "rows": (0..4).map(rows).collect::<Value>(),
        "answer": {"x": [3.0, 3.0, 2.0, 3.0], "motion": [-1.5, -1.5, -2.0, -1.5]},
    });
    write(&frames, "a.json", &balls);
    assert_eq!(checked(&[text(&frames), "--out", text(&worst)]).1, Some(1));
    let place = std::fs::read_dir(&worst).unwrap().next().unwrap().unwrap().path();
    let read = |name: &str| std::fs::read_to_string(place.join(name)).unwrap();
    let files = ["frame.json", "frame.x.json", "receipt.json", "receipt.txt"];
    assert!(files.iter().all(|name| !read(name).is_empty()));
    let page = read("receipt.html");
    assert_eq!(page.matches("<circle").count(), 4, "{page}");
    assert!(page.contains(">ball &lt;2&gt;</text>") && page.contains("wrong: solver"), "{page}");
    let smaller: Value = serde_json::from_str(&read("shrunk.json")).unwrap();
    assert_eq!(smaller["rows"].as_array().unwrap().len(), 1);
    assert_eq!(smaller["rows"][0]["label"], "ball <2>");
    let judged =
        run(&["judge", text(&place.join("shrunk.json")), text(&place.join("shrunk.x.json"))]);
    assert_eq!(judged.status.code(), Some(1), "{}", err(&judged));
}

#[test]
fn a_baseline_that_does_not_exist_is_named_with_the_option_that_records_it() {
    let folder = tempfile::tempdir().unwrap();
    frame(folder.path(), "a", RIGHT);
    let other = tempfile::tempdir().unwrap();
    let known = other.path().join("known.json");
    let arguments = ["receipts", text(folder.path()), "--baseline", text(&known)];
    let output = run(&arguments);
    assert_eq!(output.status.code(), Some(2));
    let message = format!("{}: there is no such file; record it with --update", text(&known));
    assert!(err(&output).contains(&message), "{}", err(&output));
    assert_eq!(run(&[&arguments[..], &["--update"]].concat()).status.code(), Some(0));
    assert_eq!(run(&arguments).status.code(), Some(0));
}
