//! Verdicts as lines of JSON, to test another judge: the problems of the library, random hostile
//! problems and steps of the shipped scenes, each with the answers of all solvers and some wrong
//! answers, the judge's verdicts on them, and the diagnosis of the problem; and steps of mechanisms
//! with redundant joints in skew orientations, with the answers of the pivoting solvers.
//!
//! ```console
//! $ cargo run --example verdicts -- 2000 > verdicts.jsonl
//! $ for judge in judge cones polygons; do python3 tests/independent/$judge.py verdicts.jsonl; done
//! ```
//!
//! The argument is the number of random problems. `tests/independent` states what is checked.

use lcplab::simulation::Simulation;
use std::io::{self, BufWriter, Write};

use lcplab::diagnosis;
use lcplab::error::Result;
use lcplab::hunt;
use lcplab::judge::{Demand, judge, judge_cone};
use lcplab::lcp::file::{Problem, number};
use lcplab::lcp::friction::{ConeProblem, FrictionProblem, Law, Model, Polyhedral, ProblemForm};
use lcplab::lcp::{Lcp, library};
use lcplab::report::answer::{Answer, json_object, rounding_json};
use lcplab::report::friction::JudgedAnswer;
use lcplab::scene::{Scene, Scheme, catalogue};
use lcplab::solver::{Options, PolygonPgs, Registry, Settings, Solution, Solver, Start, Status};
use lcplab_testing::{EFFORTS, MECHANISMS, Machine};
use rayon::prelude::*;
use serde_json::{Value, json};

/// Larger problems are left out: exact arithmetic in Python takes too long.
const MOST_ROWS: usize = 60;
/// The seed of the random hostile problems.
const SEED: u64 = 17;
/// The number of contacts with a cone in very different units.
const CONTACTS: usize = 300;
/// The corners of the friction polygons.
const CORNERS: [usize; 2] = [4, 8];
/// Larger problems are left out under a polygon, where a contact has up to ten unknowns.
const MOST_POLYGON_ROWS: usize = 24;
/// The steps of each scene that are examined.
const STEPS: [usize; 3] = [1, 5, 20];
/// The solvers whose class contains the problems of mechanisms with redundant joints.
const PIVOTING: [&str; 3] = ["dantzig", "lemke", "block-pivoting"];

fn main() -> Result<()> {
    let random = std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(2000);
    let settings = Settings::default().with_max_iterations(500);
    let options = Options::default().with_settings(settings);
    let solvers: Vec<_> =
        Registry::standard().entries().map(|entry| entry.build(&options)).collect();
    let mut subjects = of_library()?;
    subjects.extend((0..random).map(hostile));
    subjects.extend(of_scenes()?);
    subjects.retain(|subject| subject.problem.lcp.len() <= MOST_ROWS);
    let mut records: Vec<Value> =
        subjects.par_iter().map(|subject| record(subject, &solvers)).collect();
    records.extend(of_machines(&solvers)?);
    records.extend(of_cones(&subjects));
    records.extend(of_polygons(&subjects)?);
    let mut out = BufWriter::new(io::stdout().lock());
    for record in records {
        writeln!(out, "{record}").expect("standard output");
    }
    Ok(())
}

/// Every problem with pairs of tangents under both cone laws, and contacts in very different units.
fn of_cones(subjects: &[Subject]) -> Vec<Value> {
    let single = |k: usize| {
        let truth = hunt::cone::contact(SEED, k);
        (format!("contact {k}"), truth.problem.friction().clone())
    };
    let problems: Vec<_> = with_contacts(subjects).chain((0..CONTACTS).map(single)).collect();
    let models = [Model::CoulombCone, Model::AssociatedCone];
    let both = problems.par_iter().flat_map_iter(|named| models.map(|model| (named, model)));
    both.map(|((name, friction), model)| cone_record(name, friction, model)).collect()
}

/// The problems with pairs of tangents, and their names.
fn with_contacts(subjects: &[Subject]) -> impl Iterator<Item = (String, FrictionProblem)> {
    subjects.iter().filter_map(|subject| {
        let Problem { name, lcp, .. } = &subject.problem;
        let friction = lcp.coupling().and_then(|_| FrictionProblem::of(lcp).ok())?;
        Some((name.clone(), friction))
    })
}

