//! E38: a contact that is added too late, K&M's test before a contact.

use super::setting::{DT, G, over_time, point, weigh, world};
use super::{Finding, Measure};
use crate::chapter::code::Form;
use crate::chapter::code::code07_whole_step::WholeStep;
use crate::chapter::code::constraint_class::Joint;
use crate::error::Result;
use crate::plot::{Axis, Lines, Series};

/// Heights (m) of a ball that starts at rest on the floor.
fn heights(test: Form, feedback: f64) -> Result<Vec<f64>> {
    let step = WholeStep { feedback, ..WholeStep::CORRECTED };
    let floor = Joint::contact([None, Some(0)], 0.0);
    let mut world = world(vec![point(0.0, 0.0)], Vec::new());
    let mut heights = vec![0.0];
    for _ in 0..600 {
        let c = world.bodies[0].position.z;
        let enters = match test {
            Form::Printed => c < 0.0,
            Form::Corrected => c <= 0.0,
        };
        world.constraints.clear();
        if enters {
            world.constraints.push(Box::new(floor.clone()));
        }
        weigh(&mut world.bodies);
        step.take(&mut world, DT)?;
        heights.push(world.bodies[0].position.z);
    }
    Ok(heights)
}

pub(super) fn example() -> Result<Finding> {
    let runs = |feedback| -> Result<[Vec<f64>; 2]> {
        Ok([heights(Form::Printed, feedback)?, heights(Form::Corrected, feedback)?])
    };
    let ([sunk, held], [back, firm]) = (runs(0.0)?, runs(0.2)?);
    let height = |words: &str, step: usize, [printed, corrected]: [&Vec<f64>; 2]| {
        let measure = Measure::new(words, "mm", 1e3 * printed[step], 1e3 * corrected[step]);
        measure.truth(&[0.0], "it rests", 1e-9)
    };
    let millimetres = |heights: &[f64]| {
        over_time(&heights[..31].iter().map(|height| 1e3 * height).collect::<Vec<_>>())
    };
    let lines = Lines::new(
        "e38",
        "A ball at rest on the floor",
        "The strict test lets the ball sink by g dt² in the first step; feedback with β = 0.2 \
                  brings it back, without feedback it stays there.",
        Axis::linear("time", "s"),
        Axis::linear("height", "mm"),
        vec![
            Series::measured("printed", millimetres(&sunk)),
            Series::measured("printed, β = 0.2", millimetres(&back)),
            Series::measured("corrected", millimetres(&held)),
            Series::theory("−g dt²", vec![(0.0, -1e3 * G * DT * DT), (0.5, -1e3 * G * DT * DT)]),
        ],
    );
    Ok(Finding::new(
        "A ball of 1 kg lies still on the floor, c = 0; g = 9.81 m/s², dt = 1/60 s. All but the test is \
         corrected.",
    )
    .measure(height("height after 1 step, β = 0", 1, [&sunk, &held]))
    .measure(height("height after 600 steps, β = 0", 600, [&sunk, &held]))
    .measure(height("height after 1 step, β = 0.2", 1, [&back, &firm]))
    .measure(height("height after 600 steps, β = 0.2", 600, [&back, &firm]).agreeing())
    .plot(&lines))
}
