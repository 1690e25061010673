//! The impulses of a step: from those of the step before, by sweeps, and again if something
//! bounces.
//!
//! A constraint's rows stand where they stood before. Contacts are known by their names, and come
//! in the order of their bodies in every step: the old ones are found by going through both lists
//! side by side.

use super::masses::Masses;
use super::rows::{Place, Rows};
use super::sweeper::Sweeper;
use crate::formulation::has_closed;
use crate::scene::{Persistence, Scene};
use lcplab_solver::Status;

/// The impulses of the last step, and whose they are.
#[derive(Default)]
pub(super) struct Impulses {
    contacts: Vec<Place>,
    first: Answer,
    /// With what bounced; empty if nothing did.
    bounced: Answer,
}

/// The x of a solve, one entry a row, and that of the step before.
#[derive(Default)]
struct Answer {
    x: Vec<f64>,
    before: Vec<f64>,
    /// The x before the sweeps of this step.
    start: Vec<f64>,
}

impl Impulses {
    /// The x that moved the bodies.
    pub fn x(&self) -> &[f64] {
        if self.bounced.x.is_empty() { &self.first.x } else { &self.bounced.x }
    }

    /// The x of the first solve, and of the one with bounces: what each started from, and its
    /// answer.
    pub fn solves(&self) -> [[&[f64]; 2]; 2] {
        [&self.first, &self.bounced].map(|answer| [&*answer.start, &*answer.x])
    }

    /// Nothing is known of a step before; the memory stays.
    pub fn forget(&mut self) {
        self.contacts.clear();
        self.first.x.clear();
        self.bounced.x.clear();
    }

    /// Sweeps over the rows, and again for J u⁺ = −e J u⁻ in those that closed and approached fast.
    pub fn solve(
        &mut self,
        scene: &Scene,
        rows: &mut Rows,
        masses: &Masses,
        sweeper: &mut Sweeper,
        sweeps: usize,
    ) -> Result<(), Status> {
        let Impulses { contacts, first, bounced } = self;
        first.recall(contacts, rows, scene);
        bounced.recall(contacts, rows, scene);
        contacts.clone_from(&rows.contacts);
        sweeper.sweep(&rows.system, &mut first.x, &masses.free, sweeps)?;
        let mut bounces = false;
        for &(i, speed, e) in &rows.approaching {
            let w = rows.system.rows()[i].rate(&sweeper.v) + rows.system.aims_mut()[i].b;
            if has_closed(first.x[i], w, speed) {
                rows.system.aims_mut()[i].b = e * speed;
                bounces = true;
            }
        }
        if bounces {
            return sweeper.sweep(&rows.system, &mut bounced.x, &masses.free, sweeps);
        }
        bounced.x.clear();
        Ok(())
    }
}

impl Answer {
    /// The x that rows of the same name had, 0 for new ones, and for all where there was no answer.
    fn recall(&mut self, old: &[Place], rows: &Rows, scene: &Scene) {
        self.find(old, rows, scene);
        self.start.clone_from(&self.x);
    }

    fn find(&mut self, old: &[Place], rows: &Rows, scene: &Scene) {
        let Answer { x, before, .. } = self;
        std::mem::swap(x, before);
        x.clear();
        x.resize(rows.system.rows().len(), 0.0);
        if before.is_empty() || scene.contact.persistence == Persistence::None {
            return;
        }
        let joints = rows.contacts.first().map_or(x.len(), |contact| contact.first);
        x.iter_mut().zip(&*before).take(joints).for_each(|(new, old)| *new = *old);
        let mut old = old;
        for new in &rows.contacts {
            let passed = old.iter().take_while(|o| o.id.bodies < new.id.bodies).count();
            old = &old[passed..];
            let mut pair = old.iter().take_while(|o| o.id.bodies == new.id.bodies);
            if let Some(same) = pair.find(|o| o.id == new.id) {
                let count = new.rows.min(same.rows);
                x[new.first..new.first + count]
                    .copy_from_slice(&before[same.first..same.first + count]);
            }
        }
    }
}
