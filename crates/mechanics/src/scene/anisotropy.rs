//! Friction that depends on the direction on a surface: the fields `friction_direction` and
//! `friction_across` of a body or a pair.

use super::build::direction;
use super::{Scene, range};
use crate::body::{Anisotropy, Pose};
use lcplab_lcp::error::Defects;

/// The fields of a body or a pair.
#[derive(Clone, Copy)]
pub(super) struct Fields {
    /// The coefficient along the direction, if given.
    pub friction: Option<f64>,
    /// The coefficient across it.
    pub across: Option<f64>,
    /// The direction, in the axes in which the body's shape is given.
    pub direction: Option<[f64; 3]>,
}

impl Fields {
    /// The anisotropy in the body's frame, which has this pose in the axes of its shape; `None`
    /// without the fields, or with a defect.
    pub fn read(self, defects: &mut Defects, place: &str, frame: &Pose) -> Option<Anisotropy> {
        let (across, written) = match (self.across, self.direction) {
            (None, None) => return None,
            (Some(across), Some(written)) => (across, written),
            (Some(_), None) => {
                defects.add(format!("{place}.friction_across"), "needs a friction_direction");
                return None;
            }
            (None, Some(_)) => {
                defects.add(format!("{place}.friction_direction"), "needs a friction_across");
                return None;
            }
        };
        let along = self.friction.unwrap_or(0.0);
        if along <= 0.0 {
            let reason = "needs a friction above 0 of the same body or pair";
            defects.add(format!("{place}.friction_direction"), reason);
        }
        if across <= 0.0 {
            let reason =
                format!("must be above 0, is {across}: 0.001, say, for almost no friction");
            defects.add(format!("{place}.friction_across"), reason);
        } else {
            range::coefficient(defects, format!("{place}.friction_across"), across);
        }
        let direction = direction(defects, &format!("{place}.friction_direction"), &written);
        let direction = frame.q.inverse() * direction;
        defects.is_empty().then_some(Anisotropy { direction, ratio: across / along })
    }
}

/// Checks that no two bodies that may touch have a direction each, unless their pair is given.
pub(super) fn check(defects: &mut Defects, scene: &Scene) {
    let with_direction: Vec<usize> =
        (0..scene.bodies.len()).filter(|&k| scene.bodies[k].anisotropy.is_some()).collect();
    for (first, &a) in with_direction.iter().enumerate() {
        for &b in &with_direction[first + 1..] {
            let is_given = scene.pairs.get(&[a, b]);
            let is_given =
                is_given.is_some_and(|own| own.without_contact || own.friction.is_some());
            let may_move = [a, b].iter().any(|&k| scene.bodies[k].mass.dof() > 0);
            if !is_given && may_move {
                let [a, b] = [a, b].map(|k| &scene.bodies[k].name);
                let reason =
                    format!("is given for {a:?} and for {b:?}: give the friction of this pair");
                defects.add("friction_direction", reason);
            }
        }
    }
}
