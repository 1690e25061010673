//! Where a step's energy went: every impulse's work, and what the step itself adds or loses.
//!
//! An impulse P takes the velocities from u to u⁺ = u + M⁻¹P at fixed poses, so its work is exactly
//!
//! ```text
//! ½ u⁺ᵀM u⁺ − ½ uᵀM u = ½ (u + u⁺)·P,      P = dt F + Jᵀ X,   X = x, or dt x for forces
//! ```
//!
//! which splits into the work ½ X_i (J u + J u⁺)_i of each row. Where the row fulfils w = J u⁺ +
//! bias, the part −½ X_i bias_i is the bias's doing, or the bounce's. Then the bodies move by dt u⁺
//! while gravity has worked along ½ dt (u + u⁺), which leaves −½ dt m g·(v⁺ − v), and the inertia
//! turns with the body, which leaves ½ ω⁺·(I⁺ − I) ω⁺. Springs gain ½ k (c⁺² − c²); beside the work
//! of their rows and of their dampers that leaves what the step itself takes. A body that is put
//! elsewhere by d gains −m g·d, and what its inertia turns.
//!
//! All this is computed from the [events](super::StepEvent) that the scheme recorded; the change
//! is measured from the states before and after. What is missing between the two is a row of its
//! own: rounding, unless something acted that was not recorded. A scheme that does not record its
//! events has no ledger.

use nalgebra::Vector3;

use super::events::Impulses;
use super::motion::elastic;
use super::{Solve, StepEvent};
use crate::assembly::Assembly;
use crate::body::{Body, State, angular, linear};
use crate::constraint::Bounds;
use crate::scene::Scene;

/// A remainder up to this part of the scale is rounding.
const ROUNDING: f64 = 1e-11;

/// The change of kinetic, potential and springs' energy in a step (J), by cause. Gains are
/// positive. What the springs of the penalty method store is not part of the energy.
///
/// ```
/// use lcplab_mechanics::scene::Scene;
/// use lcplab_mechanics::simulation::{Ledger, Simulation};
/// use lcplab_solver::Dantzig;
///
/// // The middle one of three balls has ½ J, which its impact takes out.
/// let mut simulation = Simulation::new(Scene::load("fig7")?, Box::new(Dantzig::default()));
/// let before = simulation.states().to_vec();
/// let step = simulation.step().expect("a step that can be taken");
/// let ledger = step.ledger.unwrap();
/// assert!(ledger.closes() && ledger.remainder().abs() < 1e-12);
/// assert_eq!(ledger.accounts()[1].0, "contact");
/// let events = step.events.as_ref().unwrap();
/// let again = Ledger::of(simulation.scene(), &before, &step.solves, events, &step.states);
/// assert_eq!(again, ledger);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Ledger {
    /// The change itself, measured from the states.
    pub change: f64,
    /// Rigid equations: 0 where J stays, a loss where the velocities no longer fit it.
    pub constraint: f64,
    /// Contacts and limits: the loss of an impact.
    pub contact: f64,
    /// What bounces give back.
    pub restitution: f64,
    /// Gaps that close within the step: the contact stops there and does not bounce.
    pub gap: f64,
    /// Feedback of position errors.
    pub bias: f64,
    /// Dry friction: never a gain.
    pub friction: f64,
    /// Motors, and supports that move springs.
    pub motor: f64,
    /// The constant forces and torques on bodies, gravity apart.
    pub external: f64,
    /// Dampers of springs: −d ċ² dt with the mean ċ of the step.
    pub damper: f64,
    /// What a step takes of the springs' energy beside that: the loss of an implicit step.
    pub spring: f64,
    /// The gyroscopic torque, and the inertia turning with the body: together 0 in the limit.
    pub gyroscopic: f64,
    /// Gravity along the path of the step against gravity along the mean velocity.
    pub integrator: f64,
    /// Bodies that were put elsewhere, by the corrections of split impulse and NGS.
    pub correction: f64,
    /// The size (J) of the energies that all this was computed from, for rounding is a part of
    /// them: kinetic energy, m |g·p| of each body, and the work of each row.
    pub scale: f64,
}

