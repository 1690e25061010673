//! Derives the LCP from Newton's law in the four steps of K&M Figure 4, with the numbers filled in.
//!
//! Figure 4 prints F = J λ, a b of the opposite sign, and ≥ 0 without complementarity (E22); here
//! F = Jᵀx, x ≥ 0 pushes apart, and w = A x + b holds with the conditions of the
//! [problem](lcplab_lcp).

mod columns;
mod motion;
mod sliding;
mod statement;

use super::units::Units;
use columns::Columns;
use lcplab_mechanics::formulation::{Posing, Problem, Stage};
use lcplab_mechanics::scene::Scene;
use lcplab_page::document::{Formula, Section};
pub(super) use motion::motion;

/// The four steps; for another friction model, its law follows later.
pub(super) fn newton_to_lcp(
    scene: &Scene,
    problem: &Problem,
    before: Option<&Problem>,
    posing: Option<&Posing>,
    units: &Units,
) -> Section {
    let mut section = Section::new("from Newton's law to the LCP");
    let columns = Columns::of(problem);
    if let Some(before) = before.filter(|before| columns.has_matrices_of(before)) {
        let stage = before.stage.name();
        section.say(format!("J, M⁻¹ and A are those of the {stage} above."));
        newton(&mut section, &columns, scene.step.dt);
        constraint(&mut section, &columns);
        statement::right_side(&mut section, &columns, units);
        return section;
    }
    section.say(match problem.assembly.columns() - columns.kept.len() {
        0 => "The velocity components of the moving bodies:".into(),
        more => format!("The velocity components that occur in a row; {more} others do not:"),
    });
    section.formula(columns.names(scene));
    if !problem.slides.is_empty() {
        sliding::substitution(&mut section, scene, problem);
    }
    newton(&mut section, &columns, scene.step.dt);
    inverse_mass(&mut section, &columns);
    constraint(&mut section, &columns);
    jacobian(&mut section, &columns, units);
    insertion(&mut section, problem);
    statement::lcp(&mut section, &columns, posing, units);
    section
}

/// Step 1: the motion with the constraints' x.
fn newton(section: &mut Section, columns: &Columns, dt: f64) {
    let problem = columns.problem;
    let assembly = &problem.assembly;
    let target = columns.pick(&problem.target);
    let formula = Formula::default();
    let (words, law, numbers) = match problem.stage {
        Stage::Velocity => (
            "1. Newton's law over the step. Without constraints the velocities would be u*. The \
             impulses x of the rows act along Jᵀ and change them.",
            [
                "u⁺ = u* + M⁻¹Jᵀ x,   u* = u + dt M⁻¹F",
                "u^+ = u^* + M^{-1} J^T x, \\qquad u^* = u + dt\\, M^{-1} F",
            ],
            formula
                .symbols("u* =", "u^* =")
                .vector(&columns.pick(&assembly.u))
                .symbols("+", "+")
                .number(dt)
                .symbols("s ·", "\\,\\mathrm{s} \\cdot")
                .vector(&columns.pick(&assembly.accelerate(&assembly.force)))
                .symbols("=", "=")
                .vector(&target),
        ),
        Stage::Acceleration => (
            "1. Newton's law. Without constraints the accelerations would be a*. The forces x of the rows \
             act along Jᵀ and change them.",
            match problem.slides.is_empty() {
                true => [
                    "u' = a* + M⁻¹Jᵀ x,   a* = M⁻¹F",
                    "u' = a^* + M^{-1} J^T x, \\qquad a^* = M^{-1} F",
                ],
                false => [
                    "u' = a* + M⁻¹Jᵀ S x,   a* = M⁻¹F",
                    "u' = a^* + M^{-1} J^T S x, \\qquad a^* = M^{-1} F",
                ],
            },
            formula.symbols("a* =", "a^* =").vector(&target),
        ),
        Stage::Restitution => (
            "1. The contacts named above bounce. The step is solved again from the same u*, \
             with a different bias for the rows that bounce.",
            ["u⁺ = u* + M⁻¹Jᵀ x", "u^+ = u^* + M^{-1} J^T x"],
            formula.symbols("u* =", "u^* =").vector(&target),
        ),
        Stage::Impact => (
            "1. Newton's law over an instant. Only the impulses x of the rows matter; forces have no time to \
             act.",
            ["u⁺ = u* + M⁻¹Jᵀ x", "u^+ = u^* + M^{-1} J^T x"],
            formula.symbols("u* =", "u^* =").vector(&target),
        ),
        Stage::Position => (
            "1. The rows move the bodies along Jᵀ.",
            ["Δs = M⁻¹Jᵀ x", "\\Delta s = M^{-1} J^T x"],
            formula.symbols("target =", "\\mathrm{target} =").vector(&target),
        ),
    };
    section.say(words);
    section.formula(Formula::default().symbols(law[0], law[1]));
    section.formula(numbers.unit(columns.unit()));
}

fn inverse_mass(section: &mut Section, columns: &Columns) {
    let response = Formula::default().symbols("M⁻¹ =", "M^{-1} =");
    let unit = if columns.is_angular { "1/kg or 1/(kg m²)" } else { "1/kg" };
    section.formula(columns.inverse_mass(response).unit(unit));
}

/// Step 2: the conditions of the rows on the motion.
fn constraint(section: &mut Section, columns: &Columns) {
    let (moved, latex) = moved(columns.problem.stage);
    let motion = match columns.problem.stage {
        Stage::Acceleration => "accelerations",
        Stage::Position => "displacements",
        _ => "new velocities",
    };
    section.say(format!(
        "2. Every row is a condition on the {motion} {moved}: w is J {moved} plus the bias. A contact \
         requires w ≥ 0 and pushes only if w = 0."
    ));
    let law = Formula::default()
        .symbols(&format!("w = J {moved} + bias"), &format!("w = J {latex} + \\mathrm{{bias}}"));
    section.formula(law);
}

/// J and the bias.
fn jacobian(section: &mut Section, columns: &Columns, units: &Units) {
    let numbers = columns
        .j(Formula::default().symbols("J =", "J ="))
        .symbols(",   bias =", ", \\quad \\mathrm{bias} =")
        .vector(&columns.problem.bias);
    section.formula(numbers.unit(units.of_w()));
}

/// Step 3: the motion substituted into the constraint.
fn insertion(section: &mut Section, problem: &Problem) {
    let (target, latex) = target(problem.stage);
    let x = effort(problem);
    section.say("3. Equation 1 is substituted into equation 2.");
    section.formula(Formula::default().symbols(
        &format!("w = J M⁻¹Jᵀ {x} + J {target} + bias"),
        &format!("w = J M^{{-1}} J^T {x} + J {latex} + \\mathrm{{bias}}"),
    ));
}

/// The motion that the rows constrain.
fn moved(stage: Stage) -> (&'static str, &'static str) {
    match stage {
        Stage::Acceleration => ("u'", "u'"),
        Stage::Position => ("Δs", "\\Delta s"),
        _ => ("u⁺", "u^+"),
    }
}

/// The motion without constraints.
fn target(stage: Stage) -> (&'static str, &'static str) {
    match stage {
        Stage::Acceleration => ("a*", "a^*"),
        Stage::Position => ("0", "0"),
        _ => ("u*", "u^*"),
    }
}

/// What acts through Jᵀ: x, or S x with the friction of sliding contacts substituted.
fn effort(problem: &Problem) -> &'static str {
    if problem.slides.is_empty() { "x" } else { "S x" }
}
