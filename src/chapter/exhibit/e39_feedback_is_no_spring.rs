//! E39: feedback is not a spring, and pushes bodies apart, K&M section on drifting.

use super::setting::{DT, over_time};
use super::{Finding, Measure};
use crate::constraint::Spring;
use crate::error::Result;
use crate::plot::{Axis, Lines, Series};
use crate::scene::{Scene, Scheme};
use crate::simulation::Simulation;
use crate::solver::Dantzig;

/// A step (s) of a mass (kg) on a spring with error c (m) and its rate (m/s), using the row
/// w = (1/m + γ) x + b, b = v + β/dt c: the velocity after it.
fn row(spring: Spring, compliance: f64, mass: f64, c: f64, v: f64) -> f64 {
    let b = v + spring.feedback(DT) * c;
    v - b / (1.0 / mass + compliance) / mass
}

/// The implicit Euler step of m v' = −k c − d v, solved for the velocity.
fn implicit(spring: Spring, mass: f64, c: f64, v: f64) -> f64 {
    let Spring { stiffness: k, damping: d } = spring;
    (mass * v - DT * k * c) / (mass + DT * d + DT * DT * k)
}

/// The remaining error (m) after this number of steps from 0.1 m at rest.
fn left(steps: usize, next: impl Fn(f64, f64) -> f64) -> f64 {
    let start = (0.1, 0.0);
    let (c, _) = (0..steps).fold(start, |(c, v), _| {
        let v = next(c, v);
        (c + DT * v, v)
    });
    c
}

/// Heights (m) and the initial speed (m/s) of a body that starts too deep in the ground.
fn pushed_out(scheme: Scheme, depth: f64) -> Result<(Vec<f64>, f64)> {
    let text = format!(
        "[step]\ndt = {DT}\nbaumgarte = 0.2\n\
         [[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n\
         [[bodies]]\nname = \"body\"\nmass = 1\nshape = \"point\"\nposition = [0, 0, {}]\n",
        -depth
    );
    let mut scene = Scene::from_toml("overlap.toml", &text)?;
    scene.step.scheme = scheme;
    let mut simulation = Simulation::new(scene, Box::new(Dantzig::default()));
    let (mut heights, mut first) = (vec![-depth], f64::NAN);
    simulation.run(60, |step| {
        let body = &step.states[1];
        heights.push(body.pose.p.z);
        if step.number == 1 {
            first = body.v.z;
        }
        std::ops::ControlFlow::Continue(())
    });
    Ok((heights, first))
}

pub(super) fn example() -> Result<Finding> {
    let damped = Spring { stiffness: 300.0, damping: 20.0 };
    let gamma = damped.compliance(DT);
    let speed = |words: &str, mass: f64| {
        let of = |gamma| row(damped, gamma, mass, 0.1, 0.4);
        let measure = Measure::new(words, "m/s", of(0.0), of(gamma));
        measure.truth(&[implicit(damped, mass, 0.1, 0.4)], "implicit Euler", 1e-12)
    };
    let error = |words: &str, mass: f64| {
        let of = |gamma| left(10, |c, v| row(damped, gamma, mass, c, v));
        let measure = Measure::new(words, "m", of(0.0), of(gamma));
        measure.truth(&[left(10, |c, v| implicit(damped, mass, c, v))], "implicit Euler", 1e-12)
    };
    let (thrown, _) = pushed_out(Scheme::Velocity, 0.3)?;
    let (lifted, _) = pushed_out(Scheme::SplitImpulse, 0.3)?;
    let (_, pushed) = pushed_out(Scheme::Velocity, 0.1)?;
    let (_, still) = pushed_out(Scheme::SplitImpulse, 0.1)?;
    let top = |heights: &[f64]| heights.iter().copied().fold(0.0, f64::max);
    let push = Measure::new("speed out of 0.1 m, one step", "m/s", pushed, still);
    let jump = Measure::new("peak above ground, from 0.3 m", "m", top(&thrown), top(&lifted));
    let lines = Lines::new(
        "e39",
        "A body at rest 0.3 m deep in the ground",
        "Feedback with β = 0.2 throws the body out of the ground; correcting its position apart \
                  from its velocity lifts it just to the surface.",
        Axis::linear("time", "s"),
        Axis::linear("height", "m"),
        vec![
            Series::measured("printed", over_time(&thrown)),
            Series::measured("corrected", over_time(&lifted)),
            Series::reference("the ground", vec![(0.0, 0.0), (1.0, 0.0)]),
        ],
    );
    Ok(Finding::new(
        "First a mass on a spring of k = 300 N/m and d = 20 N s/m, stretched by 0.1 m, moving at 0.4 m/s for \
         one step or from rest for ten; dt = 1/60 s, so β = 0.2. Printed is the row with this feedback alone, with 1/dt \
         (E34), corrected the one with compliance as well; true is the spring's own implicit step.\n\nThen \
         a body of 1 kg at rest in the ground, 0.1 m or 0.3 m deep, g = 9.81 m/s², β = 0.2. Corrected is split \
         impulse: positions by themselves.",
    )
    .measure(speed("u⁺ of 2 kg", 2.0))
    .measure(speed("u⁺ of 2000 kg", 2000.0))
    .measure(error("error of 2 kg, ten steps", 2.0))
    .measure(error("error of 2000 kg, ten steps", 2000.0))
    .measure(push.truth(&[0.0], "it rests", 1e-12))
    .measure(jump.truth(&[0.0], "it rests", 1e-9))
    .plot(&lines))
}
