//! Explains a time step of a scene, from its states to the next ones.

use std::ops::RangeInclusive;

use nalgebra::Vector3;

use super::single::{Ending, Single};
use super::units::{Units, with_unit};
use super::{Method, setup};
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::number::{capitalized, counted, readable};
use lcplab_mechanics::assembly::{Row, Source};
use lcplab_mechanics::body::{Mass, State, linear};
use lcplab_mechanics::formulation::Stage;
use lcplab_mechanics::scene::{Scene, Scheme};
use lcplab_mechanics::simulation::{Cause, Failure, Simulation, Solve, Step};
use lcplab_page::document::notation::{plain, vector};
use lcplab_page::document::{Block, Document, Section};
use lcplab_solver::{Registry, Status};

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
    let name = if scene.title.is_empty() { &scene.name } else { &scene.title };
    let mut document = Document {
        title: name.clone(),
        lead: String::new(),
        sections: Vec::new(),
        is_accepted: true,
    };
    let mut lead: Vec<String> = Vec::new();
    let mut simulation = Simulation::new(scene.clone(), method.solver()?);
    for number in 1..=*numbers.end() {
        let (states, time) = (simulation.states().to_vec(), simulation.time());
        let outcome = simulation.step();
        let own = match &outcome {
            Ok(step) => &step.solves,
            Err(_) => simulation.unfinished(),
        };
        if numbers.contains(&number) || outcome.is_err() {
            let [from, to] = [time, time + scene.step.dt].map(plain);
            let when = format!("step {number}, from {from} s to {to} s");
            let problem = own.first().map(|solve| &solve.problem);
            document.add("", setup::states(&when, scene, &states, problem));
        }
        match outcome {
            Ok(step) if numbers.contains(&number) => {
                let place = if numbers.clone().count() > 1 {
                    format!("Step {number}, ")
                } else {
                    String::new()
                };
                lead.push(found(&place, level, &step.solves));
                lead.push(meaning(scene, &states, &step));
                solves(&mut document, scene, method, &place, &step.solves, None)?;
                let mut after = setup::after(scene, &states, &step);
                after.title = format!("{place}{}", after.title);
                document.add("", after);
            }
            Ok(_) => {}
            Err(failure) => {
                lead.push(format!("{failure}."));
                let solves = simulation.unfinished();
                impossible(&mut document, scene, method, &failure, solves)?;
                break;
            }
        }
    }
    lead.retain(|words| !words.is_empty());
    lead.truncate(LISTED);
    lead.push(match document.is_accepted {
        true => "The judge accepts every answer.".into(),
        false => "The judge does not accept every answer.".into(),
    });
    document.lead = lead.join(" ");
    Ok(document)
}

/// Maximum number of sentences of the lead: two for each step.
const LISTED: usize = 4;

/// Maximum number of rows of an x in the lead.
const SHORT: usize = 6;

/// Maximum number of entries of an x that are not broken across lines.
const UNBROKEN: usize = 3;

/// The answers of a step, and the solver, in two sentences; empty if nothing was solved.
fn found(place: &str, level: Scheme, solves: &[Solve]) -> String {
    let solves: Vec<&Solve> = solves.iter().filter(|own| !own.problem.lcp.is_empty()).collect();
    let Some(last) = solves.last() else { return String::new() };
    let one = |own: &&Solve| {
        let x = &own.solution.x;
        let is_joint = |row: &Row| matches!(row.id.source, Source::Constraint(_));
        let joints = own.problem.assembly.rows.iter().filter(|row| is_joint(row)).count();
        let actors = match joints {
            0 => "the contacts",
            joints if joints == own.problem.assembly.rows.len() => "the joints",
            _ => "the contacts and joints",
        };
        let (does, what) = match own.problem.stage {
            Stage::Velocity => (format!("{actors} take"), "impulses"),
            Stage::Impact => ("the impact takes".into(), "impulses"),
            Stage::Restitution => ("restitution takes".into(), "impulses"),
            Stage::Acceleration => (format!("{actors} carry"), "forces"),
            Stage::Position => ("the position correction takes".into(), "multipliers"),
        };
        let unit = Units::of(&own.problem).of_x();
        let most = x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let values = with_unit(&if let [x] = x[..] { plain(x) } else { vector(x) }, &unit);
        match x.len() {
            rows if rows > SHORT => {
                let most = with_unit(&readable(most, 3), &unit);
                format!("{does} {rows} {what} of at most {most}")
            }
            rows if rows > UNBROKEN => format!("{does} {values}"),
            _ => format!("{does} {}", values.replace(' ', "\u{a0}")),
        }
    };
    let answers = solves.iter().map(one).collect::<Vec<_>>().join("; afterwards ");
    let entry = Registry::standard().entry(&last.solver);
    let unit = entry.map_or("iterations", |entry| entry.group.unit());
    let counts: Vec<_> = solves.iter().map(|own| own.solution.iterations.to_string()).collect();
    let is_solved = solves.iter().all(|own| own.solution.status == Status::Solved);
    let (solver, level) = (&last.solver, level.name());
    let work = match (is_solved, solves.len()) {
        (true, 1) => {
            let counted = counted(last.solution.iterations, unit.trim_end_matches('s'));
            format!("at {level} level {solver} finds x in {counted}.")
        }
        (true, all) => {
            let counts = counts.join(" and ");
            format!(
                "the scheme poses {all} LCPs in this order; {solver} finds x in {counts} {unit}."
            )
        }
        (false, _) => {
            let counts = counts.join(", ");
            format!("at {level} level {solver} ends without a solution ({counts} {unit}).")
        }
    };
    let place = place.replace(',', ":");
    // Values of x that are no solution would mislead.
    capitalized(&match is_solved {
        true => format!("{place}{answers}. {}", capitalized(&work)),
        false => format!("{place}{work}"),
    })
}

