//! A time step of a scene, from its states to the next ones.

use std::ops::ControlFlow;

use super::answer::{self, Reading};
use super::units::Units;
use super::{Method, derivation, setup, solve};
use crate::certificate::Demand;
use crate::document::notation::plain;
use crate::document::{Document, Section};
use crate::error::{Error, Result};
use crate::scene::{Formulation, Scene};
use crate::simulation::{Simulation, Solve, Step};
use crate::solver::{Event, Iterate, Observer};

/// Explains the first so many steps of a scene at velocity or acceleration level.
///
/// # Errors
/// If the scene is stepped by another family of methods.
pub fn step(scene: &Scene, method: &Method, steps: usize) -> Result<Document> {
    let level = scene.step.formulation;
    if !Formulation::LEVELS.contains(&level) {
        let reason = format!("velocity and acceleration are explained, not {}", level.name());
        return Err(Error::invalid(scene.name.as_str(), "formulation", reason));
    }
    let mut document = Document {
        title: format!("{}, at {} level, by {}", scene.name, level.name(), method.name()),
        lead: format!("{}. {}", scene.title, CONVENTIONS),
        sections: Vec::new(),
        is_accepted: true,
    };
    let mut simulation = Simulation::new(scene.clone(), method.solver()?);
    for number in 1..=steps {
        let (states, time) = (simulation.states().to_vec(), simulation.time());
        let place = format!("Step {number}");
        let when = format!("from {} s to {} s", plain(time), plain(time + scene.step.dt));
        document.add(&place, setup::states(&when, scene, &states));
        let mut starts = Starts::default();
        match simulation.observed_step(&mut starts) {
            Ok(step) => explain(&mut document, scene, method, &step, &starts)?,
            Err(failure) => {
                let mut section = Section::new("it cannot be taken");
                section.say(format!("{failure}."));
                document.add(&place, section);
                document.is_accepted = false;
                break;
            }
        }
    }
    Ok(document)
}

const CONVENTIONS: &str = "Rows are counted from 0; x ≥ 0 pushes the bodies of a row apart; \
a row acts on body 1 minus body 0.";

/// The points at which the solves of a step start.
#[derive(Default)]
struct Starts(Vec<Vec<f64>>);

impl Observer for Starts {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        if iterate.event == Event::Start {
            self.0.push(iterate.x.to_vec());
        }
        ControlFlow::Continue(())
    }
}

/// The sections of a step after its states.
fn explain(
    document: &mut Document,
    scene: &Scene,
    method: &Method,
    step: &Step,
    starts: &Starts,
) -> Result<()> {
    for (k, own) in step.solves.iter().enumerate() {
        if !own.problem.lcp.is_empty() {
            let stage = own.problem.stage.name();
            let place = format!("Step {}, {}", step.number, place(&step.solves, k, stage));
            let start = starts.0.get(k).filter(|_| starts.0.len() == step.solves.len());
            solve_explained(document, &place, scene, method, own, start.map(Vec::as_slice))?;
        }
    }
    document.add(&format!("Step {}", step.number), setup::after(scene, step));
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

/// The sections of one LCP of a step.
fn solve_explained(
    document: &mut Document,
    place: &str,
    scene: &Scene,
    method: &Method,
    own: &Solve,
    start: Option<&[f64]>,
) -> Result<()> {
    let (problem, x) = (&own.problem, &own.solution.x);
    let units = Units::of(problem);
    document.add(place, setup::masses(scene, problem));
    document.add(place, setup::rows(scene, problem));
    document.add(place, derivation::newton_to_lcp(scene, problem, &units));
    document.add(place, solving(method, own, start)?);
    let labels = problem.assembly.rows.iter().map(|row| row.label(scene)).collect();
    let reading = Reading { lcp: &problem.lcp, labels, units };
    let demand = Demand { tolerance: method.tolerance(), ..Demand::default() };
    let (mut section, is_accepted) = answer::section(&reading, &own.solution, &demand);
    derivation::motion(&mut section, problem, x, scene.step.dt);
    document.add(place, section);
    document.is_accepted &= is_accepted;
    Ok(())
}

/// The solver at work on a step's problem, from where the simulation started it.
fn solving(method: &Method, own: &Solve, start: Option<&[f64]>) -> Result<Section> {
    let lcp = &own.problem.lcp;
    let (method, remark) = match lcp.matrix().is_symmetric() || method.name() == "lemke" {
        true => (method.clone(), None),
        false => {
            (method.for_any_matrix(), Some("A is not symmetric, so Lemke's method takes over."))
        }
    };
    let (mut section, solution) = solve::section(lcp, &method, start)?;
    if let Some(remark) = remark {
        section.say(remark);
    }
    if solution.x != own.solution.x {
        section.say(format!(
            "The simulation came to its answer in another way: {}.",
            own.solution.status
        ));
    }
    Ok(section)
}
