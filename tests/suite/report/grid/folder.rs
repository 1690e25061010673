//! The folder of results: resumed, refused, and collected to the same bits in any order.

use std::fs;
use std::path::Path;

use indicatif::ProgressBar;
use lcplab::report::grid::{Collection, Folder, Grid, collect};
use lcplab::solver::Stop;
use serde_json::Value;

use super::grid;
use crate::cli::{err, out, run};

const SMALL: &str = "family = 'stack'\n[set]\nsolver.name = 'pgs'\n\
                     [axes]\nn = [1, 2, 3]\nratio = [1.0, 8.0]";

/// Collects and returns the tables.
fn collected(grid: &Grid, folder: &Folder) -> (Collection, [String; 3]) {
    let collection = collect(grid, folder).unwrap();
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    (collection, ["results.csv", "results.json", "index.html"].map(read))
}

fn run_all(grid: &Grid, path: &Path) -> usize {
    Folder::new(path, grid).unwrap().run_missing(&ProgressBar::hidden(), &Stop::default()).unwrap()
}

#[test]
fn what_is_collected_is_the_same_in_any_order_and_on_any_number_of_threads() {
    let grid = grid(SMALL);
    let tables: Vec<[String; 3]> = [1, 2, 5]
        .into_iter()
        .map(|threads| {
            let path = tempfile::tempdir().unwrap();
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| run_all(&grid, path.path()));
            collected(&grid, &Folder::new(path.path(), &grid).unwrap()).1
        })
        .collect();
    let path = tempfile::tempdir().unwrap();
    let folder = Folder::new(path.path(), &grid).unwrap();
    for task in [5, 2, 6, 1, 4, 3] {
        folder.run_one(task).unwrap();
    }
    let (collection, backwards) = collected(&grid, &folder);
    assert!(collection.missing.is_empty());
    assert!(tables.iter().all(|table| *table == backwards));
}

#[test]
fn a_run_goes_on_where_it_was_interrupted() {
    let (grid, path) = (grid(SMALL), tempfile::tempdir().unwrap());
    let folder = Folder::new(path.path(), &grid).unwrap();
    folder.run_one(4).unwrap();
    let (collection, _) = collected(&grid, &folder);
    assert_eq!(collection.missing, [1, 2, 3, 5, 6]);

    // A mark in the first result shows that it is kept and not made again.
    let file = path.path().join("tasks/4.json");
    let mut record: Value = serde_json::from_str(&fs::read_to_string(&file).unwrap()).unwrap();
    record["machine"]["platform"] = "another machine".into();
    fs::write(&file, record.to_string()).unwrap();
    assert_eq!(run_all(&grid, path.path()), 5);
    assert_eq!(folder.record(4).unwrap().unwrap().machine.platform, "another machine");
    assert_eq!(run_all(&grid, path.path()), 0);
    assert!(collected(&grid, &folder).0.missing.is_empty());
}

#[test]
fn results_of_a_changed_file_are_refused() {
    let (old, path) = (grid(SMALL), tempfile::tempdir().unwrap());
    run_all(&old, path.path());
    let new = grid(&SMALL.replace("8.0", "9.0"));
    let refused = Folder::new(path.path(), &new).unwrap_err().to_string();
    assert!(refused.contains("plan.json: belongs to plan"), "{refused}");

    // Without the plan the results still tell where they belong.
    fs::remove_file(path.path().join("plan.json")).unwrap();
    let folder = Folder::new(path.path(), &new).unwrap();
    for refused in [
        collect(&new, &folder).map(|_| 0),
        folder.run_missing(&ProgressBar::hidden(), &Stop::default()),
    ] {
        assert!(refused.unwrap_err().to_string().contains("1.json: belongs to plan"));
    }
}

#[test]
fn results_of_a_changed_scene_are_refused() {
    let path = tempfile::tempdir().unwrap();
    let scene = path.path().join("mine.toml");
    let text = lcplab::scene::text("pendulum").unwrap().1;
    fs::write(&scene, &text).unwrap();
    let file = format!("scene = {scene:?}\nsteps = 1\n[axes]\nstep.dt = [0.01]");
    let hash = || grid(&file).plan().unwrap().hash;
    let before = hash();
    assert_eq!(before, hash());
    fs::write(&scene, text + "\n# another one\n").unwrap();
    assert_ne!(before, hash());
}

