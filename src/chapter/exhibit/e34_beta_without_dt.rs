//! E34: feedback without 1/dt, K&M (25), Codes 4 and 7.

use super::setting::{DT, over_time, stretched_rod};
use super::{Finding, Measure};
use crate::chapter::code::Form;
use crate::chapter::code::code07_whole_step::WholeStep;
use crate::chapter::code::constraint_class::Joint;
use crate::error::Result;
use crate::plot::{Axis, Lines, Series};

/// The number of steps until at most half is left.
fn half(errors: &[f64]) -> f64 {
    let reached = errors.iter().position(|error| *error <= 0.5 * errors[0]);
    reached.map_or(f64::INFINITY, |steps| steps as f64)
}

pub(super) fn example() -> Result<Finding> {
    let rod = Joint::rod([Some(0), Some(1)], 1.0);
    let errors = |beta, dt: f64, steps| {
        stretched_rod(&WholeStep { beta, ..WholeStep::CORRECTED }, &rod, dt, steps)
    };
    let (printed, corrected) = (errors(Form::Printed, DT, 600)?, errors(Form::Corrected, DT, 600)?);
    let part = |words: &str, dt: f64| -> Result<Measure> {
        let left = |form| errors(form, dt, 10).map(|errors| errors[10] / errors[0]);
        let measure = Measure::new(words, "", left(Form::Printed)?, left(Form::Corrected)?);
        Ok(measure.truth(&[0.9f64.powi(10)], "(1 − β)¹⁰", 1e-12))
    };
    let second = Measure::new("error after 1 s", "mm", 1e3 * printed[60], 1e3 * corrected[60]);
    let halved = Measure::new("steps until it is halved", "", half(&printed), half(&corrected));
    let steps = (0.5f64.ln() / 0.9f64.ln()).ceil();
    let lines = Lines::new(
        "e34",
        "An error of 0.1 m with β = 0.1",
        "The pale bands are 0.1 (1 − β)ⁿ and 0.1 (1 − β dt)ⁿ after n steps of 1/60 s.",
        Axis::linear("time", "s"),
        Axis::log("error", "m"),
        vec![
            Series::measured("printed", over_time(&printed[..61])),
            Series::measured("corrected", over_time(&corrected[..61])),
            Series::theory("theory, corrected", over_time(&powers(0.9))),
            Series::theory("theory, printed", over_time(&powers(1.0 - 0.1 * DT))),
        ],
    );
    Ok(Finding::new(
        "A rod of 1 m between two bodies of 1 kg is 0.1 m too long; no forces, β = 0.1, the penalty \
         added once. Steps of 1/60 s but for the last line.",
    )
    .measure(second.truth(&[100.0 * 0.9f64.powi(60)], "100 (1 − β)⁶⁰", 1e-9))
    .measure(halved.truth(&[steps], "ln ½/ln(1 − β)", 0.0))
    .measure(part("part left after ten steps", DT)?)
    .measure(part("the same, steps of 1/240 s", DT / 4.0)?)
    .plot(&lines))
}

/// 0.1 m times the powers of a factor.
fn powers(factor: f64) -> Vec<f64> {
    (0..=60).map(|k| 0.1 * factor.powi(k)).collect()
}
