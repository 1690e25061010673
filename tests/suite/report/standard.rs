use indicatif::ProgressBar;
use lcplab::lcp::friction::Model;
use lcplab::report::experiment::Experiment;
use lcplab::report::page::Table;
use lcplab::report::results::Results;
use lcplab::report::{methods, run, view, write};
use lcplab::solver::{ALL, Method};

/// Every study once, on scenes that take milliseconds.
const SMALL: &str = r#"
title = "small"
lead = "A *small* report."
solvers = ["pgs", "dantzig"]
comparison = [{ scene = "fig7", steps = 2 }, { scene = "incline", steps = 3 }]
cross_check = [{ scene = "fig7", step = 1 }]
convergence = [{ scene = "chain", step = 20, omegas = [1.0, 1.5] }]
rates = { bodies = [5], ratios = [10.0] }
worst_cases = { sizes = [2, 4] }
friction = { mu = 0.5, push = 3.0 }
merits = [{ scene = "stack", step = 1 }]
sparsity = [{ scene = "stack", step = 1 }]
drift = [{ scene = "pendulum", duration = 0.1 }]
"#;

pub fn experiment(text: &str) -> lcplab::error::Result<Experiment> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("small.toml");
    std::fs::write(&path, text).unwrap();
    Experiment::load(path.to_str().unwrap())
}

pub fn results(threads: usize) -> Results {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let experiment = experiment(SMALL).unwrap();
    pool.install(|| run::run(&experiment, &ProgressBar::hidden())).unwrap()
}

/// The table of these results whose file has this name.
pub fn table(results: &Results, name: &str) -> Table {
    let tables = view::document(results).tables;
    tables.into_iter().find(|(id, _)| id == name).expect("a table of that name").1
}

#[test]
fn results_are_the_same_for_any_number_of_threads() {
    let [one, three] = [1, 3].map(results);
    let json = |results: &Results| {
        let mut value = serde_json::to_value(results).unwrap();
        value.as_object_mut().unwrap().remove("machine").expect("the only part that differs");
        value.to_string()
    };
    assert_eq!(json(&one), json(&three));
}

#[test]
fn results_survive_their_file_and_give_the_same_page() {
    let results = results(2);
    let text = serde_json::to_string(&results).unwrap();
    let back: Results = serde_json::from_str(&text).unwrap();
    assert_eq!(back, results);
    let page = |results| view::document(results).page.render().unwrap();
    assert_eq!(page(&back), page(&results));
}

#[test]
fn a_report_is_one_page_that_fetches_nothing_with_its_data_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let page = write::report(&results(2), folder.path()).unwrap();
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
    // A CSV for each of 15 tables, an SVG and a CSV for each of 11 figures.
    assert_eq!(count, 15 + 2 * 11);
    assert!(folder.path().join("results.json").is_file());
    let left_over = std::fs::read_dir(folder.path()).unwrap();
    assert!(left_over.flatten().all(|file| file.path().extension().is_none_or(|e| e != "part")));
}

#[test]
fn no_claim_is_refuted() {
    let results = results(2);
    assert!(results.is_good(), "{}", results.summary());
}

#[test]
fn measured_slopes_are_the_spectral_radii_on_the_chain() {
    for curve in &results(2).convergence[0].curves {
        let (predicted, measured) = (curve.predicted_rate.unwrap(), curve.measured_rate.unwrap());
        assert!((measured.ln() / predicted.ln() - 1.0).abs() < 0.1, "ω = {}", curve.omega);
    }
}

#[test]
fn a_bad_report_file_is_refused_with_its_line() {
    let wrong = experiment(&SMALL.replace("lead =", "leed =")).unwrap_err().to_string();
    assert!(wrong.contains("line 3: unknown field `leed`"), "{wrong}");
    let missing =
        experiment("title = \"t\"\nlead = \"\"\nsparsity = [{ scene = \"moon\", step = 1 }]")
            .unwrap();
    let error = run::run(&missing, &ProgressBar::hidden()).unwrap_err().to_string();
    assert!(error.starts_with("there is no scene file or shipped scene named \"moon\""), "{error}");
}

#[test]
fn the_readme_lists_every_method_and_the_models_it_takes() {
    let readme = include_str!("../../../README.md");
    for method in methods::all() {
        let (line, class, source) = match method {
            Method::Boxed(entry) => (entry.method, entry.class, entry.source),
            Method::Cone(entry) => (entry.method, entry.class, entry.source),
        };
        let row = format!("| `{}` | {line} | {class} | {source} |", method.name());
        assert!(readme.contains(&row), "the README lacks the row\n{row}");
    }
    let names = |model: Model| {
        let taking = methods::all().into_iter().filter(|method| method.takes(Some(model)));
        taking.map(|method| format!("`{}`", method.name())).collect::<Vec<_>>()
    };
    let boxed: Vec<String> =
        ALL.iter().map(|entry| entry.name).chain(["clarabel"]).map(|n| format!("`{n}`")).collect();
    for model in Model::ALL {
        let mut row = readme.lines().filter(|line| line.starts_with("| `"));
        let name = match model {
            Model::Polyhedral { .. } => "polygon-4".to_string(),
            model => model.to_string(),
        };
        let row = row.find(|line| line.starts_with(&format!("| `{name}`"))).expect("a row");
        let solvers = match names(model) {
            names if names == boxed => "all solvers above".to_string(),
            names if names == boxed[..ALL.len()] => "all solvers above but `clarabel`".to_string(),
            names => names.join(", "),
        };
        assert!(row.ends_with(&format!("| {solvers} |")), "{model}: {solvers}\n{row}");
    }
}