/// The smaller of these problems under polygons, contacts in very different units, and contacts
/// whose numbers are small integers, which have many ties.
fn of_polygons(subjects: &[Subject]) -> Result<Vec<Value>> {
    let random = |k: usize| {
        let friction = FrictionProblem::of(&hunt::contact_problem(SEED, k)).ok()?;
        Some((format!("contact {k}"), friction))
    };
    let problems: Vec<_> = with_contacts(subjects)
        .filter(|(_, friction)| friction.lcp().len() <= MOST_POLYGON_ROWS)
        .chain((0..CONTACTS / 2).filter_map(random))
        .collect();
    let all = problems.par_iter().flat_map_iter(|named| CORNERS.map(|corners| (named, corners)));
    all.map(|((name, friction), corners)| polygon_record(name, friction, corners)).collect()
}

fn polygon_record(name: &str, friction: &FrictionProblem, corners: usize) -> Result<Value> {
    let model = Model::Polyhedral { directions: corners };
    let posed = ProblemForm::Polyhedral(Polyhedral::new(friction, corners)?);
    let settings = Settings::default().with_max_iterations(500);
    let options = Options::default().with_settings(settings.clone());
    let demand = Demand::default();
    let judged = |solver: &str, status: Option<&Status>, x: &[f64]| {
        let judged = JudgedAnswer::at_contacts(friction, &posed, x, &demand);
        let (word, judged) = match status {
            Some(status) => {
                let judged = judged.with_claim(&posed, status, &demand);
                (judged.claim(status, None).0, judged)
            }
            None => ("failed", judged), // no solver claims it
        };
        let certificate = &judged.certificate;
        let mut answer = json_object(&certificate.verdict);
        answer.extend(rounding_json(certificate.rounded_by));
        let evidence = certificate.evidence.iter();
        answer.extend(evidence.map(|found| ("certificate".into(), json_object(found).into())));
        answer.insert("solver".into(), json!(solver));
        answer.insert("status".into(), json!(word));
        answer.insert("x".into(), x.iter().map(|&x| number(x)).collect());
        answer.insert("scaled_residual".into(), number(certificate.scaled_residual));
        Value::Object(answer)
    };
    let mut answers = Vec::new();
    let mut right = vec![0.0; friction.lcp().len()];
    let mut solved = |name: &str, solution: Solution| {
        if solution.status == Status::Solved {
            right.clone_from(&solution.x);
        }
        answers.push(judged(name, Some(&solution.status), &solution.x));
    };
    for method in Registry::standard().methods().filter(|method| method.takes(Some(model))) {
        solved(method.name(), method.solve(&posed, &options, &mut ()));
    }
    if let ProblemForm::Polyhedral(polyhedral) = &posed {
        let sweeps = PolygonPgs { settings };
        solved(PolygonPgs::NAME, sweeps.solve(polyhedral, &Start::default(), &mut ()));
    }
    // For one contact there are few active sets to try.
    let exact = (friction.lcp().len() == 3)
        .then(|| hunt::RightAnswer::of(&posed, Some(model), None, None))
        .flatten();
    if let Some(exact) = exact {
        answers.push(judged("exact", None, &exact.x));
        right = exact.x;
    }
    let boxed = friction.coupled_box();
    answers.extend(strange(&boxed, &right).map(|(name, x)| judged(name, None, &x)));
    answers.extend(turned(friction, &right).map(|(name, x)| judged(name, None, &x)));
    Ok(json!({
        "name": name, "model": model.to_string(), "problem": Problem::new(name, boxed).to_json(),
        "tolerance": demand.tolerance, "answers": answers,
    }))
}

