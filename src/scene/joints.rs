//! From the constraints of a description to those of a scene: anchors in the bodies' frames.

use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::Vector3;

use super::Scene;
use super::build::direction;
use super::description::{self, Kind};
use super::settings::positive;
use crate::body::{Mass, Pose, Shape, State};
use crate::constraint::{
    AxisLock, Bodies, Coincidence, Constraint, Distance, Motion, Orientation, Weld,
};
use crate::error::Defects;

/// A constraint as it was written, and where.
pub(super) struct Site<'a> {
    /// Its place in the file, such as `constraints[2]`.
    pub place: String,
    /// What is written there.
    pub written: &'a description::Constraint,
}

impl Site<'_> {
    /// The constraint, if it has no defect that hides it.
    pub fn build(
        &self,
        defects: &mut Defects,
        names: &HashMap<&str, usize>,
        scene: &Scene,
    ) -> Option<Arc<dyn Constraint>> {
        self.check_fields(defects);
        let bodies = self.bodies(defects, names, scene)?;
        let poses = bodies.map(|body| body.map_or(State::WORLD, |k| scene.states[k]).pose);
        let anchored = |x: &Vector3<f64>| [poses[0].local(x), poses[1].local(x)];
        let point = self.written.point.map_or(poses[1].p, Vector3::from);
        let relative = poses[0].q.inverse() * poses[1].q;
        let orientation = Orientation { bodies, relative };
        Some(match self.written.kind {
            Kind::Ball | Kind::Nail => Arc::new(Coincidence { bodies, anchors: anchored(&point) }),
            Kind::Orientation => Arc::new(orientation),
            Kind::Fixed => Arc::new(Weld {
                point: Coincidence { bodies, anchors: anchored(&point) },
                orientation,
            }),
            Kind::Distance => Arc::new(self.distance(defects, bodies, &poses)?),
            Kind::LockTranslation | Kind::LockRotation => {
                let axis = poses[0].q.inverse() * self.axis(defects)?;
                let motion = match self.written.kind {
                    Kind::LockRotation => Motion::Rotation { relative: orientation },
                    _ => Motion::Translation { anchors: anchored(&poses[1].p), offset: 0.0 },
                };
                Arc::new(AxisLock { bodies, axis, motion })
            }
        })
    }

    /// Fields that this kind does not have.
    fn check_fields(&self, defects: &mut Defects) {
        use Kind::{Ball, Distance, Fixed, LockRotation, LockTranslation, Nail};
        let written = self.written;
        let fields: [(&str, bool, &[Kind]); 4] = [
            ("point", written.point.is_some(), &[Ball, Nail, Fixed]),
            ("points", written.points.is_some(), &[Distance]),
            ("length", written.length.is_some(), &[Distance]),
            ("axis", written.axis.is_some(), &[LockTranslation, LockRotation]),
        ];
        for (field, given, kinds) in fields {
            if given && !kinds.contains(&written.kind) {
                defects.add(format!("{}.{field}", self.place), "this kind of constraint has none");
            }
        }
        let points = written.points.into_iter().flatten().chain(written.point);
        if points.flatten().any(|x| !x.is_finite()) {
            defects.add(format!("{}.point", self.place), "must be finite");
        }
    }

    fn bodies(
        &self,
        defects: &mut Defects,
        names: &HashMap<&str, usize>,
        scene: &Scene,
    ) -> Option<Bodies> {
        let place = format!("{}.bodies", self.place);
        let written = &self.written.bodies;
        let (least, most) = self.arity();
        if !(least..=most).contains(&written.len()) {
            let wanted =
                if least == most { format!("{most}") } else { format!("{least} or {most}") };
            defects.add(place, format!("names {} bodies, must name {wanted}", written.len()));
            return None;
        }
        let found: Vec<_> = written.iter().map(|name| names.get(name.as_str()).copied()).collect();
        for (name, _) in written.iter().zip(&found).filter(|(_, body)| body.is_none()) {
            defects.add(place.as_str(), format!("there is no body named {name:?}"));
        }
        let bodies = match found[..] {
            [Some(body)] => [None, Some(body)],
            [Some(first), Some(second)] => [Some(first), Some(second)],
            _ => return None,
        };
        if bodies[0] == bodies[1] {
            defects.add(place, format!("joins {:?} to itself", written[0]));
            return None;
        }
        let moves = |body: Option<usize>| body.is_some_and(|k| scene.bodies[k].mass != Mass::Fixed);
        if !bodies.into_iter().any(moves) {
            defects.add(place, "joins only bodies that do not move");
            return None;
        }
        self.check_turning(defects, &bodies, scene);
        Some(bodies)
    }

    /// The least and the greatest number of bodies this kind joins.
    fn arity(&self) -> (usize, usize) {
        match self.written.kind {
            Kind::Ball => (2, 2),
            Kind::Nail => (1, 1),
            _ => (1, 2),
        }
    }

    /// A point mass has no orientation that could be kept.
    fn check_turning(&self, defects: &mut Defects, bodies: &Bodies, scene: &Scene) {
        let turns =
            matches!(self.written.kind, Kind::Fixed | Kind::Orientation | Kind::LockRotation);
        for &k in bodies.iter().flatten() {
            if turns && scene.bodies[k].shape == Shape::Point {
                let reason =
                    format!("{:?} is a point, it has no orientation", scene.bodies[k].name);
                defects.add(format!("{}.bodies", self.place), reason);
            }
        }
    }

    fn distance(
        &self,
        defects: &mut Defects,
        bodies: Bodies,
        poses: &[Pose; 2],
    ) -> Option<Distance> {
        let ends = match (self.written.points, bodies[0]) {
            (Some(points), _) => points.map(Vector3::from),
            (None, Some(_)) => [poses[0].p, poses[1].p],
            (None, None) => {
                defects.add(format!("{}.points", self.place), "is missing: where in the world?");
                return None;
            }
        };
        let length = self.written.length.unwrap_or((ends[1] - ends[0]).norm());
        positive(defects, format!("{}.length", self.place), length);
        Some(Distance { bodies, anchors: [0, 1].map(|k| poses[k].local(&ends[k])), length })
    }

    fn axis(&self, defects: &mut Defects) -> Option<Vector3<f64>> {
        let place = format!("{}.axis", self.place);
        let Some(axis) = self.written.axis else {
            defects.add(place, "is missing");
            return None;
        };
        Some(direction(defects, &place, &axis))
    }
}
