//! The statement of an LCP in numbers: A, b and the bounds.

use super::units::Units;
use lcplab_lcp::Lcp;
use lcplab_page::document::{Formula, Section};

/// The statement of a problem given as numbers.
pub(super) fn statement(lcp: &Lcp, units: &Units) -> Section {
    stated(lcp, false, units)
}

/// The same for rows whose friction model is stated later.
pub(super) fn without_friction(lcp: &Lcp, units: &Units) -> Section {
    let mut section = stated(lcp, true, units);
    section.title = "the rows".into();
    section
}

fn stated(lcp: &Lcp, law_follows: bool, units: &Units) -> Section {
    let mut section = Section::new("the LCP");
    section.formula(Formula::default().symbols("w = A x + b", "w = A x + b"));
    section.formula(matrix(lcp, Formula::default().symbols("A =", "A =")).unit(units.of_matrix()));
    section.formula(Formula::default().symbols("b =", "b =").vector(lcp.b()).unit(units.of_w()));
    bounds(&mut section, lcp, law_follows, units);
    section
}

/// A, preceded by its name.
pub(super) fn matrix(lcp: &Lcp, formula: Formula) -> Formula {
    formula.matrix(lcp.len(), lcp.len(), |i, j| lcp.matrix().entry(i, j))
}

/// lo and hi, and their requirements on w.
pub(super) fn bounds(section: &mut Section, lcp: &Lcp, law_follows: bool, units: &Units) {
    let is_standard = |i: usize| lcp.lo()[i] == 0.0 && lcp.hi()[i] == f64::INFINITY;
    if !law_follows && !lcp.has_coupled_rows() && (0..lcp.len()).all(is_standard) {
        section.say("Every x ≥ 0 and w ≥ 0, and w > 0 only if x = 0.");
        return;
    }
    section.say("x stays within its bounds; w > 0 only if x is at the lower one, w < 0 only if x is at the upper \
     one.");
    let formula = Formula::default()
        .symbols("lo =", "\\mathrm{lo} =")
        .vector(lcp.lo())
        .symbols("≤ x ≤", "\\le x \\le")
        .vector(lcp.hi())
        .symbols("= hi", "= \\mathrm{hi}");
    section.formula(formula.unit(units.of_x()));
    let has_friction = lcp.has_coupled_rows();
    if law_follows {
        section.say("Friction rows have no bounds yet; the friction law follows.");
    } else if has_friction {
        section.say("Friction rows have the bounds ±μ x of their normal row instead of ∓∞.");
    }
}