impl Ledger {
    /// The accounts with their names, in the order of tables.
    pub fn accounts(&self) -> [(&'static str, f64); 13] {
        [
            ("constraint", self.constraint),
            ("contact", self.contact),
            ("restitution", self.restitution),
            ("gap", self.gap),
            ("bias", self.bias),
            ("friction", self.friction),
            ("motor", self.motor),
            ("external", self.external),
            ("damper", self.damper),
            ("spring", self.spring),
            ("gyroscopic", self.gyroscopic),
            ("integrator", self.integrator),
            ("correction", self.correction),
        ]
    }

    /// What no account explains (J).
    pub fn remainder(&self) -> f64 {
        self.change - self.accounts().iter().map(|(_, work)| work).sum::<f64>()
    }

    /// Whether nothing but rounding is missing.
    pub fn closes(&self) -> bool {
        self.remainder().abs() <= ROUNDING * self.scale
    }

    /// The accounts of a step from what acted in it, and the change from its states before and
    /// after.
    pub fn of(
        scene: &Scene,
        before: &[State],
        solves: &[Solve],
        events: &[StepEvent],
        after: &[State],
    ) -> Self {
        let mut ledger = Ledger {
            change: energy(scene, after) - energy(scene, before),
            scale: size(scene, before).max(size(scene, after)),
            ..Ledger::default()
        };
        let mut states = before.to_vec();
        let mut assembly = None;
        for event in events {
            if let Some(impulses) = Impulses::of(scene, event, solves) {
                ledger.add_rows(&impulses);
                ledger.add_forces(scene, &impulses);
                states = impulses.assembly.with_velocities(&states, &impulses.next);
                assembly = Some(impulses.assembly);
            }
            match event {
                StepEvent::Advance(h) => ledger.advance(scene, assembly, &mut states, *h),
                StepEvent::Shift { body, by } => {
                    let moved = states[*body].displaced(by);
                    ledger.correction += shift(scene, *body, &states[*body], &moved, &linear(by));
                    let stored = elastic(scene, &states);
                    states[*body] = moved;
                    ledger.correction += elastic(scene, &states) - stored;
                }
                StepEvent::Answer(_) | StepEvent::VelocityUpdate(_) => (),
            }
        }
        ledger
    }

    fn add_rows(&mut self, impulses: &Impulses) {
        let next = impulses.assembly.push_forward(&impulses.next);
        for (i, row) in impulses.assembly.rows.iter().enumerate() {
            let impulse = impulses.x[i];
            let work = 0.5 * impulse * (row.velocity - row.drift + next[i]);
            let bias = -0.5 * impulse * impulses.feedback[i];
            self.scale += work.abs();
            match row.bounds {
                Bounds::Friction { .. } => self.friction += work,
                Bounds::Effort(_) => self.motor += work,
                _ if row.spring.is_some() => {
                    let damping = row.spring.map_or(0.0, |spring| spring.damping);
                    let mean = 0.5 * (row.velocity + row.drift + next[i]);
                    let taken = 0.0 - damping * impulses.h * mean * mean;
                    // The work of a moving support.
                    let moved = 0.0 - impulse * row.drift;
                    self.damper += taken;
                    self.motor += moved;
                    self.spring += work - taken - moved;
                }
                Bounds::Bilateral => self.constraint += work - bias,
                Bounds::Unilateral => self.contact += work - bias,
            }
            if matches!(row.bounds, Bounds::Bilateral | Bounds::Unilateral) && row.spring.is_none()
            {
                let is_gap = row.bounds == Bounds::Unilateral && row.c > 0.0;
                match impulses.bounces(i) {
                    true => self.restitution += bias,
                    false if is_gap => self.gap += bias,
                    false => self.bias += bias,
                }
            }
        }
    }

    /// The work of gravity along the mean velocity, of external forces and of the gyroscopic
    /// torque.
    fn add_forces(&mut self, scene: &Scene, impulses: &Impulses) {
        let Impulses { assembly, h, .. } = impulses;
        for block in &assembly.blocks {
            let (u, next) = (block.gather(&assembly.u), block.gather(&impulses.next));
            let (torque, mean) = (angular(&block.gather(&assembly.force)), 0.5 * (u + next));
            let wrench = scene.bodies[block.body].wrench(block.pose());
            self.external += h * wrench.dot(&mean);
            self.gyroscopic += h * (torque - angular(&wrench)).dot(&angular(&mean));
            self.integrator += h * block.mass * scene.gravity.dot(&linear(&mean));
        }
    }

    /// Moves the bodies with their velocities: the path along which gravity is the potential's, and
    /// the inertia that turns.
    fn advance(
        &mut self,
        scene: &Scene,
        assembly: Option<&Assembly>,
        states: &mut [State],
        h: f64,
    ) {
        let stored = elastic(scene, states);
        let alone =
            |(body, state): (&Body, &State)| scene.step.gyroscopic().advanced(&body.mass, state, h);
        let moved: Vec<State> = match assembly {
            Some(assembly) => assembly.advanced(states, h),
            None => scene.bodies.iter().zip(&*states).map(alone).collect(),
        };
        for (body, (state, moved)) in states.iter_mut().zip(moved).enumerate() {
            self.integrator -= h * scene.bodies[body].mass.mass() * scene.gravity.dot(&state.v);
            self.gyroscopic += spin(scene, body, &moved) - spin(scene, body, state);
            *state = moved;
        }
        self.spring += elastic(scene, states) - stored;
    }
}

impl std::ops::Add for Ledger {
    type Output = Ledger;

