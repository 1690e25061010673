//! The solver at work, as it tells it.

use super::{Method, dantzig, lemke, sweeps};
use crate::document::Section;
use crate::document::notation::vector;
use crate::error::Result;
use crate::lcp::Lcp;
use crate::solver::{Observer, Solution, Start};

/// Someone who writes down what a solver does.
pub(super) trait Scribe: Observer {
    /// What was written, after the solve.
    fn section(self: Box<Self>, solution: &Solution) -> Section;
}

/// A section on the solve of a problem from a start, and its solution.
pub(super) fn section(
    lcp: &Lcp,
    method: &Method,
    start: Option<&[f64]>,
) -> Result<(Section, Solution)> {
    let mut scribe: Box<dyn Scribe + '_> = match method.name() {
        "dantzig" => Box::new(dantzig::Moves::of(lcp)),
        "lemke" => Box::new(lemke::Tableaux::of(lcp)),
        _ => Box::new(sweeps::Sweeps::of(lcp, method.name())),
    };
    let solution = method.solver()?.solve(lcp, &Start { x: start }, &mut *scribe);
    let mut section = scribe.section(&solution);
    if lcp.coupling().is_some() && matches!(method.name(), "dantzig" | "lemke") {
        section.say(
            "The bounds of friction rows were frozen at the last x, and the problem solved again, until \
             they agreed with it.",
        );
    }
    let plural = if solution.iterations == 1 { "" } else { "s" };
    section.say(format!(
        "{} ends after {} iteration{plural} with x = {}: {}.",
        method.name(),
        solution.iterations,
        vector(&solution.x),
        solution.status
    ));
    if let Some(fallback) = solution.fallback {
        section.say(format!("Something else had a part in it: {fallback}."));
    }
    Ok((section, solution))
}
