//! The rows of a step, straight from constraints and contacts.

use super::masses::Masses;
use crate::assembly::{Source, Undefined};
use crate::body::State;
use crate::constraint::{self, Bounds, Constraint, Kind};
use crate::formulation::Bias;
use crate::scene::{ContactId, DetectedContact, Scene};
use crate::simulation::Cause;
use crate::simulation::laws::excess_of;
use lcplab_lcp::error::Error;
use lcplab_solver::Status;
use lcplab_solver::kernel::impulses::{Row, RowTarget, System};

/// All rows: those of the constraints, then those of the contacts.
#[derive(Default)]
pub(super) struct Rows {
    /// Ĵ, b and the bounds.
    pub system: System,
    /// The contacts' names and places, ascending by their bodies.
    pub contacts: Vec<Place>,
    /// The normal rows that approach fast enough to bounce, with J u⁻ (m/s) and e.
    pub approaching: Vec<(usize, f64, f64)>,
    /// Those of one constraint.
    own: Vec<constraint::Row>,
}

/// Where the rows of a contact stand.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub id: ContactId,
    /// The first of them.
    pub first: usize,
    /// 1, or with friction 3.
    pub rows: usize,
}

impl Rows {
    /// The rows at these states; equations, limits, and contacts within the margin.
    pub fn fill(
        &mut self,
        scene: &Scene,
        states: &[State],
        found: &[DetectedContact],
        masses: &Masses,
    ) -> Result<(), Cause> {
        self.system.clear(masses.len());
        self.contacts.clear();
        self.approaching.clear();
        let asking = RowRequest::of(scene);
        for (k, constraint) in scene.constraints.iter().enumerate() {
            self.add(Source::Constraint(k), constraint.as_ref(), states, masses, &asking)?;
        }
        for found in found {
            let first = self.system.rows().len();
            self.add(Source::Contact(found.id), &found.contact, states, masses, &asking)?;
            self.contacts.push(Place { id: found.id, first, rows: self.own.len() });
        }
        Ok(())
    }

    fn add(
        &mut self,
        source: Source,
        constraint: &dyn Constraint,
        states: &[State],
        masses: &Masses,
        asking: &RowRequest,
    ) -> Result<(), Cause> {
        let bodies = constraint.bodies();
        let pair = bodies.map(|body| body.map_or(&State::WORLD, |k| &states[k]));
        let places = bodies.map(|body| masses.place(body));
        let first = self.system.rows().len();
        if places == [None; 2] {
            return Err(refused(asking, source, &Status::ZeroDiagonal { row: first }));
        }
        self.own.clear();
        constraint
            .add_rows(pair, &mut self.own)
            .map_err(|cause| Cause::Undefined(Undefined { source, bodies, cause }))?;
        for (k, row) in self.own.iter().enumerate() {
            let scaled = scaled(row, places, masses);
            let e = if row.kind == Kind::Normal { asking.scene.restitution(bodies) } else { 0.0 };
            if e > 0.0 {
                let speed = scaled.rate(&masses.before);
                if asking.scene.contact.bounces(-speed) {
                    self.approaching.push((first + k, speed, e));
                }
            }
            let pushed = self.system.push(scaled, asking.aim(row, first));
            pushed.map_err(|status| refused(asking, source, &status))?;
        }
        Ok(())
    }

    /// How far friction is outside Coulomb's cone, as in
    /// [`LawErrors`](crate::simulation::LawErrors).
    pub fn cone_excess(&self, x: &[f64]) -> f64 {
        let with_friction = self.contacts.iter().filter(|place| place.rows == 3);
        let sizes = with_friction.map(|&Place { first, .. }| {
            let most = self.system.aims()[first + 1].hi * x[first];
            [x[first + 1].hypot(x[first + 2]), most]
        });
        excess_of(sizes, 0.0)
    }
}

fn refused(asking: &RowRequest, source: Source, status: &Status) -> Cause {
    Cause::Problem(Error::invalid(asking.name, source.to_string(), status.to_string()))
}

/// A row of Ĵ, the lower body first. The part of a body that does not move drops out.
fn scaled(row: &constraint::Row, places: [Option<usize>; 2], masses: &Masses) -> Row {
    let part = |k: usize, place: usize| masses.scaled_row(place, &row.jacobian[k]);
    match places {
        [Some(p), Some(q)] if p <= q => Row { bodies: [p, q], jacobian: [part(0, p), part(1, q)] },
        [Some(p), Some(q)] => Row { bodies: [q, p], jacobian: [part(1, q), part(0, p)] },
        [Some(p), None] => Row { bodies: [p; 2], jacobian: [part(0, p), [0.0; 6]] },
        [None, Some(q)] => Row { bodies: [q; 2], jacobian: [part(1, q), [0.0; 6]] },
        [None, None] => Row { bodies: [0; 2], jacobian: [[0.0; 6]; 2] },
    }
}

/// What a scene asks of rows.
struct RowRequest<'a> {
    name: &'a str,
    dt: f64,
    bias: Bias,
    scene: &'a Scene,
}

impl<'a> RowRequest<'a> {
    fn of(scene: &'a Scene) -> Self {
        RowRequest {
            name: &scene.name,
            dt: scene.step.dt,
            bias: Bias::new(scene, scene.step.baumgarte),
            scene,
        }
    }

    /// What it asks of a row, of a constraint whose first row stands there.
    fn aim(&self, row: &constraint::Row, first: usize) -> RowTarget {
        let b = self.bias.of(row.kind, row.bounds, row.spring, row.c, row.speed);
        let ((lo, hi), follows) = match row.bounds {
            Bounds::Friction { normal, mu } => ((-mu, mu), Some(first + normal)),
            Bounds::Effort(effort) => ((-effort * self.dt, effort * self.dt), None),
            bounds => (bounds.interval(), None),
        };
        RowTarget { b, lo, hi, follows }
    }
}
