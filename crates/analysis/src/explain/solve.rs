//! The solver at work, as it reports its steps.

use super::answer::Reading;
use super::units::with_unit;
use super::{Method, dantzig, lemke, sweeps};
use lcplab_lcp::Lcp;
use lcplab_lcp::error::Result;
use lcplab_lcp::number::counted;
use lcplab_page::document::notation::{indexed, interval, plain, vector};
use lcplab_page::document::{Block, Formula, Section};
use lcplab_solver::{Dantzig, Lemke, Observer, Solution, Start, Status};

/// An observer that writes down what a solver does.
pub(super) trait Scribe: Observer {
    /// The text, after the solve.
    fn section(self: Box<Self>, solution: &Solution) -> Section;
}

/// The text of a solve, and its result.
pub(super) struct Solved {
    pub section: Section,
    pub solution: Solution,
}

/// The solve of a problem from a start.
pub(super) fn section(reading: &Reading, method: &Method, start: Option<&[f64]>) -> Result<Solved> {
    let lcp = reading.lcp;
    let mut scribe: Box<dyn Scribe + '_> = match method.name() {
        Dantzig::NAME => Box::new(dantzig::Moves::of(reading)),
        Lemke::NAME => Box::new(lemke::Tableaux::of(reading)),
        _ => Box::new(sweeps::Sweeps::of(reading, method.name())),
    };
    let solution =
        method.solver()?.solve(lcp, &Start { x: start, ..Start::default() }, &mut *scribe);
    let mut section = scribe.section(&solution);
    if let (Status::Ray { row, direction }, true) = (&solution.status, method.name() != Lemke::NAME)
    {
        section.say(match method.name() {
            Dantzig::NAME => stuck(reading, &solution.x, *row),
            _ => ENDLESS.to_string(),
        });
        ray(&mut section, reading, direction);
    }
    let x = with_unit(&vector(&solution.x), &reading.units.of_x());
    section.say(format!(
        "{} ends after {} with x = {x}: {}.",
        method.name(),
        counted(solution.iterations, "iteration"),
        solution.status
    ));
    if let Some(fallback) = solution.fallback {
        section.say(format!("Something else had a part in it: {fallback}."));
    }
    Ok(Solved { section, solution })
}

/// The method at work on a problem; Lemke's if the method is not made for it.
pub(super) fn by_suitable(
    reading: &Reading,
    method: &Method,
    start: Option<&[f64]>,
) -> Result<Solved> {
    if reading.lcp.matrix().is_symmetric() || method.name() == Lemke::NAME {
        return section(reading, method, start);
    }
    let mut solved = section(reading, &method.for_any_matrix(), start)?;
    let reason = Block::Text("A is not symmetric, so Lemke's method takes over.".into());
    solved.section.blocks.insert(0, reason);
    Ok(solved)
}

/// What happens to sweeps if there is no solution.
const ENDLESS: &str = "Every further sweep moves x by the same d, without end: x reaches no bound, and \
no w comes closer to 0, because Δw = A d is";

/// A row that Dantzig's method cannot satisfy.
fn stuck(reading: &Reading, x: &[f64], row: usize) -> String {
    let w = with_unit(&plain(reading.lcp.w(x)[row]), &reading.units.w[row]);
    format!(
        "Row {row} is not satisfied: {} = {w}. From here x can move along d without end: it reaches no bound, \
         and no w comes closer to 0, because Δw = A d is",
        indexed("w", row)
    )
}

/// The ray along which x could go forever.
fn ray(section: &mut Section, reading: &Reading, direction: &[f64]) {
    let product = reading.lcp.homogeneous().w(direction);
    section.formula(
        Formula::default()
            .symbols("d =", "d =")
            .vector(direction)
            .symbols(",   A d =", ", \\quad A d =")
            .vector(&product),
    );
}

/// The bounds of friction rows, frozen at the last x, as a table.
pub(super) fn frozen(section: &mut Section, reading: &Reading, round: usize, lcp: &Lcp) {
    section.say(match round {
        1 => "The bounds ±μ x_n of friction rows are frozen at the x_n of the start, and the problem with \
              these bounds is solved."
            .to_string(),
        round => format!(
            "Round {round}: the bounds of friction rows are frozen at the x_n just found, and the problem \
             is solved again from there, until the bounds agree with x."
        ),
    });
    let line = |i: usize| {
        reading.lcp.coupling()?.index(i)?;
        let bounds = interval(lcp.lo()[i], lcp.hi()[i]);
        Some(vec![i.to_string(), with_unit(&bounds, &reading.units.x[i])])
    };
    let lines = (0..lcp.len()).filter_map(line).collect();
    section.table(&format!("round {round}, frozen bounds"), &["row", "bounds of x"], lines);
}
