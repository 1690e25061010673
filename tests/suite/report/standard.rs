use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use indicatif::ProgressBar;
use lcplab::error::Error;
use lcplab::lcp::friction::Model;
use lcplab::report::experiment::{Experiment, SHIPPED};
use lcplab::report::kind::{KINDS, UNDECIDED};
use lcplab::report::methods::with_reference;
use lcplab::report::page::Table;
use lcplab::report::results::{Part, Results};
use lcplab::report::study::comparison::{Sample, thinned};
use lcplab::report::study::convergence::Finding;
use lcplab::report::study::drift::long::Curve;
use lcplab::report::study::{Study, convergence, drift, sliding};
use lcplab::report::view::{Outcome, ReportPage, View};
use lcplab::report::{run, view, write};
use lcplab::scene::catalogue::SHIPPED as SHIPPED_SCENES;
use lcplab::solver::{Method, Registry, Stop};

/// Every study once, on scenes that take milliseconds.
const SMALL: &str = r#"
title = "small"
lead = "A *small* report."

[[section]]
title = "Words alone"
text = "With $x^2$."

[[section]]
study = "comparison"
solvers = ["pgs", "dantzig"]
scenes = [{ scene = "fig7", steps = 2 }, { scene = "incline", steps = 3 }]

[[section]]
study = "cross-check"
scenes = [{ scene = "fig7", step = 1 }]

[[section]]
study = "convergence"
title = "Slopes"
text = "Look at the slopes."
scenes = [{ scene = "chain", step = 20, omegas = [1.0, 1.5] }]

[[section]]
study = "grid"
grid = "ratio"

[[section]]
study = "sliding"
mu = 0.5
push = 3.0

[[section]]
study = "sparsity"
scenes = [{ scene = "stack", step = 1 }]

[[section]]
study = "drift"
scenes = [{ scene = "pendulum", title = "Pendulum", period = 2.4, periods = 2 }]
"#;

pub fn experiment(text: &str) -> lcplab::error::Result<Experiment> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("small.toml");
    std::fs::write(&path, text).unwrap();
    Experiment::load(path.to_str().unwrap())
}

/// The results of the small report, found once for all tests.
pub fn results() -> &'static Results {
    static RESULTS: OnceLock<Results> = OnceLock::new();
    RESULTS.get_or_init(|| run_on(2))
}

fn run_on(threads: usize) -> Results {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let experiment = experiment(SMALL).unwrap();
    pool.install(|| run_all(&experiment))
}

/// The results of all its tasks, saved nowhere.
pub fn run_all(experiment: &Experiment) -> Results {
    run::run(experiment, None, with_reference(), &ProgressBar::hidden(), &Stop::default(), &|_| {
        Ok(())
    })
    .unwrap()
}

/// The document's table whose file has this name.
pub fn table(document: &ReportPage, name: &str) -> Table {
    document.tables.iter().find(|(id, _)| id == name).expect("a table of that name").1.clone()
}

#[test]
fn results_are_the_same_for_any_number_of_threads() {
    let [one, three] = [1, 3].map(run_on);
    let json = |results: &Results| {
        let mut value = serde_json::to_value(results).unwrap();
        value.as_object_mut().unwrap().remove("machine").expect("the only part that differs");
        value.to_string()
    };
    assert_eq!(json(&one), json(&three));
}

#[test]
fn results_survive_their_file_and_give_the_same_page() {
    let results = results();
    let text = serde_json::to_string(&results).unwrap();
    let back: Results = serde_json::from_str(&text).unwrap();
    assert_eq!(back, *results);
    let page = |results| view::document(results).unwrap().page.render().unwrap();
    assert_eq!(page(&back), page(results));
}

