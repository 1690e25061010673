//! Examines the problems of a run, one file per step, each solved from the answer to the previous
//! one.

use std::collections::BTreeMap;

use lcplab_lcp::file::Problem;
use lcplab_lcp::merit;
use lcplab_solver::Start;
use serde_json::Value;

use super::examination::{Examination, StepSummary, first_bad_step};
use super::examine::{UserSolver, creep, examine};
use super::frame::Frame;
use super::island::{worst, worst_part};
use super::reference::{ReferenceSolution, start};

/// Examines problems in the order of their steps: rows with the same name start from the last
/// answer. The first problem with a large error is examined.
pub fn examine_sequence(problems: &[Problem], user_solver: &UserSolver) -> Examination {
    let solver = user_solver.solver();
    let (mut last, mut taken) = (BTreeMap::new(), Vec::new());
    let mut found = Examination::default();
    for problem in problems {
        let names = names(problem);
        let mut from = start(&problem.lcp);
        for (x, name) in from.iter_mut().zip(&names) {
            *x = last.get(name).copied().unwrap_or(*x);
        }
        let x = solver.solve(&problem.lcp, &Start::at(&from), &mut ()).x;
        found.notes.push(note(problem, &x));
        last = names.into_iter().zip(x.iter().copied()).collect();
        taken.push((from, x));
    }
    let worst = first_bad_step(&found.notes);
    if let Some(problem) = problems.get(worst) {
        let (from, x) = taken.swap_remove(worst);
        let (frame, from) = worst_part(Frame::of(problem), &x, from);
        let from = (problems.len() > 1).then_some(from.as_slice());
        found.unsupported = examine(&frame, user_solver, from);
        if found.unsupported.is_none() {
            let reason = ReferenceSolution::absence(&frame.lcp);
            found.unmeasured = Some(match problems.len() {
                1 => reason.into(),
                _ => format!("{}: {reason}", problem.name),
            });
        }
        found.place = worst;
        found.moving = creep(&frame).into_iter().collect();
        found.frame = Some(frame);
    }
    found
}

fn note(problem: &Problem, x: &[f64]) -> StepSummary {
    let frame = Frame::of(problem);
    let reference = ReferenceSolution::of(&frame);
    let missing = reference.as_ref().map(|reference| reference.missing_in_answer(x));
    let missing = missing.map(|whole| worst(&frame, x, whole).map_or(whole, |(_, error)| error));
    let error = |reference: &ReferenceSolution<'_>| {
        reference.exact.iter().zip(x).map(|(exact, x)| exact - x).collect()
    };
    let impulse = frame.impulse(&reference.as_ref().map_or_else(Vec::new, error), |_| true);
    let upward = |body| if impulse.is_empty() { 0.0 } else { frame.upward(&impulse, body) };
    let bias = frame.motion.iter().flat_map(|motion| &motion.bias);
    StepSummary {
        name: problem.name.clone(),
        missing,
        unsupported: frame.bodies.iter().map(upward).sum(),
        residual: merit::scaled_residual(&problem.lcp, x),
        bias: bias.fold(0.0, |most, bias| most.max(-bias)),
        penetration: None,
        energy: None,
    }
}

/// The names of the rows: the label, or the number if there is none, and how many earlier rows have
/// the same label, because files of other programs may give all corners of a box one label.
fn names(problem: &Problem) -> Vec<(String, usize)> {
    let rows = problem.extra.get("rows").and_then(Value::as_array);
    let label = |i: usize| Some(rows?.get(i)?.get("label")?.as_str()?.to_string());
    let mut seen = BTreeMap::new();
    let mut name = |i: usize| {
        let label = label(i).unwrap_or_else(|| i.to_string());
        let count = seen.entry(label.clone()).or_insert(0);
        *count += 1;
        (label, *count)
    };
    (0..problem.lcp.len()).map(&mut name).collect()
}
