//! The motion that results from an answer.

use super::columns::Columns;
use super::{effort, moved, target};
use crate::explain::step_units::of_motion;
use lcplab_mechanics::formulation::{Problem, Stage};
use lcplab_page::document::notation::settled;
use lcplab_page::document::{Formula, Section};

/// The motion that results from an answer.
pub(in crate::explain) fn motion(problem: &Problem, x: &[f64], dt: f64) -> Section {
    let mut section = Section::new("the new motion");
    let columns = Columns::of(problem);
    let [(moved, moved_latex), (target, target_latex)] =
        [moved(problem.stage), target(problem.stage)];
    let target_numbers = columns.pick(&problem.target);
    let motion = columns.pick(&problem.motion(x));
    let change: Vec<f64> = motion.iter().zip(&target_numbers).map(|(m, t)| m - t).collect();
    let sizes: Vec<f64> = target_numbers.iter().map(|t| t.abs()).collect();
    let motion = settled(&motion, &sizes);
    let u = columns.pick(&problem.assembly.u);
    let sizes: Vec<f64> = u.iter().zip(&sizes).map(|(u, size)| u.abs() + dt * size).collect();
    let next = settled(&columns.pick(&problem.next_velocity(x, dt)), &sizes);
    let x = effort(problem);
    let formula = Formula::default()
        .symbols(
            &format!("{moved} = {target} + M⁻¹Jᵀ {x} ="),
            &format!("{moved_latex} = {target_latex} + M^{{-1}} J^T {x} ="),
        )
        .vector(&target_numbers)
        .symbols("+", "+")
        .vector(&change)
        .symbols("=", "=")
        .vector(&motion);
    section.formula(formula.unit(columns.unit()));
    if problem.stage == Stage::Acceleration {
        let formula = Formula::default()
            .symbols("u + dt u' =", "u + dt\\, u' =")
            .vector(&u)
            .symbols("+", "+")
            .number(dt)
            .symbols("s ·", "\\,\\mathrm{s} \\cdot")
            .vector(&motion)
            .symbols("=", "=")
            .vector(&next);
        section.formula(formula.unit(of_motion(Stage::Velocity, columns.is_angular)));
    }
    section
}
