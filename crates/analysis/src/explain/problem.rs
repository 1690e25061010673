//! Explains a problem file, from A and b on.

use super::answer::{self, Reading};
use super::friction::{self, ExplainedAnswer};
use super::solve::{self, Solved};
use super::units::Units;
use super::{Method, refutation, statement};
use lcplab_lcp::error::Result;
use lcplab_lcp::friction::{Model, ProblemForm};
use lcplab_lcp::number::counted;
use lcplab_lcp::{Lcp, Question, file};
use lcplab_page::document::Document;
use lcplab_solver::{Registry, Solution, Status, solve_by_sequence};

/// Explains how a problem is solved from x = 0 under its friction model. For polygons, their LCP is
/// solved; for cones, the answer of a cone solver is shown, and the method is followed on the box
/// for comparison.
///
/// # Errors
/// If an option of the solver is invalid.
pub fn problem(question: &Question, method: &Method) -> Result<Document> {
    let problem = question.problem();
    let name = if problem.name.is_empty() { "A problem" } else { &problem.name };
    let model = question.model();
    let lead = model.map_or(String::new(), |model| format!(" The friction model is {model}."));
    let by = match (question.boxed(), model) {
        (None, Some(model)) => format!("under {model}"),
        _ => format!("by {}", method.name()),
    };
    let mut document = Document {
        title: format!("{name}, {by}"),
        lead: format!("{}, counted from 0.{lead}", counted(problem.lcp.len(), "row")),
        sections: Vec::new(),
        is_accepted: false,
    };
    document.is_accepted = match question.posed() {
        ProblemForm::Boxed(lcp) => boxed(question, lcp, method, &mut document)?,
        ProblemForm::Polyhedral(polygons) => {
            let answer = answer(question, method);
            let answered = answered(question, method, &answer, &mut document);
            friction::polygons(&answered, &mut document, polygons)?
        }
        ProblemForm::Cone(cones) => {
            let answer = answer(question, method);
            let answered = answered(question, method, &answer, &mut document);
            friction::cones(&answered, &mut document, cones)?
        }
    };
    Ok(document)
}

/// The rows of a problem with the labels and units from its file, under these bounds.
fn reading<'a>(problem: &file::Problem, lcp: &'a Lcp) -> Reading<'a> {
    let label = |i: usize| {
        let row = problem.extra.get("rows").and_then(|rows| rows.get(i));
        row.and_then(|row| row.get("label")?.as_str()).unwrap_or_default().to_string()
    };
    let labels = (0..lcp.len()).map(label).collect();
    Reading { lcp, labels, units: Units::stated(problem), is_again: false }
}

/// A box, coupled or frozen; returns whether the judge accepts the answer.
fn boxed(question: &Question, lcp: &Lcp, method: &Method, document: &mut Document) -> Result<bool> {
    let problem = question.problem();
    let reading = reading(problem, lcp);
    let Solved { section: solving, solution } = solve::section(&reading, method, None)?;
    let frozen = (question.model() == Some(Model::FrozenBox)).then_some(&problem.frozen_at);
    let frozen = frozen.into_iter().flatten();
    let frozen = frozen.map(|at| friction::frozen(&reading, &problem.lcp, at));
    let statement = statement::statement(lcp, &reading.units);
    let (answer, is_accepted) = answer::section(&reading, &solution, &method.demand());
    let unit =
        Registry::standard().entry(method.name()).map_or("iterations", |own| own.group.unit());
    let how = match solution.status {
        Status::Solved => "finds x in",
        _ => "ends without a solution after",
    };
    document.lead = format!(
        "{} {how} {}, and the judge {} the answer. {}",
        method.name(),
        counted(solution.iterations, unit.trim_end_matches('s')),
        if is_accepted { "accepts" } else { "rejects" },
        document.lead
    );
    let proof = refutation::of(lcp, &solution);
    let proof = proof.map(|proof| refutation::section(&reading, Some(&proof)));
    for section in frozen.chain([statement, solving, answer]).chain(proof) {
        document.add("", section);
    }
    Ok(is_accepted)
}

/// The answer that `solve` gives, and its solver.
fn answer(question: &Question, method: &Method) -> (Solution, String) {
    let found = solve_by_sequence(question.posed(), method.options(), &mut ());
    (found.solution, found.solver)
}

/// An answer to polygons or cones, after the statement of its rows.
fn answered<'a>(
    question: &'a Question,
    method: &'a Method,
    (answer, solver): &'a (Solution, String),
    document: &mut Document,
) -> ExplainedAnswer<'a> {
    let rows = reading(question.problem(), &question.problem().lcp);
    document.add("", statement::without_friction(rows.lcp, &rows.units));
    ExplainedAnswer { place: "", method, rows, answer, solver, start: None }
}
