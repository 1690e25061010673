//! The rows of all constraints and contacts, each with an identifier that persists between steps.

use std::fmt;

use nalgebra::{Vector3, Vector6};

use super::{Block, Undefined};
use crate::body::{Shape, State, linear};
use crate::constraint::{self, Bodies, Bounds, Constraint, Kind, Spring};
use crate::scene::{ContactId, DetectedContact, Resting, Scene};

/// Which inequalities (contacts and limits) are included; equations always are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ConstraintFilter<'a> {
    /// Contacts with a gap up to the search margin, and all limits: for the velocity level, where
    /// gaps may close within the step.
    Near,
    /// Those that [touch](crate::scene::Resting): for impacts.
    Touching,
    /// Those that touch and separate no faster than a resting contact may, or than α pushes an
    /// overlap apart: for the acceleration level.
    Resting,
    /// Only those with these identifiers, whatever their gap: within a step whose rows have been
    /// chosen.
    Only(&'a [RowId]),
}

/// The origin of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Source {
    /// The constraint with this index in the scene.
    Constraint(usize),
    /// A contact.
    Contact(ContactId),
}

/// A row's identifier: the same from step to step, so that its x can start the next solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RowId {
    /// The constraint or contact.
    pub source: Source,
    /// The index of the row; of a contact 0 is normal, 1 and 2 are tangential.
    pub component: usize,
}

/// A row of J with its data.
#[derive(Debug, Clone)]
pub struct Row {
    /// Its identifier.
    pub id: RowId,
    /// What it constrains.
    pub kind: Kind,
    /// The indices of its bodies; `None` is the world. Those of a contact come in the order of the
    /// scene, regardless of which one defines the normal; those of a constraint as the scene lists
    /// them.
    pub bodies: Bodies,
    /// c (m or rad).
    pub c: f64,
    /// J u at the current velocities (m/s or rad/s).
    pub velocity: f64,
    /// The contribution to J u of bodies without columns: a fixed body may have a prescribed
    /// motion.
    pub drift: f64,
    /// J'u (m/s² or rad/s²).
    pub velocity_product: f64,
    /// The target of J u (m/s or rad/s).
    pub speed: f64,
    /// Its spring and damper, if it is compliant.
    pub spring: Option<Spring>,
    /// The bounds of its force; a friction row's `normal` is an index into the rows of the
    /// assembly.
    pub bounds: Bounds,
    parts: [Option<Part>; 2],
}

/// The name of the fixed world in joints.
const WORLD: &str = "world";

/// The part of a row of J for one moving body.
#[derive(Debug, Clone, Copy)]
pub struct Part {
    /// The body's block.
    pub block: usize,
    /// Its entries for [v; ω]; a point mass uses only the first three.
    pub jacobian: Vector6<f64>,
}

impl Row {
    /// The parts of moving bodies: one or two.
    pub fn parts(&self) -> impl Iterator<Item = &Part> {
        self.parts.iter().flatten()
    }

    /// The force (world) on each of its two bodies for x = 1, fixed ones included; the two are
    /// opposite.
    pub(crate) fn pushes(&self) -> [Vector3<f64>; 2] {
        let [first, second] = self.parts.map(|part| part.map(|part| linear(&part.jacobian)));
        let other = |push: Option<Vector3<f64>>| push.map_or_else(Vector3::zeros, |push| -push);
        [first.unwrap_or_else(|| other(second)), second.unwrap_or_else(|| other(first))]
    }

    /// The direction (world) in which a positive x pushes the second of [`bodies`](Row::bodies);
    /// `None` for rows that only exert a torque.
    pub fn direction(&self) -> Option<Vector3<f64>> {
        let [first, second] = self.parts.map(|part| part.map(|part| linear(&part.jacobian)));
        second.or(first.map(|pull| -pull)).filter(|push| push.norm() > 0.0)
    }

    /// The moving bodies with their entries of J, for [v; ω].
    pub fn movers(&self) -> impl Iterator<Item = (usize, Vector6<f64>)> {
        let pairs = self.bodies.into_iter().zip(self.parts);
        pairs.filter_map(|(body, part)| Some((body?, part?.jacobian)))
    }

    /// J u (m/s or rad/s) with the velocities of these states; J is not updated.
    pub(crate) fn velocity_with(&self, states: &[State]) -> f64 {
        let own = self.movers().map(|(body, jacobian)| jacobian.dot(&states[body].velocity()));
        own.sum::<f64>() + self.drift
    }

    /// Whether it only keeps bodies from rotating: a row of a hinge or a weld.
    pub(crate) fn holds_axis(&self) -> bool {
        let only_turns = |part: &Part| linear(&part.jacobian) == Vector3::zeros();
        self.bounds == Bounds::Bilateral && self.spring.is_none() && self.parts().all(only_turns)
    }

    /// Whether its force is limited, by its bounds or by compliance, so that it does not take part
    /// in an impact.
    pub(crate) fn is_force_limited(&self) -> bool {
        self.spring.is_some() || matches!(self.bounds, Bounds::Effort(_))
    }

    /// A unique text for the row, such as `normal ground box1 0 at face 0 on vertex 3`. The
    /// features are omitted if two bodies touch at only one point. Body names with blanks, and the
    /// name `world`, are quoted.
    pub fn label(&self, scene: &Scene) -> String {
        let name = |body: Option<usize>| match body.map(|k| scene.bodies[k].name.as_str()) {
            None => WORLD.to_string(),
            Some(name) if name == WORLD || name.contains([' ', '"']) => format!("{name:?}"),
            Some(name) => name.to_string(),
        };
        let [first, second] = self.bodies.map(name);
        let row = format!("{} {first} {second} {}", self.kind.name(), self.id.component);
        match self.id.source {
            Source::Contact(id) if !touch_at_one_point(scene, id.bodies) => {
                format!("{row} at {id}")
            }
            Source::Constraint(k) if shares_its_bodies(scene, k) => {
                format!("{row} of {}", self.id.source)
            }
            Source::Contact(_) | Source::Constraint(_) => row,
        }
    }