/// Answers with wrong friction: turned by 90°, missing, or at the limit of the disk.
fn turned(friction: &FrictionProblem, x: &[f64]) -> impl Iterator<Item = (&'static str, Vec<f64>)> {
    type Turn = fn([f64; 3], f64) -> [f64; 3];
    let turns: [(&'static str, Turn); 3] = [
        ("turned", |[n, t1, t2], _| [n, -t2, t1]),
        ("frictionless", |[n, _, _], _| [n, 0.0, 0.0]),
        ("on the disk", |[n, t1, t2], mu| match t1.hypot(t2) {
            0.0 => [n, mu * n, 0.0],
            length => [n, mu * n * (t1 / length), mu * n * (t2 / length)],
        }),
    ];
    turns.into_iter().map(move |(name, turn)| {
        let mut y = x.to_vec();
        for contact in friction.contacts() {
            contact.put(turn(contact.of(x), contact.mu), &mut y);
        }
        (name, y)
    })
}

fn cone_record(name: &str, friction: &FrictionProblem, model: Model) -> Value {
    let settings = Settings::default().with_max_iterations(500);
    let demand = Demand::default();
    let law = if model == Model::CoulombCone { Law::Coulomb } else { Law::Associated };
    let cone = ConeProblem::new(friction.clone(), law);
    let judged = |solver: &str, status: &str, x: &[f64]| {
        let certificate = judge_cone(&cone, x, &demand);
        let mut answer = json_object(&certificate.verdict);
        answer.extend(rounding_json(certificate.rounded_by));
        answer.insert("solver".into(), json!(solver));
        answer.insert("status".into(), json!(status));
        answer.insert("x".into(), x.iter().map(|&x| number(x)).collect());
        answer.insert("scaled_residual".into(), number(certificate.scaled_residual));
        Value::Object(answer)
    };
    let mut answers = Vec::new();
    let mut last = vec![0.0; friction.lcp().len()];
    for entry in Registry::standard().cone_entries().filter(|entry| entry.laws.contains(&law)) {
        let solution = entry.build(&settings).solve(&cone, &Start::default(), &mut ());
        answers.push(judged(&entry.name, solution.status.word(), &solution.x));
        last = solution.x;
    }
    answers.extend(
        strange(&friction.coupled_box(), &last).map(|(name, x)| judged(name, "failed", &x)),
    );
    let problem = Problem::new(name, friction.coupled_box()).to_json();
    json!({
        "name": name, "model": model.to_string(), "problem": problem,
        "tolerance": demand.tolerance, "answers": answers,
    })
}

/// A problem, and where the solvers start.
struct Subject {
    problem: Problem,
    start: Option<Vec<f64>>,
}

impl Subject {
    fn cold(problem: Problem) -> Self {
        Subject { problem, start: None }
    }
}

fn of_library() -> Result<Vec<Subject>> {
    library::all().map(|family| Ok(Subject::cold(family.generate(&[])?))).collect()
}

fn hostile(k: usize) -> Subject {
    let (lcp, start) = hunt::problem(SEED, k);
    let kind = hunt::KINDS[k % hunt::KINDS.len()].name;
    Subject { problem: Problem::new(format!("{kind} {k}"), lcp), start }
}

/// The LCPs of three steps of each shipped scene, at velocity and at acceleration level.
fn of_scenes() -> Result<Vec<Subject>> {
    let names = catalogue::SHIPPED.iter().map(|shipped| shipped.name);
    let runs: Vec<_> = names.flat_map(|name| Scheme::LEVELS.map(|level| (name, level))).collect();
    let subjects: Result<Vec<_>> =
        runs.par_iter().map(|&(name, level)| of_scene(name, level)).collect();
    Ok(subjects?.into_iter().flatten().collect())
}

fn of_scene(name: &str, level: Scheme) -> Result<Vec<Subject>> {
    of_steps(name, Scene::load(name)?, level)
}

/// The LCPs of three steps of each mechanism with redundant joints, in two skew orientations, with
/// and without gravity, at both levels. They are judged as `simulate` judges steps, without a
/// search for an exact solution: redundant rows agree but for rounding, so often there is none.
fn of_machines(solvers: &[Box<dyn Solver>]) -> Result<Vec<Value>> {
    let settings = [
        ([0.4, -1.3, 0.6], 9.81, EFFORTS[0], 0.1, 0.01),
        ([-2.1, 0.9, 2.7], 0.0, EFFORTS[1], 0.2, 1.0 / 60.0),
    ];
    let demand = Demand { prove_up_to: 0, ..Demand::default() };
    let mut records = Vec::new();
    for (kind, name) in MECHANISMS.into_iter().enumerate() {
        for (angles, gravity, effort, beta, dt) in settings {
            let text = Machine { kind, angles, gravity, effort, beta, dt }.scene();
            for level in Scheme::LEVELS {
                let scene = Scene::from_toml("machine.toml", &text)?;
                let steps = of_steps(&format!("{name}, gravity {gravity},"), scene, level)?;
                let all = || solvers.iter().map(|solver| &**solver);
                let pivoting = || all().filter(|solver| PIVOTING.contains(&solver.name()));
                records.extend(steps.iter().map(|step| judged_record(step, pivoting(), &demand)));
            }
        }
    }
    Ok(records)
}

fn of_steps(name: &str, mut scene: Scene, level: Scheme) -> Result<Vec<Subject>> {
    scene.step.scheme = level;
    let mut simulation = Simulation::of(&scene)?;
    let mut subjects = Vec::new();
    for step in 1..=STEPS[2] {
        let Ok(taken) = simulation.step() else { break };
        if taken.solves.iter().any(|solve| solve.problem.lcp.len() > 4 * MOST_ROWS) {
            break; // all later steps are too large, too
        }
        let solves = taken.solves.iter().filter(|_| STEPS.contains(&step));
        for solve in solves.filter(|solve| solve.posing.is_none()) {
            let name = format!("{name} {}, step {step}", level.name());
            subjects.push(Subject::cold(Problem::new(name, solve.problem.lcp.clone())));
        }
    }
    Ok(subjects)
}

fn record(subject: &Subject, solvers: &[Box<dyn Solver>]) -> Value {
    let mut record =
        judged_record(subject, solvers.iter().map(|solver| &**solver), &Demand::default());
    // Without one where the singular values of A cannot be found.
    let diagnosis = diagnosis::problem(&subject.problem);
    record["diagnosis"] = diagnosis.map_or(Value::Null, |found| found.to_json());
    record
}

/// The answers of the solvers and the wrong ones, judged; without a diagnosis.
fn judged_record<'s>(
    subject: &Subject,
    solvers: impl Iterator<Item = &'s dyn Solver>,
    demand: &Demand,
) -> Value {
    let Subject { problem, start } = subject;
    let lcp = &problem.lcp;
    let mut answers = Vec::new();
    let mut exact = vec![0.0; lcp.len()];
    for solver in solvers {
        let start = Start { x: start.as_deref(), ..Start::default() };
        let solution = solver.solve(lcp, &start, &mut ());
        if solution.status == Status::Solved {
            exact.clone_from(&solution.x);
        }
        answers.push(Answer::judged(lcp, solver.name(), solution, demand).to_json().into());
    }
    answers.extend(strange(lcp, &exact).map(|(name, x)| judged(lcp, name, &x, demand)));
    json!({
        "name": problem.name, "problem": problem.to_json(), "tolerance": demand.tolerance,
        "answers": answers,
    })
}