/// A slower rotation (rad/s) is rounding.
const ROTATION: f64 = 1e-9;

/// The motion after a step, and the weight that fixed bodies support, in a sentence.
fn meaning(scene: &Scene, before: &[State], step: &Step) -> String {
    let after = setup::without_rounding(scene, before, &step.states);
    let moving = || scene.bodies.iter().zip(&after).filter(|(body, _)| body.mass != Mass::Fixed);
    let fastest = moving().max_by(|a, b| a.1.v.norm().total_cmp(&b.1.v.norm()));
    let motion = match fastest {
        Some((body, state)) if state.v.norm() > 0.0 => {
            format!("{} is the fastest body, at {} m/s", body.name, readable(state.v.norm(), 3))
        }
        _ if after.iter().any(|state| state.omega.norm() > ROTATION) => {
            "bodies turn in place".into()
        }
        _ => "every body is at rest".into(),
    };
    let weight = scene.gravity * moving().map(|(body, _)| body.mass.mass()).sum::<f64>();
    let last = step.solves.iter().rfind(|solve| solve.problem.stage != Stage::Position);
    let is_complete = |solve: &&Solve| solve.problem.slides.is_empty() && weight.norm() > 0.0;
    let support = last.filter(is_complete).map(|solve| {
        let rows = solve.problem.assembly.rows.iter().zip(&solve.solution.x);
        let outer = rows.filter(|(row, _)| row.parts().count() == 1);
        let push = |(row, x): (&Row, &f64)| {
            row.parts().map(|part| linear(&part.jacobian)).sum::<Vector3<f64>>() * *x
        };
        let sum: Vector3<f64> = outer.map(push).sum();
        let (time, mean) = match solve.problem.stage {
            Stage::Acceleration => (1.0, ""),
            _ => (scene.step.dt, " on average"),
        };
        let [own, all] = [-sum.dot(&weight) / weight.norm() / time, weight.norm()]
            .map(|force| readable(force, 3));
        let who = if scene.constraints.is_empty() { "bodies" } else { "bodies and points" };
        format!("Fixed {who} push with {own} N{mean} against the weight of {all} N. ")
    });
    format!("{}After the step {motion}.", support.unwrap_or_default())
}

/// The LCPs of a step, and why it failed, if it did; `number` precedes the titles.
fn solves(
    document: &mut Document,
    scene: &Scene,
    method: &Method,
    number: &str,
    solves: &[Solve],
    failure: Option<&Failure>,
) -> Result<()> {
    let mut before = None;
    for (k, own) in solves.iter().enumerate() {
        if own.problem.lcp.is_empty() {
            continue;
        }
        let stage = match own.problem.stage {
            Stage::Velocity => "impulses",
            Stage::Acceleration => "forces",
            stage => stage.name(),
        };
        let place = capitalized(&format!("{number}{}", place(solves, k, stage)));
        let ending = match failure.map(|failure| &failure.cause) {
            Some(Cause::NoSolution { proof, .. }) if k + 1 == solves.len() => {
                Ending::Impossible(proof.as_ref())
            }
            _ => Ending::ExplainedAnswer,
        };
        // Sections before the first LCP state the bodies only.
        let has_derivation = |section: &Section| section.blocks.iter().any(is_heading);
        let is_again = document.sections.iter().any(has_derivation);
        let single = Single { scene, method, own, place: &place, before, is_again };
        single.explain(document, ending)?;
        before = Some(&own.problem);
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
    solves(document, scene, method, "", unfinished, Some(failure))?;
    let mut section = Section::new("the step cannot be solved");
    section.say(format!("{failure}."));
    document.add("", section);
    document.is_accepted = false;
    Ok(())
}

fn is_heading(block: &Block) -> bool {
    matches!(block, Block::Heading(_))
}

/// The stage of solve k; numbered if the step has several of its kind.
fn place(solves: &[Solve], k: usize, stage: &str) -> String {
    let same = |solve: &&Solve| solve.problem.stage == solves[k].problem.stage;
    match solves.iter().filter(same).count() {
        1 => stage.to_string(),
        _ => format!("{stage} {}", solves[..=k].iter().filter(same).count()),
    }
}
