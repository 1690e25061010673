//! Grid files: axes and their values, defects with lines, seeds.

use std::collections::BTreeSet;

use lcplab::report::grid::{Grid, Task};
use proptest::prelude::*;
use toml::Value;

use super::grid;
use lcplab_testing::cases;

/// The defects of a text, one a line.
fn defects(text: &str) -> String {
    Grid::from_toml("bad.toml", text).unwrap_err().to_string()
}

/// The values of a setting over the tasks.
fn values(text: &str, path: &str) -> Vec<f64> {
    let tasks = grid(text).plan().unwrap().tasks;
    tasks.iter().map(|task| task.number(path).unwrap()).collect()
}

#[test]
fn an_unknown_setting_is_a_defect_with_its_line_and_what_there_is() {
    let text = "scene = 'chain'\n\n[axes]\nsolver.omgea = [1.0]\nbodies.box.mass = [1]";
    let message = defects(text);
    assert!(message.contains("line 4: solver.omgea: unknown field \"omgea\""), "{message}");
    assert!(message.contains("\"name\", \"omega\", \"order\""), "{message}");
    assert!(message.contains("line 5: bodies.box.mass: unknown field \"box\""), "{message}");
}

#[test]
fn each_kind_of_mistake_has_its_line() {
    for (text, expected) in [
        (
            "scene = 'chain'\ncolour = 3",
            "line 2: \"colour\" is not a key of a grid file; the keys are title",
        ),
        (
            "family = 'stack'\nmeasure = 'speed'",
            "line 2: measure: there is no \"speed\"; there are",
        ),
        (
            "family = 'stack'\ntheory = 'none'",
            "line 2: theory: there is no \"none\"; there are young",
        ),
        ("title = 'x'", "line 1: scene: is missing"),
        ("scene = 'chain'\nfamily = 'stack'", "line 2: family: there is a scene too"),
        ("family = 'stack'\nsteps = 3", "line 2: steps: a problem of a family is solved once"),
        ("family = 'stack'\n[set]\nn = 3\n[axes]\nn = [4]", "line 3: n: is set twice"),
        ("family = 'stack'\n[axes]\nn = []", "line 3: n: is empty"),
        ("family = 'stack'\n[axes]\nn = 4", "line 3: n: needs a list of values"),
        (
            "family = 'stack'\n[axes]\nn = { from = 1, till = 3 }",
            "line 3: n: unknown field \"till\"",
        ),
        (
            "family = 'stack'\n[zip]\nn = [1, 2]\nratio = [1]",
            "line 4: zip.ratio: has 1 values, n has 2",
        ),
        ("family = 'stack'\nrepeat = 0", "line 2: repeat: must lie between 1 and 100000, is 0"),
        ("family = 'stack'\nseed = 'x'", "line 2: seed: invalid type"),
        ("family = 'stack'\n[labels]\nn = 'N'", "line 3: n: needs a text, and must be an axis"),
        (
            "family = 'stack'\n[axes]\nsolver.omega = [1]",
            "line 3: solver.omega: has no effect: dantzig",
        ),
        ("family = 'stack'\n[axes", "line 2: "),
    ] {
        let message = defects(text);
        assert!(message.contains(expected), "{text}\n{message}");
    }
    for (kind, what) in [("family", "problem family"), ("scene", "scene file or shipped scene")] {
        let unknown = defects(&format!("{kind} = 'stak'"));
        let expected = format!("line 1: {kind}: there is no {what} named \"stak\"");
        assert!(unknown.contains(&expected), "{unknown}");
    }
}

#[test]
fn a_range_has_its_ends_and_equal_steps_or_ratios() {
    let linear = "family = 'stack'\n[axes]\nratio = { from = 1.0, to = 1.9, count = 10 }";
    assert_eq!(values(linear, "ratio"), [1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9]);
    let log = "family = 'stack'\n[axes]\nn = { from = 1, to = 1000, count = 4, spacing = 'log' }";
    assert_eq!(values(log, "n"), [1.0, 10.0, 100.0, 1000.0]);
}