/// An entry of x and its row, changed.
type Change = fn(f64, usize) -> f64;

/// Answers that are wrong, or barely right.
fn strange<'a>(lcp: &'a Lcp, x: &'a [f64]) -> impl Iterator<Item = (&'static str, Vec<f64>)> + 'a {
    let changes: [(&'static str, Change); 8] = [
        ("nothing", |_, _| 0.0),
        ("far", |_, _| 1e9),
        ("doubled", |x, _| 2.0 * x),
        ("a little more", |x, _| x * (1.0 + 1e-9)),
        ("shifted", |x, i| if i == 0 { x + 1e-7 } else { x }),
        ("negative", |x, _| -x),
        ("dusty", |x, _| x),
        ("dirty", |x, _| x),
    ];
    changes.into_iter().map(move |(name, change)| {
        let mut x: Vec<f64> = x.iter().enumerate().map(|(i, &x)| change(x, i)).collect();
        let size = x.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
        match name {
            "far" => lcp.project_all(&mut x),
            // A rounding error, and a larger error, in every third entry.
            "dusty" => x.iter_mut().step_by(3).for_each(|x| *x += 1e-15 * size),
            "dirty" => x.iter_mut().step_by(3).for_each(|x| *x += 1e-12 * size),
            _ => {}
        }
        (name, x)
    })
}

fn judged(lcp: &Lcp, name: &str, x: &[f64], demand: &Demand) -> Value {
    let certificate = judge(lcp, x, demand);
    let vector = |v: &[f64]| -> Value { v.iter().map(|&v| number(v)).collect() };
    let mut answer = json_object(&certificate);
    answer.insert("solver".into(), json!(name));
    answer.insert("status".into(), json!("failed")); // no solver claims it
    answer.insert("x".into(), vector(x));
    answer.insert("w".into(), vector(&certificate.w));
    Value::Object(answer)
}
