//! From Newton's law to the LCP in the four steps of K&M Figure 4, with matrices filled in.
//!
//! Figure 4 prints F = J λ, a b of the other sign, and ≥ 0 without complementarity (E22); here
//! F = Jᵀx, x ≥ 0 pushes apart, and w = A x + b holds with the conditions of `math §3`.

use super::units::{Units, of_motion};
use crate::document::{Formula, SHOWN, Section};
use crate::formulation::{Problem, Stage};
use crate::lcp::Lcp;
use crate::scene::Scene;

/// With more rows or columns matrices are not written side by side.
const SIDE_BY_SIDE: usize = 6;

/// A problem without the columns that no row touches.
struct Columns<'a> {
    problem: &'a Problem,
    kept: Vec<usize>,
    /// Rows of J, dense, kept columns alone; the first [`SHOWN`] rows.
    jacobian: Vec<Vec<f64>>,
    is_angular: bool,
}

impl<'a> Columns<'a> {
    fn of(problem: &'a Problem) -> Self {
        let assembly = &problem.assembly;
        let mut kept: Vec<usize> =
            assembly.jacobian_pattern().into_iter().map(|(_, column)| column).collect();
        kept.sort_unstable();
        kept.dedup();
        let dense = |i: usize| {
            let row = assembly.jacobian_row(i);
            let entry = |k: &usize| row.iter().find(|(column, _)| column == k).map_or(0.0, |e| e.1);
            kept.iter().map(entry).collect()
        };
        let jacobian = (0..assembly.rows.len().min(SHOWN)).map(dense).collect();
        let is_angular = kept.iter().any(|&column| component(problem, column).1 >= 3);
        Columns { problem, kept, jacobian, is_angular }
    }

    fn pick(&self, values: &[f64]) -> Vec<f64> {
        self.kept.iter().map(|&column| values[column]).collect()
    }

    fn unit(&self) -> &'static str {
        of_motion(self.problem.stage, self.is_angular)
    }

    /// Adds J.
    fn j(&self, formula: Formula) -> Formula {
        let rows = self.problem.assembly.rows.len();
        formula.matrix(rows, self.kept.len(), |i, k| self.jacobian[i][k])
    }

    /// Adds Jᵀ.
    fn j_transposed(&self, formula: Formula) -> Formula {
        let rows = self.problem.assembly.rows.len();
        formula.matrix(self.kept.len(), rows, |k, i| self.jacobian[i][k])
    }

    /// Adds M⁻¹.
    fn inverse_mass(&self, formula: Formula) -> Formula {
        let column = |&column: &usize| {
            let mut unit = vec![0.0; self.problem.assembly.columns()];
            unit[column] = 1.0;
            self.pick(&self.problem.assembly.accelerate(&unit))
        };
        let columns: Vec<Vec<f64>> = self.kept.iter().take(SHOWN).map(column).collect();
        formula.matrix(self.kept.len(), self.kept.len(), |i, j| columns[j][i])
    }

    /// The names of the kept columns, such as `v_z of bottom`.
    fn names(&self, scene: &Scene) -> String {
        let name = |&column: &usize| {
            let (body, k) = component(self.problem, column);
            let part = ["v_x", "v_y", "v_z", "ω_x", "ω_y", "ω_z"][k];
            format!("{part} of {}", scene.bodies[body].name)
        };
        let shown: Vec<String> = self.kept.iter().take(SHOWN).map(name).collect();
        let more = if self.kept.len() > SHOWN { ", …" } else { "" };
        shown.join(", ") + more
    }
}

/// The body of a column, and which of its velocity components it is.
fn component(problem: &Problem, column: usize) -> (usize, usize) {
    let blocks = &problem.assembly.blocks;
    let block = &blocks[blocks.partition_point(|block| block.offset <= column) - 1];
    (block.body, column - block.offset)
}

