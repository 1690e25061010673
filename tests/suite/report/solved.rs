//! The study `solved`: problem files by solver.

use lcplab::report::experiment::Experiment;
use lcplab::report::view;

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