#[test]
fn an_impossible_point_is_a_row_with_its_reason_and_the_rest_goes_on() {
    let text = "scene = 'chain'\nsteps = 1\n[set]\nsolver.name = 'sor'\n\
                [axes]\nsolver.omega = [1.0, 2.5]\ngenerate.links = [2, -1, 'x']";
    let (grid, path) = (grid(text), tempfile::tempdir().unwrap());
    assert_eq!(run_all(&grid, path.path()), 6);
    let folder = Folder::new(path.path(), &grid).unwrap();
    let (collection, [csv, ..]) = collected(&grid, &folder);
    assert_eq!((collection.done.len(), collection.impossible()), (6, 5));
    let reason = |task: usize| folder.record(task).unwrap().unwrap().reason.unwrap_or_default();
    assert_eq!(reason(1), "");
    assert!(reason(2).starts_with("chain.toml: generate.links: invalid value"), "{}", reason(2));
    assert!(reason(3).starts_with("chain.toml: generate.links: invalid type"), "{}", reason(3));
    assert_eq!(reason(4), "chain: solver.omega: must lie between 0 and 2, is 2.5");
    assert!(csv.lines().nth(4).unwrap().contains("impossible,none,\"chain: solver.omega"), "{csv}");
}

#[test]
fn a_motion_that_fails_is_a_row_that_says_when() {
    let text = "scene = 'painleve'\n[axes]\nstep.scheme = ['acceleration']\nsteps = [300]";
    let (grid, path) = (grid(text), tempfile::tempdir().unwrap());
    run_all(&grid, path.path());
    let finding = Folder::new(path.path(), &grid).unwrap().record(1).unwrap().unwrap().finding;
    let finding = finding.unwrap();
    let trouble = finding.trouble.unwrap();
    assert_eq!(finding.status, "failed", "{trouble}");
    assert!(trouble.starts_with("step "), "{trouble}");
}

#[test]
fn the_commands_plan_run_and_collect() {
    let path = tempfile::tempdir().unwrap();
    let file = path.path().join("small.toml");
    fs::write(&file, SMALL).unwrap();
    let results = path.path().join("results");
    let grid = |action: &str, more: &[&str]| {
        let mut arguments = vec!["grid", action, file.to_str().unwrap()];
        arguments.extend(["--out", results.to_str().unwrap()]);
        arguments.extend(more);
        run(&arguments)
    };
    let plan: Value = serde_json::from_str(&out(&grid("plan", &["--json"]))).unwrap();
    assert_eq!(plan["tasks"][5]["settings"]["ratio"], 8.0);
    assert!(!results.exists(), "nothing is written");
    assert!(out(&grid("plan", &[])).starts_with("small: 6 tasks, plan "));
    assert_eq!(grid("run", &["--task", "7"]).status.code(), Some(2));
    assert_eq!(grid("run", &["--task", "2"]).status.code(), Some(0));
    let missing = grid("collect", &[]);
    assert_eq!(missing.status.code(), Some(1));
    assert!(err(&missing).contains("5 tasks have no results: 1, 3, 4, 5, 6"));
    assert_eq!(out(&grid("run", &["--threads", "2"])), "5 of 6 tasks run, 1 were done before\n");
    let collected = grid("collect", &[]);
    assert!(out(&collected).starts_with("6 of 6 tasks collected, 0 impossible, 0 false claims\n"));
    let csv = fs::read_to_string(results.join("results.csv")).unwrap();
    assert!(!csv.contains("seconds"), "times are apart");
    let times = fs::read_to_string(results.join("times.csv")).unwrap();
    assert!(times.starts_with("task,seconds,machine\n1,"));
    fs::write(&file, SMALL.replace("8.0", "9.0")).unwrap();
    assert_eq!(grid("collect", &[]).status.code(), Some(2));
}

