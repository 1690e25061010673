//! Energy, momentum and errors of a scene at one instant: what plots and tables show of a motion.

use nalgebra::Vector3;

use crate::body::{Body, State};
use crate::constraint::{Bounds, Row};
use crate::scene::{DetectedContact, Scene, contacts};

/// Energy, momentum and errors at one instant.
///
/// ```
/// use lcplab_mechanics::scene::Scene;
/// use lcplab_mechanics::simulation::{Motion, Simulation, carried, momentum_sizes};
/// use lcplab_solver::Dantzig;
///
/// // A stone of 1 kg, thrown up at 3 m/s.
/// let scene = Scene::load("free_fall")?;
/// let start = Motion::of(&scene, &scene.states, 0);
/// assert_eq!(momentum_sizes(&scene, &scene.states)[0], start.linear_momentum.norm());
/// let mut simulation = Simulation::new(scene.clone(), Box::new(Dantzig::default()));
/// let step = simulation.step().expect("a step that can be taken");
/// assert_eq!(step.motion.energy(), step.motion.kinetic + step.motion.potential);
/// // Nothing carries it.
/// assert!(carried(&scene, &start, &step.motion).unwrap().abs() < 1e-12);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// The number of steps taken.
    pub step: usize,
    /// Time since the start (s).
    pub time: f64,
    /// ½ Σ m |v|² + ω·I ω (J).
    pub kinetic: f64,
    /// −Σ m g·p (J): 0 where all masses are at the origin.
    pub potential: f64,
    /// ½ Σ k c² of springs (J).
    pub elastic: f64,
    /// Σ m v (kg m/s).
    pub linear_momentum: Vector3<f64>,
    /// Σ p × m v + I ω, about the world's origin (kg m²/s).
    pub angular_momentum: Vector3<f64>,
    /// max |c| over the equality rows that are lengths (m).
    pub drift: f64,
    /// max |c| over the equality rows that are angles (rad).
    pub angular_drift: f64,
    /// The deepest overlap of two bodies (m), 0 without one.
    pub penetration: f64,
}

impl Motion {
    /// The measures of a scene whose bodies have these states after this number of steps.
    pub fn of(scene: &Scene, states: &[State], step: usize) -> Self {
        Motion::overlapping(scene, states, step, &contacts(scene, states, 0.0))
    }

    /// The same where contacts are known, all that overlap among them.
    pub(super) fn overlapping(
        scene: &Scene,
        states: &[State],
        step: usize,
        found: &[DetectedContact],
    ) -> Self {
        let bodies = || scene.bodies.iter().map(|body| &body.mass).zip(states);
        let deepest = found.iter().map(|found| -found.gap).fold(0.0, f64::max);
        Motion {
            step,
            time: step as f64 * scene.step.dt,
            kinetic: bodies().map(|(mass, state)| mass.kinetic_energy(state)).sum(),
            potential: bodies()
                .map(|(mass, state)| 0.0 - mass.mass() * scene.gravity.dot(&state.pose.p))
                .sum(),
            elastic: elastic(scene, states),
            linear_momentum: bodies().map(|(mass, state)| mass.momentum(state)).sum(),
            angular_momentum: bodies().map(|(mass, state)| mass.angular_momentum(state)).sum(),
            drift: drift(scene, states, false),
            angular_drift: drift(scene, states, true),
            penetration: deepest,
        }
    }

    /// Kinetic and potential energy, and what springs store (J).
    pub fn energy(&self) -> f64 {
        self.kinetic + self.potential + self.elastic
    }
}

/// Σ m |v| (kg m/s) and Σ |p| m |v| + |I ω| (kg m²/s): the sizes of the bodies' momenta, whose sums
/// may cancel.
pub fn momentum_sizes(scene: &Scene, states: &[State]) -> [f64; 2] {
    let of_body = |(body, state): (&Body, &State)| {
        let linear = body.mass.momentum(state).norm();
        let spin = body.mass.angular_momentum(&State { v: Vector3::zeros(), ..*state });
        [linear, state.pose.p.norm() * linear + spin.norm()]
    };
    let sizes = scene.bodies.iter().zip(states).map(of_body);
    sizes.fold([0.0; 2], |sum, own| [sum[0] + own[0], sum[1] + own[1]])
}

/// The part of the weight that contacts, joints and springs carry between two instants, W being the
/// weight of all that moves and F the upward part of the forces that bodies are given:
///
/// ```text
/// (ΔP + (W − F) Δt) / W Δt
/// ```
///
/// 1 at rest, 0 in free fall. `None` without weight or without time.
pub fn carried(scene: &Scene, before: &Motion, after: &Motion) -> Option<f64> {
    let time = after.time - before.time;
    let scene = scene.forced(scene.time + before.time, time);
    let up = -scene.gravity.try_normalize(0.0)?;
    let moving = || scene.bodies.iter().filter(|body| body.mass.mass() > 0.0);
    let weight = scene.gravity.norm() * moving().map(|body| body.mass.mass()).sum::<f64>();
    let given = moving().map(|body| body.force.dot(&up)).sum::<f64>();
    let gained = up.dot(&(after.linear_momentum - before.linear_momentum));
    (weight * time > 0.0).then(|| (gained + (weight - given) * time) / (weight * time))
}

/// What springs store (J): ½ k c² of each of their rows.
pub(super) fn elastic(scene: &Scene, states: &[State]) -> f64 {
    let stored =
        |row: &Row| row.spring.map_or(0.0, |spring| 0.5 * spring.stiffness * row.c * row.c);
    rows(scene, states).iter().map(stored).sum()
}

/// The rows of all constraints; one without direction has none.
fn rows(scene: &Scene, states: &[State]) -> Vec<Row> {
    let rows = scene.constraints.iter().flat_map(|constraint| {
        let states = constraint.bodies().map(|body| body.map_or(&State::WORLD, |k| &states[k]));
        constraint.rows(states).unwrap_or_default()
    });
    rows.collect()
}

/// max |c| over rigid equality rows of one kind; a constraint without direction has no say.
fn drift(scene: &Scene, states: &[State], angular: bool) -> f64 {
    let rigid = |row: &Row| row.bounds == Bounds::Bilateral && row.spring.is_none();
    let rows = rows(scene, states).into_iter();
    rows.filter(|row| rigid(row) && row.kind.is_angular() == angular)
        .map(|row| row.c.abs())
        .fold(0.0, f64::max)
}