/// The four steps.
pub(super) fn newton_to_lcp(scene: &Scene, problem: &Problem, units: &Units) -> Section {
    let mut section = Section::new("from Newton's law to the LCP");
    let columns = Columns::of(problem);
    let all = problem.assembly.columns();
    let left_out = all - columns.kept.len();
    if left_out > 0 {
        section.say(format!("Of {all} columns no row touches {left_out}; they are left out."));
    }
    section.say(format!("The columns are {}.", columns.names(scene)));
    newton(&mut section, &columns, scene.step.dt);
    constraint(&mut section, &columns, units);
    insertion(&mut section, &columns);
    lcp(&mut section, &columns, units);
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
            "1. Newton's law over the step. Without constraints the velocities would become u*; the \
             impulses x of the rows act along Jᵀ and add to them.",
            [
                "u⁺ = u* + M⁻¹Jᵀ x,   u* = u + dt M⁻¹F",
                "u^+ = u^* + M^{-1} J^T x, \\qquad u^* = u + dt\\, M^{-1} F",
            ],
            formula
                .symbols("u* =", "u^* =")
                .vector(&columns.pick(&assembly.u))
                .symbols("+", "+")
                .number(dt)
                .symbols("·", "\\cdot")
                .vector(&columns.pick(&assembly.accelerate(&assembly.force)))
                .symbols("=", "=")
                .vector(&target),
        ),
        Stage::Acceleration => (
            "1. Newton's law. Without constraints the accelerations would be a*; the forces x of the rows \
             act along Jᵀ and add to them.",
            ["u' = a* + M⁻¹Jᵀ x,   a* = M⁻¹F", "u' = a^* + M^{-1} J^T x, \\qquad a^* = M^{-1} F"],
            formula.symbols("a* =", "a^* =").vector(&target),
        ),
        Stage::Impact | Stage::Restitution => (
            "1. Newton's law over an instant: no force matters but the impulses x of the rows.",
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
    let response = Formula::default().symbols("M⁻¹ =", "M^{-1} =");
    let unit = if columns.is_angular { "1/kg or 1/(kg m²)" } else { "1/kg" };
    section.formula(columns.inverse_mass(response).unit(unit));
}

/// Step 2: what the rows ask of the motion.
fn constraint(section: &mut Section, columns: &Columns, units: &Units) {
    let (moved, latex) = moved(columns.problem.stage);
    section.say(
        "2. Every row asks something of the new motion: its w is that motion along J, and the bias. A \
         contact wants w ≥ 0 and pushes only where w = 0.",
    );
    let law = Formula::default()
        .symbols(&format!("w = J {moved} + bias"), &format!("w = J {latex} + \\mathrm{{bias}}"));
    section.formula(law);
    let numbers = columns
        .j(Formula::default().symbols("J =", "J ="))
        .symbols(",   bias =", ", \\quad \\mathrm{bias} =")
        .vector(&columns.problem.bias);
    section.formula(numbers.unit(units.of_w()));
}

/// Step 3: the motion put into the constraint.
fn insertion(section: &mut Section, columns: &Columns) {
    let (target, latex) = target(columns.problem.stage);
    section.say("3. The first is put into the second.");
    section.formula(Formula::default().symbols(
        &format!("w = J ({target} + M⁻¹Jᵀ x) + bias = J M⁻¹Jᵀ x + J {target} + bias"),
        &format!(
            "w = J \\left( {latex} + M^{{-1}} J^T x \\right) + \\mathrm{{bias}} \
             = J M^{{-1}} J^T x + J {latex} + \\mathrm{{bias}}"
        ),
    ));
    let problem = columns.problem;
    if problem.assembly.rows.len().max(columns.kept.len()) > SIDE_BY_SIDE {
        section
            .say("J, M⁻¹ and the bias are those above; they are too wide to stand side by side.");
        return;
    }
    let product = columns.j(Formula::default().symbols("J M⁻¹Jᵀ =", "J M^{-1} J^T ="));
    section.formula(columns.j_transposed(columns.inverse_mass(product)));
    let name = [format!("J {target} ="), format!("J {latex} =")];
    let product = columns.j(Formula::default().symbols(&name[0], &name[1]));
    let pushed = problem.assembly.push_forward(&problem.target);
    let numbers = product.vector(&columns.pick(&problem.target)).symbols("=", "=").vector(&pushed);
    section.formula(numbers);
}

