//! A citable set of problems: the library, steps of the shipped scenes and problems of physics
//! engines, as files with an index of their properties.

use std::path::Path;

use indicatif::ProgressBar;
use rayon::prelude::*;
use sha2::{Digest, Sha256};

use crate::card::Card;
use crate::csv;
use crate::error::Result;
use crate::file;
use crate::judge::exact::prove;
use crate::judge::{Demand, Verdict, judge};
use crate::lcp::file::{Expected, Problem};
use crate::lcp::friction::Model;
use crate::lcp::library::{self, Family};
use crate::lcp::{Lcp, Matrix};
use crate::report::study::cards::Record;
use crate::scene::{Scene, catalogue};
use crate::simulation::Step;
use crate::solver::{Options, Registry, Start, default_for};

/// The index with the properties of each problem.
const INDEX: &str = "index.csv";
/// How to cite the set.
const CITATION: &str = "CITATION.cff";
/// Problems with more numbers in A are left out.
const MOST_NUMBERS: usize = 90_000;
/// Number of seeds for each family that has one.
const SEEDS: u32 = 3;
/// Numbers of rows, or of bodies, in which a family is exported, if possible.
const SIZES: [f64; 3] = [10.0, 50.0, 200.0];
/// The same for sparse families.
const LARGE: [f64; 2] = [1000.0, 10_000.0];
/// The exported steps of each shipped scene.
const STEPS: [usize; 2] = [1, 10];
/// Maximum number of rows for which an exact solution is computed if none is known.
const EXACT_ROWS: usize = 24;
/// The edition of the set: it changes with any of its files.
const VERSION: &str = "3";

/// Writes one file per problem, index.csv and CITATION.cff; returns the number of problems.
///
/// # Errors
/// If the folder cannot be written.
pub fn write(folder: &Path, progress: &ProgressBar) -> Result<usize> {
    file::prepare(folder, &[INDEX, CITATION])?;
    let mut problems: Vec<Problem> = library::all().flat_map(of_family).collect();
    let scenes = catalogue::SHIPPED.par_iter();
    let steps: Vec<_> = scenes.map(|scene| steps(scene.name)).collect();
    problems.extend(steps.into_iter().flatten());
    for frame in &Record::load(None)?.frames {
        problems.push(frame.problem()?);
    }
    problems.retain(|problem| !problem.lcp.is_empty() && is_small(&problem.lcp));
    problems.par_iter_mut().for_each(solved);
    progress.set_length(problems.len() as u64);
    let examined = |problem: &Problem| {
        progress.inc(1);
        (Card::of(&problem.lcp), truth(problem))
    };
    let properties: Vec<(Card, String)> = problems.par_iter().map(examined).collect();
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
    for (problem, (card, truth)) in problems.iter().zip(&properties) {
        let text = format!("{}\n", problem.to_json());
        let hash: String = Sha256::digest(&text).iter().map(|byte| format!("{byte:02x}")).collect();
        if written.contains(&hash) {
            // A family with another parameter for the same problem.
            continue;
        }
        let name = format!("{:03}_{}.json", written.len() + 1, stem(&problem.name));
        file::write_in(folder, &name, text)?;
        csv::record(&mut index, record(problem, card, [truth, &name, &hash]));
        written.push(hash);
    }
    file::write_in(folder, INDEX, index)?;
    file::write_in(folder, CITATION, citation(written.len()))?;
    Ok(written.len())
}

/// The problems of a family: its default, its sizes, its seeds.
fn of_family(family: &dyn Family) -> Vec<Problem> {
    let has = |name: &str| family.parameters().iter().any(|parameter| parameter.name == name);
    let seeds = if has("seed") { 1..=SEEDS } else { 1..=1 };
    let mut problems = Vec::new();
    for seed in seeds.map(f64::from) {
        let given = has("seed").then_some(("seed", seed));
        // A size that the family does not have is skipped.
        let sized =
            |n: f64| family.generate(&given.into_iter().chain([("n", n)]).collect::<Vec<_>>()).ok();
        problems.extend(family.generate(given.as_slice()));
        if has("n") {
            let usual: Vec<Problem> = SIZES.into_iter().filter_map(sized).collect();
            let is_sparse =
                usual.last().is_some_and(|p| matches!(p.lcp.matrix(), Matrix::Sparse(_)));
            problems.extend(usual);
            if is_sparse && seed == 1.0 {
                problems
                    .extend(LARGE.into_iter().map_while(|n| sized(n).filter(|p| is_small(&p.lcp))));
            }
        }
    }
    problems
}

