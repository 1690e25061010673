//! E37: a bounce that no term produces, K&M section on the algorithm.

use super::setting::{DT, G, point, weigh, world};
use super::{Finding, Measure};
use crate::chapter::code::code07_whole_step::WholeStep;
use crate::chapter::code::constraint_class::Joint;
use crate::error::Result;
use crate::plot::{Axis, Lines, Series};
use crate::scene::Scene;
use crate::simulation::Simulation;
use crate::solver::Dantzig;

/// The coefficient of restitution.
const E: f64 = 0.5;
/// Steps per second of the fall, fine enough to resolve the impact.
const RATE: usize = 480;

/// The height and speed of a ball after each step of dt (s), as printed.
fn printed(start: (f64, f64), dt: f64, steps: usize) -> Result<Vec<(f64, f64)>> {
    let mut world = world(vec![point(start.0, start.1)], Vec::new());
    let floor = Joint::contact([None, Some(0)], 0.0);
    let mut path = vec![start];
    for _ in 0..steps {
        weigh(&mut world.bodies);
        world.constraints.clear();
        // The row exists from first contact on; without it Code 7 would return early (E32).
        let step = if world.bodies[0].position.z <= 0.0 {
            world.constraints.push(Box::new(floor.clone()));
            &WholeStep::PRINTED
        } else {
            &WholeStep::CORRECTED
        };
        step.take(&mut world, dt)?;
        let ball = &world.bodies[0];
        path.push((ball.position.z, ball.linear_velocity.z));
    }
    Ok(path)
}

/// The same with the library's restitution.
fn corrected(start: (f64, f64), dt: f64, steps: usize) -> Result<Vec<(f64, f64)>> {
    let text = format!(
        "[step]\ndt = {dt}\n[contact]\nrestitution = {E}\n\
         [[bodies]]\nname = \"floor\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n\
         [[bodies]]\nname = \"ball\"\nmass = 1\nshape = \"point\"\nposition = [0, 0, {}]\nvelocity = [0, 0, {}]\n",
        start.0, start.1
    );
    let scene = Scene::from_toml("bounce.toml", &text)?;
    let mut simulation = Simulation::new(scene, Box::new(Dantzig::default()));
    let mut path = vec![start];
    simulation.run(steps, |step| {
        let ball = &step.states[1];
        path.push((ball.pose.p.z, ball.v.z));
        std::ops::ControlFlow::Continue(())
    });
    Ok(path)
}

/// The greatest height after the ball has first turned upwards; 0 if it never does.
fn rebound(path: &[(f64, f64)]) -> f64 {
    let turn = path.windows(2).position(|pair| pair[1].0 > pair[0].0).unwrap_or(path.len());
    path[turn..].iter().map(|(height, _)| *height).fold(0.0, f64::max)
}

pub(super) fn example() -> Result<Finding> {
    let dt = 1.0 / RATE as f64;
    let (hit, thrown) = (printed((0.0, -3.0), DT, 1)?, corrected((0.0, -3.0), DT, 1)?);
    let (dead, alive) = (printed((1.0, 0.0), dt, RATE)?, corrected((1.0, 0.0), dt, RATE)?);
    let speed = Measure::new("speed after the impact", "m/s", hit[1].1, thrown[1].1);
    let height = Measure::new("rebound of a fall from 1 m", "m", rebound(&dead), rebound(&alive));
    let heights = |path: &[(f64, f64)]| {
        path.iter().enumerate().map(|(k, (z, _))| (k as f64 * dt, *z)).collect::<Vec<_>>()
    };
    let lines = Lines::new(
        "e37",
        "A ball that falls from 1 m",
        "As printed the ball stays where it hits; with restitution e = ½ it rises to e² = ¼ of \
                  its height.",
        Axis::linear("time", "s"),
        Axis::linear("height", "m"),
        vec![
            Series::measured("printed", heights(&dead)),
            Series::measured("corrected", heights(&alive)),
            Series::reference("e² · 1 m", vec![(0.0, E * E), (1.0, E * E)]),
        ],
    );
    // The impact is resolved to within a step, in which the ball falls v dt.
    let uncertain = (2.0 * G).sqrt() * dt;
    Ok(Finding::new(
        "A ball of 1 kg that should bounce with e = ½, g = 9.81 m/s². First it touches the floor at 3 m/s, one \
         step of 1/60 s. Then it falls from 1 m, 480 steps a second. The corrected form is the library's: \
         the rows that push and approached are solved again with b = J u* + e J u in w = A x + b.",
    )
    .measure(speed.truth(&[E * 3.0], "e times the speed", 1e-12))
    .measure(height.truth(&[E * E], "e² times the height", uncertain))
    .plot(&lines))
}
