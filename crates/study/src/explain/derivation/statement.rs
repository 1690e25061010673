//! The LCP: A, b and the bounds.

use super::columns::Columns;
use super::target;
use crate::explain::units::Units;
use lcplab_mechanics::formulation::{Posing, Stage};
use lcplab_page::document::{Formula, Section};
use lcplab_problem::Lcp;

/// Step 4: A and b.
pub(super) fn lcp(
    section: &mut Section,
    columns: &Columns,
    posing: Option<&Posing>,
    units: &Units,
) {
    let problem = columns.problem;
    section.say("4. What stands before x is A, the rest is b.");
    if problem.stage == Stage::Velocity {
        section.say(
            "The chapter's Figure 4 prints b with the other sign, by which the velocity that is to be \
             stopped would be doubled (E22).",
        );
    }
    section.formula(Formula::default().symbols("w = A x + b", "w = A x + b"));
    let own = &problem.lcp;
    let softened = problem.compliance.iter().any(|&compliance| compliance != 0.0);
    let (name, latex) = match (softened, problem.slides.is_empty()) {
        (true, _) => ("A = J M⁻¹Jᵀ + diag(γ) =", "A = J M^{-1} J^T + \\mathrm{diag}(\\gamma) ="),
        (false, true) => ("A = J M⁻¹Jᵀ =", "A = J M^{-1} J^T ="),
        (false, false) => ("A = J M⁻¹Jᵀ S =", "A = J M^{-1} J^T S ="),
    };
    if softened {
        section.say("Springs yield: each adds its γ to the diagonal.");
        let gamma = Formula::default().symbols("γ =", "\\gamma =").vector(&problem.compliance);
        section.formula(gamma.unit(units.of_matrix()));
    }
    if !problem.slides.is_empty() {
        section.say("S does not stand on both sides, so A is not symmetric.");
    }
    section.formula(matrix(own, Formula::default().symbols(name, latex)).unit(units.of_matrix()));
    let (target, target_latex) = target(problem.stage);
    let formula = Formula::default()
        .symbols(
            &format!("b = J {target} + bias ="),
            &format!("b = J {target_latex} + \\mathrm{{bias}} ="),
        )
        .vector(&problem.assembly.push_forward(&problem.target))
        .symbols("+", "+")
        .vector(&problem.bias)
        .symbols("=", "=")
        .vector(own.b());
    section.formula(formula.unit(units.of_w()));
    bounds(section, own, posing, units);
}

/// The statement of a problem that comes as numbers.
pub(in crate::explain) fn statement(lcp: &Lcp, units: &Units) -> Section {
    let mut section = Section::new("the LCP");
    section.formula(Formula::default().symbols("w = A x + b", "w = A x + b"));
    section.formula(matrix(lcp, Formula::default().symbols("A =", "A =")).unit(units.of_matrix()));
    section.formula(Formula::default().symbols("b =", "b =").vector(lcp.b()).unit(units.of_w()));
    bounds(&mut section, lcp, None, units);
    section
}

fn matrix(lcp: &Lcp, formula: Formula) -> Formula {
    formula.matrix(lcp.len(), lcp.len(), |i, j| lcp.matrix().entry(i, j))
}

/// lo and hi, and what they ask of w.
fn bounds(section: &mut Section, lcp: &Lcp, posing: Option<&Posing>, units: &Units) {
    section.say("x stays within its bounds; w > 0 only where x is at the lower one, w < 0 only at the upper one.");
    let formula = Formula::default()
        .symbols("lo =", "\\mathrm{lo} =")
        .vector(lcp.lo())
        .symbols("≤ x ≤", "\\le x \\le")
        .vector(lcp.hi())
        .symbols("= hi", "= \\mathrm{hi}");
    section.formula(formula.unit(units.of_x()));
    let rubs = lcp.coupling().is_some_and(|coupling| !coupling.is_empty());
    match posing {
        Some(_) => section.say("Friction rows have no bounds yet: their law comes next."),
        None if rubs => {
            section.say("Friction rows have the bounds ±μ x of their normal row in place of ∓∞.");
        }
        None => {}
    }
}
