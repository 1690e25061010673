//! Where within a step a body first arrives at another one.
//!
//! The [path](crate::simulation::path) is sampled so often that no body moves by more than half
//! of the thinnest one in between; where a contact that is not at rest has become an overlap, the
//! instant is found by bisection (Baraff 1989).

use crate::assembly::{RowId, Source};
use crate::body::State;
use crate::constraint::{Bounds, Row};
use crate::scene::{Detector, Scene};
use crate::simulation::path;

/// Halvings until the instant is known to the last digits of a step.
const HALVINGS: usize = 48;
/// An overlap below this part of the slop is rounding.
const ROUNDING: f64 = 1e-6;

/// A way from one instant to another, h (s) later.
pub(super) struct Interval<'a> {
    pub scene: &'a Scene,
    pub before: &'a [State],
    pub after: &'a [State],
    pub h: f64,
}

impl Interval<'_> {
    /// The part θ of the way, before 1, after which a contact or limit that is not among the
    /// resting ones would become an overlap.
    pub fn arrival(&self, resting: &[RowId]) -> Option<f64> {
        let mut detector = Detector::new(self.scene);
        let known = self.overlaps(0.0, &mut detector);
        let mut arrives = |theta: f64| {
            let overlaps = self.overlaps(theta, &mut detector);
            overlaps.iter().any(|overlap| self.is_new(overlap, &known, resting))
        };
        let samples = path::samples(self.scene, self.before, self.after);
        let at = |sample: usize| sample as f64 / samples as f64;
        let seen = (1..=samples).find(|&sample| arrives(at(sample)))?;
        let (mut low, mut high) = (at(seen - 1), at(seen));
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if arrives(middle) { high = middle } else { low = middle }
        }
        Some(low)
    }

    /// Whether an overlap was not there at first, and is not that of a resting pair whose features
    /// have changed their names.
    fn is_new(&self, overlap: &Overlap, known: &[Overlap], resting: &[RowId]) -> bool {
        let slop = self.scene.resting().gap;
        let is_same = |id: &RowId| *id == overlap.id;
        if known.iter().any(|known| is_same(&known.id)) || resting.iter().any(is_same) {
            return false;
        }
        let is_pair = |id: &RowId| bodies(id).is_some() && bodies(id) == bodies(&overlap.id);
        let deepest = known.iter().filter(|k| is_pair(&k.id)).map(|k| k.depth).fold(0.0, f64::max);
        match deepest > 0.0 || resting.iter().any(is_pair) {
            true => overlap.depth > deepest + slop,
            false => overlap.depth > ROUNDING * slop,
        }
    }

    /// All overlaps at a part of the way.
    fn overlaps(&self, theta: f64, detector: &mut Detector) -> Vec<Overlap> {
        let ends = self.before.iter().zip(self.after);
        let states: Vec<State> = ends.map(|(a, b)| path::between(a, b, self.h, theta)).collect();
        let found = detector.find(self.scene, &states, 0.0);
        let contacts = found.iter().map(|found| Overlap {
            id: RowId { source: Source::Contact(found.id), component: 0 },
            depth: -found.gap,
        });
        let state = |body: Option<usize>| body.map_or(&State::WORLD, |k| &states[k]);
        let limits = self.scene.constraints.iter().enumerate().flat_map(|(k, constraint)| {
            let rows = constraint.rows(constraint.bodies().map(state)).unwrap_or_default();
            let is_limit = |row: &Row| row.bounds == Bounds::Unilateral && row.spring.is_none();
            let rows = rows.into_iter().enumerate().filter(move |(_, row)| is_limit(row));
            rows.map(move |(component, row)| Overlap {
                id: RowId { source: Source::Constraint(k), component },
                depth: -row.c,
            })
        });
        contacts.chain(limits).filter(|overlap| overlap.depth > 0.0).collect()
    }
}

/// A contact or limit that is overlapped.
struct Overlap {
    id: RowId,
    /// By how much (m or rad).
    depth: f64,
}

/// The bodies of a contact.
fn bodies(id: &RowId) -> Option<[usize; 2]> {
    match id.source {
        Source::Contact(id) => Some(id.bodies),
        Source::Constraint(_) => None,
    }
}
