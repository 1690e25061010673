//! Forces as arrows, with one scale (px per newton) for the whole strip.

use std::fmt::Write;

use nalgebra::Vector3;

use super::clip::Place;
use super::colors::FORCES;
use super::frame::{Force, Frame, Origin};
use super::ink::tenth;
use super::layout::Lens;
use crate::number::readable;
use crate::plot::canvas::hex;
use crate::plot::style::TEXT;

/// The head of an arrow in px: length and half of its width.
const HEAD: (f64, f64) = (6.0, 2.4);
/// The distance between the lines of two arrows, one of which continues the other, in px.
const BESIDE: f64 = 8.0;
/// Shorter arrows are not drawn.
pub(super) const SHORTEST: f64 = 2.0;
/// Length of the longest arrow in px, and as a share of the frame's smaller side.
const LONGEST: (f64, f64) = (52.0, 0.35);

impl Origin {
    /// All origins, in the order of legends.
    pub const ALL: [Origin; 5] =
        [Origin::Normal, Origin::Friction, Origin::Constraint, Origin::Impulse, Origin::Velocity];

    /// The word in legends.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Origin::Normal => "normal",
            Origin::Friction => "friction",
            Origin::Constraint => "constraint",
            Origin::Impulse => "impulse",
            Origin::Velocity => "velocity",
        }
    }

    /// The unit of its arrows.
    pub(super) fn unit(self) -> &'static str {
        match self {
            Origin::Impulse => "N s",
            Origin::Velocity => "m/s",
            _ => "N",
        }
    }

    fn color(self) -> String {
        hex(FORCES[self as usize])
    }
}

impl Frame {
    /// The largest arrow in words, if there is one.
    pub fn largest(&self) -> Option<String> {
        let size = |force: &Force| force.force.norm();
        let largest = self.forces.iter().max_by(|a, b| size(a).total_cmp(&size(b)))?;
        Some(format!("at most {} {}", readable(size(largest), 3), largest.origin.unit()))
    }
}

/// The largest arrow of all frames with this unit, 0 if there is none.
pub(super) fn largest(frames: &[Frame], unit: &str) -> f64 {
    let forces = frames.iter().flat_map(|frame| &frame.forces);
    let own = forces.filter(|force| force.origin.unit() == unit).map(|force| force.force.norm());
    own.filter(|f| f.is_finite()).fold(0.0, f64::max)
}

/// Divides the arrows of each unit by the largest one, so that they share a scale; returns the
/// largest one for each origin.
pub(super) fn normalize(frames: &mut [Frame]) -> [f64; Origin::ALL.len()] {
    let most = Origin::ALL.map(|origin| largest(frames, origin.unit()));
    let forces = frames.iter_mut().flat_map(|frame| &mut frame.forces);
    forces.for_each(|force| force.force /= most[force.origin as usize]);
    most
}

/// The length of a newton in px, for this largest force.
pub(super) fn scale(largest: f64, lens: &Lens) -> f64 {
    LONGEST.0.min(LONGEST.1 * lens.width.min(lens.height)) / largest
}

/// The tips of the arrows in the picture plane (m), for this length of a newton (px); longer arrows
/// than that of the largest force (N) are cut there.
pub(super) fn tips<'a>(
    frames: impl Iterator<Item = &'a Frame>,
    largest: f64,
    lens: &Lens,
    newton: f64,
) -> impl Iterator<Item = Vector3<f64>> {
    let forces = frames.flat_map(|frame| &frame.forces);
    let seen = forces.filter(|force| lens.holds(lens.place(&force.point)));
    seen.filter_map(move |force| {
        let cut = (largest / force.force.norm()).min(1.0);
        let tip = force.point + force.force * (cut * newton / lens.scale);
        tip.iter().all(|x| x.is_finite()).then(|| lens.camera.project(&tip))
    })
}

/// The arrows of a frame in tenths of a px, with a background outline, and a dot at every contact.
pub(super) fn markup(forces: &[Force], lens: &Lens, scale: f64) -> String {
    let placed = placed(forces, lens, scale);
    let of_origin = |origin: Origin| {
        let (mut shafts, mut heads) = (String::new(), String::new());
        for (_, tail, tip) in placed.iter().filter(|(force, ..)| force.origin == origin) {
            add(&mut shafts, &mut heads, *tail, *tip, origin == Origin::Normal);
        }
        drawn(origin, &shafts, &heads)
    };
    Origin::ALL.map(of_origin).concat()
}

/// The tail and the tip of each arrow in the cell, in the order of origins; an arrow that continues
/// another one is beside it.
fn placed<'a>(forces: &'a [Force], lens: &Lens, scale: f64) -> Vec<(&'a Force, Place, Place)> {
    let place = |force: &Force| {
        let tail = lens.place(&force.point);
        (tail, lens.place(&(force.point + force.force * (scale / lens.scale))))
    };
    let is_drawn =
        |(tail, tip): &(Place, Place)| lens.holds(*tail) && tip.0.is_finite() && tip.1.is_finite();
    let mut in_line: Vec<(Place, Place)> = Vec::new();
    let mut arrows = Vec::new();
    for origin in Origin::ALL {
        for force in forces.iter().filter(|force| force.origin == origin) {
            let arrow = place(force);
            let (tail, tip) = arrow;
            if !is_drawn(&arrow) {
                continue;
            }
            if in_line.iter().any(|other| continues(*other, arrow)) {
                let (dx, dy) = (tip.0 - tail.0, tip.1 - tail.1);
                let (x, y) = (-dy * BESIDE / dx.hypot(dy), dx * BESIDE / dx.hypot(dy));
                arrows.push((force, (tail.0 + x, tail.1 + y), (tip.0 + x, tip.1 + y)));
            } else {
                in_line.push(arrow);
                arrows.push((force, tail, tip));
            }
        }
    }
    arrows
}

