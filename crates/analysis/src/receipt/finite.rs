//! Numbers that are not finite: the first one rejects the step, and nothing else can be computed.

use super::finding::{Finding, Stage};
use super::step::EngineStep;

/// What is not checked in a step with such a number.
pub(crate) const REST: &str = "everything else, because a number is not finite";

/// The first entry of a step that is not finite.
pub(crate) fn first_not_finite(step: &EngineStep) -> Option<Finding> {
    let gauss = &step.gauss;
    let mass = gauss.mass.iter().copied();
    let jacobian = gauss.jacobian.iter().enumerate();
    let jacobian = jacobian.flat_map(|(i, row)| row.iter().map(move |&(j, value)| (i, j, value)));
    let entry = in_matrix("mass", mass).or_else(|| in_matrix("jacobian", jacobian));
    // Bounds may be infinite, but only toward their own side.
    let bounded = |values: &[f64], infinity: f64| -> Vec<f64> {
        values.iter().map(|&value| if value == infinity { 0.0 } else { value }).collect()
    };
    let (lo, hi) = (bounded(&gauss.lo, f64::NEG_INFINITY), bounded(&gauss.hi, f64::INFINITY));
    let answer = &step.answer;
    let reported_push = answer.reported_push.as_deref().unwrap_or(&[]);
    let vectors: [(Stage, &str, &[f64], Kind); 10] = [
        (Stage::Assembly, "bias", &gauss.bias, Kind::Rows),
        (Stage::Assembly, "compliance", &gauss.compliance, Kind::Rows),
        (Stage::Assembly, "mu", &step.friction.mu, Kind::Rows),
        (Stage::Assembly, "lo", &lo, Kind::Rows),
        (Stage::Assembly, "hi", &hi, Kind::Rows),
        (Stage::Assembly, "target", &gauss.target, Kind::Dofs),
        (Stage::Assembly, "gravity", &[step.source.gravity], Kind::Number),
        (Stage::Solver, "forces", &answer.forces, Kind::Rows),
        (Stage::Solver, "motion", &answer.motion, Kind::Dofs),
        (Stage::WriteBack, "reported_push", reported_push, Kind::Dofs),
    ];
    entry.or_else(|| {
        vectors.iter().find_map(|(stage, name, values, kind)| {
            let place = values.iter().position(|value| !value.is_finite())?;
            let what = format!("{name}[{place}] is {}", word(values[place]));
            Some(match kind {
                Kind::Rows => {
                    let bodies = step.bodies_of(Some(place));
                    Finding { row: Some(place), bodies, ..rejected(*stage, what) }
                }
                Kind::Dofs => {
                    let bodies = step.dof_bodies.get(place).cloned().into_iter().collect();
                    Finding { bodies, ..rejected(*stage, what) }
                }
                Kind::Number => rejected(*stage, what),
            })
        })
    })
}

/// What the entries of a vector belong to.
enum Kind {
    Rows,
    Dofs,
    Number,
}

fn in_matrix(
    name: &str,
    mut entries: impl Iterator<Item = (usize, usize, f64)>,
) -> Option<Finding> {
    let (i, j, value) = entries.find(|(.., value)| !value.is_finite())?;
    Some(rejected(Stage::Assembly, format!("{name}[{i}, {j}] is {}", word(value))))
}

fn rejected(stage: Stage, what: String) -> Finding {
    Finding::new(stage, what, f64::INFINITY, 0.0)
}

/// A number that is not finite, as problem files write it.
fn word(value: f64) -> &'static str {
    match value {
        value if value.is_nan() => "nan",
        value if value > 0.0 => "inf",
        _ => "-inf",
    }
}
