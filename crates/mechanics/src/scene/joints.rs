//! Builds the constraints of a scene from those of a description: resolves body names, checks the
//! fields, and calls the constructor of the joint.

use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::Vector3;

use super::build::direction;
use super::description;
use super::settings::{not_negative, positive};
use super::{Scene, range};
use crate::body::{Mass, Shape, State};
use crate::constraint::{ALL, Bodies, Constraint, Field, Joint, Placement};
use lcplab_lcp::error::Defects;

/// A constraint as written, with its place in the file.
pub(super) struct Site<'a> {
    /// Its place in the file, such as `constraints[2]`.
    pub place: String,
    /// The constraint as written.
    pub written: &'a description::Constraint,
}

impl Site<'_> {
    /// The constraint, unless a defect prevents it.
    pub fn build(
        &self,
        defects: &mut Defects,
        names: &HashMap<&str, usize>,
        scene: &Scene,
    ) -> Option<Arc<dyn Constraint>> {
        let joint = self.joint(defects)?;
        let before = defects.len();
        self.check_fields(defects, joint);
        let bodies = self.bodies(defects, joint, names, scene)?;
        let placement = self.placement(defects, bodies, scene);
        if defects.len() > before {
            return None;
        }
        match (joint.build)(&placement) {
            Ok(constraint) => Some(constraint),
            Err(fault) => {
                defects.add(self.at(fault.field), fault.reason);
                None
            }
        }
    }

    /// Sets the initial speed of the bodies attached to the joint, if one is given.
    pub fn start(
        &self,
        defects: &mut Defects,
        names: &HashMap<&str, usize>,
        bodies: &[description::Body],
        scene: &mut Scene,
    ) {
        let Some(speed) = self.written.start_speed else { return };
        let mut refuse = |reason: String| defects.add(self.at(Field::StartSpeed), reason);
        let place = |name: &String| names.get(name.as_str()).copied();
        let (Some(axis), Some(last)) =
            (self.written.axis, self.written.bodies.last().and_then(place))
        else {
            // This was already reported.
            return;
        };
        if !speed.is_finite() {
            return refuse(format!("must be finite, is {speed}"));
        }
        let written = &bodies[last];
        if written.fixed {
            return refuse(format!(
                "{:?} is fixed: name the body that is to move last",
                written.name
            ));
        }
        if (written.velocity, written.angular_velocity) != ([0.0; 3], [0.0; 3]) {
            return refuse(format!("{:?} has velocities of its own", written.name));
        }
        let axis = Vector3::from(axis).normalize() * speed;
        let first = self.written.bodies.first().filter(|_| self.written.bodies.len() == 2);
        let first = first.and_then(place).map_or(State::WORLD, |k| scene.states[k]);
        let state = &mut scene.states[last];
        let carried = |p: Vector3<f64>| first.v + first.omega.cross(&(p - first.pose.p));
        match self.written.kind.as_str() {
            "slider" => {
                (state.v, state.omega) = (carried(state.pose.p) + axis, first.omega);
            }
            _ => {
                let point = self.written.point.map_or(state.pose.p, Vector3::from);
                state.omega = first.omega + axis;
                state.v = carried(point) + state.omega.cross(&(state.pose.p - point));
            }
        }
    }

    /// The place of a field in the file.
    fn at(&self, field: Field) -> String {
        format!("{}.{field}", self.place)
    }

    fn joint(&self, defects: &mut Defects) -> Option<&'static Joint> {
        let joint = Joint::by_name(&self.written.kind);
        if joint.is_none() {
            let known: Vec<_> = ALL.iter().map(|joint| joint.name).collect();
            let reason = format!(
                "there is no constraint {:?}; known are {}",
                self.written.kind,
                known.join(", ")
            );
            defects.add(format!("{}.kind", self.place), reason);
        }
        joint
    }

    /// Whether a field is given.
    fn has(&self, field: Field) -> bool {
        let written = self.written;
        match field {
            Field::Point => written.point.is_some(),
            Field::Points => written.points.is_some(),
            Field::Axis => written.axis.is_some(),
            Field::Axes => written.axes.is_some(),
            Field::Length => written.length.is_some(),
            Field::Angle => written.angle.is_some(),
            Field::Limits => written.limits.is_some(),
            Field::Speed => written.speed.is_some(),
            Field::StartSpeed => written.start_speed.is_some(),
            Field::Effort => written.effort.is_some(),
            Field::Stiffness => written.stiffness.is_some(),
            Field::Damping => written.damping.is_some(),
            Field::Teeth => written.teeth.is_some(),
        }
    }

    /// Reports fields that this kind does not have, and those that are missing.
    fn check_fields(&self, defects: &mut Defects, joint: &Joint) {
        for field in Field::ALL {
            let needed = joint.needs.contains(&field);
            if self.has(field) && !needed && !joint.takes.contains(&field) {
                defects.add(self.at(field), format!("a {} has none", joint.name));
            } else if needed && !self.has(field) {
                defects.add(self.at(field), "is missing");
            }
        }
    }

    /// The given fields, each checked individually.
    fn placement(&self, defects: &mut Defects, bodies: Bodies, scene: &Scene) -> Placement {
        let written = self.written;
        self.check_numbers(defects);
        if let Some(point) = &written.point {
            range::vector(defects, &self.at(Field::Point), point);
        }
        for point in written.points.iter().flatten() {
            range::vector(defects, &self.at(Field::Points), point);
        }
        let mut unit = |field, axis: &[f64; 3]| direction(defects, &self.at(field), axis);
        Placement {
            bodies,
            poses: bodies.map(|body| body.map_or(State::WORLD, |k| scene.states[k]).pose),
            point: written.point.map(Vector3::from),
            points: written.points.map(|points| points.map(Vector3::from)),
            axis: written.axis.map(|axis| unit(Field::Axis, &axis)),
            axes: written.axes.map(|axes| axes.map(|axis| unit(Field::Axes, &axis))),
            length: written.length,
            angle: written.angle,
            limits: written.limits,
            speed: written.speed,
            effort: written.effort,
            stiffness: written.stiffness,
            damping: written.damping,
            teeth: written.teeth,
        }
    }

    /// Reports invalid single numbers.
    fn check_numbers(&self, defects: &mut Defects) {
        let written = self.written;
        let sizes = [(Field::Length, written.length), (Field::Angle, written.angle)];
        for (field, size) in sizes {
            size.into_iter().for_each(|size| positive(defects, self.at(field), size));
        }
        let rates = [(Field::Stiffness, written.stiffness), (Field::Damping, written.damping)];
        for (field, rate) in rates {
            rate.into_iter().for_each(|rate| not_negative(defects, self.at(field), rate));
        }
        if let Some(effort) = written.effort.filter(|effort| !(*effort > 0.0)) {
            defects.add(self.at(Field::Effort), format!("must be positive, is {effort}"));
        }
        if let Some(speed) = written.speed.filter(|speed| !speed.is_finite()) {
            defects.add(self.at(Field::Speed), format!("must be finite, is {speed}"));
        }
        if written.teeth.is_some_and(|teeth| teeth.contains(&0)) {
            defects.add(self.at(Field::Teeth), "must be at least 1 each");
        }
    }

    fn bodies(
        &self,
        defects: &mut Defects,
        joint: &Joint,
        names: &HashMap<&str, usize>,
        scene: &Scene,
    ) -> Option<Bodies> {
        let place = format!("{}.bodies", self.place);
        let written = &self.written.bodies;
        let (least, most) = joint.bodies;
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
        for body in bodies.iter().flatten().take(joint.turns).map(|&k| &scene.bodies[k]) {
            if body.shape == Shape::Point {
                let reason = format!("{:?} is a point, it has no orientation", body.name);
                defects.add(place.as_str(), reason);
            }
        }
        Some(bodies)
    }
}
