//! Painlevé's rod: no forces solve the problem, but impulses do.

use super::measure::{Case, Known, Method, ROUNDING, first, start};
use super::{Row, Size};
use crate::constraint::Kind;
use crate::error::Result;
use crate::simulation::Cause;

/// At acceleration level the proof that there is no solution, checked exactly; at velocity level a
/// step after which the tip does not penetrate.
pub(super) fn rod(size: Size) -> Result<Vec<Row>> {
    let case = Case::load("painleve", "painleve", size)?;
    let formula = "d \\ge 0,\\ A^T d \\le 0,\\ b^T d < 0";
    let what = "number of proofs that no forces exist";
    let known =
        vec![Known::exact((0.0, "a proof is exact: it holds or it fails"), what, formula, "", 1.0)];
    let mut rows = case.rows(Method::Acceleration, known, |scene| {
        let failure = start(scene)?.step().err()?;
        let proved = matches!(failure.cause, Cause::NoSolution { proof: Some(_), .. });
        Some(vec![f64::from(u8::from(proved))])
    });
    let formula = "0";
    let known =
        vec![Known::exact(ROUNDING, "speed of the tip toward the ground", formula, "m/s", 0.0)];
    rows.extend(case.rows(Method::Velocity, known, |scene| {
        let step = first(scene)?;
        let solve = step.solves.last()?;
        let after = solve.problem.next_velocity(&solve.solution.x, scene.step.dt);
        let speeds = solve.problem.assembly.push_forward(&after);
        let rows = solve.problem.assembly.rows.iter().zip(&solve.solution.x).zip(speeds);
        // Touching rows with a force; a row with a gap may approach by the gap.
        let into = rows
            .filter(|((row, x), _)| row.kind == Kind::Normal && **x > 0.0 && row.c <= 1e-9)
            .map(|(_, speed)| speed.abs())
            .reduce(f64::max)?;
        Some(vec![into])
    }));
    Ok(rows)
}