fn is_small(lcp: &Lcp) -> bool {
    lcp.matrix().stored() <= MOST_NUMBERS
}

/// The last LCPs of these steps of a shipped scene, up to the first step that has none or a large
/// one: large scenes take minutes to simulate.
fn steps(name: &str) -> Vec<Problem> {
    let Ok(scene) = Scene::load(name) else { return Vec::new() };
    let exported = |step| Some(Step::of(&scene, step).ok()?.solves.pop()?.exported(&scene, step));
    STEPS.into_iter().map_while(|step| exported(step).filter(|p| is_small(&p.lcp))).collect()
}

/// Adds an exact solution to a small problem without a known one.
fn solved(problem: &mut Problem) {
    let lcp = &problem.lcp;
    let is_open = is_boxed(problem) && !problem.extra.contains_key("expected");
    if !is_open || lcp.len() > EXACT_ROWS {
        return;
    }
    let proof = answer(lcp).and_then(|x| prove(lcp, &x));
    if let Some(proof) = proof {
        let expected = Expected::one_of_several(proof.x);
        problem.extra.insert("expected".into(), expected.json());
    }
}

/// Whether it is solved as a boxed LCP, and not under another friction model.
fn is_boxed(problem: &Problem) -> bool {
    problem.model.is_none_or(|model| model == Model::CoupledBox)
}

/// The answer of the default solver.
fn answer(lcp: &Lcp) -> Option<Vec<f64>> {
    let solver = Registry::standard().entry(default_for(lcp)).ok()?.build(&Options::default());
    Some(solver.solve(lcp, &Start::default(), &mut ()).x)
}

/// Letters and digits of a name, for a file name.
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

/// A line of the index, from the problem's truth, the name of its file and its hash.
fn record(problem: &Problem, card: &Card, [truth, name, hash]: [&str; 3]) -> [String; 11] {
    let known = |key: &str| problem.extra.get(key).and_then(|v| v.as_str()).unwrap_or_default();
    [
        name.to_string(),
        problem.name.clone(),
        known("source").to_string(),
        card.rows.to_string(),
        card.coupled.to_string(),
        card.equations.to_string(),
        card.class.clone().unwrap_or_default(),
        card.rank.map(|rank| rank.to_string()).unwrap_or_default(),
        card.condition.map(csv::number).unwrap_or_default(),
        truth.to_string(),
        hash.to_string(),
    ]
}

/// What is known about its solutions: by construction, or by the judge's verdict on the default
/// solver's answer.
fn truth(problem: &Problem) -> String {
    match Expected::of(problem) {
        Some(expected) if expected.is_impossible() => "no solution".into(),
        Some(Expected { solutions, complete }) => {
            let how_many = if complete { "all solutions" } else { "solutions" };
            format!("{how_many}: {}", solutions.len())
        }
        None if !is_boxed(problem) => String::new(),
        None => {
            let verdict = answer(&problem.lcp)
                .map(|x| judge(&problem.lcp, &x, &Demand::default()).verdict)
                .filter(Verdict::is_solution);
            verdict.map_or(String::new(), |verdict| verdict.word().replace('_', " "))
        }
    }
}

fn citation(count: usize) -> String {
    format!(
        "cff-version: 1.2.0\ntitle: \"lcplab problem set {VERSION}: {count} linear complementarity problems of contact\"\n\
         type: dataset\nversion: \"{VERSION}\"\nmessage: \"Cite it by version; index.csv has a SHA-256 of each file.\"\n\
         license:\n  - MIT\n  - Apache-2.0\nauthors:\n  - name: \"The lcplab developers\"\n"
    )
}
