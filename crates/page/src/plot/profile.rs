//! Performance profiles of many methods in panels: each group of methods has one for each column,
//! and two panels stand side by side, or one on a narrow picture. Each panel also shows the methods
//! of the other groups, pale.

use plotters::prelude::*;

use super::axis::{Axis, Scale};
use super::canvas::{Anchor, Canvas, Frame, dashes, fine, stroke};
use super::cut::cut;
use super::marker::{draw_markers, marker_places};
use super::style::{self, FAINT_INK, GRID, INK, TEXT};
use crate::csv;
use crate::figure::Figure;
use crate::number::readable;

const TOP: f64 = 46.0;
const HEIGHT: f64 = 105.0;
const LEFT: f64 = 54.0;
const GAP: f64 = 26.0;
/// The height of the title of a panel.
const HEAD: f64 = 22.0;
/// From the top of a panel to that of the next one below.
const BELOW: f64 = HEIGHT + 28.0 + HEAD;
const SAMPLE: f64 = 30.0;
const LINE: f64 = 20.0;
const PALE: RGBColor = RGBColor(214, 217, 222);

/// Step functions in a grid of panels.
#[derive(Debug, Clone)]
pub struct Profiles {
    /// See [`Figure::id`].
    pub id: String,
    /// See [`Figure::title`].
    pub title: String,
    /// See [`Figure::caption`].
    pub caption: String,
    /// The ratio τ ≥ 1, logarithmic.
    pub x: Axis,
    /// The fraction of problems, from 0 to 1.
    pub y: Axis,
    /// The titles of the columns, from left to right.
    pub columns: Vec<String>,
    /// The groups, from top to bottom.
    pub groups: Vec<Group>,
}

/// A line of panels.
#[derive(Debug, Clone)]
pub struct Group {
    /// The name of the group.
    pub name: String,
    /// One for each method.
    pub curves: Vec<Curve>,
}

/// The profiles of one method.
#[derive(Debug, Clone)]
pub struct Curve {
    /// The method; it determines the color ([`style::style`]).
    pub name: String,
    /// For each column the steps (τ, fraction), with τ increasing, and the number of problems.
    pub columns: Vec<(Vec<(f64, f64)>, usize)>,
}

impl Curve {
    /// The name; of several columns with the numbers of problems: `pgs (40)`, or `pgs (40, 38)` if
    /// they differ.
    fn label(&self) -> String {
        if self.columns.len() == 1 {
            return self.name.clone();
        }
        let mut counts: Vec<String> = self.columns.iter().map(|(_, n)| n.to_string()).collect();
        counts.dedup();
        format!("{} ({})", self.name, counts.join(", "))
    }
}

impl Profiles {
    /// The decimal logarithms of 1 and of the largest τ.
    fn range(&self) -> (f64, f64) {
        let steps = self.groups.iter().flat_map(|group| &group.curves).flat_map(|c| &c.columns);
        let taus = steps.flat_map(|(steps, _)| steps).map(|(tau, _)| tau.log10());
        let most = taus.filter(|log| log.is_finite()).fold(0.5, f64::max);
        (-0.02 * most, 1.05 * most)
    }
}

/// The corners of a step function over positions, from its left end to `right`.
fn corners(steps: &[(f64, f64)], (left, right): (f64, f64)) -> Vec<(f64, f64)> {
    let mut share = 0.0;
    let mut corners = vec![(left, 0.0)];
    for (tau, next) in steps {
        let at = tau.log10();
        corners.extend([(at, share), (at, *next)]);
        share = *next;
    }
    corners.push((right, share));
    corners
}

impl Figure for Profiles {
    fn id(&self) -> &str {
        &self.id
    }

    fn title(&self) -> &str {
        &self.title
    }

    fn caption(&self) -> &str {
        &self.caption
    }

