//! Where a step's energy went: every impulse's work, and what the step itself adds or loses.
//!
//! An impulse P takes the velocities from u to u⁺ at fixed poses, so its work is exactly
//!
//! ```text
//! ½ u⁺ᵀM u⁺ − ½ uᵀM u = ½ (u + u⁺)·P,      P = dt F + Jᵀ X,   X = x, or dt x for forces
//! ```
//!
//! which splits into the work ½ X_i (J u + J u⁺)_i of each row. Where the row fulfils
//! w = J u⁺ + bias, the part −½ X_i bias_i is the bias's doing, or the bounce's. Then the bodies move
//! by dt u⁺ while gravity has worked along ½ dt (u + u⁺), which leaves −½ dt m g·(v⁺ − v), and the
//! inertia turns with the body, which leaves ½ ω⁺·(I⁺ − I) ω⁺. What is still missing is a row of its
//! own: rounding, unless something is forgotten.

use nalgebra::Vector3;

use super::Solve;
use crate::assembly::{Assembly, Row};
use crate::body::{State, angular, linear};
use crate::constraint::{Bounds, Kind};
use crate::formulation::{Problem, Stage};
use crate::scene::{Formulation, Integrator, Scene};

/// The change of kinetic plus potential energy in a step (J), by cause. Gains are positive.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Ledger {
    /// The change itself, measured from the states.
    pub change: f64,
    /// Rigid equations: 0 where J stays, a loss where the velocities no longer fit it.
    pub constraint: f64,
    /// Contacts and limits: the loss of a blow.
    pub contact: f64,
    /// What bounces give back.
    pub restitution: f64,
    /// Feedback of position errors and gaps.
    pub bias: f64,
    /// Dry friction: never a gain.
    pub friction: f64,
    /// Motors.
    pub motor: f64,
    /// The constant forces on bodies, gravity apart.
    pub external: f64,
    /// Springs; what they store is not part of the energy.
    pub spring: f64,
    /// The gyroscopic torque, and the inertia turning with the body: together 0 in the limit.
    pub gyroscopic: f64,
    /// Gravity along the path of the step against gravity along the mean velocity.
    pub integrator: f64,
    /// Positions and velocities that were changed otherwise than by impulses: the corrections of split
    /// impulse and NGS; the whole change in families without LCPs and by integrators with stages.
    pub correction: f64,
}