#[test]
fn a_report_is_one_page_that_fetches_nothing_with_its_data_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let page = write::report(results(), folder.path()).unwrap();
    let html = std::fs::read_to_string(page).unwrap();
    for fetched in ["src=\"http", "href=\"http", "url(http", "@import", "<script src", "<img"] {
        assert!(!html.contains(fetched), "{fetched}");
    }
    let links = html.split("href=\"data/").skip(1).filter_map(|rest| rest.split('"').next());
    let mut count = 0;
    for link in links {
        assert!(folder.path().join("data").join(link).is_file(), "{link}");
        count += 1;
    }
    // A CSV for each of 12 tables, an SVG and a CSV for each of 6 figures.
    assert_eq!(count, 12 + 2 * 6);
    assert!(folder.path().join("results.json").is_file());
    let left_over = std::fs::read_dir(folder.path()).unwrap();
    assert!(left_over.flatten().all(|file| file.path().extension().is_none_or(|e| e != "part")));
}

#[test]
fn no_claim_is_refuted() {
    let results = results();
    assert!(results.is_good().unwrap(), "{}", results.summary().unwrap());
}

#[test]
fn measured_slopes_are_the_spectral_radii_on_the_chain() {
    let found = results().findings::<convergence::Plan>().unwrap();
    let Finding::Sweeps(rates) = &found[0] else { panic!("rates: {found:?}") };
    for curve in &rates.curves {
        let (predicted, measured) = (curve.predicted_rate.unwrap(), curve.measured_rate.unwrap());
        assert!((measured.ln() / predicted.ln() - 1.0).abs() < 0.1, "ω = {}", curve.omega);
    }
}

#[test]
fn nothing_supports_a_stack_at_first_and_a_solution_supports_all_of_it() {
    let plan: convergence::Plan = toml::from_str(
        "[methods]\nproblems = [{ boxes = 3, ratio = 5.0, friction = 0.0 }]\nsolvers = ['pgs', 'lemke']",
    )
    .unwrap();
    let Finding::Methods(progress) = plan.run(0, with_reference()).unwrap().0 else {
        panic!("methods")
    };
    let [pgs, lemke] = &progress.methods[..] else { panic!("two methods") };
    assert_eq!(pgs.marks[0].iteration, 0);
    assert!((pgs.marks[0].unsupported.unwrap() - 1.0).abs() < 1e-12);
    assert!(pgs.ten().unwrap().unsupported.unwrap() > 0.1);
    for method in [pgs, lemke] {
        assert!(method.marks.last().unwrap().unsupported.unwrap() < 1e-6, "{}", method.solver);
    }
}

#[test]
fn a_task_that_fails_is_a_row_with_its_reason_and_the_others_go_on() {
    let text = SMALL.replace("\"pendulum\"", "\"moon\"");
    let results = run_all(&experiment(&text).unwrap());
    assert!(results.is_complete() && !results.is_good().unwrap());
    let reason = "there is no scene file or shipped scene named \"moon\"";
    let said = format!("drift, moon: failed: {reason}");
    assert!(results.summary().unwrap().contains(&said), "{}", results.summary().unwrap());
    let document = view::document(&results).unwrap();
    let rows = table(&document, "drift_failures").rows;
    assert!(rows.len() == 1 && rows[0][0].text == "moon" && rows[0][1].text.starts_with(reason));
    assert_eq!(table(&document, "ratio_tasks").rows.len(), 55);
}

#[test]
fn a_run_goes_on_where_another_one_stopped() {
    let experiment = experiment(SMALL).unwrap();
    let whole = run_all(&experiment);
    let mut stopped = whole.clone();
    stopped.sections[3].tasks[0].finding = None;
    // A finding that a run from the start would never make shows that it was not made again.
    let marked = serde_json::json!({"marked": true});
    stopped.sections[4].tasks[1].finding = Some(marked.clone());
    let go_on = |earlier: &Results| {
        run::run(
            &experiment,
            Some(earlier),
            with_reference(),
            &ProgressBar::hidden(),
            &Stop::default(),
            &|_| Ok(()),
        )
        .unwrap()
    };
    let resumed = go_on(&stopped);
    assert_eq!(resumed.sections[3], whole.sections[3]);
    assert_eq!(resumed.sections[4].tasks[1].finding, Some(marked));
    // Other settings, or another version, have other findings.
    stopped.sections[4].settings["bodies"] = serde_json::json!([6]);
    assert_eq!(go_on(&stopped).sections[4], whole.sections[4]);
    stopped.version = "0.0.0".into();
    assert_eq!(go_on(&stopped).sections, whole.sections);
}

