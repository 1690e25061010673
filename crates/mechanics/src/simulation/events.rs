//! The impulses and moves of a step, as recorded by its scheme.
//!
//! A step is a sequence of impulses at fixed poses and of moves at fixed velocities. From them the
//! work is computed independently of the scheme and compared with the states after the step: see
//! [`Ledger`](super::Ledger).

use std::collections::BTreeMap;

use nalgebra::Vector6;

use super::Solve;
use crate::assembly::{Assembly, Row, RowId};
use crate::constraint::Kind;
use crate::formulation::{Problem, Stage};
use crate::scene::Scene;

/// Something that changed velocities or positions.
#[derive(Debug, Clone)]
pub enum StepEvent {
    /// The impulses of the step's solve of this number, and of the forces of its duration.
    Answer(usize),
    /// Impulses of a scheme that poses no problem.
    VelocityUpdate(VelocityUpdate),
    /// All bodies moved with their velocities for so long (s): s ← s + h S u.
    Advance(f64),
    /// A body was put elsewhere and kept its velocity: s ← s + S d.
    Shift {
        /// The number of the body.
        body: usize,
        /// d = [Δp; Δθ] (m, rad).
        by: Vector6<f64>,
    },
}

/// Impulses at fixed poses: u⁺ = u + M⁻¹(h F + Jᵀ X).
#[derive(Debug, Clone)]
pub struct VelocityUpdate {
    /// u, M, F, and J of each row.
    pub assembly: Assembly,
    /// For how long the forces F acted (s).
    pub h: f64,
    /// X (N s, N m s), a row each.
    pub impulses: Vec<f64>,
    /// What of J u⁺ (m/s), with its sign turned, a row owes to the feedback of errors or to its
    /// bounce.
    pub feedback: Vec<f64>,
    /// Whether the feedback of contacts is a bounce, of all that have an impulse.
    pub bounces: bool,
}

/// The impulse of each row, summed over all pushes; a row is as it was last.
pub(super) fn pushed(events: &[StepEvent]) -> Vec<(Row, f64)> {
    let mut sums: BTreeMap<RowId, (Row, f64)> = BTreeMap::new();
    for event in events {
        let StepEvent::VelocityUpdate(VelocityUpdate { assembly, impulses, .. }) = event else {
            continue;
        };
        for (row, impulse) in assembly.rows.iter().zip(impulses) {
            let sum = sums.entry(row.id).or_insert_with(|| (row.clone(), 0.0));
            *sum = (row.clone(), sum.1 + impulse);
        }
    }
    sums.into_values().collect()
}

/// Impulses at fixed poses, whoever wrote them down.
pub(super) struct Impulses<'a> {
    pub assembly: &'a Assembly,
    pub h: f64,
    pub x: Vec<f64>,
    pub feedback: Vec<f64>,
    /// u⁺ = u + M⁻¹(h F + Jᵀ X).
    pub next: Vec<f64>,
    /// Which rows bounced.
    bounced: Vec<bool>,
}

impl<'a> Impulses<'a> {
    /// Those of an act, if it is one of impulses.
    pub fn of(scene: &Scene, event: &'a StepEvent, solves: &'a [Solve]) -> Option<Self> {
        match event {
            StepEvent::Answer(k) => Some(Impulses::answered(scene, &solves[*k])),
            StepEvent::VelocityUpdate(push) => Some(Impulses::pushed(push)),
            StepEvent::Advance(_) | StepEvent::Shift { .. } => None,
        }
    }

    fn answered(scene: &Scene, Solve { problem, solution, .. }: &'a Solve) -> Self {
        let x = problem.efforts(&solution.x);
        let bounced = |row: &Row| {
            problem.stage == Stage::Restitution
                && row.kind == Kind::Normal
                && scene.contact.bounces(-row.velocity)
        };
        Impulses {
            assembly: &problem.assembly,
            h: problem.dt,
            x: x.into_iter().map(|x| impulse(problem, x)).collect(),
            feedback: (0..problem.bias.len()).map(|i| feedback(problem, i)).collect(),
            next: problem.next_velocity(&solution.x, problem.dt),
            bounced: problem.assembly.rows.iter().map(bounced).collect(),
        }
    }

    fn pushed(push: &'a VelocityUpdate) -> Self {
        let VelocityUpdate { assembly, h, impulses, feedback, bounces } = push;
        let pull = assembly.pull_back(impulses);
        let total: Vec<f64> = assembly.force.iter().zip(pull).map(|(f, p)| h * f + p).collect();
        let change = assembly.accelerate(&total);
        Impulses {
            assembly,
            h: *h,
            x: impulses.clone(),
            feedback: feedback.clone(),
            next: assembly.u.iter().zip(change).map(|(u, change)| u + change).collect(),
            bounced: assembly.rows.iter().map(|row| *bounces && row.kind == Kind::Normal).collect(),
        }
    }

    /// Whether the feedback of a row is a bounce.
    pub fn bounces(&self, row: usize) -> bool {
        self.bounced[row]
    }
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
        Stage::Velocity | Stage::Impact | Stage::Restitution => {
            problem.bias[i] - problem.assembly.rows[i].drift
        }
    }
}
