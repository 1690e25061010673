//! The LCP: A, b and the bounds.

use super::columns::Columns;
use super::target;
use crate::explain::statement::{bounds, matrix};
use crate::explain::units::Units;
use lcplab_mechanics::formulation::{Posing, Stage};
use lcplab_page::document::{Formula, Section};

/// Step 4: A and b.
pub(super) fn lcp(
    section: &mut Section,
    columns: &Columns,
    posing: Option<&Posing>,
    units: &Units,
) {
    let problem = columns.problem;
    section.say("4. The factor of x is A, and the rest is b: w = A x + b.");
    if problem.stage == Stage::Velocity {
        section.say(
            "Figure 4 of K&M (Kenwright & Morgan) prints b with the opposite sign, which would double the velocity of \
             the body instead of stopping it (`lcplab chapter E22`).",
        );
    }
    let own = &problem.lcp;
    let softened = problem.compliance.iter().any(|&compliance| compliance != 0.0);
    let (name, latex) = match (softened, problem.slides.is_empty()) {
        (true, _) => ("A = J M⁻¹Jᵀ + diag(γ) =", "A = J M^{-1} J^T + \\mathrm{diag}(\\gamma) ="),
        (false, true) => ("A = J M⁻¹Jᵀ =", "A = J M^{-1} J^T ="),
        (false, false) => ("A = J M⁻¹Jᵀ S =", "A = J M^{-1} J^T S ="),
    };
    if softened {
        section.say("Springs are compliant: each adds its γ to the diagonal.");
        let gamma = Formula::default().symbols("γ =", "\\gamma =").vector(&problem.compliance);
        section.formula(gamma.unit(units.of_matrix()));
    }
    if !problem.slides.is_empty() {
        section.say("S appears on one side only, so A is not symmetric.");
    }
    section.formula(matrix(own, Formula::default().symbols(name, latex)).unit(units.of_matrix()));
    right_side(section, columns, units);
    bounds(section, own, posing.is_some(), units);
}

/// b, from the motion without constraints and the bias.
pub(super) fn right_side(section: &mut Section, columns: &Columns, units: &Units) {
    let problem = columns.problem;
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
        .vector(problem.lcp.b());
    section.formula(formula.unit(units.of_w()));
}