#[test]
fn results_that_cannot_be_saved_are_reported_before_anything_runs() {
    let full = |_: &Results| Err(Error::invalid("results.json", "disk", "is full"));
    let progress = ProgressBar::hidden();
    let message = run::run(
        &experiment(SMALL).unwrap(),
        None,
        with_reference(),
        &progress,
        &Stop::default(),
        &full,
    )
    .unwrap_err();
    assert_eq!(message.to_string(), "results.json: disk: is full");
    assert_eq!(progress.position(), 0);
}

#[test]
fn every_kind_of_study_is_known_by_a_name_of_its_own() {
    let names: BTreeSet<_> = KINDS.iter().map(|kind| kind.name).collect();
    assert_eq!(names.len(), KINDS.len());
}

#[test]
fn kinds_that_decide_nothing_are_listed_by_name_and_all_others_decide() {
    let mut decides = BTreeMap::new();
    for (name, _) in SHIPPED {
        for section in Experiment::load(name).unwrap().sections {
            if let Some(study) = section.study {
                let outcome = study.outcome(&[]).unwrap();
                decides.insert(study.name(), outcome != Outcome::undecided());
            }
        }
    }
    // About problem files, which no shipped report has.
    decides.insert("solved", true);
    let shown: BTreeSet<&str> = decides.keys().copied().collect();
    let kinds: BTreeSet<&str> = KINDS.iter().map(|kind| kind.name).collect();
    assert_eq!(shown, kinds, "a report in reports/ shows every kind");
    let listed: BTreeSet<&str> = UNDECIDED.iter().map(|(name, _)| *name).collect();
    let undecided: BTreeSet<&str> =
        decides.iter().filter(|(_, decides)| !**decides).map(|(name, _)| *name).collect();
    assert_eq!(undecided, listed);
}

/// Whether the findings of a section of the small report are good once the first is changed.
fn is_good_after<S: View>(plan: &S, change: impl Fn(&mut S::Finding)) -> bool {
    let mut findings = results().findings::<S>().unwrap();
    assert!(plan.outcome(&findings).good, "as it was found");
    change(&mut findings[0]);
    plan.outcome(&findings).good
}

#[test]
fn pushes_and_paths_that_are_not_as_geometry_says_are_bad() {
    let plan = sliding::Plan { mu: 0.5, push: 3.0 };
    assert!(is_good_after(&plan, |_| ()));
    assert!(!is_good_after(&plan, |study| study.slides[7].expected.strength += 0.01));
    assert!(!is_good_after(&plan, |study| study.grips[3].measured = f64::NAN));
    assert!(!is_good_after(&plan, |study| study.paths[0].accepted -= 1));
    assert!(!is_good_after(&plan, |study| study.rod[0].verdict = "not_a_solution".into()));
}

#[test]
fn errors_that_do_not_fall_with_the_step_are_bad() {
    let plan = drift::Plan { scenes: Vec::new(), ledgers: Vec::new(), orders: None };
    fn curves(finding: &mut drift::Finding) -> &mut [Curve] {
        match finding {
            drift::Finding::Long(run) => &mut run.curves,
            other => panic!("a long run: {other:?}"),
        }
    }
    assert!(is_good_after(&plan, |_| ()));
    assert!(!is_good_after(&plan, |found| {
        *curves(found)[1].drift.first_mut().unwrap() = 1.0;
    }));
    assert!(!is_good_after(&plan, |found| curves(found)[0].failure = Some("no step".into())));
}

#[test]
fn a_thinned_motion_keeps_its_ends_and_its_extremes() {
    let sample = |k: usize| {
        let peak = |at: usize| if k == at { 1.0 } else { 0.0 };
        Sample {
            time: k as f64,
            energy: peak(777) - peak(1234),
            drift: peak(501),
            penetration: 0.0,
        }
    };
    let thinned = thinned(&(0..=2000).map(sample).collect::<Vec<_>>());
    let times: Vec<f64> = thinned.iter().map(|sample| sample.time).collect();
    assert!(times.is_sorted() && times.len() <= 210, "{}", times.len());
    for kept in [0.0, 501.0, 777.0, 1234.0, 2000.0] {
        assert!(times.contains(&kept), "{kept}");
    }
}

