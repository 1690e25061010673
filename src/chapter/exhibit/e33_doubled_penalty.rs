//! E33: the penalty is added once for each body, K&M Code 7.

use super::setting::{DT, over_time, stretched_rod};
use super::{Finding, Measure};
use crate::chapter::code::Form;
use crate::chapter::code::code07_whole_step::WholeStep;
use crate::chapter::code::constraint_class::Joint;
use crate::error::Result;
use crate::plot::{Axis, Lines, Panel, Series};

pub(super) fn example() -> Result<Finding> {
    let pair = Joint::rod([Some(0), Some(1)], 1.0);
    let lone = Joint::rod([None, Some(1)], 1.0);
    let step = |penalty, feedback| WholeStep { penalty, feedback, ..WholeStep::CORRECTED };
    let errors = |form, beta, joint: &Joint| stretched_rod(&step(form, beta), joint, DT, 60);
    let factor = |words: &str, beta: f64, joint: &Joint| -> Result<Measure> {
        let of = |form| errors(form, beta, joint).map(|errors| errors[1] / errors[0]);
        let measure = Measure::new(words, "", of(Form::Printed)?, of(Form::Corrected)?);
        Ok(measure.truth(&[1.0 - beta], "1 − β", 1e-12))
    };
    // As printed in everything but the place of the penalty: β is then a rate.
    let rate = |penalty| -> Result<f64> {
        let step = WholeStep { penalty, ..WholeStep::PRINTED };
        stretched_rod(&step, &pair, DT, 1).map(|errors| errors[1] / errors[0])
    };
    let unscaled =
        Measure::new("factor, two, no 1/dt", "", rate(Form::Printed)?, rate(Form::Corrected)?);
    let (doubled, once) =
        (errors(Form::Printed, 1.2, &pair)?, errors(Form::Corrected, 1.2, &pair)?);
    let left = Measure::new("error after 1 s, β = 1.2", "m", doubled[60], once[60]);
    let size = |errors: &[f64]| errors.iter().map(|error| error.abs()).collect::<Vec<_>>();
    let decay = |factor: f64| (0..=30).map(|k| 0.1 * factor.powi(k)).collect::<Vec<_>>();
    let panel = |beta: f64| -> Result<Panel> {
        Ok(Panel {
            y: Axis::log(format!("error, β = {beta}"), "m"),
            series: vec![
                Series::measured(
                    "printed",
                    over_time(&size(&errors(Form::Printed, beta, &pair)?)[..31]),
                ),
                Series::measured(
                    "corrected",
                    over_time(&size(&errors(Form::Corrected, beta, &pair)?)[..31]),
                ),
                Series::theory("0.1 |1 − 2β|ᵏ", over_time(&size(&decay(1.0 - 2.0 * beta)))),
                Series::theory("0.1 |1 − β|ᵏ", over_time(&size(&decay(1.0 - beta)))),
            ],
        })
    };
    let lines = Lines {
        id: "e33".into(),
        title: "An error between two bodies".into(),
        caption:
            "With β = 0.1 the printed penalty is twice as strong as stated; with β = 1.2, at which \
                  a single penalty is stable, the error grows without bound."
                .into(),
        x: Axis::linear("time", "s"),
        panels: vec![panel(0.1)?, panel(1.2)?],
    };
    Ok(Finding::new(
        "A rod of 1 m between two bodies of 1 kg is 0.1 m too long; no forces, dt = 1/60 s, feedback β/dt. \
         Factors are the error after a step over that before it, for β = 0.1; where the rod hangs on the world there is one \
         body only, and the fault does not show. With β alone, as printed, the factor is 1 − β dt \
         if added once. With β = 1.2 the error is multiplied by −0.2 in a step, by −1.4 as printed.",
    )
    .measure(left.truth(&[0.1 * 0.2f64.powi(60)], "0.1 (−0.2)⁶⁰", 1e-12))
    .measure(factor("factor, two bodies", 0.1, &pair)?)
    .measure(factor("factor, one body", 0.1, &lone)?.agreeing())
    .measure(unscaled.truth(&[1.0 - 0.1 * DT], "1 − β dt", 1e-12))
    .plot(&lines))
}
