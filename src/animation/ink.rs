//! Draws one frame: paths and circles in tenths of a px, and the colors of bodies. They stand in a
//! group with round ends of lines and without fill.

use std::fmt::Write;

use nalgebra::Vector3;

use super::clip::{Place, cut};
use super::colors::{FIXED, GROUND, HEAVY, POINT, body_color, heated};
use super::coverage::Coverage;
use super::ground::Patch;
use super::joint::Mark;
use super::layout::Lens;
use super::solid::{Part, Solid};
use crate::body::{Body, Mass, Shape};
use crate::plot::canvas::hex;
use crate::plot::style::{FAINT_INK, GRID, INK};

/// The radius of joint marks in px.
pub(super) const MARK: f64 = 2.6;
/// Thickness in px of a half space seen from the edge.
const BAND: f64 = 6.0;
/// A ball with a smaller radius in px is drawn as a plain disk.
pub(super) const PLAIN: f64 = 3.0;
/// A plane counts as seen from the edge if its normal points less than this (as a sine) to the
/// viewer.
const EDGE_ON: f64 = 0.02;
/// The direction of the light: left of the viewer and above (right, up, towards the viewer).
pub(super) const LIGHT: Vector3<f64> = Vector3::new(-0.40, 0.74, 0.54);

/// Brightness of an unlit face, and the addition from light.
pub(super) const FACE: (f64, f64) = (0.70, 0.44);

/// The disks that make a ball look round: brightness, offset towards the light, and size, both in
/// radii.
pub(super) const LIT: [(f64, f64, f64); 3] =
    [(0.88, 0.0, 1.0), (0.96, 0.18, 0.78), (1.05, 0.36, 0.45)];

/// A body with this many times the mass of every other one is dark.
const OUTWEIGHS: f64 = 10.0;

type Rgb = (u8, u8, u8);

/// A frame that is being drawn.
pub(super) struct Ink<'a> {
    lens: &'a Lens,
    out: String,
    /// The attributes and the data of the current path.
    path: (String, String),
    /// Whether each body is a group with its number.
    pub groups_bodies: bool,
}

impl<'a> Ink<'a> {
    /// An empty frame.
    pub fn new(lens: &'a Lens) -> Self {
        Ink { lens, out: String::new(), path: Default::default(), groups_bodies: false }
    }

    /// The markup, in tenths of a px.
    pub fn finish(mut self) -> String {
        self.end_path();
        self.out
    }

    /// Draws a half space: its patch, its section if seen from the edge, or only the grid if seen
    /// from behind.
    pub fn ground(&mut self, patch: &Patch) {
        let towards = self.lens.camera.project(&patch.normal);
        if towards.z.abs() <= EDGE_ON {
            return self.cut_ground(patch, (towards.x, -towards.y));
        }
        if towards.z > 0.0 {
            let corners = patch.corners.iter().map(|corner| self.lens.place(corner)).collect();
            self.polygon(&format!("stroke=\"none\" fill=\"{}\"", hex(GROUND)), corners);
        }
        let style = format!("stroke=\"{}\" stroke-width=\"9\"", hex(FIXED));
        for line in &patch.lines {
            self.line(&style, line.map(|end| self.lens.place(&end)));
        }
    }

    fn cut_ground(&mut self, patch: &Patch, (nx, ny): Place) {
        let places = patch.corners.map(|corner| self.lens.place(&corner));
        let apart = |a: Place, b: Place| (a.0 - b.0).hypot(a.1 - b.1);
        let across = [[0, 1], [1, 2]].map(|[i, j]| [places[i], places[j]]);
        let [a, b] = across;
        let [start, end] = if apart(a[0], a[1]) >= apart(b[0], b[1]) { a } else { b };
        let under = |(x, y): Place| (x - BAND * nx, y - BAND * ny);
        let band = vec![start, end, under(end), under(start)];
        self.polygon(&format!("stroke=\"none\" fill=\"{}\"", color(GRID)), band);
        let style = format!("stroke=\"{}\" stroke-width=\"12\"", color(FAINT_INK));
        self.line(&style, [start, end]);
    }