#[test]
fn a_section_says_how_its_figures_and_tables_were_obtained() {
    let document = view::document(results()).unwrap();
    let section = document.page.sections.iter().find(|section| section.id == "ratio").unwrap();
    let origin = section.origin.as_ref().expect("an origin");
    assert_eq!(origin.settings, "grid = \"ratio\"");
    assert_eq!(origin.command, "lcplab report small.toml --section ratio");
}

#[test]
fn one_section_can_be_run_alone() {
    let alone = experiment(SMALL).unwrap().only("ratio").unwrap();
    let results = run_all(&alone);
    assert_eq!(results.sections, [results_of("ratio")]);
    let message = experiment(SMALL).unwrap().only("rat").err().unwrap().to_string();
    assert!(message.starts_with("there is no section named \"rat\"; there are words-alone"));
}

fn results_of(id: &str) -> Part {
    results().sections.iter().find(|part| part.id == id).unwrap().clone()
}

#[test]
fn the_documentation_lists_every_method_and_the_models_it_takes() {
    let page = include_str!("../../../docs/solvers.md");
    for method in with_reference().methods() {
        let (line, class, source) = match method {
            Method::Boxed(entry) => (entry.method, entry.class, entry.source),
            Method::Cone(entry) => (entry.method, entry.class, entry.source),
        };
        let row = format!("| `{}` | {line} | {class} | {source} |", method.name());
        assert!(page.contains(&row), "docs/solvers.md lacks the row\n{row}");
    }
    let names = |model: Model| {
        let taking = with_reference().methods().filter(|method| method.takes(Some(model)));
        taking.map(|method| format!("`{}`", method.name())).collect::<Vec<_>>()
    };
    let boxed: Vec<String> = Registry::standard()
        .entries()
        .map(|entry| &*entry.name)
        .chain(["clarabel"])
        .map(|n| format!("`{n}`"))
        .collect();
    for model in Model::ALL {
        let mut row = page.lines().filter(|line| line.starts_with("| `"));
        let name = match model {
            Model::Polyhedral { .. } => "polygon-4".to_string(),
            model => model.to_string(),
        };
        let row = row.find(|line| line.starts_with(&format!("| `{name}`"))).expect("a row");
        let solvers = match names(model) {
            names if names == boxed => "all solvers above".to_string(),
            names if names == boxed[..boxed.len() - 1] => {
                "all solvers above except `clarabel`".to_string()
            }
            names => names.join(", "),
        };
        assert!(row.ends_with(&format!("| {solvers} |")), "{model}: {solvers}\n{row}");
    }
}

#[test]
fn the_report_on_scenes_shows_all_but_the_tower() {
    let report = Experiment::load("scenes").unwrap();
    let studies = report.sections.iter().filter_map(|section| section.study.as_ref());
    let studies = studies.filter(|study| study.name() == "scenes");
    let mut shown: Vec<String> = studies.flat_map(|study| study.tasks()).collect();
    shown.push("tower".into());
    shown.sort();
    let mut shipped: Vec<&str> = SHIPPED_SCENES.iter().map(|scene| scene.name).collect();
    shipped.sort();
    assert_eq!(shown, shipped);
}

#[test]
fn the_documentation_has_a_row_for_every_kind_of_study() {
    let page = include_str!("../../../docs/reports.md");
    let rows = page.lines().filter_map(|line| line.strip_prefix("| ")?.split(" | ").next());
    let named: BTreeSet<&str> = rows.flat_map(|names| names.split('`')).collect();
    for kind in KINDS {
        assert!(named.contains(kind.name), "docs/reports.md lacks a row for {}", kind.name);
    }
}

#[test]
fn every_shipped_report_can_be_read_and_has_a_row_in_the_documentation() {
    for (name, _) in SHIPPED {
        let report = Experiment::load(name).unwrap();
        assert!(report.sections.iter().any(|section| section.study.is_some()), "{name}");
        assert!(
            include_str!("../../../docs/reports.md").contains(&format!("\n| `{name}` |")),
            "{name}"
        );
    }
}
