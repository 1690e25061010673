//! Writes proofs of all problems of the library, and of all shipped scenes at steps 1, 10 and 60,
//! with at most ROWS rows: `cargo run --release --example prove_all -- FOLDER [ROWS]`. Then
//! `python3 proofs/lcpcheck.py FOLDER` checks them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

use lcplab::error::Result;
use lcplab::file;
use lcplab::lcp::file::Problem;
use lcplab::lcp::{Question, library};
use lcplab::proof::{ProofSearch, prove};
use lcplab::report::answer::first_answer;
use lcplab::scene::catalogue::SHIPPED;
use lcplab::simulation::Simulation;

const STEPS: [usize; 3] = [1, 10, 60];

fn main() -> Result<()> {
    let mut arguments = std::env::args().skip(1);
    let folder = PathBuf::from(arguments.next().unwrap_or_else(|| "proofs-of-all".into()));
    let most: usize = arguments.next().and_then(|rows| rows.parse().ok()).unwrap_or(200);
    let mut kinds: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    let mut proved = |problem: &Problem| -> Result<()> {
        if problem.lcp.is_empty() || problem.lcp.len() > most {
            return Ok(());
        }
        let start = Instant::now();
        let question = Question::new(problem, None, &problem.name)?;
        let ProofSearch { proof, missing } = prove(&question, &first_answer(&problem.lcp));
        let kind = proof.as_ref().map_or("none", |proof| proof.claim.kind().name());
        let coupled = problem.lcp.has_coupled_rows();
        *kinds.entry((if coupled { "coupled" } else { "not coupled" }, kind)).or_default() += 1;
        if ["none", "within"].contains(&kind) {
            let reason = &missing[0].1;
            println!("{}, {} rows: {kind}; {reason}", problem.name, problem.lcp.len());
        }
        if start.elapsed().as_secs() > 10 {
            println!("{} took {} s", problem.name, start.elapsed().as_secs());
        }
        let stem: String =
            problem.name.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
        file::write_in(&folder, format!("{stem}.json"), problem.to_json().to_string())?;
        match proof {
            Some(proof) => write(&folder, &stem, &proof.to_json().to_string()),
            None => Ok(()),
        }
    };
    file::prepare(&folder, &[])?;
    for family in library::all() {
        if let Ok(problem) = family.generate(&[]) {
            proved(&problem)?;
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
                proved(&Problem { name: format!("{} {number}", scene.name), ..problem })?;
            }
        }
    }
    for ((rows, kind), count) in kinds {
        println!("{rows:<12} {kind:<12} {count}");
    }
    Ok(())
}

fn write(folder: &Path, stem: &str, text: &str) -> Result<()> {
    file::write_in(folder, format!("{stem}.proof.json"), text)
}
