//! Paths in the plane of one row, x_i across and w_i upwards, beside the graph of the law: the three
//! segments on which a solution lies.

use plotters::prelude::*;

use super::axis::{Axis, Scale};
use super::canvas::{Anchor, Canvas, Frame, fine, stroke};
use super::cut::cut;
use super::style::{self, FAINT_INK, GRID, INK, TEXT};
use crate::csv;
use crate::figure::Figure;
use crate::number::{count, readable};

/// Size of a panel and what lies around it in px.
const HEIGHT: f64 = 220.0;
const LEFT: f64 = 52.0;
const TOP: f64 = 84.0;
const GAP: f64 = 18.0;
const BELOW: f64 = 64.0;
/// Width of the law's graph, and the radius of its ends, in px.
const LAW: f64 = 6.0;
const DOT: f64 = 3.0;

/// Paths of (x_i, w_i), two panels side by side, all on the same axes.
#[derive(Debug, Clone)]
pub struct Plane {
    /// See [`Figure::id`].
    pub id: String,
    /// See [`Figure::title`].
    pub title: String,
    /// See [`Figure::caption`].
    pub caption: String,
    /// x_i, with its unit.
    pub x: Axis,
    /// w_i, with its unit.
    pub w: Axis,
    /// The bounds of x_i: above the lower one w_i may be positive, at the upper one negative.
    pub bounds: (f64, f64),
    /// One a method.
    pub paths: Vec<Path>,
}

/// A path.
#[derive(Debug, Clone)]
pub struct Path {
    /// Whose; it decides the colour ([`style::style`]).
    pub name: String,
    /// (x_i, w_i) from the start on.
    pub points: Vec<(f64, f64)>,
}

impl Plane {
    /// The ranges of x and w that hold all paths, and the corners of the law that are near them.
    fn ranges(&self) -> [(f64, f64); 2] {
        let points = || self.paths.iter().flat_map(|path| &path.points);
        let x = Scale::Linear.range(points().map(|p| p.0).filter(|x| x.is_finite()));
        let w = points().map(|p| p.1).filter(|w| w.is_finite());
        let w = Scale::Linear.range(w.chain([0.0])).unwrap_or((-1.0, 1.0));
        let (lo, hi) = x.unwrap_or((-1.0, 1.0));
        let near = |bound: &f64| (bound - lo).abs().min((bound - hi).abs()) <= hi - lo;
        let corners = [self.bounds.0, self.bounds.1].map(|bound| Some(bound).filter(near));
        let all = [lo, hi].into_iter().chain(corners.into_iter().flatten());
        let x = Scale::Linear.range(all).unwrap_or((lo, hi));
        // Where a corner is seen, so is the segment that starts there.
        let room = 0.22 * (w.1 - w.0);
        let below = if corners[1].is_some() { w.0.min(-room) } else { w.0 };
        let above = if corners[0].is_some() { w.1.max(room) } else { w.1 };
        [x, (below, above)]
    }

    /// The graph: w ≥ 0 at the lower bound, w = 0 between, w ≤ 0 at the upper one.
    fn law(&self, x: (f64, f64), w: (f64, f64)) -> Vec<(f64, f64)> {
        let (lo, hi) = self.bounds;
        let from = if lo.is_finite() { vec![(lo, w.1), (lo, 0.0)] } else { vec![(x.0, 0.0)] };
        let to = if hi.is_finite() { vec![(hi, 0.0), (hi, w.0)] } else { vec![(x.1, 0.0)] };
        from.into_iter().chain(to).collect()
    }
}

impl Figure for Plane {
    fn id(&self) -> &str {
        &self.id
    }

    fn title(&self) -> &str {
        &self.title
    }

    fn caption(&self) -> &str {
        &self.caption
    }

    fn svg(&self) -> String {
        let width = (style::WIDTH - 2.0 * style::EDGE - GAP) / 2.0 - LEFT;
        let pitch = HEIGHT + BELOW;
        let lines = self.paths.len().div_ceil(2).max(1);
        let [x, w] = self.ranges();
        let mut canvas = Canvas::titled(TOP + pitch * lines as f64, &self.title);
        draw_key(&mut canvas);
        for (k, path) in self.paths.iter().enumerate() {
            let left = style::EDGE + LEFT + (LEFT + width + GAP) * (k % 2) as f64;
            let top = TOP + pitch * (k / 2) as f64;
            let frame = Frame { x, y: w, left, right: left + width, top, bottom: top + HEIGHT };
            self.draw_axes(&mut canvas, &frame);
            path.draw(&mut canvas, &frame, x, w);
        }
        let words: Vec<String> = self.paths.iter().map(Path::describe).collect();
        let (lo, hi) = (readable(self.bounds.0, 3), readable(self.bounds.1, 3));
        let description = format!(
            "Paths of {} and {} with bounds {lo} and {hi}. {}.",
            self.x.heading(),
            self.w.heading(),
            words.join("; ")
        );
        canvas.finish(&self.id, &self.title, &description)
    }

    /// One record a point: path, number from 0, x, w.
    fn csv(&self) -> String {
        let mut out = String::new();
        csv::record(&mut out, ["path", "number", &self.x.heading(), &self.w.heading()]);
        for path in &self.paths {
            for (k, (x, w)) in path.points.iter().enumerate() {
                let numbers = [k.to_string(), csv::number(*x), csv::number(*w)];
                csv::record(&mut out, [path.name.clone()].into_iter().chain(numbers));
            }
        }
        out
    }
}

