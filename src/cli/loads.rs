//! `--loads`: the forces of an answer by bodies.

use lcplab::document::{Block, Section};
use lcplab::error::{Error, Result};
use lcplab::lcp::Question;
use lcplab::page;
use lcplab::report::answer::first_answer;
use lcplab::report::loads::Loads;
use lcplab::scene::Scene;
use lcplab::simulation::{Simulation, Step};
use serde_json::{Value, json};

/// The forces, or why they are not summed.
pub type Summed = std::result::Result<Loads, String>;

/// The forces of the last problem of a step.
///
/// # Errors
/// With the reason, if there is no such problem, or friction is not that of boxes.
pub fn of_step(scene: &Scene, step: Option<&Step>) -> Summed {
    let step = step.ok_or("no step was completed")?;
    let solves = step.posed(scene).map_err(|cause| cause.to_string())?;
    let Some(last) = solves.last() else {
        return Err(format!(
            "the last step of the scheme {} solves no LCP",
            scene.step.scheme.name()
        ));
    };
    let problem = last.exported(scene, step.number);
    let question = Question::new(&problem, None, &scene.name).map_err(|cause| cause.to_string())?;
    Loads::of(&question, &last.solution.x).ok_or_else(|| {
        let model = scene.contact.model;
        format!("only the forces of rows with bounds are summed; the friction model is {model}")
    })
}

/// The forces of a scene in the step of this number, from 1.
///
/// # Errors
/// With the reason, if the simulation does not reach the step; otherwise as [`of_step`].
pub fn of_scene(scene: &Scene, number: usize) -> Summed {
    let mut simulation = Simulation::of(scene).map_err(|cause| cause.to_string())?;
    let mut last = None;
    for _ in 0..number {
        last = Some(simulation.step().map_err(|failure| failure.to_string())?);
    }
    of_step(scene, last.as_ref())
}

/// The forces of the default method's answer to a problem.
///
/// # Errors
/// As [`check`].
pub fn of_problem(question: &Question, input: &str) -> Result<Summed> {
    check(question, input)?;
    let x = first_answer(question);
    Ok(Loads::of(question, &x).ok_or_else(|| "the friction model has no bounds".to_string()))
}

/// The section of a document.
pub fn section(loads: &Summed) -> Section {
    match loads {
        Ok(loads) => loads.section(),
        Err(why) => {
            let mut section = Section::new("forces by body");
            section.say(format!("Not summed: {why}."));
            section
        }
    }
}

/// The section of a page.
pub fn page_section(loads: &Summed) -> page::Section {
    let section = section(loads);
    page::Section {
        id: "forces-by-body".into(),
        title: "Forces by body, in the last step".into(),
        blocks: section.blocks.iter().map(Block::on_page).collect(),
        ..page::Section::default()
    }
}

/// The value of the key `loads`.
pub fn to_json(loads: &Summed) -> Value {
    match loads {
        Ok(loads) => loads.json(),
        Err(why) => json!({ "unexamined": why }),
    }
}

/// Checks that the forces of an answer can be summed by bodies.
///
/// # Errors
/// If the file does not say which bodies its rows act between, or friction has a model.
pub fn check(question: &Question, input: &str) -> Result<()> {
    let zero = vec![0.0; question.problem().lcp.len()];
    let reason = match question.model() {
        Some(model) => {
            format!(
                "sums forces of rows with bounds; the friction model of this problem is {model}"
            )
        }
        None if Loads::of(question, &zero).is_none() => {
            "needs the keys motion, with its level, rows with their bodies, and bodies".into()
        }
        None => return Ok(()),
    };
    Err(Error::invalid(input, "--loads", reason))
}
