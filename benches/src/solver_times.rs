//! The times of solvers on stacks and scenes, for reports.

use std::hint::black_box;

use lcplab::error::Result;
use lcplab::judge::{Demand, Verdict, judge};
use lcplab::lcp::Lcp;
use lcplab::lcp::friction::Model;
use lcplab::report::study::Study;
use lcplab::report::study::posed::{Loaded, OfFamily, Posed, Source};
use lcplab::report::study::settings::AtStep;
use lcplab::report::study::solved::{self, Column};
use lcplab::report::study::solver_times::{Frames, Record, SolverTime, TenSweeps, TimedProblem};
use lcplab::solver::{Entry, Options, Registry, Settings, Solution, Start, Status};

use crate::machine;
use crate::timing::{Contender, interleaved, timed};

/// One or two of each group of solvers.
const SOLVERS: [&str; 9] = [
    "pgs",
    "sor",
    "mprgp",
    "apgd",
    "newton",
    "interior-point",
    "block-pivoting",
    "dantzig",
    "lemke",
];
const TOLERANCE: f64 = 1e-8;
const MAX_ITERATIONS: usize = 50_000;
const OMEGA: f64 = 1.7;
/// Numbers of boxes.
const SIZES: [usize; 5] = [5, 10, 20, 50, 100];
/// Masses of the top box relative to the others.
const RATIOS: [f64; 2] = [1.0, 100.0];
/// Coefficients of friction.
const FRICTION: [f64; 2] = [0.0, 0.5];
/// Random piles for which no solver was tuned: numbers of bodies and contacts.
const PILES: [(usize, usize); 2] = [(100, 200), (500, 1000)];
/// Scenes and their steps.
const SCENES: [(&str, usize); 5] =
    [("incline", 50), ("sliding", 10), ("chain", 30), ("net", 20), ("pyramid", 20)];
/// How the names of recorded frames begin, and the limit of their iterations.
const ENGINES: [&str; 4] = ["drake", "lcplab", "mujoco", "pybullet"];
const FRAME_ITERATIONS: usize = 10_000;
/// The time (s) for all rounds of a problem, and the allowed numbers of rounds.
const TIME: f64 = 3.0;
const ROUNDS: (usize, usize) = (5, 300);

/// Measures them.
///
/// # Errors
/// If a problem cannot be generated.
pub fn measure() -> Result<Record> {
    let stacks = FRICTION.iter().flat_map(|&friction| {
        SIZES.iter().flat_map(move |&boxes| {
            RATIOS.map(|ratio| Source::Stack(Loaded { boxes, ratio, friction }))
        })
    });
    let piles = PILES.map(|(bodies, contacts)| {
        let values = [("bodies", bodies), ("contacts", contacts)];
        let values = values.map(|(name, value)| (name.to_string(), value as f64)).into();
        Source::Family(OfFamily { family: "contact-graph".into(), values })
    });
    let scenes = SCENES.map(|(scene, step)| Source::Scene(AtStep { scene: scene.into(), step }));
    Ok(Record {
        date: machine::today(),
        processor: machine::describe().processor,
        tolerance: TOLERANCE,
        max_iterations: MAX_ITERATIONS,
        omega: OMEGA,
        frames: frames()?,
        problems: stacks.chain(piles).chain(scenes).map(problem).collect::<Result<_>>()?,
    })
}

/// The number of recorded frames that each solver solves.
fn frames() -> Result<Frames> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../frames/");
    let column = |solver: &str| Column { solver: solver.into(), model: Some(Model::CoupledBox) };
    let study = solved::Plan {
        files: ENGINES.map(|engine| format!("{folder}{engine}_*.npz")).into(),
        solvers: SOLVERS.map(column).into(),
        tolerance: TOLERANCE,
        max_iterations: FRAME_ITERATIONS,
    };
    let mut frames = Frames {
        all: 0,
        max_iterations: FRAME_ITERATIONS,
        solved: SOLVERS.map(|own| (own.into(), 0)).into(),
    };
    for engine in 0..ENGINES.len() {
        for frame in study.run(engine, Registry::standard())?.0 {
            frames.all += 1;
            for (solver, answer) in frames.solved.iter_mut().zip(frame.answers) {
                solver.1 += usize::from(answer.is_some_and(|own| own.is_claim && own.is_accepted));
            }
        }
    }
    Ok(frames)
}

fn options() -> Options {
    let settings =
        Settings::default().with_tolerance(TOLERANCE).with_max_iterations(MAX_ITERATIONS);
    Options::default().with_settings(settings).with_omega(OMEGA)
}

fn problem(problem: Source) -> Result<TimedProblem> {
    let posed = problem.posed()?;
    let entries: Vec<&Entry> =
        SOLVERS.iter().map(|name| Registry::standard().entry(name)).collect::<Result<_>>()?;
    let mut solvers: Vec<SolverTime> = entries.iter().map(|entry| first(entry, &posed)).collect();
    let solved: Vec<usize> = (0..solvers.len()).filter(|&i| solvers[i].seconds.is_some()).collect();
    let mut contenders: Vec<Contender<'_>> =
        solved.iter().map(|&i| contender(entries[i], &posed.lcp, &options())).collect();
    let ten = options().with_settings(Settings::default().with_max_iterations(10));
    let pgs = Registry::standard().entry("pgs")?;
    contenders.push(contender(pgs, &posed.lcp, &ten));
    let round = solvers.iter().filter_map(|own| own.seconds).sum::<f64>();
    let rounds = ((TIME / round) as usize).clamp(ROUNDS.0, ROUNDS.1);
    let times = interleaved(rounds, &mut contenders);
    for (&i, time) in solved.iter().zip(&times) {
        solvers[i].seconds = Some(time.best);
    }
    let x = solve(pgs, &posed.lcp, &ten).x;
    let ten_sweeps =
        TenSweeps { seconds: times[solved.len()].best, unsupported: posed.unsupported(&x) };
    println!("{}: {} rows, {rounds} rounds", problem.name(), posed.lcp.len());
    let stored = posed.lcp.matrix().stored();
    Ok(TimedProblem { problem, rows: posed.lcp.len(), stored, ten_sweeps, solvers })
}

fn solve(entry: &Entry, lcp: &Lcp, options: &Options) -> Solution {
    entry.build(options).solve(black_box(lcp), &Start::default(), &mut ())
}

/// A first solve, with its time only if the judge accepts its answer.
fn first(entry: &Entry, posed: &Posed) -> SolverTime {
    let mut found = None;
    let seconds = timed(|| found = Some(solve(entry, &posed.lcp, &options())));
    let solution = found.expect("a solution");
    let demand = Demand { tolerance: TOLERANCE, prove_up_to: 0 };
    let verdict = judge(&posed.lcp, &solution.x, &demand).verdict;
    let is_accepted =
        solution.status == Status::Solved && !matches!(verdict, Verdict::NotASolution { .. });
    SolverTime {
        solver: entry.name.to_string(),
        iterations: solution.iterations,
        seconds: is_accepted.then_some(seconds),
    }
}

fn contender<'a>(entry: &'a Entry, lcp: &'a Lcp, options: &Options) -> Contender<'a> {
    let options = options.clone();
    Contender::new(move || {
        timed(|| {
            black_box(solve(entry, lcp, &options));
        })
    })
}