/// The motion that an answer leads to.
pub(super) fn motion(section: &mut Section, problem: &Problem, x: &[f64], dt: f64) {
    let columns = Columns::of(problem);
    let [(moved, moved_latex), (target, target_latex)] =
        [moved(problem.stage), target(problem.stage)];
    let target_numbers = columns.pick(&problem.target);
    let motion = columns.pick(&problem.motion(x));
    let change: Vec<f64> = motion.iter().zip(&target_numbers).map(|(m, t)| m - t).collect();
    section.say("The bodies then move, in the columns that the rows touch, with");
    let formula = Formula::default()
        .symbols(
            &format!("{moved} = {target} + M⁻¹Jᵀ x ="),
            &format!("{moved_latex} = {target_latex} + M^{{-1}} J^T x ="),
        )
        .vector(&target_numbers)
        .symbols("+", "+")
        .vector(&change)
        .symbols("=", "=")
        .vector(&motion);
    section.formula(formula.unit(columns.unit()));
    if problem.stage == Stage::Acceleration {
        let next = columns.pick(&problem.next_velocity(x, dt));
        let formula = Formula::default()
            .symbols("u + dt u' =", "u + dt\\, u' =")
            .vector(&columns.pick(&problem.assembly.u))
            .symbols("+", "+")
            .number(dt)
            .symbols("·", "\\cdot")
            .vector(&motion)
            .symbols("=", "=")
            .vector(&next);
        section.formula(formula.unit(of_motion(Stage::Velocity, columns.is_angular)));
    }
}

/// Step 4: A and b.
fn lcp(section: &mut Section, columns: &Columns, units: &Units) {
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
        (false, false) => ("A =", "A ="),
    };
    if !problem.slides.is_empty() {
        section.say(
            "Contacts that slide have their friction put in for the unknown: the column of such a normal \
             row has its part of the tangential ones, and A is not symmetric.",
        );
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
    bounds(section, own, units);
}

/// The statement of a problem that comes as numbers.
pub(super) fn statement(lcp: &Lcp, units: &Units) -> Section {
    let mut section = Section::new("the LCP");
    section.formula(Formula::default().symbols("w = A x + b", "w = A x + b"));
    section.formula(matrix(lcp, Formula::default().symbols("A =", "A =")).unit(units.of_matrix()));
    section.formula(Formula::default().symbols("b =", "b =").vector(lcp.b()).unit(units.of_w()));
    bounds(&mut section, lcp, units);
    section
}

fn matrix(lcp: &Lcp, formula: Formula) -> Formula {
    formula.matrix(lcp.len(), lcp.len(), |i, j| lcp.matrix().entry(i, j))
}

/// lo and hi, and what they ask of w.
fn bounds(section: &mut Section, lcp: &Lcp, units: &Units) {
    section.say("x stays within its bounds; w > 0 only where x is at the lower one, w < 0 only at the upper one.");
    let formula = Formula::default()
        .symbols("lo =", "\\mathrm{lo} =")
        .vector(lcp.lo())
        .symbols("≤ x ≤", "\\le x \\le")
        .vector(lcp.hi())
        .symbols("= hi", "= \\mathrm{hi}");
    section.formula(formula.unit(units.of_x()));
    if lcp.coupling().is_some() {
        section.say("Friction rows have the bounds ±μ x of their normal row in place of ∓∞.");
    }
}

/// The motion that the rows ask something of.
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
