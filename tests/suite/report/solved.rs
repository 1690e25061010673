//! The study `solved`: problem files by solver.

use lcplab::plugin::Plugin;
use lcplab::report::experiment::Experiment;
use lcplab::report::study::Study;
use lcplab::report::study::solved::{Column, Plan};
use lcplab::report::view;
use lcplab::solver::Registry;

use super::standard::{experiment, run_all, table};

#[test]
fn each_file_and_solver_has_its_verdict_and_reason_and_the_accepted_are_counted() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    // x = 1; and w = −1 for every x ≥ 0, which no solver can solve.
    file("easy.json", r#"{ "name": "easy", "A": { "dense": [[2]] }, "b": [-2] }"#);
    file("none.json", r#"{ "name": "none", "A": { "dense": [[0]] }, "b": [-1] }"#);
    let text = format!(
        "title = 'Two'\nlead = ''\n[[section]]\nstudy = 'solved'\nfiles = ['{}/*.json']\n\
         solvers = [{{ solver = 'dantzig' }}, {{ solver = 'lemke', model = 'coupled-box' }}, \
         {{ solver = 'cone-pgs' }}]\n",
        folder.path().display()
    );
    let document = view::document(&run_all(&experiment(&text).unwrap())).unwrap();
    let rows = |name: &str| -> Vec<Vec<String>> {
        let table = table(&document, name);
        table.rows.iter().map(|row| row.iter().map(|cell| cell.text.clone()).collect()).collect()
    };
    let by_file = rows("by_file");
    assert_eq!(by_file[0], ["easy", "1", "accepted", "accepted", "–"]);
    assert_eq!(by_file[1][..2], ["none", "1"]);
    assert!(by_file[1][2..4].iter().all(|cell| cell.ends_with(", 1")), "{by_file:?}");
    let by_solver = rows("by_solver");
    for row in &by_solver[..2] {
        assert_eq!(row[2..4], ["2", "1"]);
        assert!(row[4].ends_with(": 1") && row[5] == "1", "{row:?}");
    }
    assert_eq!(by_solver[2][2..4], ["0", "0"]);
}

#[test]
fn an_unknown_solver_is_an_error_and_a_start_that_solves_the_problem_is_no_answer() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rest.json");
    std::fs::write(&path, r#"{ "A": { "dense": [[1, 0], [0, 1]] }, "b": [1, 1] }"#).unwrap(); // x = 0
    let plan = |solver: &str| Plan {
        files: vec![path.display().to_string()],
        solvers: vec![Column { solver: solver.into(), model: None }],
        tolerance: 1e-8,
        max_iterations: 100,
    };
    let error = plan("dantzg").run(0, Registry::standard()).unwrap_err().to_string();
    assert!(error.contains("there is no solver named \"dantzg\""), "{error}");
    let mut solvers = Registry::default();
    let one_number = r#"short=python3 -c "import sys; [print('{\"x\": [1]}', flush=True) for line in sys.stdin]""#;
    let short = Plugin::start(one_number, 60.0).unwrap();
    short.add_to(&mut solvers).unwrap();
    let (files, ()) = plan("short").run(0, &solvers).unwrap();
    let answer = files[0].answers[0].as_ref().unwrap();
    assert!(!answer.is_accepted && !answer.is_claim, "{answer:?}");
}

#[test]
fn the_report_of_recorded_frames_names_all_sixty() {
    let experiment = Experiment::load("reports/frames.toml").unwrap();
    let text = std::fs::read_to_string("reports/frames.toml").unwrap();
    let frames = std::fs::read_dir("frames").unwrap().map(|own| own.unwrap().file_name());
    let frames: Vec<String> = frames.map(|own| own.into_string().unwrap()).collect();
    let frames = frames.iter().filter(|own| own.ends_with(".npz"));
    let is_named = |frame: &&String| {
        let engine = frame.split_once('_').unwrap().0;
        text.contains(&format!("\"frames/{engine}_*.npz\""))
    };
    assert_eq!(frames.filter(is_named).count(), 60);
    assert_eq!(experiment.sections.len(), 1);
}
