//! A grid as a section of a report.

use std::fs;
use std::path::Path;

use indicatif::ProgressBar;
use lcplab::report::experiment::Experiment;
use lcplab::report::grid::{Folder, Grid, collect};
use lcplab::report::methods::with_reference;
use lcplab::report::results::Results;
use lcplab::report::{run, view};
use lcplab::solver::Stop;

const GRID: &str = "title = 'Two bodies'\nfamily = 'stack'\nmeasure = 'error'\ntheory = 'mass-ratio'\n\
                    [set]\nn = 2\nsolver.name = 'pgs'\nsolver.tolerance = 0\n\
                    [axes]\nsolver.max_iterations = [1, 2, 5]\nratio = [1, 10]\n";

/// A grid file, and a report whose only section is that grid.
fn written(folder: &Path, text: &str) -> (String, String) {
    let file = folder.join("two.toml").display().to_string();
    fs::write(&file, text).unwrap();
    let report =
        format!("title = 'Mine'\nlead = ''\n[[section]]\nstudy = 'grid'\ngrid = '{file}'\n");
    (file, report)
}

fn results(report: &str) -> Results {
    let experiment = Experiment::parse(report, "mine.toml", "mine").unwrap();
    run::run(&experiment, None, with_reference(), &ProgressBar::hidden(), &Stop::default(), &|_| {
        Ok(())
    })
    .unwrap()
}

#[test]
fn a_report_finds_at_each_point_of_a_grid_what_the_grid_alone_finds() {
    let folder = tempfile::tempdir().unwrap();
    let (file, report) = written(folder.path(), GRID);
    let results = results(&report);
    let grid = Grid::load(&file).unwrap();
    let alone = Folder::new(&folder.path().join("alone"), &grid).unwrap();
    alone.run_missing(&ProgressBar::hidden(), &Stop::default()).unwrap();
    let collection = collect(&grid, &alone).unwrap();
    let own: Vec<_> =
        results.sections[0].findings().map(|found| found["finding"].clone()).collect();
    let expected = collection
        .points()
        .iter()
        .map(|point| serde_json::json!(point.finding))
        .collect::<Vec<_>>();
    assert_eq!(own, expected);
    let document = view::document(&results).unwrap();
    assert_eq!(document.figures.len(), 1);
    assert_eq!(document.tables.iter().find(|(id, _)| id == "two_tasks").unwrap().1.rows.len(), 6);
    assert!(results.is_good().unwrap());
}

#[test]
fn a_number_that_contradicts_theory_is_reported_and_the_report_is_not_good() {
    let folder = tempfile::tempdir().unwrap();
    let (_, report) = written(folder.path(), GRID);
    let mut results = results(&report);
    assert!(results.summary().unwrap().contains("6 of 6 numbers match the closed form"));
    let finding = results.sections[0].tasks[2].finding.as_mut().unwrap();
    finding["finding"]["values"]["error"] = 0.3.into();
    assert!(!results.is_good().unwrap());
    assert!(results.summary().unwrap().contains("5 of 6 numbers match the closed form"));
}

#[test]
fn a_timed_grid_shows_how_long_each_point_took() {
    let folder = tempfile::tempdir().unwrap();
    let text = GRID
        .replace("solver.tolerance = 0", "solver.tolerance = 1e-3")
        .replace("[1, 2, 5]", "[50, 100, 200]");
    let (_, report) = written(folder.path(), &text);
    let timed = results(&format!("{report}timed = true\n"));
    let figures = |results: &Results| -> Vec<String> {
        view::document(results).unwrap().figures.iter().map(|figure| figure.id().into()).collect()
    };
    assert_eq!(figures(&timed), ["two_error", "two_seconds"]);
    let plain = results(&report);
    assert_eq!(figures(&plain), ["two_error"]);
    assert!(plain.sections[0].findings().eq(timed.sections[0].findings()));
}

#[test]
fn results_are_drawn_again_without_the_grids_file() {
    let folder = tempfile::tempdir().unwrap();
    let (file, report) = written(folder.path(), GRID);
    let results = results(&report);
    let page = || view::document(&results).unwrap().page.render().unwrap();
    let before = page();
    fs::remove_file(file).unwrap();
    assert!(page() == before && before.contains("Two bodies"));
}

#[test]
fn a_grid_with_plug_ins_of_its_own_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (_, report) = written(folder.path(), &format!("{GRID}[plugins.mine]\ncommand = 'mine'\n"));
    let error = Experiment::parse(&report, "mine.toml", "mine").err().unwrap().to_string();
    assert!(error.contains("of a grid in a report must be declared in the report file"), "{error}");
}

#[test]
fn defects_of_a_grid_file_are_reported_with_their_lines() {
    let folder = tempfile::tempdir().unwrap();
    let (_, report) = written(folder.path(), &GRID.replace("'stack'", "'stacks'"));
    let refused = Experiment::parse(&report, "mine.toml", "mine").err();
    let error = refused.unwrap().to_string();
    assert!(error.contains("stacks") && error.contains("line"), "{error}");
}

#[test]
fn one_extreme_value_does_not_flatten_the_others() {
    let folder = tempfile::tempdir().unwrap();
    let text = "title = 'Chain'\nscene = 'chain'\nmeasure = 'energy_change'\n[set]\nsteps = 3\n\
                [axes]\nstep.scheme = ['velocity', 'soft', 'xpbd']\nstep.dt = [0.005, 0.01, 0.02]\n";
    let (_, report) = written(folder.path(), text);
    let mut results = results(&report);
    let mut drawn = |values: [f64; 9]| {
        for (task, value) in results.sections[0].tasks.iter_mut().zip(values) {
            task.finding.as_mut().unwrap()["finding"]["values"]["energy_change"] = value.into();
        }
        view::document(&results).unwrap().figures[0].svg()
    };
    let alike = drawn([-1.0, -2.0, -3.0, -1.0, -2.0, -3.0, -1.0, -2.0, 30.0]);
    assert!(alike.contains("data-y=\"linear "), "30 is less than 20 times the median of 2");
    let apart = drawn([-1.0, -2.0, -3.0, -1.0, -2.0, -3.0, -1.0, -2.0, 50.0]);
    assert!(apart.contains("data-y=\"symmetric:0 "), "50 is more than 20 times the median");
}
