//! Explains a time step of a scene, from its states to the next ones.

use std::ops::RangeInclusive;

use super::single::{Ending, Single};
use super::{Method, setup};
use lcplab_lcp::error::{Error, Result};
use lcplab_mechanics::scene::{Scene, Scheme};
use lcplab_mechanics::simulation::{Cause, Failure, Simulation, Solve};
use lcplab_page::document::notation::plain;
use lcplab_page::document::{Document, Section};

/// Explains the first steps of a scene at velocity or acceleration level.
///
/// # Errors
/// If the scene uses another scheme.
pub fn step(scene: &Scene, method: &Method, steps: usize) -> Result<Document> {
    self::steps(scene, method, 1..=steps)
}

/// Explains these steps of a scene, counted from 1; earlier steps are taken without explanation.
///
/// # Errors
/// If the scene uses another scheme.
pub fn steps(scene: &Scene, method: &Method, numbers: RangeInclusive<usize>) -> Result<Document> {
    let level = scene.step.scheme;
    if !Scheme::LEVELS.contains(&level) {
        let reason =
            format!("only velocity and acceleration can be explained, not {}", level.name());
        return Err(Error::invalid(scene.name.as_str(), "scheme", reason));
    }
    let mut document = Document {
        title: format!("{}, at {} level, by {}", scene.name, level.name(), method.name()),
        lead: format!("{}. {}", scene.title, CONVENTIONS),
        sections: Vec::new(),
        is_accepted: true,
    };
    let mut simulation = Simulation::new(scene.clone(), method.solver()?);
    for number in 1..=*numbers.end() {
        let (states, time) = (simulation.states().to_vec(), simulation.time());
        let place = format!("Step {number}");
        let outcome = simulation.step();
        if numbers.contains(&number) || outcome.is_err() {
            let when = format!("from {} s to {} s", plain(time), plain(time + scene.step.dt));
            document.add(&place, setup::states(&when, scene, &states));
        }
        match outcome {
            Ok(step) if numbers.contains(&number) => {
                solves(&mut document, scene, method, number, &step.solves, None)?;
                document.add(&place, setup::after(scene, &step));
            }
            Ok(_) => {}
            Err(failure) => {
                let solves = simulation.unfinished();
                impossible(&mut document, scene, method, &failure, solves)?;
                break;
            }
        }
    }
    Ok(document)
}

const CONVENTIONS: &str = "Rows are numbered from 0. x ≥ 0 pushes the bodies of a row apart. w of a row is the \
 velocity of its second body relative to its first one, plus the bias.";

/// The LCPs of a step, and why it failed, if it did.
fn solves(
    document: &mut Document,
    scene: &Scene,
    method: &Method,
    number: usize,
    solves: &[Solve],
    failure: Option<&Failure>,
) -> Result<()> {
    for (k, own) in solves.iter().enumerate() {
        if own.problem.lcp.is_empty() {
            continue;
        }
        let stage = own.problem.stage.name();
        let place = format!("Step {number}, {}", place(solves, k, stage));
        let ending = match failure.map(|failure| &failure.cause) {
            Some(Cause::NoSolution { proof, .. }) if k + 1 == solves.len() => {
                Ending::Impossible(proof.as_ref())
            }
            _ => Ending::ExplainedAnswer,
        };
        Single { scene, method, own, place: &place }.explain(document, ending)?;
    }
    Ok(())
}

/// A step that cannot be computed: what was solved, and what went wrong.
fn impossible(
    document: &mut Document,
    scene: &Scene,
    method: &Method,
    failure: &Failure,
    unfinished: &[Solve],
) -> Result<()> {
    solves(document, scene, method, failure.step, unfinished, Some(failure))?;
    let mut section = Section::new("the step cannot be solved");
    section.say(format!("{failure}."));
    document.add(&format!("Step {}", failure.step), section);
    document.is_accepted = false;
    Ok(())
}

/// The stage of solve k; numbered if the step has several of its kind.
fn place(solves: &[Solve], k: usize, stage: &str) -> String {
    let same = |solve: &&Solve| solve.problem.stage == solves[k].problem.stage;
    match solves.iter().filter(same).count() {
        1 => stage.to_string(),
        _ => format!("{stage} {}", solves[..=k].iter().filter(same).count()),
    }
}
