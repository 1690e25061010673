//! The stages that every step has: parts of assembly, solver and write-back.
//!
//! Two proved bounds distinguish solver and write-back: one on the error of the engine's own motion
//! v, one on that of the motion u(x) which its forces x cause. If both are above the limit, the
//! solver is wrong. If only one is, the engine wrote back something else than it solved. There are
//! two exceptions, in which the difference is the solver's residual: engines that solve for the
//! motion and compute the forces from it, and a motion that is exactly that of the forces.
//!
//! Without such bounds, v must be the motion that x causes (write-back), and x and v must satisfy
//! the law of every row (solver).

use lcplab_judge::gap_bound::GapBound;
use lcplab_lcp::Level;

use super::bounds::MotionError;
use super::definite::{self, first_not_definite};
use super::finding::{Finding, Report, Stage};
use super::finite::{self, first_not_finite};
use super::law::Violation;
use super::limits::rounding;
use super::newton::are_forces_of_motion;
use super::step::{EngineStep, difference};

/// What is wrong where the problem is not known completely.
const OUTSIDE: &str = "a force is outside its bounds or its friction cone";
/// What is wrong where the motion error has no bound.
pub(crate) const UNLAWFUL: &str = "force and motion of a row do not satisfy its law";
/// Divisors are at least this.
const TINY: f64 = 1e-300;

/// What a step that an adapter or a file describes allows to check before its solver: the assembly,
/// where it says what model and state require.
pub(crate) fn before_solver(step: &EngineStep) -> Report {
    let mut report = Report { findings: Vec::new(), not_checked: vec!["collision".into()] };
    let is_broken = broken(step).is_some();
    let findings = match is_broken {
        true => [None, None, None],
        false => [expected_jacobian(step), expected_bias(step), expected_target(step)],
    };
    if !is_broken {
        let parts = ["J", "the bias", "the free motion"];
        let checked: Vec<&str> =
            (0..3).filter(|&k| findings[k].is_some()).map(|k| parts[k]).collect();
        report.not_checked.push(match checked.is_empty() {
            true => "assembly".into(),
            false => format!("assembly: all but {}", listed(&checked)),
        });
    }
    report.findings.extend(findings.into_iter().flatten());
    report.not_checked.push("write-back: the position after the step".into());
    if step.gauss.level == Some(Level::Acceleration) {
        report.not_checked.push("write-back: the velocity after the step".into());
    }
    report
}

/// Words as a list: a, b and c.
fn listed(words: &[&str]) -> String {
    match words {
        [most @ .., last] if !most.is_empty() => format!("{} and {last}", most.join(", ")),
        words => words.concat(),
    }
}

/// The largest difference of a row of J, relative to its largest entry.
fn expected_jacobian(step: &EngineStep) -> Option<Finding> {
    let expected = step.expected.jacobian.as_ref().filter(|_| !step.is_empty())?;
    let error = |i: usize| {
        let mut apart = vec![0.0; step.gauss.target.len()];
        step.gauss.jacobian[i].iter().for_each(|&(j, value)| apart[j] += value);
        expected[i].iter().for_each(|&(j, value)| apart[j] -= value);
        let scale = expected[i].iter().fold(TINY, |most, (_, value)| most.max(value.abs()));
        largest(apart.into_iter().map(|own| own.abs() / scale)).map_or(0.0, |(_, error)| error)
    };
    let (row, error) = largest((0..step.len()).map(error))?;
    let what = "J of a row differs from expected_jacobian";
    let finding = Finding::new(Stage::Assembly, what, error, rounding(step.source.bits));
    Some(Finding { row: Some(row), bodies: step.bodies_of(Some(row)), ..finding })
}

/// The largest difference of a bias, relative to its terms and to those of J u*.
fn expected_bias(step: &EngineStep) -> Option<Finding> {
    let expected = step.expected.bias.as_ref().filter(|_| !step.is_empty())?;
    let sizes = step.size_along(&step.gauss.target);
    let error = |i: usize| {
        let bias = step.gauss.bias[i];
        let terms = bias.abs() + expected[i].abs() + sizes[i];
        (bias - expected[i]).abs() / terms.max(TINY)
    };
    let (row, error) = largest((0..step.len()).map(error))?;
    let what = "the bias of a row differs from expected_bias";
    let bodies = step.bodies_of(Some(row));
    let finding = Finding::new(Stage::Assembly, what, error, rounding(step.source.bits));
    Some(Finding { row: Some(row), bodies, ..finding })
}

