//! A problem file, from A and b on.

use super::answer::{self, Reading};
use super::solve::{self, Solved};
use super::units::Units;
use super::{Method, refutation, statement};
use lcplab_judge::Demand;
use lcplab_page::document::Document;
use lcplab_problem::error::Result;
use lcplab_problem::file::Problem;

/// Explains how a problem is solved from x = 0.
///
/// # Errors
/// If an option of the solver cannot be used.
pub fn problem(problem: &Problem, method: &Method) -> Result<Document> {
    let (lcp, units) = (&problem.lcp, Units::stated(problem));
    let name = if problem.name.is_empty() { "A problem" } else { &problem.name };
    let label = |i: usize| {
        let row = problem.extra.get("rows").and_then(|rows| rows.get(i));
        row.and_then(|row| row.get("label")?.as_str()).unwrap_or_default().to_string()
    };
    let labels = (0..lcp.len()).map(label).collect();
    let reading = Reading { lcp, labels, units };
    let Solved { section: solving, solution } = solve::section(&reading, method, None)?;
    let statement = statement::statement(lcp, &reading.units);
    let demand = Demand { tolerance: method.tolerance(), ..Demand::default() };
    let (answer, is_accepted) = answer::section(&reading, &solution, &demand);
    let mut document = Document {
        title: format!("{name}, by {}", method.name()),
        lead: format!("{} rows, counted from 0.", lcp.len()),
        sections: Vec::new(),
        is_accepted,
    };
    let proof = refutation::of(lcp, &solution);
    let proof = proof.map(|proof| refutation::section(&reading, Some(&proof)));
    for section in [statement, solving, answer].into_iter().chain(proof) {
        document.add("", section);
    }
    Ok(document)
}