    /// Draws solids in painting order, without hidden ones. Bodies are colored by `heat` if given.
    pub fn solids(&mut self, bodies: &[Body], heat: &[f64], solids: &[&Solid]) {
        let mut coverage = Coverage::new(self.lens.width, self.lens.height);
        let mut seen: Vec<Vec<Vec<Place>>> = Vec::new();
        for solid in solids.iter().rev() {
            let visible = if solid.faces.is_empty() {
                vec![self.round_part(solid, &mut coverage)]
            } else {
                solid.faces.iter().map(|face| self.flat_part(solid, face, &mut coverage)).collect()
            };
            seen.push(visible);
        }
        for (solid, visible) in solids.iter().zip(seen.into_iter().rev()) {
            let base = look(bodies, heat, solid);
            match solid.part {
                Part::Body(k) if self.groups_bodies => {
                    self.raw(&format!("<g data-body=\"{k}\">"));
                    self.solid(solid, visible, base);
                    self.raw("</g>\n");
                }
                _ => self.solid(solid, visible, base),
            }
        }
    }

    /// Draws the visible faces of a solid.
    fn solid(&mut self, solid: &Solid, visible: Vec<Vec<Place>>, base: Rgb) {
        if solid.faces.is_empty() {
            if let Some(ends) = visible.into_iter().next().filter(|ends| !ends.is_empty()) {
                self.round(solid, base, &ends);
            }
            return;
        }
        for (face, corners) in solid.faces.iter().zip(visible) {
            let normal = solid.normal(face).unwrap_or_else(Vector3::zeros);
            let style = format!("fill=\"{}\"", hex(shade(base, self.light(&normal))));
            self.outlined(&style, corners);
        }
    }

    /// The positions of a rounded solid's corners; empty if it is hidden or outside the frame.
    fn round_part(&self, solid: &Solid, coverage: &mut Coverage) -> Vec<Place> {
        let ends: Vec<_> = solid.corners.iter().map(|corner| self.lens.place(corner)).collect();
        let ends = if ends.len() > 1 { self.inside(ends) } else { ends };
        let (Some(&first), Some(&last)) = (ends.first(), ends.last()) else { return Vec::new() };
        let radius = (solid.radius * self.lens.scale).max(0.5);
        let inside = self.lens.holds(first) || self.lens.holds(last);
        if inside && coverage.claim_round([first, last], radius) { ends } else { Vec::new() }
    }

    /// The positions of a face's corners; empty if it faces away, is hidden or outside the frame.
    fn flat_part(&self, solid: &Solid, face: &[usize], coverage: &mut Coverage) -> Vec<Place> {
        let towards = solid.normal(face).map_or(0.0, |n| self.lens.camera.project(&n).z);
        if towards <= 1e-6 {
            return Vec::new();
        }
        let corners = solid.face(face).map(|corner| self.lens.place(corner)).collect();
        let corners = self.inside(corners);
        if corners.len() > 2 && coverage.claim_polygon(&corners) { corners } else { Vec::new() }
    }

    /// Draws a shaded disk with two great circles that rotate with it, or a capsule.
    fn round(&mut self, solid: &Solid, base: Rgb, ends: &[Place]) {
        let radius = solid.radius * self.lens.scale;
        if let [start, end] = *ends {
            return match solid.part {
                Part::Rod(_) => self.stroke(base, radius, [start, end]),
                Part::Body(_) => self.capsule(base, radius, [start, end]),
            };
        }
        let center = ends[0];
        if base == POINT || radius < PLAIN {
            return self.disc("stroke=\"none\"", base, center, radius);
        }
        self.disc("", shade(base, LIT[0].0), center, radius);
        for (light, aside, size) in LIT.into_iter().skip(1) {
            let (x, y) = (aside * radius * LIGHT.x, aside * radius * LIGHT.y);
            let at = (center.0 + x, center.1 - y);
            self.disc("stroke=\"none\"", shade(base, light), at, size * radius);
        }
        for axis in [Vector3::z(), Vector3::y()] {
            self.great_circle(solid, &axis, base, center, radius);
        }
        self.outline(center, radius);
    }

