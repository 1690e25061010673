//! E35: feedback that makes the error grow, K&M (25) with (34) and (44).

use super::setting::{DT, over_time, stretched_rod};
use super::{Finding, Measure};
use crate::chapter::code::Form;
use crate::chapter::code::code07_whole_step::{Limits, WholeStep};
use crate::chapter::code::constraint_class::Joint;
use crate::error::Result;
use crate::plot::{Axis, Lines, Series};

pub(super) fn example() -> Result<Finding> {
    let rod = Joint::rod([Some(0), Some(1)], 1.0);
    let negative = Joint { jacobian: -1.0, ..rod.clone() };
    let both = Joint { penalty: -1.0, ..negative.clone() };
    let scaled = WholeStep {
        beta: Form::Corrected,
        penalty: Form::Corrected,
        limits: Limits::Absent,
        ..WholeStep::PRINTED
    };
    let errors = |step: &WholeStep, joint: &Joint| stretched_rod(step, joint, DT, 60);
    let literally = errors(&WholeStep::PRINTED, &negative)?;
    let (grows, dies, right) =
        (errors(&scaled, &negative)?, errors(&scaled, &both)?, errors(&scaled, &rod)?);
    let factor = |errors: &[f64]| errors[1] / errors[0];
    let (whole, step) = (0.1 * 0.9f64.powi(60), 0.9);
    let as_printed = Measure::new("factor, all as printed", "", factor(&literally), factor(&dies));
    let alone = Measure::new("factor, β/dt, e once", "", factor(&grows), factor(&dies));
    let second = Measure::new("error after 1 s", "m", grows[60], dies[60]);
    let other = Measure::new("the same, J of (39)", "m", right[60], right[60]);
    let lines = Lines::new(
        "e35",
        "An error of 0.1 m with feedback of either sign",
        "With J = −∂c/∂s, as the ball joint and the contact are printed, the error c fed back \
                  grows to 30 m in a second; −c lets it die away.",
        Axis::linear("time", "s"),
        Axis::log("error", "m"),
        vec![
            Series::measured("printed", over_time(&grows)),
            Series::measured("printed, β without 1/dt", over_time(&literally)),
            Series::measured("corrected", over_time(&dies)),
        ],
    );
    Ok(Finding::new(
        "A rod of 1 m between two bodies of 1 kg is 0.1 m too long; no forces, dt = 1/60 s, β = 0.1. Its J is \
         that of (34), −∂c/∂s. Where all of Code 7 is as printed, its penalty is \
         doubled (E33) and β lacks 1/dt (E34); in the other lines those two are corrected and the sign alone \
         is at fault. With the J of (39) the printed sign is right.",
    )
    .measure(second.truth(&[whole], "0.1 (1 − β)⁶⁰", 1e-12))
    .measure(as_printed.truth(&[step], "1 − β", 1e-12))
    .measure(alone.truth(&[step], "1 − β", 1e-12))
    .measure(other.truth(&[whole], "0.1 (1 − β)⁶⁰", 1e-12).agreeing())
    .plot(&lines))
}
