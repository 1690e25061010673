//! The data of an animation: the bodies, their poses, and the forces.

use nalgebra::Vector3;
use serde_json::{Value, json};

use super::super::colors::{POINT, heated};
use super::chart::{self, PLOT};
use super::stage::Stage;
use super::{Animation, Recording};
use crate::animation::frame::{Force, Origin};
use crate::animation::ground::Patch;
use crate::animation::ink::{FACE, LIGHT, LIT, MARK, PLAIN, paint, tenth};
use crate::animation::layout::Lens;
use crate::animation::solid::Solid;
use crate::animation::{Camera, arrow, joint};
use crate::body::{Body, Mass, Shape, State};
use crate::constraint::Bodies;
use crate::scene::Scene;

/// Positions are rounded to a power of ten of meters below this length (px).
const EXACT: f64 = 0.05;
/// Quaternion components are multiplied by this and rounded.
pub(super) const TURN: f64 = 1e4;
/// The number of color steps from gray to red.
const HEATS: u8 = 20;
/// Larger numbers are clipped: they are far outside the picture.
const FAR: f64 = 1e12;

pub(super) fn json(animation: &Animation) -> Value {
    let stage = animation.stage();
    let unit = 10f64.powf((EXACT / stage.lens.scale).log10().floor());
    let measures = animation.measures().into_iter().map(|measure| {
        let (lo, hi) = chart::range(animation, measure);
        json!({ "name": measure.name(), "unit": measure.unit(), "range": [short(lo), short(hi)] })
    });
    let steps = animation.longest().iter().map(|sample| sample.motion.step);
    let camera = Camera::new(animation.view);
    let basis = [0, 1, 2].map(|k| {
        let axis = Vector3::ith(k, 1.0);
        let seen = camera.project(&axis);
        [seen.x, seen.y, seen.z]
    });
    let (x, y) = stage.lens.middle();
    json!({
        "camera": basis,
        "size": [stage.lens.width, stage.lens.height],
        "scale": stage.lens.scale,
        "middle": [x, y],
        "pivot": micro(&stage.pivot),
        "ground": stage.patches.iter().map(ground).collect::<Vec<_>>(),
        "light": [LIGHT.x, LIGHT.y, LIGHT.z],
        "face": [FACE.0, FACE.1],
        "lit": LIT.map(|(light, aside, size)| [light, aside, size]),
        "heat": (0..=HEATS).map(|k| heated(f64::from(k) / f64::from(HEATS))).collect::<Vec<_>>(),
        "plain": PLAIN,
        "mark": MARK,
        "rod": joint::rod(&animation.scene, &stage.lens),
        "unit": unit,
        "turn": 1.0 / TURN,
        "bodies": bodies(&animation.scene, &stage.lens),
        "joints": joints(&animation.scene),
        "start": animation.first_shown(),
        "times": animation.times().iter().map(|time| short(*time)).collect::<Vec<_>>(),
        "steps": steps.collect::<Vec<_>>(),
        "plot": PLOT,
        "end": chart::end(animation),
        "measures": measures.collect::<Vec<_>>(),
        "recordings": animation.recordings.iter().map(|own| recording(animation, own, &stage, unit)).collect::<Vec<_>>(),
    })
}

/// The parts of each body (several for a compound), with corners and faces in the body's frame;
/// empty if nothing is drawn.
fn bodies(scene: &Scene, lens: &Lens) -> Vec<Value> {
    let dot = joint::dot(scene, lens) / lens.scale;
    let part = |k: usize, body: &Body, solid: Solid| {
        json!({
            "corners": solid.corners.iter().map(micro).collect::<Vec<_>>(),
            "faces": solid.faces,
            "radius": solid.radius,
            "color": paint(&scene.bodies, k),
            "plain": paint(&scene.bodies, k) == POINT,
            "fixed": body.mass == Mass::Fixed,
        })
    };
    let of = |(k, body): (usize, &Body)| {
        let solids = Solid::of(k, body, &State::WORLD.pose, dot);
        solids.into_iter().map(|solid| part(k, body, solid)).collect::<Vec<_>>()
    };
    scene.bodies.iter().enumerate().map(of).map(Value::from).collect()
}

/// A rectangle of the ground with its grid lines.
fn ground(patch: &Patch) -> Value {
    let lines = patch.lines.iter().map(|line| line.map(|end| micro(&end)));
    json!({
        "corners": patch.corners.map(|corner| micro(&corner)),
        "lines": lines.collect::<Vec<_>>(),
        "normal": micro(&patch.normal),
    })
}