    /// Draws a line with the width of a round solid and round ends.
    fn stroke(&mut self, color: Rgb, radius: f64, ends: [Place; 2]) {
        let (color, width) = (hex(color), tenth(2.0 * radius));
        self.line(&format!("stroke=\"{color}\" stroke-width=\"{width}\""), ends);
    }

    /// Draws strokes on top of each other: a dark outline, then the brightness of a ball's disks.
    fn capsule(&mut self, base: Rgb, radius: f64, ends: [Place; 2]) {
        self.stroke(shade(base, 0.35), radius, ends);
        for (light, aside, size) in LIT {
            let (x, y) = (aside * radius * LIGHT.x, aside * radius * LIGHT.y);
            let lit = ends.map(|(px, py)| (px + x, py - y));
            self.stroke(shade(base, light), size * (radius - 0.7).max(0.5 * radius), lit);
        }
    }

    /// Draws the visible half of the great circle normal to an axis of the body.
    fn great_circle(
        &mut self,
        solid: &Solid,
        axis: &Vector3<f64>,
        base: Rgb,
        (x, y): Place,
        radius: f64,
    ) {
        let m = self.lens.camera.project(&(solid.turn * axis));
        let flat = m.x.hypot(m.y);
        if flat < 1e-6 {
            // It is the outline.
            return;
        }
        let (along_x, along_y) = (radius * m.y / flat, radius * m.x / flat);
        // The ellipse's ends lie perpendicular to m; the half towards the viewer bends along −m.
        let sweep = u8::from(m.z < 0.0);
        let angle = along_y.atan2(along_x).to_degrees();
        let style = format!(
            "stroke=\"{}\" stroke-width=\"{}\"",
            hex(shade(base, 0.5)),
            tenth((0.06 * radius).clamp(0.7, 2.0))
        );
        let course = format!(
            "M{} {}A{} {} {angle:.1} 0 {sweep} {} {}",
            tenth(x - along_x),
            tenth(y - along_y),
            tenth(radius),
            tenth(radius * m.z.abs()),
            tenth(x + along_x),
            tenth(y + along_y)
        );
        self.path(&style, &course, true);
    }

    /// Draws the marks of joints.
    pub fn marks(&mut self, marks: &[Mark]) {
        for mark in marks {
            let (Mark::Ball(point) | Mark::Pin(point)) = mark;
            let (x, y) = self.lens.place(point);
            if !self.lens.holds((x, y)) {
                continue;
            }
            match mark {
                Mark::Ball(_) => self.disc("stroke=\"#ffffff\"", rgb(INK), (x, y), MARK),
                Mark::Pin(_) => {
                    let side = tenth(2.0 * MARK);
                    let (left, top) = (tenth(x - MARK), tenth(y - MARK));
                    let course = format!("M{left} {top}h{side}v{side}h-{side}z");
                    let style = format!("stroke=\"none\" fill=\"{}\"", color(INK));
                    self.path(&style, &course, true);
                }
            }
        }
    }

    /// Adds existing markup, in tenths of a px.
    pub fn raw(&mut self, markup: &str) {
        self.end_path();
        self.out.push_str(markup);
    }

    /// The brightness of a face with this normal.
    fn light(&self, normal: &Vector3<f64>) -> f64 {
        FACE.0 + FACE.1 * self.lens.camera.project(normal).dot(&LIGHT).max(0.0)
    }

    fn inside(&self, polygon: Vec<Place>) -> Vec<Place> {
        cut(polygon, self.lens.width, self.lens.height)
    }

    fn disc(&mut self, attributes: &str, fill: Rgb, (x, y): Place, radius: f64) {
        self.end_path();
        let gap = if attributes.is_empty() { "" } else { " " };
        let _ = writeln!(
            self.out,
            "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"{gap}{attributes}/>",
            tenth(x),
            tenth(y),
            tenth(radius),
            hex(fill)
        );
    }