impl Plane {
    fn draw_axes(&self, canvas: &mut Canvas, frame: &Frame) {
        let columns = Scale::Linear.ticks(frame.x, 5);
        let rows = Scale::Linear.ticks(frame.y, 5);
        canvas.layer("class=\"grid\"", |layer| {
            let plane = frame.plane(layer);
            let upright = columns.iter().map(|tick| [(tick.at, frame.y.0), (tick.at, frame.y.1)]);
            let level = rows.iter().map(|tick| [(frame.x.0, tick.at), (frame.x.1, tick.at)]);
            upright
                .chain(level)
                .try_for_each(|ends| plane.draw(&PathElement::new(ends, stroke(GRID, 1.0))))
        });
        let law = cut(&self.law(frame.x, frame.y), frame.x, frame.y);
        canvas.layer("class=\"law\" stroke-linejoin=\"round\" stroke-linecap=\"round\"", |layer| {
            let plane = frame.plane(layer);
            law.iter().try_for_each(|run| {
                plane.draw(&PathElement::new(run.clone(), stroke(LAW_INK, LAW)))
            })
        });
        for tick in &rows {
            let (_, y) = frame.place((frame.x.0, tick.at));
            canvas.text((frame.left - 6.0, y + 4.0), Anchor::End, 12.0, FAINT_INK, &tick.label);
        }
        for tick in &columns {
            let (x, _) = frame.place((tick.at, frame.y.0));
            let at = (x, frame.bottom + 16.0);
            canvas.text(at, Anchor::Middle, 12.0, FAINT_INK, &tick.label);
        }
        let middle = ((frame.left + frame.right) / 2.0, frame.bottom + 34.0);
        canvas.text(middle, Anchor::Middle, TEXT, INK, &self.x.heading());
        let upwards = (frame.right, frame.top - 8.0);
        canvas.text(upwards, Anchor::End, TEXT, INK, &self.w.heading());
    }
}

/// The colour of the law's graph.
const LAW_INK: RGBColor = RGBColor(196, 200, 206);

impl Path {
    fn draw(&self, canvas: &mut Canvas, frame: &Frame, x: (f64, f64), w: (f64, f64)) {
        let (r, g, b) = style::style(&self.name).color;
        let color = RGBColor(r, g, b);
        let name = (frame.left, frame.top - 8.0);
        canvas.text(name, Anchor::Start, TEXT, INK, &self.name);
        let finite = |p: &&(f64, f64)| p.0.is_finite() && p.1.is_finite();
        let points: Vec<(f64, f64)> = self.points.iter().filter(finite).copied().collect();
        let places: Vec<(f64, f64)> = points.iter().map(|point| frame.place(*point)).collect();
        canvas.layer("stroke-linejoin=\"round\"", |layer| {
            let plane = frame.plane(layer);
            cut(&points, x, w)
                .into_iter()
                .try_for_each(|run| plane.draw(&PathElement::new(run, stroke(color, style::THIN))))
        });
        canvas.layer("class=\"points\"", |layer| {
            apart(&places).try_for_each(|place| disc(layer, place, DOT, color.filled()))
        });
        let Some((first, last)) = places.first().zip(places.last()) else { return };
        canvas.layer("class=\"ends\"", |layer| {
            disc(layer, *last, DOT + 2.5, INK.filled())?;
            disc(layer, *first, DOT + 2.5, style::PAPER.filled())?;
            disc(layer, *first, DOT + 2.5, stroke(INK, 1.6))
        });
    }

    fn describe(&self) -> String {
        let place = |p: &(f64, f64)| format!("({}, {})", readable(p.0, 2), readable(p.1, 2));
        match (self.points.first(), self.points.last()) {
            (Some(first), Some(last)) => format!(
                "{} goes from {} to {} in {} steps",
                self.name,
                place(first),
                place(last),
                count(self.points.len() - 1)
            ),
            _ => format!("{} has no points", self.name),
        }
    }
}

/// The places that the eye can tell from the one before.
fn apart(places: &[(f64, f64)]) -> impl Iterator<Item = (f64, f64)> + '_ {
    let mut last: Option<(f64, f64)> = None;
    places.iter().copied().filter(move |place| {
        let far = last.is_none_or(|last| (last.0 - place.0).hypot(last.1 - place.1) > 1.0);
        if far {
            last = Some(*place);
        }
        far
    })
}

fn disc<E: std::fmt::Debug + std::error::Error + Send + Sync>(
    layer: &DrawingArea<impl DrawingBackend<ErrorType = E>, plotters::coord::Shift>,
    (x, y): (f64, f64),
    radius: f64,
    look: ShapeStyle,
) -> Result<(), DrawingAreaErrorKind<E>> {
    layer.draw(&Circle::new((fine(x), fine(y)), fine(radius), look))
}

fn draw_key(canvas: &mut Canvas) {
    let y = 50.0;
    let ends = [(style::EDGE, y), (style::EDGE + 34.0, y)].map(|(x, y)| (fine(x), fine(y)));
    canvas.layer("stroke-linecap=\"round\"", |layer| {
        layer.draw(&PathElement::new(ends, stroke(LAW_INK, LAW)))
    });
    canvas.text((style::EDGE + 44.0, y + 5.0), Anchor::Start, TEXT, INK, "the law");
    canvas.layer("class=\"ends\"", |layer| {
        disc(layer, (128.0, y), DOT + 2.5, stroke(INK, 1.6))?;
        disc(layer, (200.0, y), DOT + 2.5, INK.filled())
    });
    canvas.text((140.0, y + 5.0), Anchor::Start, TEXT, INK, "start");
    canvas.text((212.0, y + 5.0), Anchor::Start, TEXT, INK, "end");
}
