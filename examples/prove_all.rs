//! Writes proofs of all problems of the library, and of all shipped scenes at steps 1, 10 and 60,
//! with at most ROWS rows: `cargo run --release --example prove_all -- FOLDER [ROWS] [MODEL]`. Then
//! `python3 proofs/lcpcheck.py FOLDER` checks them.
//!
//! With a friction model, the problems are those with contacts, under this model, and the recorded
//! frames in `frames` of engines that use it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

use lcplab::error::Result;
use lcplab::file;
use lcplab::files;
use lcplab::judge::{Demand, judge_friction};
use lcplab::lcp::file::Problem;
use lcplab::lcp::friction::Model;
use lcplab::lcp::{Question, library};
use lcplab::proof::{Claim, Near, ProofSearch, prove};
use lcplab::report::answer::first_answer;
use lcplab::scene::catalogue::SHIPPED;
use lcplab::simulation::Simulation;
use lcplab::solver::{Options, Settings, solve_by_sequence};

const STEPS: [usize; 3] = [1, 10, 60];
/// A proved distance, relative to the largest entry, that counts as close.
const CLOSE: f64 = 1e-9;

fn main() -> Result<()> {
    let mut arguments = std::env::args().skip(1);
    let folder = PathBuf::from(arguments.next().unwrap_or_else(|| "proofs-of-all".into()));
    let most: usize = arguments.next().and_then(|rows| rows.parse().ok()).unwrap_or(200);
    let model: Option<Model> = arguments.next().map(|model| model.parse()).transpose()?;
    file::prepare(&folder, &[])?;
    let mut tally = Tally { folder, most, model, counts: BTreeMap::new() };
    for family in library::all() {
        if let Ok(problem) = family.generate(&[]) {
            tally.add("library", problem)?;
        }
    }
    for scene in SHIPPED {
        let mut simulation = Simulation::of(&scene.scene()?)?;
        for number in 1..=STEPS[STEPS.len() - 1] {
            let Ok(step) = simulation.step() else { break };
            if step.solves.iter().any(|solve| solve.problem.lcp.len() > 4 * most) {
                break; // all later steps are too large, too
            }
            if let (true, Some(solve)) = (STEPS.contains(&number), step.solves.last()) {
                let problem = solve.exported(simulation.scene(), number);
                let name = format!("{} {number}", scene.name);
                tally.add("scenes", Problem { name, ..problem })?;
            }
        }
    }
    if model.is_some() {
        let entries = std::fs::read_dir("frames").expect("the folder of the frames");
        let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
        paths.retain(|path| path.extension().is_some_and(|ending| ending == "npz"));
        paths.sort();
        for path in paths {
            let problem = files::read(&path, None)?;
            if problem.model == model {
                tally.add("frames", problem)?;
            }
        }
    }
    for ((of, rows, kind), count) in tally.counts {
        println!("{of:<8} {rows:<12} {kind:<40} {count}");
    }
    Ok(())
}

/// The kinds of the proofs that were found.
struct Tally {
    folder: PathBuf,
    most: usize,
    model: Option<Model>,
    counts: BTreeMap<(&'static str, &'static str, String), usize>,
}

impl Tally {
    /// Proves what can be proved of a problem, and writes both.
    fn add(&mut self, of: &'static str, problem: Problem) -> Result<()> {
        let n = problem.lcp.len();
        let has_contacts = problem.friction().is_some_and(|friction| friction.is_ok());
        if n == 0 || n > self.most || self.model.is_some() && !has_contacts {
            return Ok(());
        }
        let problem = Problem { model: self.model.or(problem.model), ..problem };
        let question = Question::new(&problem, None, &problem.name)?;
        let answer = match self.model {
            Some(_) => solve_by_sequence(question.posed(), &precise(), &mut ()).solution.x,
            None => first_answer(&question),
        };
        let start = Instant::now();
        let ProofSearch { proof, missing } = prove(&question, &answer);
        let seconds = start.elapsed().as_secs_f64();
        let kind = proof.as_ref().map_or("none", |proof| proof.claim.kind().name());
        let mut result = kind.to_string();
        if self.model.is_some() {
            let claim = proof.as_ref().map(|proof| &proof.claim);
            result += match claim {
                Some(Claim::BodySolution { region, .. }) if region.bias_change > 0.0 => {
                    ", changed bias"
                }
                _ => "",
            };
            let size = answer.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
            result += match claim {
                Some(
                    Claim::Solution { near: Some(Near { distance, .. }), .. }
                    | Claim::ConeSolution { near: Some(Near { distance, .. }), .. }
                    | Claim::BodySolution { near: Some(Near { distance, .. }), .. },
                ) if *distance > CLOSE * size => ", farther than 1e-9",
                _ => "",
            };
            let demand = Demand { prove_up_to: 0, ..Demand::default() };
            let verdict = judge_friction(question.posed(), &answer, &demand).verdict;
            result += if verdict.is_solution() { "" } else { " (answer rejected)" };
            println!("{}, {n} rows: {result}, {seconds:.3} s", problem.name);
        } else if ["none", "within"].contains(&kind) {
            println!("{}, {n} rows: {kind}; {}", problem.name, missing[0].1);
        }
        if seconds > 10.0 {
            println!("{} took {seconds:.0} s", problem.name);
        }
        let coupled = problem.lcp.has_coupled_rows();
        let rows = if coupled { "coupled" } else { "not coupled" };
        *self.counts.entry((of, rows, result)).or_default() += 1;
        let stem: String =
            problem.name.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
        file::write_in(&self.folder, format!("{stem}.json"), problem.to_json().to_string())?;
        match proof {
            Some(proof) => write(&self.folder, &stem, &proof.to_json().to_string()),
            None => Ok(()),
        }
    }
}

/// A tolerance near rounding, so that the distance of a proof is not that of the solver.
fn precise() -> Options {
    let settings = Settings::default().with_tolerance(1e-14).with_max_iterations(20_000);
    Options::default().with_settings(settings)
}

fn write(folder: &Path, stem: &str, text: &str) -> Result<()> {
    file::write_in(folder, format!("{stem}.proof.json"), text)
}
