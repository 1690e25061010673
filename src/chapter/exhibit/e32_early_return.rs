//! E32: without constraints nothing moves, K&M Codes 3 and 7.

use nalgebra::Vector3;

use super::setting::{DT, G, over_time, point, world};
use super::{Finding, Measure};
use crate::chapter::code::Form;
use crate::chapter::code::code03_update::update;
use crate::chapter::code::code05_rigid_body::RigidBody;
use crate::chapter::code::constraint_class::Joint;
use crate::error::Result;
use crate::plot::{Axis, Lines, Series};

/// The number of frames without a constraint.
const FRAMES: usize = 60;

/// The falling ball in one form: its heights (m), and its state when the constraint is added.
struct Fall {
    heights: Vec<f64>,
    force: f64,
    gained: f64,
}

/// A ball falls next to another body, which is nailed after 60 frames.
fn fall(form: Form) -> Result<Fall> {
    let weigh = |bodies: &mut [RigidBody]| bodies[0].force.z -= G;
    let mut world = world(vec![point(10.0, 0.0), point(0.0, 0.0)], Vec::new());
    let mut fall = Fall { heights: vec![10.0], force: 0.0, gained: 0.0 };
    for frame in 1..=90 {
        let speed = world.bodies[0].linear_velocity.z;
        if frame == FRAMES + 1 {
            fall.force = world.bodies[0].force.z;
            let nail = Joint::ball([None, Some(1)], [Vector3::zeros(); 2]);
            world.constraints.push(Box::new(nail));
        }
        update(form, &mut world, weigh, DT)?;
        let ball = &world.bodies[0];
        fall.heights.push(ball.position.z);
        if frame == FRAMES + 1 {
            fall.gained = ball.linear_velocity.z - speed;
        }
    }
    Ok(fall)
}

pub(super) fn example() -> Result<Finding> {
    let (printed, corrected) = (fall(Form::Printed)?, fall(Form::Corrected)?);
    let n = FRAMES as f64;
    let height = Measure::new(
        "height after 60 frames",
        "m",
        printed.heights[FRAMES],
        corrected.heights[FRAMES],
    );
    let force = Measure::new("force left over then", "N", printed.force, corrected.force);
    let gained = Measure::new("speed gained in frame 61", "m/s", printed.gained, corrected.gained);
    let exact = |t: f64| 10.0 - 0.5 * G * t * t;
    let curve: Vec<_> = (0..=90).map(|k| k as f64 * DT).map(|t| (t, exact(t))).collect();
    let lines = Lines::new(
        "e32",
        "A ball that nothing holds",
        "As printed the ball hangs for a second, until a constraint appears on another body; \
                  then it sets off with the speed of the whole second.",
        Axis::linear("time", "s"),
        Axis::linear("height", "m"),
        vec![
            Series::measured("printed", over_time(&printed.heights)),
            Series::measured("corrected", over_time(&corrected.heights)),
            Series::theory("10 − g t²/2", curve),
        ],
    );
    Ok(Finding::new(
        "A ball of 1 kg falls from 10 m for 60 frames of 1/60 s, g = 9.81 m/s², without any constraint. In frame 61 \
         another body is nailed, which has nothing to do with the ball.",
    )
    .measure(height.truth(&[10.0 - G * DT * DT * n * (n + 1.0) / 2.0], "10 − g dt² n(n+1)/2", 1e-9))
    .measure(force.truth(&[0.0], "forces are cleared", 0.0))
    .measure(gained.truth(&[-G * DT], "−g dt", 1e-12))
    .plot(&lines))
}
