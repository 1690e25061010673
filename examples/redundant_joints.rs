//! Mechanisms with redundant joints in random orientations, simulated with each solver, and the
//! steps whose answer the judge rejects.
//!
//! ```console
//! $ cargo run --release --example redundant_joints -- 50000 > table.md
//! $ cargo run --release --example redundant_joints -- 1000 --records dantzig > records.jsonl
//! $ python3 tests/independent/judge.py records.jsonl
//! ```
//!
//! The arguments are the number of steps for each solver and the names of solvers, by default all
//! whose class contains singular matrices. The mechanisms, orientations, gravity, feedback, time
//! steps and motors are random, with the same seed for every solver; levels alternate. With
//! `--records` every answer is printed as a line of JSON for another judge. The exit code is 1 if
//! `dantzig`, `lemke`, `block-pivoting`, `newton` or `interior-point` leaves a step without an
//! accepted answer of its own, except on Bricard's ring.

use std::collections::BTreeMap;
use std::process::ExitCode;

use lcplab::error::Result;
use lcplab::judge::{Demand, judge};
use lcplab::lcp::file::{Problem, number};
use lcplab::report::answer::json_object;
use lcplab::scene::{Scene, Scheme};
use lcplab::simulation::{Simulation, Solve};
use lcplab::solver::{
    BlockPivoting, Dantzig, Enumeration, InteriorPoint, Jacobi, Lemke, MatrixClass, Newton,
    Registry, Status,
};
use lcplab_testing::{MECHANISMS, Machine, machine};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use rayon::prelude::*;
use serde_json::json;

const TOLERANCE: f64 = 1e-8;
/// The sweeps of Jacobi's method. In a ring of welds the slowest part of its error needs up to
/// 25,000 sweeps for this tolerance: ln(10⁸) λ̄/λ, where λ is the smallest positive eigenvalue of
/// D⁻¹A, and λ̄ the bound on the largest one that sets the step.
const JACOBI_SWEEPS: usize = 100_000;
/// The steps of each simulation.
const STEPS: usize = 20;
/// It has no degree of freedom left once it has drifted: at acceleration level the run may end.
const LOCKING: &str = "a ring of Bricard";
/// The headings of the table.
const COLUMNS: [&str; 8] = [
    "solver",
    "mechanism",
    "level",
    "steps",
    "refused",
    "of these claimed",
    "other solver",
    "not taken",
];
/// The solvers that must solve every step.
const REQUIRED: [&str; 5] =
    [Dantzig::NAME, Lemke::NAME, BlockPivoting::NAME, Newton::NAME, InteriorPoint::NAME];

/// The outcomes of the solves of some steps.
#[derive(Debug, Clone, Copy, Default)]
struct Tally {
    steps: usize,
    /// Steps with an answer that the judge rejects, or without one.
    refused: usize,
    /// Of these, the steps that the solver itself calls solved.
    claimed: usize,
    /// Steps that another solver answered in its place.
    replaced: usize,
    /// Steps that were not taken because the simulation ended.
    missing: usize,
}

impl Tally {
    fn plus(self, other: Tally) -> Tally {
        Tally {
            steps: self.steps + other.steps,
            refused: self.refused + other.refused,
            claimed: self.claimed + other.claimed,
            replaced: self.replaced + other.replaced,
            missing: self.missing + other.missing,
        }
    }

    fn is_clean(&self) -> bool {
        self.refused + self.replaced + self.missing == 0
    }
}