    fn add(self, other: Ledger) -> Ledger {
        Ledger {
            change: self.change + other.change,
            constraint: self.constraint + other.constraint,
            contact: self.contact + other.contact,
            restitution: self.restitution + other.restitution,
            gap: self.gap + other.gap,
            bias: self.bias + other.bias,
            friction: self.friction + other.friction,
            motor: self.motor + other.motor,
            external: self.external + other.external,
            damper: self.damper + other.damper,
            spring: self.spring + other.spring,
            gyroscopic: self.gyroscopic + other.gyroscopic,
            integrator: self.integrator + other.integrator,
            correction: self.correction + other.correction,
            scale: self.scale.max(other.scale),
        }
    }
}

/// What a body that is put elsewhere gains (J).
fn shift(scene: &Scene, body: usize, from: &State, to: &State, by: &Vector3<f64>) -> f64 {
    let lifted = 0.0 - scene.bodies[body].mass.mass() * scene.gravity.dot(by);
    lifted + spin(scene, body, to) - spin(scene, body, from)
}

fn spin(scene: &Scene, body: usize, state: &State) -> f64 {
    scene.bodies[body].mass.spin_energy(state)
}

fn scene_kinetic(scene: &Scene, states: &[State]) -> f64 {
    scene.bodies.iter().zip(states).map(|(body, state)| body.mass.kinetic_energy(state)).sum()
}

fn potential(scene: &Scene, states: &[State]) -> f64 {
    let height = |p: &Vector3<f64>| 0.0 - scene.gravity.dot(p);
    let bodies = scene.bodies.iter().zip(states);
    bodies.map(|(body, state)| body.mass.mass() * height(&state.pose.p)).sum()
}

fn energy(scene: &Scene, states: &[State]) -> f64 {
    scene_kinetic(scene, states) + potential(scene, states) + elastic(scene, states)
}

/// The energies that a change is a difference of, without regard to sign (J).
fn size(scene: &Scene, states: &[State]) -> f64 {
    let bodies = scene.bodies.iter().zip(states);
    let heights =
        bodies.map(|(body, state)| body.mass.mass() * scene.gravity.dot(&state.pose.p).abs());
    scene_kinetic(scene, states) + heights.sum::<f64>() + elastic(scene, states)
}