/// The sizes of the arrows, given the largest one for each origin: to the right of the body at a
/// steep arrow's middle, above one that is not steep.
pub(super) fn sizes(
    forces: &[Force],
    lens: &Lens,
    scale: f64,
    most: &[f64],
    bodies: &[(usize, [f64; 4])],
) -> String {
    let mut out = String::new();
    for (Force { force, origin, .. }, tail, tip) in placed(forces, lens, scale) {
        let (dx, dy) = (tip.0 - tail.0, tip.1 - tail.1);
        if dx.hypot(dy) < SHORTEST {
            continue;
        }
        let (x, y) = (0.5 * (tail.0 + tip.0), 0.5 * (tail.1 + tip.1));
        let holds = |[left, right, top, bottom]: &[f64; 4]| {
            (*left..=*right).contains(&x) && (*top..=*bottom).contains(&y)
        };
        let edges = bodies.iter().map(|(_, edges)| edges).filter(|edges| holds(edges));
        let (x, y, anchor) = match dx.abs() < dy.abs() {
            true => (edges.fold(x, |x, edges| x.max(edges[1])) + 6.0, y + 5.0, "start"),
            false => (x, y - 7.0, "middle"),
        };
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{}\" text-anchor=\"{anchor}\" font-size=\"{}\" fill=\"{}\" stroke=\"#ffffff\" \
             stroke-width=\"35\" paint-order=\"stroke\">{} {}</text>",
            tenth(x),
            tenth(y),
            10.0 * TEXT,
            origin.color(),
            readable(force.norm() * most[*origin as usize], 3),
            origin.unit()
        );
    }
    out
}

/// Whether two arrows lie on one line and touch.
fn continues((a, b): (Place, Place), (c, d): (Place, Place)) -> bool {
    let (ux, uy) = (b.0 - a.0, b.1 - a.1);
    let square = ux * ux + uy * uy;
    let aside = |p: Place| (ux * (p.1 - a.1) - uy * (p.0 - a.0)).abs() / square.sqrt();
    let along = |p: Place| (ux * (p.0 - a.0) + uy * (p.1 - a.1)) / square;
    let gap = HEAD.0 / square.sqrt();
    let (low, high) = (along(c).min(along(d)), along(c).max(along(d)));
    aside(c) < 1.0 && aside(d) < 1.0 && low < 1.0 + gap && high > -gap
}

/// An arrow to the right in tenths of a px, for a legend.
pub(super) fn sample(origin: Origin, start: Place, length: f64) -> String {
    let (mut shafts, mut heads) = (String::new(), String::new());
    add(&mut shafts, &mut heads, start, (start.0 + length, start.1), false);
    drawn(origin, &shafts, &heads)
}

fn drawn(origin: Origin, shafts: &str, heads: &str) -> String {
    if heads.is_empty() {
        return String::new();
    }
    let color = origin.color();
    format!(
        "<g stroke-linejoin=\"round\"><path fill=\"#ffffff\" stroke=\"#ffffff\" stroke-width=\"31\" \
         d=\"{shafts}{heads}\"/>\n<path fill=\"none\" stroke=\"{color}\" stroke-width=\"15\" \
         d=\"{shafts}\"/>\n<path stroke=\"none\" fill=\"{color}\" d=\"{heads}\"/></g>\n"
    )
}

/// Adds an arrow. The shaft ends where the head begins; a short arrow has a small head.
fn add(shafts: &mut String, heads: &mut String, tail: Place, tip: Place, dot: bool) {
    let (dx, dy) = (tip.0 - tail.0, tip.1 - tail.1);
    let length = dx.hypot(dy);
    if dot {
        let (x, y) = (tenth(tail.0 - 2.0), tenth(tail.1));
        let _ = write!(heads, "M{x} {y}a20 20 0 1 0 40 0a20 20 0 1 0 -40 0z");
    }
    if length < SHORTEST {
        return;
    }
    let (ux, uy) = (dx / length, dy / length);
    let head = HEAD.0.min(0.7 * length);
    let half = HEAD.1 * head / HEAD.0;
    let (nx, ny) = (tip.0 - head * ux, tip.1 - head * uy);
    let point = |(x, y): Place| format!("{} {}", tenth(x), tenth(y));
    let (left, right) = ((nx - half * uy, ny + half * ux), (nx + half * uy, ny - half * ux));
    let _ = write!(shafts, "M{}L{}", point(tail), point((nx, ny)));
    let _ = write!(heads, "M{}L{}L{}z", point(tip), point(left), point(right));
}
