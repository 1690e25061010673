//! The friction models other than the coupled box, each with its problem.

mod cone;
mod polygon;

use super::Method;
use super::answer::Reading;
use super::solve::{self, Solved};
use super::units::with_unit;
use lcplab_judge::Demand;
use lcplab_lcp::Lcp;
use lcplab_lcp::error::Result;
use lcplab_page::document::notation::{indexed, interval, plain};
use lcplab_page::document::{Document, Section};
use lcplab_solver::Solution;

pub(super) use cone::cones;
pub(super) use polygon::polygons;

/// An answer to a problem under a polygon or a cone, to be explained at a place in a document.
pub(super) struct ExplainedAnswer<'a> {
    pub place: &'a str,
    /// The solver that is followed.
    pub method: &'a Method,
    /// The rows of the contacts and the others, with friction as a coupled box.
    pub rows: Reading<'a>,
    /// The x that is judged, one entry per row.
    pub answer: &'a Solution,
    /// The solver that found it.
    pub solver: &'a str,
    /// The start, one entry per row; `None` means 0.
    pub start: Option<&'a [f64]>,
}

impl ExplainedAnswer<'_> {
    /// Adds a section at this place.
    fn add(&self, document: &mut Document, section: Section) {
        document.add(self.place, section);
    }

    /// The method at work on an LCP; Lemke's if the method is not made for it.
    fn solved(&self, reading: &Reading, start: Option<&[f64]>) -> Result<Solved> {
        solve::by_suitable(reading, self.method, start)
    }

    /// The judge's demand.
    fn demand(&self) -> Demand {
        self.method.demand()
    }
}

/// The frozen box: bounds ±μ x_n with an x_n known in advance.
pub(super) fn frozen(reading: &Reading, problem: &Lcp, at: &[f64]) -> Section {
    let mut section = Section::new("friction in a frozen box");
    section.say(
        "The model freezes the friction bounds: they are ±μ x of the normal row, with an x that is \
         known in advance. In a scene it is the x of the previous step, or of the first answer if contacts bounce. \
         The result is an LCP with fixed bounds, which do not depend on the new x of the normal row.",
    );
    let line = |i: usize| {
        let coupling = problem.coupling()?;
        let normal = coupling.index(i)?;
        let (lo, hi) = (reading.lcp.lo()[i], reading.lcp.hi()[i]);
        let known = with_unit(&plain(at[normal]), &reading.units.x[normal]);
        Some(vec![
            with_unit(&i.to_string(), &reading.labels[i]),
            plain(coupling.mu(i)),
            format!("{} = {known}", indexed("x", normal)),
            with_unit(&interval(lo, hi), &reading.units.x[i]),
        ])
    };
    let columns = ["row", "μ", "frozen at", "bounds of x"];
    section.table("the frozen bounds", &columns, (0..problem.len()).filter_map(line).collect());
    section
}