/// The lines of the constraints: two points on their bodies, null for the world, and their marks:
/// 1 is a dot, 2 a square.
fn joints(scene: &Scene) -> Vec<Value> {
    let of = |(bodies, ends): (Bodies, [Vector3<f64>; 2])| {
        let ends = ends.map(|p| micro(&p));
        let mark = bodies.map(|body| match body.map(|k| &scene.bodies[k].shape) {
            None => 2,
            Some(Shape::Point) => 0,
            Some(_) => 1,
        });
        json!({ "bodies": bodies, "ends": ends, "marks": mark })
    };
    scene.constraints.iter().flat_map(|joint| joint.lines()).map(of).collect()
}

fn recording(animation: &Animation, recording: &Recording, stage: &Stage, unit: f64) -> Value {
    let values = |measure| {
        let least = chart::least(animation, measure);
        let shown = |value: f64| if value.abs() > least { short(value) } else { 0.0 };
        chart::values(recording, measure).into_iter().map(shown).collect::<Vec<_>>()
    };
    let forces = recording.samples.iter().map(|sample| forces(&sample.frame.forces, stage, unit));
    json!({
        "name": recording.name,
        "poses": (0..animation.scene.bodies.len()).map(|k| poses(animation, recording, k, unit)).collect::<Vec<_>>(),
        "heat": heat(animation, recording),
        "forces": forces.collect::<Vec<_>>(),
        "measures": animation.measures().into_iter().map(values).collect::<Vec<_>>(),
        "ending": recording.ending,
    })
}

/// The channels of a body: x, y, z, and the quaternion components w, i, j, k unless it is a point.
fn poses(animation: &Animation, recording: &Recording, body: usize, unit: f64) -> Vec<Vec<i64>> {
    let mut last = nalgebra::Quaternion::identity();
    let rows = recording.samples.iter().map(|sample| {
        let pose = &sample.frame.states[body].pose;
        let q = *pose.q.quaternion();
        // The same rotation, without a jump.
        last = if q.dot(&last) < 0.0 { -q } else { q };
        let place = [pose.p.x, pose.p.y, pose.p.z].map(|x| whole(x / unit));
        let turn = [last.w, last.i, last.j, last.k].map(|x| whole(x * TURN));
        [&place[..], &turn].concat()
    });
    let rows: Vec<_> = rows.collect();
    let channels = if animation.scene.bodies[body].shape == Shape::Point { 3 } else { 7 };
    (0..channels).map(|k| changes(rows.iter().map(|row| row[k]))).collect()
}

/// The first number and the differences, without trailing zeros.
fn changes(numbers: impl Iterator<Item = i64>) -> Vec<i64> {
    let mut before = 0;
    let mut changes: Vec<i64> = numbers
        .map(|number| {
            let change = number - before;
            before = number;
            change
        })
        .collect();
    while changes.len() > 1 && changes.last() == Some(&0) {
        changes.pop();
    }
    changes
}

/// The color of each body, in steps; empty if bodies have their own colors.
fn heat(animation: &Animation, recording: &Recording) -> Vec<Vec<i64>> {
    if recording.samples.iter().all(|sample| sample.frame.heat.is_empty()) {
        return Vec::new();
    }
    let steps = |heat: f64| whole(heat.clamp(0.0, 1.0) * f64::from(HEATS));
    let of = |sample: &super::Sample, k: usize| sample.frame.heat.get(k).copied().map_or(0, steps);
    let body = |k: usize| changes(recording.samples.iter().map(|sample| of(sample, k)));
    (0..animation.scene.bodies.len()).map(body).collect()
}

/// Seven numbers per force: origin, point of action in units, and arrow in tenths of a px along the
/// world's axes.
fn forces(forces: &[Force], stage: &Stage, unit: f64) -> Vec<i64> {
    let Some(newton) = stage.newton else { return Vec::new() };
    let drawn = forces.iter().filter_map(|force| {
        let arrow = force.force * newton;
        let seen = arrow.norm() >= arrow::SHORTEST || force.origin == Origin::Normal;
        let drawn = seen && stage.lens.holds(stage.lens.place(&force.point));
        let [x, y, z] = [0, 1, 2].map(|k| whole(force.point[k] / unit));
        let far = |px: f64| tenth(px.clamp(-1e4, 1e4));
        let [fx, fy, fz] = [0, 1, 2].map(|k| far(arrow[k]));
        (drawn && arrow.norm().is_finite()).then_some([force.origin as i64, x, y, z, fx, fy, fz])
    });
    drawn.flatten().collect()
}

/// A point rounded to micrometers, in m; a unit vector with the same precision.
fn micro(point: &Vector3<f64>) -> [f64; 3] {
    [point.x, point.y, point.z].map(|x| (x * 1e6).round() / 1e6)
}

fn whole(x: f64) -> i64 {
    x.clamp(-FAR, FAR).round() as i64
}

/// The number rounded to four significant digits.
fn short(x: f64) -> f64 {
    format!("{x:.3e}").parse().unwrap_or(x)
}
