//! E14: the velocity level called a subset of the acceleration level.

use nalgebra::Vector3;

use super::common::{answer, contacts, enumerated};
use super::setting::G;
use super::{Finding, Measure, Outcome};
use crate::error::{Error, Result};
use crate::formulation::Stage;
use crate::lcp::library;
use crate::plot::{Axis, Lines, Series};
use crate::scene::catalogue::pendulum::{Pendulum, Swing};
use crate::scene::{Scene, Scheme};
use crate::simulation::Simulation;
use crate::solver::{Dantzig, Lemke};

const START: Swing<1> = Swing { angles: [0.7], rates: [1.3] };

/// A pendulum's tension, an impact, and a rod that no force can hold.
pub(super) fn example() -> Result<Finding> {
    let pull = -(G * START.angles[0].cos() + START.rates[0].powi(2));
    let step = |scheme| Ok::<f64, Error>(forces(scheme, 0.01, 1)?[0]);
    let force =
        Measure::new("λ of the rod", "N", step(Scheme::Velocity)?, step(Scheme::Acceleration)?);
    let (at_rest, impact) =
        (answer(Dantzig::NAME, &contacts(&[1.0], &[-G])?)?, contacts(&[1.0], &[-1.0])?);
    let printed = -1.0 + 0.01 * (at_rest[0] - G);
    let corrected = -1.0 + answer(Dantzig::NAME, &impact)?[0];
    let velocity = Measure::new("velocity after an impact", "m/s", printed, corrected);
    Ok(Finding::new(
        "A pendulum of 1 kg and 1 m at 0.7 rad and 1.3 rad/s: λ < 0 pulls. Printed is a step at velocity \
         level, x/dt, the same for any dt; corrected, the acceleration level.\n\nA ball of 1 kg hits the floor \
         at 1 m/s: printed is the acceleration level, w = x − g ≥ 0, with dt = 0.01 s; corrected the velocity \
         level, w = x − 1 ≥ 0.\n\nA thin rod of 1 kg and 2 m slides at 1 m/s, one end on the ground, at 60° with \
         μ = 1.8; gravity gives the end 0.00981 m/s in the step. Printed is the acceleration level, \
         w = A x + b with A and b below 0; corrected the velocity level, by Lemke's method.\n\nAll b are in \
         this library's sign.",
    )
    .measure(force.truth(&[pull], "−m (g cos θ + l θ'²)", 1e-9))
    .measure(velocity.truth(&[0.0], "the floor is rigid", 1e-12))
    .measure(painleve()?)
    .plot(&pull_over_time()?))
}

/// The normal force on the end of Painlevé's rod.
fn painleve() -> Result<Measure> {
    let tan = 3f64.sqrt();
    let given = [("mu", 1.8), ("tan", tan)];
    let forces = library::by_name("painleve")?.generate(&given)?.lcp;
    let printed = match enumerated(&forces).first() {
        Some(x) => Outcome::from(x[0]),
        None => Outcome::Impossible("no solution".into()),
    };
    let fall = 0.00981;
    let given = [given[0], given[1], ("fall", fall)];
    let impulses = library::by_name("painleve-impulse")?.generate(&given)?.lcp;
    // ¼ (A_tt fall − A_nt), with 1 + 3 sin² = 3.25 and −3 sin cos = −1.299
    let (square, tangent) = (1.0 + tan * tan, (1.0 + 4.0 * tan * tan) / (1.0 + tan * tan));
    let truth = 0.25 * (tangent * fall + 3.0 * tan / square);
    let x =
        Measure::new("push on the rod's end", "N s", printed, answer(Lemke::NAME, &impulses)?[0]);
    Ok(x.truth(&[truth], "the end sticks", 1e-9))
}

/// λ (N) in each step; at velocity level x/dt.
fn forces(scheme: Scheme, dt: f64, steps: usize) -> Result<Vec<f64>> {
    let mut scene = Scene::load("pendulum")?;
    (scene.step.scheme, scene.step.dt) = (scheme, dt);
    (scene.step.baumgarte, scene.step.alpha) = (0.0, 0.0);
    let ([(sin, cos)], [rate]) = (START.angles.map(f64::sin_cos), START.rates);
    scene.states[0].pose.p = Vector3::new(sin, 0.0, -cos);
    scene.states[0].v = rate * Vector3::new(cos, 0.0, sin);
    let mut simulation = Simulation::new(scene, Box::new(Dantzig::default()));
    let mut force = || -> Result<f64> {
        let step = simulation
            .step()
            .map_err(|failure| Error::invalid("E14", "pendulum", failure.to_string()))?;
        let unit = |stage| if stage == Stage::Velocity { dt } else { 1.0 };
        let wanted = |stage| matches!(stage, Stage::Velocity | Stage::Acceleration);
        let solve = step.solves.iter().find(|solve| wanted(solve.problem.stage));
        Ok(solve.map_or(f64::NAN, |solve| solve.solution.x[0] / unit(solve.problem.stage)))
    };
    (0..steps).map(|_| force()).collect()
}

/// The tension over two seconds: along a run of velocity-level steps, exact, and in single steps
/// from the exact motion.
fn pull_over_time() -> Result<Lines> {
    let (dt, pendulum) = (0.02, Pendulum { length: 1.0, gravity: G });
    let mut swing = START;
    let mut exact = Vec::new();
    let mut single = Vec::new();
    for k in 0..100 {
        let (t, bend) = (f64::from(k) * dt, swing.rates[0].powi(2));
        exact.push((t, G * swing.angles[0].cos() + bend));
        single.push((t, G * swing.angles[0].cos()));
        swing = pendulum.after(dt, swing);
    }
    let run = forces(Scheme::Velocity, dt, 100)?;
    let run = run.iter().enumerate().map(|(k, force)| (k as f64 * dt, -force)).collect();
    Ok(Lines::new(
        "pull_of_a_pendulum",
        "Tension of the rod of a pendulum",
        "A single step at velocity level, started on the exact motion, lacks the part that bends the \
             path. In a run, each step from the second on corrects the error of the one before; \
             the remaining error is that of steps of 0.02 s.",
        Axis::linear("time", "s"),
        Axis::linear("tension of the rod", "N"),
        vec![
            Series::measured("velocity level, a run", run),
            Series::reference("exact", exact),
            Series::theory("velocity level, single steps", single),
        ],
    ))
}