fn main() -> Result<ExitCode> {
    let mut words: Vec<String> = std::env::args().skip(1).collect();
    let has_records = words.iter().any(|word| word == "--records");
    words.retain(|word| word != "--records");
    let (numbers, names): (Vec<String>, Vec<String>) =
        words.into_iter().partition(|word| word.parse::<usize>().is_ok());
    let steps = numbers.first().and_then(|word| word.parse().ok()).unwrap_or(1000);
    let names = if names.is_empty() { with_singular_matrices() } else { names };
    let machines = machines(steps / STEPS);
    let mut is_clean = true;
    if !has_records {
        println!("| {} |", COLUMNS.join(" | "));
        println!("| --- | --- | --- | --: | --: | --: | --: | --: |");
    }
    for name in &names {
        let runs: Vec<_> = machines
            .par_iter()
            .enumerate()
            .map(|(k, own)| run(own, Scheme::LEVELS[k % 2], name, has_records))
            .collect::<Result<_>>()?;
        let mut tallies: BTreeMap<(&str, &str), Tally> = BTreeMap::new();
        for (k, (own, (tally, records))) in machines.iter().zip(runs).enumerate() {
            let key = (MECHANISMS[own.kind], Scheme::LEVELS[k % 2].name());
            let known = tallies.entry(key).or_default();
            *known = known.plus(tally);
            records.iter().for_each(|record| println!("{record}"));
        }
        let is_required = REQUIRED.contains(&name.as_str());
        let mut but_locked = tallies.iter().filter(|((mechanism, _), _)| *mechanism != LOCKING);
        is_clean &= !is_required || but_locked.all(|(_, tally)| tally.is_clean());
        if !has_records {
            print(name, &tallies);
        }
    }
    Ok(if is_clean { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// The solvers whose class contains positive semidefinite matrices. The enumeration is left out: in
/// rational numbers redundant rows contradict each other by rounding.
fn with_singular_matrices() -> Vec<String> {
    let is_suitable = |class: MatrixClass| !matches!(class, MatrixClass::Definite | MatrixClass::P);
    let entries = Registry::standard().entries();
    let suitable = entries.filter(|entry| is_suitable(entry.class.matrix));
    suitable.map(|entry| entry.name.to_string()).filter(|name| name != Enumeration::NAME).collect()
}

/// Random machines, the same in every run.
fn machines(count: usize) -> Vec<Machine> {
    let mut runner = TestRunner::deterministic();
    (0..count).map(|_| machine().new_tree(&mut runner).expect("a machine").current()).collect()
}

/// The outcomes of the steps of a machine, and each answer as a record if they are wanted.
fn run(
    own: &Machine,
    scheme: Scheme,
    solver: &str,
    has_records: bool,
) -> Result<(Tally, Vec<String>)> {
    let mut scene = Scene::from_toml("machine.toml", &own.scene())?;
    scene.step.scheme = scheme;
    (scene.solver.name, scene.solver.tolerance) = (solver.to_string(), TOLERANCE);
    if solver == Jacobi::NAME {
        scene.solver.max_iterations = JACOBI_SWEEPS;
    }
    let mut simulation = Simulation::of(&scene)?;
    let (mut tally, mut records) = (Tally::default(), Vec::new());
    for number in 1..=STEPS {
        let Ok(step) = simulation.step() else {
            tally.missing += STEPS + 1 - number;
            break;
        };
        tally.steps += 1;
        let refused: Vec<&Solve> = step.solves.iter().filter(|solve| !is_accepted(solve)).collect();
        tally.refused += usize::from(!refused.is_empty());
        let is_claimed = refused.iter().any(|solve| solve.solution.status == Status::Solved);
        tally.claimed += usize::from(is_claimed);
        tally.replaced += usize::from(step.solves.iter().any(|solve| solve.solver != solver));
        if has_records {
            let name = format!("{}, {}, step {number}", MECHANISMS[own.kind], scheme.name());
            records.extend(step.solves.iter().map(|solve| record(&name, solve)));
        }
    }
    Ok((tally, records))
}

fn demand() -> Demand {
    Demand { tolerance: TOLERANCE, prove_up_to: 0 }
}

fn is_accepted(solve: &Solve) -> bool {
    judge(&solve.problem.lcp, &solve.solution.x, &demand()).verdict.is_solution()
}

/// An answer with the judge's verdict, as `tests/independent/judge.py` reads them.
fn record(name: &str, solve: &Solve) -> String {
    let certificate = judge(&solve.problem.lcp, &solve.solution.x, &demand());
    let vector = |v: &[f64]| -> serde_json::Value { v.iter().map(|&v| number(v)).collect() };
    let mut answer = json_object(&certificate);
    answer.insert("solver".into(), json!(solve.solver));
    answer.insert("status".into(), json!(solve.solution.status.word()));
    answer.insert("x".into(), vector(&solve.solution.x));
    answer.insert("w".into(), vector(&certificate.w));
    let problem = Problem::new(name, solve.problem.lcp.clone()).to_json();
    json!({ "name": name, "problem": problem, "tolerance": TOLERANCE, "answers": [answer] })
        .to_string()
}

fn print(solver: &str, tallies: &BTreeMap<(&str, &str), Tally>) {
    let all = tallies.values().fold(Tally::default(), |sum, tally| sum.plus(*tally));
    let rows = tallies.iter().map(|((mechanism, level), tally)| (*mechanism, *level, *tally));
    for (mechanism, level, tally) in rows.chain([("all", "both", all)]) {
        let Tally { steps, refused, claimed, replaced, missing } = tally;
        let counts = [steps, refused, claimed, replaced, missing].map(|count| count.to_string());
        println!("| `{solver}` | {mechanism} | {level} | {} |", counts.join(" | "));
    }
}