    fn outline(&mut self, (x, y): Place, radius: f64) {
        self.end_path();
        let (x, y, r) = (tenth(x), tenth(y), tenth(radius));
        let _ = writeln!(self.out, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\"/>");
    }

    fn line(&mut self, style: &str, ends: [Place; 2]) {
        let course = course(&self.inside(ends.into()));
        self.path(style, &course, true);
    }

    fn polygon(&mut self, style: &str, corners: Vec<Place>) {
        let corners = self.inside(corners);
        if corners.len() > 2 {
            self.path(style, &(course(&corners) + "z"), true);
        }
    }

    /// Draws a polygon that is not merged with others, since its outline must cover theirs.
    fn outlined(&mut self, style: &str, corners: Vec<Place>) {
        if corners.len() > 2 {
            self.path(style, &(course(&corners) + "z"), false);
        }
    }

    /// Draws a path; appends to the current one if it has the same style.
    fn path(&mut self, style: &str, course: &str, merges: bool) {
        if course.is_empty() {
            return;
        }
        if !merges || self.path.0 != style {
            self.end_path();
            self.path.0 = style.into();
        }
        self.path.1.push_str(course);
        if !merges {
            self.end_path();
        }
    }

    fn end_path(&mut self) {
        let (style, course) = std::mem::take(&mut self.path);
        if !course.is_empty() {
            let _ = writeln!(self.out, "<path {style} d=\"{course}\"/>");
        }
    }
}

/// The path data of a polygon or line, relative to its first corner.
fn course(corners: &[Place]) -> String {
    let mut text = String::new();
    let mut at = (0, 0);
    for (k, &(x, y)) in corners.iter().enumerate() {
        let next = (tenth(x), tenth(y));
        let _ = match k {
            0 => write!(text, "M{} {}", next.0, next.1),
            _ => write!(text, "l{} {}", next.0 - at.0, next.1 - at.1),
        };
        at = next;
    }
    text
}

/// A length in px as tenths of a px.
pub(super) fn tenth(px: f64) -> i64 {
    (px * 10.0).round() as i64
}

/// The color of a solid.
fn look(bodies: &[Body], heat: &[f64], solid: &Solid) -> Rgb {
    match solid.part {
        Part::Rod(_) => rgb(FAINT_INK),
        Part::Body(k) => match heat.get(k) {
            Some(heat) if bodies[k].mass != Mass::Fixed => heated(*heat),
            _ => paint(bodies, k),
        },
    }
}

/// The color of the body with this index.
pub(super) fn paint(bodies: &[Body], k: usize) -> Rgb {
    match &bodies[k] {
        body if body.mass == Mass::Fixed => FIXED,
        _ if heaviest(bodies) == Some(k) => HEAVY,
        body if body.shape == Shape::Point => POINT,
        _ => body_color(k),
    }
}

/// The moving body with at least ten times the mass of every other one.
pub(super) fn heaviest(bodies: &[Body]) -> Option<usize> {
    let mass = |k: &usize| bodies[*k].mass.mass();
    let moving = || (0..bodies.len()).filter(|k| bodies[*k].mass != Mass::Fixed);
    let most = moving().max_by(|a, b| mass(a).total_cmp(&mass(b)))?;
    let mut others = moving().filter(|k| *k != most).peekable();
    others.peek()?;
    others.all(|k| mass(&most) >= OUTWEIGHS * mass(&k)).then_some(most)
}

/// A color made darker or brighter, clipped at white.
fn shade((r, g, b): Rgb, light: f64) -> Rgb {
    let scaled = |c: u8| (f64::from(c) * light).round().clamp(0.0, 255.0) as u8;
    (scaled(r), scaled(g), scaled(b))
}

fn rgb(color: plotters::style::RGBColor) -> Rgb {
    (color.0, color.1, color.2)
}

fn color(color: plotters::style::RGBColor) -> String {
    hex(rgb(color))
}