/// The difference of u* in the norm of M.
fn expected_target(step: &EngineStep) -> Option<Finding> {
    let expected = step.expected.target.as_ref()?;
    let scale = step.norm(expected).max(step.source.gravity).max(TINY);
    let error = step.norm(&difference(&step.gauss.target, expected)) / scale;
    let what = "the motion without constraints (target) differs from expected_target";
    Some(Finding::new(Stage::Assembly, what, error, rounding(step.source.bits)))
}

/// The report on a step whose numbers allow nothing else: one is not finite, or M is not positive
/// definite.
pub(crate) fn broken(step: &EngineStep) -> Option<Report> {
    let of =
        |finding, rest: &str| Report { findings: vec![finding], not_checked: vec![rest.into()] };
    match first_not_finite(step) {
        Some(finding) => Some(of(finding, finite::REST)),
        None => first_not_definite(step).map(|finding| of(finding, definite::REST)),
    }
}

/// Compares the error of the motion with the limit, and the motion and the reported generalized
/// forces with the forces.
pub(crate) fn check(step: &EngineStep, error: &MotionError, limit: f64) -> Report {
    let mut report = Report::default();
    if let (true, Some(why)) = (step.is_empty(), &step.no_bound) {
        report.not_checked.push(format!("solver and write-back, {why}"));
        return report;
    }
    let closure = closure_to_check(step, error, limit);
    match (error, closure) {
        _ if step.is_empty() => report.findings.push(free(step)),
        (_, Some(closure)) if closure.is_rejected() => {
            report.not_checked.push("solver: the motion is not that of the forces".into());
            report.findings.push(closure);
        }
        (MotionError::Unknown(why, worst), closure) => {
            report.not_checked.push(format!("solver: no bound on the motion, {why}"));
            report.findings.extend(worst.map(|worst| violation(step, OUTSIDE, worst, limit)));
            report.findings.extend(closure);
        }
        (MotionError::Unbounded(why, worst), closure) => {
            let part = "solver: a bound on the motion error does not exist";
            report.not_checked.push(format!("{part}, {why}; the law of each row was checked"));
            report.findings.extend(worst.map(|worst| violation(step, UNLAWFUL, worst, limit)));
            report.findings.extend(closure);
        }
        (MotionError::Bounded(bounds), _) => report.findings.push(motion(step, bounds, limit)),
    }
    match &step.answer.reported_push {
        None => {
            let what = "write-back: generalized forces, which the engine does not report";
            report.not_checked.push(what.into());
        }
        Some(reported) if step.is_empty() => report.findings.push(no_push(step, reported)),
        Some(reported) => report.findings.push(push(step, reported)),
    }
    report
}

/// The comparison of the motion with that of the forces, where no bound on both makes it.
///
/// No engine computes the forces of rigid rows from the motion: if these disagree, the problem is
/// not the one that the engine solved. An engine that does so for compliant rows may be as
/// inaccurate here as its solver.
fn closure_to_check(step: &EngineStep, error: &MotionError, limit: f64) -> Option<Finding> {
    let is_rigid = step.gauss.compliance.iter().all(|&compliance| compliance <= 0.0);
    let is_unbounded = matches!(error, MotionError::Unbounded(..));
    if step.has_computed_motion || !(is_rigid || is_unbounded) {
        return None;
    }
    let own = closure(step);
    let limit = if is_rigid { own.limit } else { own.limit.max(limit) };
    Some(Finding { limit, ..own })
}

/// The largest violation of the law of a row, or of its bounds.
fn violation(step: &EngineStep, what: &str, worst: Violation, limit: f64) -> Finding {
    let row = Some(worst.row);
    let finding = Finding::new(Stage::Solver, what, step.relative(worst.size), limit);
    Finding { row, bodies: step.bodies_of(row), ..finding }
}