impl Ledger {
    /// The accounts with their names, in the order of tables.
    pub fn accounts(&self) -> [(&'static str, f64); 11] {
        [
            ("constraint", self.constraint),
            ("contact", self.contact),
            ("restitution", self.restitution),
            ("bias", self.bias),
            ("friction", self.friction),
            ("motor", self.motor),
            ("external", self.external),
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

    /// The accounts of a step from its states before and after and the solves between.
    pub(super) fn of(scene: &Scene, before: &[State], solves: &[Solve], after: &[State]) -> Self {
        let mut ledger = Ledger {
            change: energy(scene, after) - energy(scene, before),
            correction: potential(scene, after) - potential(scene, before),
            ..Ledger::default()
        };
        if !is_impulsive(scene) {
            return Ledger { correction: ledger.change, ..ledger };
        }
        let mut deciding = deciding(solves).peekable();
        while let Some(Solve { problem, solution, .. }) = deciding.next() {
            let u_next = problem.next_velocity(&solution.x, problem.dt);
            ledger.add_rows(scene, problem, &problem.efforts(&solution.x), &u_next);
            ledger.add_forces(scene, problem, &u_next);
            let (assembly, own) = (&problem.assembly, kinetic(&problem.assembly, &u_next));
            let then = match deciding.peek() {
                Some(next) => kinetic(&next.problem.assembly, &u_next),
                None => turned(scene, assembly, &u_next, after),
            };
            ledger.gyroscopic += then - own;
            ledger.correction += match deciding.peek() {
                Some(next) => kinetic(&next.problem.assembly, &next.problem.assembly.u) - then,
                None => scene_kinetic(scene, after) - then,
            };
        }
        ledger
    }

    fn add_rows(&mut self, scene: &Scene, problem: &Problem, x: &[f64], u_next: &[f64]) {
        let next = problem.assembly.push_forward(u_next);
        for (i, row) in problem.assembly.rows.iter().enumerate() {
            let impulse = impulse(problem, x[i]);
            let work = 0.5 * impulse * (row.velocity + next[i]);
            let bias = -0.5 * impulse * feedback(problem, i);
            match row.bounds {
                Bounds::Friction { .. } => self.friction += work,
                Bounds::Effort(_) => self.motor += work,
                _ if row.spring.is_some() => self.spring += work,
                Bounds::Bilateral => self.constraint += work - bias,
                Bounds::Unilateral => self.contact += work - bias,
            }
            if matches!(row.bounds, Bounds::Bilateral | Bounds::Unilateral) && row.spring.is_none()
            {
                match bounces(scene, problem, row) {
                    true => self.restitution += bias,
                    false => self.bias += bias,
                }
            }
        }
    }

    /// Gravity, external forces and the gyroscopic torque over the step; at the start `correction` holds the whole
    /// change of potential energy, from which what the velocities u⁺ explain is taken.
    fn add_forces(&mut self, scene: &Scene, problem: &Problem, u_next: &[f64]) {
        let Problem { assembly, dt, .. } = problem;
        for block in &assembly.blocks {
            let (u, next) = (block.gather(&assembly.u), block.gather(u_next));
            let weight = block.mass * scene.gravity;
            let torque = angular(&block.gather(&assembly.force));
            let mean = 0.5 * (u + next);
            self.external += dt * scene.bodies[block.body].force.dot(&linear(&mean));
            self.gyroscopic += dt * torque.dot(&angular(&mean));
            self.integrator -= dt * weight.dot(&(linear(&next) - linear(&mean)));
            self.correction += dt * weight.dot(&linear(&next));
        }
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
            bias: self.bias + other.bias,
            friction: self.friction + other.friction,
            motor: self.motor + other.motor,
            external: self.external + other.external,
            spring: self.spring + other.spring,
            gyroscopic: self.gyroscopic + other.gyroscopic,
            integrator: self.integrator + other.integrator,
            correction: self.correction + other.correction,
        }
    }
}

/// Whether the solves of a step are all that changes velocities, each one an impulse: not so in
/// families without LCPs, and where an integrator has stages.
fn is_impulsive(scene: &Scene) -> bool {
    match scene.step.formulation {
        Formulation::Acceleration => scene.step.integrator == Integrator::SemiImplicitEuler,
        Formulation::SequentialImpulses => true,
        family => family.solves_lcps(),
    }
}

/// The solves whose answers counted: a bounce replaces the solve before it, and corrections of
/// positions are no impulses.
fn deciding(solves: &[Solve]) -> impl Iterator<Item = &Solve> {
    let replaced =
        |k: usize| solves.get(k + 1).is_some_and(|next| next.problem.stage == Stage::Restitution);
    let counts =
        move |&(k, solve): &(usize, &Solve)| !replaced(k) && solve.problem.stage != Stage::Position;
    solves.iter().enumerate().filter(counts).map(|(_, solve)| solve)
}

/// X (N s) of an x.
fn impulse(problem: &Problem, x: f64) -> f64 {
    match problem.stage {
        Stage::Acceleration => problem.dt * x,
        Stage::Position => 0.0,
        Stage::Velocity | Stage::Impact | Stage::Restitution => x,
    }
}

/// The part of J u⁺ (m/s), with its sign turned, that a row owes to feedback.
fn feedback(problem: &Problem, i: usize) -> f64 {
    match problem.stage {
        Stage::Acceleration => {
            problem.dt * (problem.bias[i] - problem.assembly.rows[i].velocity_product)
        }
        Stage::Position => 0.0,
        Stage::Velocity | Stage::Impact | Stage::Restitution => problem.bias[i],
    }
}

/// Whether a row's bias is a bounce.
fn bounces(scene: &Scene, problem: &Problem, row: &Row) -> bool {
    problem.stage == Stage::Restitution
        && row.kind == Kind::Normal
        && row.velocity < -scene.contact.bounce_speed
}

/// ½ uᵀM u (J) at an assembly's poses.
fn kinetic(assembly: &Assembly, u: &[f64]) -> f64 {
    let own = |block: &crate::assembly::Block| {
        let u = block.gather(u);
        let (v, omega) = (linear(&u), angular(&u));
        0.5 * (block.mass * v.norm_squared() + omega.dot(&(block.inertia * omega)))
    };
    assembly.blocks.iter().map(own).sum()
}

/// ½ uᵀM u (J) at the poses of other states.
fn turned(scene: &Scene, assembly: &Assembly, u: &[f64], states: &[State]) -> f64 {
    scene_kinetic(scene, &assembly.with_velocities(states, u))
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
    scene_kinetic(scene, states) + potential(scene, states)
}