#[test]
fn the_page_has_a_curve_for_each_value_beside_the_axis_across() {
    let text = "scene = 'pendulum'\nmeasure = ['drift', 'iterations']\n\
                [axes]\nstep.scheme = ['velocity', 'acceleration']\n\
                [zip]\nstep.dt = [0.02, 0.01]\nsteps = [2, 4]";
    let (grid, path) = (grid(text), tempfile::tempdir().unwrap());
    run_all(&grid, path.path());
    let folder = Folder::new(path.path(), &grid).unwrap();
    let (collection, [_, _, page]) = collected(&grid, &folder);
    let names = ["drift", "iterations"];
    assert!(names.iter().all(|name| page.contains(&format!("data/{name}.csv"))), "both are drawn");
    let curves = fs::read_to_string(path.path().join("data/drift.csv")).unwrap();
    for (task, record) in &collection.done {
        let drift = lcplab::csv::number(record.finding.as_ref().unwrap().get("drift").unwrap());
        let row = |line: &&str| {
            let parts = [task.shown("step.scheme"), task.shown("step.dt"), drift.clone()];
            parts.iter().all(|part| line.contains(part))
        };
        assert_eq!(curves.lines().filter(row).count(), 1, "task {} in\n{curves}", task.task);
    }
    assert_eq!(curves.lines().count(), 1 + 4);
}

#[test]
fn the_title_states_the_ends_or_the_curves_within_the_limit() {
    let text = |limit: &str| {
        format!(
            "scene = 'pendulum'\nmeasure = ['drift']\n{limit}\n[axes]\n\
             step.scheme = ['velocity', 'acceleration']\n\
             [zip]\nstep.dt = [0.04, 0.02, 0.01]\nsteps = [2, 2, 2]"
        )
    };
    let ends = "From dt 0.01 to 0.04 the drift of ";
    let within = "At dt = 0.04 s the drift stays within 10 m with velocity and acceleration";
    for (limit, title) in [("", ends), ("limit = 10.0", within), ("limit = 0.0", ends)] {
        let (grid, path) = (grid(&text(limit)), tempfile::tempdir().unwrap());
        run_all(&grid, path.path());
        let (_, [_, _, page]) = collected(&grid, &Folder::new(path.path(), &grid).unwrap());
        assert!(page.contains(title), "{limit}");
    }
}

/// A chain of ten rods needs the fewest sweeps at ω = 2 / (1 + sin(π/20)) = 1.729.
#[test]
fn the_title_states_where_a_measure_is_least_inside_the_axis() {
    let text = |omegas: &str| {
        format!(
            "scene = 'chain'\nsteps = 1\nmeasure = ['iterations']\n[set]\ngravity = [9.81, 0, 0]\n\
             solver.name = 'sor'\nsolver.tolerance = 1e-9\ngenerate.links = 10\n\
             [axes]\nsolver.omega = [{omegas}]"
        )
    };
    // Its right end is the least of the second axis.
    for (omegas, is_inside) in [("1.2, 1.73, 1.95", true), ("1.2, 1.5, 1.73", false)] {
        let (grid, path) = (grid(&text(omegas)), tempfile::tempdir().unwrap());
        run_all(&grid, path.path());
        let (_, [_, _, page]) = collected(&grid, &Folder::new(path.path(), &grid).unwrap());
        assert_eq!(page.contains("Fewest sweeps at omega = 1.73"), is_inside, "{omegas}");
        assert!(is_inside || !page.contains("Fewest sweeps"), "{omegas}");
    }
}

#[test]
fn the_first_screen_states_the_finding_and_a_long_table_of_points_is_collapsed() {
    let text = |steps: &str| {
        format!(
            "title = 'Swing'\nscene = 'pendulum'\nmeasure = ['drift']\n[axes]\n\
             step.scheme = ['velocity', 'acceleration']\nstep.dt = [0.02, 0.01]\nsteps = [{steps}]"
        )
    };
    // 4 points, and 16.
    for (steps, collapsed) in [("2", false), ("1, 2, 3, 4", true)] {
        let (grid, path) = (grid(&text(steps)), tempfile::tempdir().unwrap());
        run_all(&grid, path.path());
        let (_, [_, _, page]) = collected(&grid, &Folder::new(path.path(), &grid).unwrap());
        let top = page.split("data (CSV)").next().unwrap(); // to the end of the first figure
        assert!(top.contains("From dt 0.01 to 0.02 the drift of "), "{steps}");
        assert!(top.contains("accepted by the judge"), "{steps}");
        let (before, _) = page.split_once("Results at each point.").unwrap();
        assert_eq!(before.contains("<details class=\"part\""), collapsed, "{steps}");
    }
}