/// Without rows the motion must be the motion without constraints.
fn free(step: &EngineStep) -> Finding {
    let target = &step.gauss.target;
    let scale = step.norm(target).max(step.source.gravity).max(TINY);
    let error = step.norm(&difference(&step.answer.motion, target)) / scale;
    let what = "there are no rows, but the motion is not the motion without constraints";
    Finding::new(Stage::WriteBack, what, error, rounding(step.source.bits))
}

fn motion(step: &EngineStep, bounds: &GapBound, limit: f64) -> Finding {
    let is_wrong = |bound: f64| step.relative(bound).is_nan() || step.relative(bound) > limit;
    let (motion, answer) = (is_wrong(bounds.motion), is_wrong(bounds.answer));
    let (stage, what, error) = if motion == answer || are_forces_of_motion(step) {
        let what = "the motion does not solve the problem that the engine posed";
        (Stage::Solver, what, bounds.motion)
    } else if answer && is_motion_of_forces(step) {
        let what = "the forces do not solve the problem, although the motion is within the limit";
        (Stage::Solver, what, bounds.answer)
    } else if motion {
        let what = "the forces solve the problem, but the motion is not the one that they cause";
        (Stage::WriteBack, what, bounds.motion)
    } else {
        let what = "the motion solves the problem, but the forces do not cause it";
        (Stage::WriteBack, what, bounds.answer)
    };
    let bodies = step.bodies_of(bounds.row);
    Finding { row: bounds.row, bodies, ..Finding::new(stage, what, step.relative(error), limit) }
}

/// Whether the motion is, up to rounding, the one that the forces cause.
fn is_motion_of_forces(step: &EngineStep) -> bool {
    !closure(step).is_rejected()
}

/// Compares the motion with the one that the forces cause, u* + M⁻¹Jᵀx.
fn closure(step: &EngineStep) -> Finding {
    let caused = step.motion_of(&step.answer.forces);
    let error = step.relative(step.norm(&difference(&step.answer.motion, &caused)));
    let what = "the motion is not the one that the forces cause";
    Finding::new(Stage::WriteBack, what, error, rounding(step.source.bits))
}

/// Compares the reported generalized forces with Jᵀx, each relative to its terms.
fn push(step: &EngineStep, reported: &[f64]) -> Finding {
    let mut terms = vec![0.0; reported.len()];
    for (row, x) in step.gauss.jacobian.iter().zip(&step.answer.forces) {
        row.iter().for_each(|&(j, value)| terms[j] += (value * x).abs());
    }
    let least = 1e-6 * terms.iter().copied().fold(TINY, f64::max);
    let caused = step.push(&step.answer.forces);
    let error = |j: usize| (reported[j] - caused[j]).abs() / terms[j].max(least);
    let (worst, error) = largest((0..reported.len()).map(error)).unwrap_or((0, 0.0));
    let what = format!("the reported generalized force of degree of freedom {worst} is not Jᵀx");
    let bodies = step.dof_bodies.get(worst).cloned().into_iter().collect();
    let finding = Finding::new(Stage::WriteBack, what, error, rounding(step.source.bits));
    Finding { bodies, ..finding }
}

/// Without rows, constraints have no generalized forces: compares the motion that the reported ones
/// cause with that by gravity.
fn no_push(step: &EngineStep, reported: &[f64]) -> Finding {
    let change = step.divided_by_mass(reported);
    let scale = step.norm(&step.gauss.target).max(step.source.gravity).max(TINY);
    let error = step.norm(&change) / scale;
    let what = "there are no rows, but the reported generalized forces of constraints are not 0";
    Finding::new(Stage::WriteBack, what, error, rounding(step.source.bits))
}

/// The first of the largest values, with its place; one that is not a number is larger than all
/// others.
fn largest(values: impl Iterator<Item = f64>) -> Option<(usize, f64)> {
    let is_larger = |own: f64, worst: f64| own > worst || (own.is_nan() && !worst.is_nan());
    values.enumerate().reduce(|worst, own| if is_larger(own.1, worst.1) { own } else { worst })
}