    fn drawn(&self, wide: f64, id: &str) -> String {
        let across = if wide < style::WIDTH { 1 } else { self.columns.len().max(2) };
        let width = (wide - 2.0 * style::EDGE + GAP) / across as f64 - GAP - LEFT;
        let pitch = width + LEFT + GAP;
        let lines = self.columns.len().div_ceil(across);
        let panels = lines as f64 * BELOW - HEAD;
        // The groups side by side, and the width of each.
        let beside = (across / self.columns.len().max(1)).max(1);
        let share = (wide - 2.0 * style::EDGE + GAP) / beside as f64 - GAP;
        let legends: Vec<_> = self.groups.iter().map(|group| Legend::of(group, share)).collect();
        let head = |legends: &[Legend]| {
            let lines = legends.iter().map(|legend| legend.lines).max().unwrap_or(0);
            30.0 + LINE * lines as f64 + if self.columns.len() > 1 { HEAD } else { 6.0 }
        };
        let total: f64 = legends.chunks(beside).map(|legends| head(legends) + panels).sum();
        let (mut canvas, lower) = Canvas::titled(wide, TOP + total + 30.0, &self.title);
        let x = self.range();
        let mut top = TOP + lower;
        for (first, legends) in legends.chunks(beside).enumerate() {
            let above = top + head(legends);
            for (j, legend) in legends.iter().enumerate() {
                let (k, edge) = (first * beside + j, style::EDGE + (share + GAP) * j as f64);
                legend.draw(&mut canvas, &self.groups[k], (edge, top));
                for (c, column) in self.columns.iter().enumerate() {
                    let left = edge + LEFT + pitch * (c % across) as f64;
                    let top = above + BELOW * (c / across) as f64;
                    let (right, bottom) = (left + width, top + HEIGHT);
                    let frame = Frame { x, y: (0.0, 1.04), left, right, top, bottom };
                    self.draw_panel(&mut canvas, &frame, k, c);
                    canvas.text((left, top - 7.0), Anchor::Start, TEXT, FAINT_INK, column);
                }
                for line in 0..lines {
                    let middle = above + BELOW * line as f64 + HEIGHT / 2.0;
                    let (x, y) = (edge + 12.0, middle);
                    canvas.raw(&format!("<g transform=\"rotate(-90 {x:.1} {y:.1})\">"));
                    canvas.text((x, y), Anchor::Middle, 13.0, FAINT_INK, &self.y.heading());
                    canvas.raw("</g>\n");
                }
            }
            top = above + panels;
        }
        let middle = (wide / 2.0, top + 14.0);
        canvas.text(middle, Anchor::Middle, TEXT, INK, &self.x.heading());
        canvas.finish(id, &self.title, &self.description())
    }

    /// One record per step: column, method, problems, τ, fraction.
    fn csv(&self) -> String {
        let mut out = String::new();
        let heads = ["panel", "method", "problems", &self.x.heading(), &self.y.heading()];
        csv::record(&mut out, heads);
        for curve in self.groups.iter().flat_map(|group| &group.curves) {
            for (column, (steps, problems)) in self.columns.iter().zip(&curve.columns) {
                for (tau, share) in steps {
                    let numbers = [problems.to_string(), csv::number(*tau), csv::number(*share)];
                    let words = [column.clone(), curve.name.clone()];
                    csv::record(&mut out, words.into_iter().chain(numbers));
                }
            }
        }
        out
    }
}

impl Profiles {
    fn description(&self) -> String {
        let end = |steps: &[(f64, f64)]| steps.last().map_or(0.0, |(_, share)| *share);
        let start = |steps: &[(f64, f64)]| {
            steps.iter().take_while(|(tau, _)| *tau <= 1.0).last().map_or(0.0, |(_, share)| *share)
        };
        let mut text = String::new();
        for (c, column) in self.columns.iter().enumerate() {
            let curves = self.groups.iter().flat_map(|group| &group.curves);
            let words: Vec<String> = curves
                .filter_map(|curve| Some((&curve.name, curve.columns.get(c)?)))
                .map(|(name, (steps, problems))| {
                    let (start, end) = (readable(start(steps), 2), readable(end(steps), 2));
                    format!("{name} from {start} to {end} of {problems}")
                })
                .collect();
            text += &format!("{column}: {}. ", words.join("; "));
        }
        text.trim().into()
    }