    /// The names of its two bodies; the world's is `world`.
    pub fn names<'a>(&self, scene: &'a Scene) -> [&'a str; 2] {
        self.bodies.map(|body| body.map_or(WORLD, |k| scene.bodies[k].name.as_str()))
    }

    /// The row with its two bodies exchanged.
    fn turned(self) -> Self {
        let ([first, second], [own, other]) = (self.bodies, self.parts);
        Row { bodies: [second, first], parts: [other, own], ..self }
    }
}

/// Whether these bodies have at most one contact: points, balls and a plane.
fn touch_at_one_point(scene: &Scene, bodies: [usize; 2]) -> bool {
    bodies.iter().all(|&body| {
        matches!(
            scene.bodies[body].shape,
            Shape::Point | Shape::Sphere { .. } | Shape::Plane { .. }
        )
    })
}

/// Whether another constraint of the scene joins the same two bodies.
fn shares_its_bodies(scene: &Scene, constraint: usize) -> bool {
    let pair = |k: usize| {
        let [first, second] = scene.constraints[k].bodies();
        [first.min(second), first.max(second)]
    };
    let own = pair(constraint);
    (0..scene.constraints.len()).any(|k| k != constraint && pair(k) == own)
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Source::Constraint(k) => write!(f, "constraints[{k}]"),
            Source::Contact(id) => {
                write!(f, "contact of bodies[{}] and bodies[{}]", id.bodies[0], id.bodies[1])
            }
        }
    }
}

pub(super) fn rows(
    scene: &Scene,
    states: &[State],
    contacts: &[DetectedContact],
    entering: ConstraintFilter,
    blocks: &[Block],
) -> Result<Vec<Row>, Undefined> {
    let mut block_of = vec![None; scene.bodies.len()];
    for (k, block) in blocks.iter().enumerate() {
        block_of[block.body] = Some(k);
    }
    let state = |body: Option<usize>| body.map_or(&State::WORLD, |k| &states[k]);
    let resting = scene.resting();
    let mut rows = Vec::new();
    let mut add = |source: Source, constraint: &dyn Constraint, margin: f64| {
        let bodies = constraint.bodies();
        let pair = bodies.map(state);
        let own = constraint.rows(pair).map_err(|cause| Undefined { source, bodies, cause })?;
        let blocks = bodies.map(|body| body.and_then(|k| block_of[k]));
        let mut places = vec![None; own.len()];
        for (component, row) in own.iter().enumerate() {
            let wanted = match row.bounds {
                Bounds::Unilateral => match entering {
                    // Values that are not finite are reported later.
                    ConstraintFilter::Near => row.c <= margin || row.c.is_nan(),
                    ConstraintFilter::Touching => row.c <= resting.gap,
                    ConstraintFilter::Resting => rests(row, pair, resting, scene.step.alpha),
                    ConstraintFilter::Only(chosen) => chosen.contains(&RowId { source, component }),
                },
                Bounds::Friction { normal, .. } => places[normal].is_some(),
                Bounds::Bilateral | Bounds::Effort(_) => true,
            };
            if wanted {
                places[component] = Some(rows.len());
                let id = RowId { source, component };
                let row = placed(row, id, bodies, blocks, pair, &places);
                // A contact whose normal belongs to the second body of its pair has its bodies in
                // reverse order.
                let is_turned =
                    matches!(source, Source::Contact(id) if bodies != id.bodies.map(Some));
                rows.push(if is_turned { row.turned() } else { row });
            }
        }
        Ok(())
    };
    for (k, constraint) in scene.constraints.iter().enumerate() {
        add(Source::Constraint(k), constraint.as_ref(), f64::INFINITY)?;
    }
    for found in contacts {
        add(Source::Contact(found.id), &found.contact, found.margin)?;
    }
    Ok(rows)
}

/// Whether an inequality touches and separates no faster than a resting one may, or than α (1/s)
/// pushes an overlap apart.
fn rests(row: &constraint::Row, states: [&State; 2], resting: Resting, alpha: f64) -> bool {
    row.c <= resting.gap && rate(row, states) <= resting.speed + alpha * (-row.c).max(0.0)
}

/// J u of a constraint's row.
fn rate(row: &constraint::Row, states: [&State; 2]) -> f64 {
    let [j0, j1] = &row.jacobian;
    j0.dot(&states[0].velocity()) + j1.dot(&states[1].velocity())
}

/// A row with its place in the assembly; `places` are the places of the constraint's earlier rows.
fn placed(
    row: &constraint::Row,
    id: RowId,
    bodies: Bodies,
    blocks: [Option<usize>; 2],
    states: [&State; 2],
    places: &[Option<usize>],
) -> Row {
    let bounds = match row.bounds {
        Bounds::Friction { normal, mu } => {
            Bounds::Friction { normal: places[normal].unwrap_or_default(), mu }
        }
        own => own,
    };
    let part = |k: usize| blocks[k].map(|block| Part { block, jacobian: row.jacobian[k] });
    let driven = [0, 1].into_iter().filter(|&k| blocks[k].is_none());
    let drift = driven.map(|k| row.jacobian[k].dot(&states[k].velocity())).sum();
    Row {
        id,
        kind: row.kind,
        bodies,
        c: row.c,
        velocity: rate(row, states),
        drift,
        velocity_product: row.velocity_product,
        speed: row.speed,
        spring: row.spring,
        bounds,
        parts: [part(0), part(1)],
    }
}
