//! `problems --export`: the library as files, with cards and an index.

use std::path::Path;

use indicatif::ProgressBar;
use lcplab::card::Card;
use lcplab::certificate::{Demand, judge};
use lcplab::error::Result;
use lcplab::file;
use lcplab::lcp::file::Problem;
use lcplab::lcp::library::{self, Family};
use lcplab::plot::csv;
use lcplab::scene::{Scene, catalogue};
use lcplab::simulation;
use lcplab::solver::{Options, Start, by_name, default_for};
use sha2::{Digest, Sha256};

/// Problems with more rows are left out.
const MOST_ROWS: usize = 400;
/// Seeds of each family that has one.
const SEEDS: u32 = 3;
/// Numbers of rows, or of bodies, that a family is exported in, where it can be.
const SIZES: [f64; 3] = [10.0, 50.0, 200.0];
/// Steps of each shipped scene.
const STEPS: [usize; 2] = [1, 10];
/// The edition of the set: it changes when a file does.
const VERSION: &str = "1";

/// Writes one file a problem, index.csv and CITATION.cff.
pub fn write(folder: &Path, progress: &ProgressBar) -> Result<usize> {
    file::prepare(folder)?;
    let mut problems: Vec<Problem> = library::all().flat_map(of_family).collect();
    let scenes = catalogue::SHIPPED.iter();
    problems.extend(scenes.flat_map(|scene| STEPS.map(|k| step(scene.name, k))).flatten());
    problems.retain(|problem| (1..=MOST_ROWS).contains(&problem.lcp.len()));
    progress.set_length(problems.len() as u64);
    let mut index = String::new();
    let columns = [
        "file",
        "name",
        "source",
        "rows",
        "coupled",
        "equations",
        "class",
        "rank",
        "condition",
        "known",
        "sha256",
    ];
    csv::record(&mut index, columns);
    let mut written = Vec::new();
    for problem in &problems {
        let text = format!("{}\n", problem.to_json());
        let hash: String = Sha256::digest(&text).iter().map(|byte| format!("{byte:02x}")).collect();
        if written.contains(&hash) {
            continue; // a family with another parameter for the same problem
        }
        let name = format!("{:03}_{}.json", written.len() + 1, stem(&problem.name));
        file::write(&folder.join(&name), text)?;
        csv::record(&mut index, record(problem, &name, &hash));
        written.push(hash);
        progress.inc(1);
    }
    file::write(&folder.join("index.csv"), index)?;
    file::write(&folder.join("CITATION.cff"), citation(written.len()))?;
    Ok(written.len())
}

/// The problems of a family: its default, its sizes, its seeds.
fn of_family(family: &dyn Family) -> Vec<Problem> {
    let has = |name: &str| family.parameters().iter().any(|parameter| parameter.name == name);
    let seeds = if has("seed") { 1..=SEEDS } else { 1..=1 };
    let sizes = if has("n") { SIZES.map(Some).to_vec() } else { Vec::new() };
    let mut problems = Vec::new();
    for seed in seeds.map(f64::from) {
        for size in [None].into_iter().chain(sizes.clone()) {
            let seed = has("seed").then_some(("seed", seed));
            let given: Vec<_> = seed.into_iter().chain(size.map(|n| ("n", n))).collect();
            problems.extend(family.generate(&given)); // a size that it does not have is none
        }
    }
    problems
}

/// The last LCP of a step of a shipped scene, if there is one.
fn step(name: &str, step: usize) -> Option<Problem> {
    let scene = Scene::load(name).ok()?;
    let lcp = simulation::problem_of(&scene, step).ok()?.lcp;
    let mut problem = Problem::new(format!("{name}, step {step}"), lcp);
    problem.extra.insert("source".into(), format!("lcplab scene {name}").into());
    Some(problem)
}

/// Letters and digits of a name, for a file.
fn stem(name: &str) -> String {
    let mut stem = String::new();
    for c in name.chars() {
        match c.is_ascii_alphanumeric() {
            true => stem.push(c),
            false if !stem.ends_with('-') => stem.push('-'),
            false => {}
        }
    }
    stem.trim_matches('-').chars().take(60).collect()
}

fn record(problem: &Problem, name: &str, hash: &str) -> [String; 11] {
    let card = Card::of(&problem.lcp);
    let known = |key: &str| problem.extra.get(key).and_then(|v| v.as_str()).unwrap_or_default();
    [
        name.to_string(),
        problem.name.clone(),
        known("source").to_string(),
        card.rows.to_string(),
        card.coupled.to_string(),
        card.equations.to_string(),
        card.class.unwrap_or_default(),
        card.rank.map(|rank| rank.to_string()).unwrap_or_default(),
        card.condition.map(csv::number).unwrap_or_default(),
        truth(problem),
        hash.to_string(),
    ]
}

/// What is known of its solutions: by construction, or by a proof of the solver's answer.
fn truth(problem: &Problem) -> String {
    if let Some(expected) = problem.extra.get("expected") {
        let count = expected["solutions"].as_array().map_or(0, Vec::len);
        return match (count, expected["complete"] == true) {
            (0, true) => "no solution".into(),
            (count, true) => format!("all solutions: {count}"),
            (count, false) => format!("{count} solutions"),
        };
    }
    let solver = by_name(default_for(&problem.lcp), &Options::default());
    let Ok(solver) = solver else { return String::new() };
    let x = solver.solve(&problem.lcp, &Start::default(), &mut ()).x;
    judge(&problem.lcp, &x, &Demand::default()).verdict.word().replace('_', " ")
}

fn citation(count: usize) -> String {
    format!(
        "cff-version: 1.2.0\ntitle: \"lcplab problem set {VERSION}: {count} linear complementarity problems of contact\"\n\
         type: dataset\nversion: \"{VERSION}\"\nmessage: \"Cite it by version; index.csv has a SHA-256 of each file.\"\n\
         authors:\n  - name: \"The lcplab developers\"\n"
    )
}