    fn draw_panel(&self, canvas: &mut Canvas, frame: &Frame, own: usize, column: usize) {
        let columns = self.x.scale.ticks(frame.x, 6);
        let rows = Scale::Linear.ticks((0.0, 1.0), 4);
        canvas.layer("class=\"grid\"", |layer| {
            let plane = frame.plane(layer);
            let upright = columns.iter().map(|tick| [(tick.at, 0.0), (tick.at, frame.y.1)]);
            let level = rows.iter().map(|tick| [(frame.x.0, tick.at), (frame.x.1, tick.at)]);
            upright
                .chain(level)
                .try_for_each(|ends| plane.draw(&PathElement::new(ends, stroke(GRID, 1.0))))
        });
        for tick in &rows {
            let (_, y) = frame.place((frame.x.0, tick.at));
            canvas.text((frame.left - 6.0, y + 4.0), Anchor::End, 13.0, FAINT_INK, &tick.label);
        }
        for tick in &columns {
            let (x, _) = frame.place((tick.at, 0.0));
            let at = (x, frame.bottom + 16.0);
            canvas.text(at, Anchor::Middle, 13.0, FAINT_INK, &tick.label);
        }
        let draw = |canvas: &mut Canvas, curve: &Curve, color, width, dash: &[u32]| {
            let Some((steps, _)) = curve.columns.get(column) else { return };
            let runs = cut(&corners(steps, frame.x), frame.x, frame.y);
            canvas.layer(&dashes(dash), |layer| {
                let plane = frame.plane(layer);
                runs.into_iter()
                    .try_for_each(|run| plane.draw(&PathElement::new(run, stroke(color, width))))
            });
        };
        for (k, group) in self.groups.iter().enumerate() {
            for curve in group.curves.iter().filter(|_| k != own) {
                draw(canvas, curve, PALE, 1.0, &[]);
            }
        }
        let group = &self.groups[own];
        for (k, (curve, look)) in group.curves.iter().zip(group.looks()).enumerate() {
            let (r, g, b) = look.color;
            draw(canvas, curve, RGBColor(r, g, b), style::LINE, look.dash);
            let Some((steps, _)) = curve.columns.get(column) else { continue };
            let places = corners(steps, frame.x).into_iter().map(|point| frame.place(point));
            let inside = places.filter(|(x, _)| *x < frame.right - 1.0).collect::<Vec<_>>();
            let spots = marker_places(&inside, frame.left, k);
            draw_markers(canvas, &spots, look.marker, RGBColor(r, g, b));
        }
    }
}

impl Group {
    fn looks(&self) -> Vec<style::Style> {
        let names: Vec<&str> = self.curves.iter().map(|curve| curve.name.as_str()).collect();
        style::styles(&names)
    }
}

/// The names above the panels of a group, and their positions.
struct Legend {
    entries: Vec<(String, (f64, f64))>,
    lines: usize,
}

impl Legend {
    fn of(group: &Group, wide: f64) -> Self {
        let (mut x, mut line) = (0.0, 0);
        let mut entries = Vec::new();
        for label in group.curves.iter().map(Curve::label) {
            let length = SAMPLE + 8.0 + style::width(&label, TEXT);
            if x + length > wide && x > 0.0 {
                (x, line) = (0.0, line + 1);
            }
            entries.push((label, (x, LINE * line as f64)));
            x += length + 18.0;
        }
        Legend { entries, lines: line + 1 }
    }

    fn draw(&self, canvas: &mut Canvas, group: &Group, (left, top): (f64, f64)) {
        canvas.text((left, top + 16.0), Anchor::Start, 15.0, INK, &group.name);
        for ((label, (x, y)), look) in self.entries.iter().zip(group.looks()) {
            let (x, y) = (left + x, top + 34.0 + y);
            let (r, g, b) = look.color;
            let ends = [(x, y), (x + SAMPLE, y)].map(|(x, y)| (fine(x), fine(y)));
            canvas.layer(&dashes(look.dash), |layer| {
                layer.draw(&PathElement::new(ends, stroke(RGBColor(r, g, b), style::LINE)))
            });
            draw_markers(canvas, &[(x + SAMPLE / 2.0, y)], look.marker, RGBColor(r, g, b));
            canvas.text((x + SAMPLE + 8.0, y + 5.0), Anchor::Start, TEXT, INK, label);
        }
    }
}
