//! The laws of friction that a scene can ask for beside the coupled box, each with the problem that
//! it poses.

mod cone;
mod polygon;

pub(super) use cone::cones;
pub(super) use polygon::polygons;

use super::answer::Reading;
use super::units::with_unit;
use lcplab_page::document::Section;
use lcplab_page::document::notation::{indexed, interval, plain};
use lcplab_problem::Lcp;

/// The frozen box: bounds ±μ x_n with the x_n of the start, or of the first answer in a bounce.
pub(super) fn frozen(reading: &Reading, problem: &Lcp, at: &[f64]) -> Section {
    let mut section = Section::new("friction in a frozen box");
    section.say(
        "The scene freezes the bounds of friction: they are ±μ x of the normal row with an x that is \
         known beforehand, of the step before, or of the first answer if this is a bounce. What is left \
         is an LCP with fixed bounds; the newest x of the normal row has no part in them.",
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