#[test]
fn zipped_settings_vary_together() {
    let text = "scene = 'stack'\n[axes]\nsolver.name = ['pgs', 'dantzig']\n\
                [zip]\nstep.dt = [0.01, 0.005]\nstep.count = [1, 2]";
    let tasks = grid(text).plan().unwrap().tasks;
    let row = |task: &Task| ["solver.name", "step.dt", "step.count"].map(|path| task.shown(path));
    let rows: Vec<[String; 3]> = tasks.iter().map(row).collect();
    let expected = [
        ["pgs", "0.01", "1"],
        ["pgs", "0.005", "2"],
        ["dantzig", "0.01", "1"],
        ["dantzig", "0.005", "2"],
    ];
    assert_eq!(rows, expected.map(|row| row.map(String::from)));
}

#[test]
fn a_list_of_a_scene_is_entered_by_number_or_by_name() {
    let text = "scene = 'mass_ratio1'\n[set]\nbodies.1.mass = 3\ngenerate.mass = 1\n\
                [axes]\nbodies.load.friction = [0.1]\ngenerate.base = [2]";
    let tasks = grid(text).plan().unwrap().tasks;
    assert_eq!((tasks.len(), tasks[0].settings.len()), (1, 5));
}

#[test]
fn seeds_are_shared_by_tasks_that_differ_in_the_solver_alone() {
    let text = "family = 'contact-graph'\nrepeat = 3\n[axes]\nbodies = [4, 5]\n\
                solver.name = ['pgs', 'sor', 'dantzig']";
    let tasks = grid(text).plan().unwrap().tasks;
    assert_eq!(tasks.len(), 18);
    let key = |task: &Task| (task.shown("bodies"), task.shown("repeat"));
    let problems: BTreeSet<_> = tasks.iter().map(|task| (key(task), task.seed)).collect();
    let seeds: BTreeSet<u32> = tasks.iter().map(|task| task.seed).collect();
    assert_eq!((problems.len(), seeds.len()), (6, 6));
}

#[test]
fn seeds_follow_from_the_settings_and_not_from_the_order_of_the_axes() {
    let [one, other] =
        ["bodies = [4, 5]\ncontacts = [6, 7.0]", "contacts = [7, 6]\nbodies = [5, 4]"]
            .map(|axes| grid(&format!("family = 'contact-graph'\n[axes]\n{axes}")).plan().unwrap());
    let seeds = |tasks: &[Task]| -> BTreeSet<(String, String, u32)> {
        tasks.iter().map(|t| (t.shown("bodies"), t.shown("contacts"), t.seed)).collect()
    };
    assert_ne!(one.hash, other.hash);
    assert_eq!(seeds(&one.tasks), seeds(&other.tasks));
    let text = "family = 'contact-graph'\nseed = 2\n[axes]\nbodies = [4, 5]\ncontacts = [6, 7]";
    let reseeded = grid(text).plan().unwrap();
    assert!(seeds(&one.tasks).is_disjoint(&seeds(&reseeded.tasks)));
}

proptest! {
    #![proptest_config(cases(32))]

    /// Every combination once, numbered from 1, the last axis fastest.
    #[test]
    fn a_plan_is_the_product_of_its_axes(
        sizes in prop::collection::vec(1_usize..5, 1..5),
        repeat in 1_usize..4,
    ) {
        let names = ["n", "ratio", "solver.omega", "solver.tolerance"];
        let list = |size: usize| (1..=size).map(|k| k.to_string()).collect::<Vec<_>>().join(", ");
        let axes: String =
            names.iter().zip(&sizes).map(|(name, &size)| format!("{name} = [{}]\n", list(size))).collect();
        let plan = grid(&format!(
            "family = 'stack'\nrepeat = {repeat}\n[set]\nsolver.name = 'sor'\n[axes]\n{axes}"
        )).plan().unwrap();
        prop_assert_eq!(plan.tasks.len(), sizes.iter().product::<usize>() * repeat);
        let points: Vec<Vec<f64>> = plan.tasks.iter()
            .map(|task| plan.axes.iter().map(|path| task.number(path).unwrap()).collect())
            .collect();
        prop_assert!(points.is_sorted_by(|a, b| a < b), "ascending, so none twice");
        prop_assert!(plan.tasks.iter().enumerate().all(|(k, task)| task.task == k + 1));
        prop_assert!(plan.tasks.iter().all(|task| task.settings["family"] == Value::from("stack")));
    }
}
