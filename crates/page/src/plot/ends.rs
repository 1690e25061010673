//! Labels of curves: right of the frame where a curve reaches it, otherwise inside the plot, where
//! they cover no curve ([`place`]). A thin line leads to the curve.
//!
//! [`place`]: super::place

use std::collections::BTreeMap;

use plotters::prelude::*;

use super::axis::Axis;
use super::canvas::{Anchor, Canvas, Frame, escape, fine, stroke};
use super::legend::Drawn;
use super::line::Lines;
use super::marker::marker_places;
use super::panel::Panel;
use super::place::{Map, Place, Wanted, steps};
use super::series::{Look, Series};
use super::style::{self, INK, TEXT, width};

/// The height of a line of text, and the length of the line to a label, in px.
const LINE: f64 = 16.0;
const LEADER: f64 = 14.0;
/// The width of the marker between that line and a label right of the frame, in px.
const SPOT: f64 = 11.0;
/// A curve whose last point is beyond this fraction of the width reaches the right edge; separate
/// points do so earlier, because no line leads to a label inside.
const REACHES: f64 = 0.93;
const POINTS_REACH: f64 = 0.7;
/// The largest fraction of a figure's width that the labels take.
const MOST: f64 = 0.36;

/// With more labels inside, those of a narrow picture cover the curves, and a [`Key`] shows all; so
/// it does with fewer if it is needed for the labels right of the frame.
///
/// [`Key`]: super::key::Key
const MOST_INSIDE: usize = 4;
const MOST_WITH_KEY: usize = 0;
/// The least heights of a panel with labels inside, the only one or of several, and of one with a
/// key above it, in px.
const INSIDE: (f64, f64) = (280.0, 230.0);
const CROWDED: f64 = 230.0;
/// The cost of a px between the end of a curve and its label, relative to a px of distance.
const ALONG: f64 = 0.12;
/// Ends that are less than this apart share a leader, or are at the same height, in px.
const SAME: f64 = 3.0;
const LEVEL: f64 = 0.5;
/// Curves join where their ends are at most this part of the axis apart, and are separate where
/// their starts are at least this part apart.
const TOGETHER: f64 = 0.02;
const SEPARATE: f64 = 0.06;
/// The distance between two points of a curve next to which a label can stand, in px.
const APART: f64 = 20.0;

/// A label, the end of its curve (px), and its color.
struct End<'a> {
    name: &'a str,
    text: &'a str,
    at: (f64, f64),
    color: RGBColor,
    /// Whether its marker stands before a label right of the frame; next to points it would look
    /// like one of them.
    has_marker: bool,
}

/// The names and labels of a panel's curves.
fn labels(panel: &Panel) -> impl Iterator<Item = (&Series, &str)> {
    let labels = panel.series.iter().filter_map(|series| Some((series, series.end.as_deref()?)));
    labels.filter(|(_, label)| !label.is_empty())
}

/// Whether the label of a curve stands right of the frame: it reaches the right edge of the axis
/// with these ends, is data, and does not join others there.
fn reaches(figure: &Lines, panel: &Panel, series: &Series, x: (f64, f64)) -> bool {
    if series.look == Look::Reference || joins(panel, series) {
        return false;
    }
    let last = last(series).and_then(|point| figure.x.scale.position(point.0));
    last.is_some_and(|last| last > x.0 + reach(series) * (x.1 - x.0))
}

/// The part of the width beyond which a curve reaches the right edge.
fn reach(series: &Series) -> f64 {
    let is_path = series.look == Look::Points && series.points.len() > 1;
    if is_path { POINTS_REACH } else { REACHES }
}

/// Whether a curve ends where several others do, and starts apart from them: its label stands near
/// its start.
fn joins(panel: &Panel, series: &Series) -> bool {
    let curves = || labels(panel).filter(|(own, _)| own.look == Look::Measured);
    let shown = |(_, y): &(f64, f64)| panel.y.scale.position(*y);
    let all = || curves().flat_map(|(own, _)| own.points.iter().filter_map(shown));
    let (lo, hi) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
    let start = |own: &Series| own.points.iter().find_map(shown);
    let end = |own: &Series| own.points.iter().rev().find_map(shown);
    let within = |a: Option<f64>, b: Option<f64>, part: f64| {
        a.zip(b).is_some_and(|(a, b)| (a - b).abs() < part * (hi - lo))
    };
    let others = || curves().map(|(own, _)| own).filter(|own| own.name != series.name);
    let joined = || others().filter(|own| within(end(own), end(series), TOGETHER));
    let is_apart = joined().all(|own| !within(start(own), start(series), SEPARATE));
    series.look == Look::Measured && joined().count() > 1 && is_apart
}

/// The names and labels of a panel's curves that reach the right edge of the axis with these ends.
fn reaching<'a>(
    figure: &Lines,
    panel: &'a Panel,
    x: (f64, f64),
) -> impl Iterator<Item = (&'a str, &'a str)> {
    let own = labels(panel).filter(move |(series, _)| reaches(figure, panel, series, x));
    own.map(|(series, label)| (series.name.as_str(), label))
}

/// Whether a picture of this width has no room for the labels inside.
pub(super) fn is_crowded(figure: &Lines, x: (f64, f64), wide: f64) -> bool {
    let widest = figure.panels.iter().flat_map(|panel| reaching(figure, panel, x));
    let widest = widest.map(|(_, label)| width(label, TEXT)).fold(0.0, f64::max);
    let most = if widest > MOST * wide { MOST_WITH_KEY } else { MOST_INSIDE };
    let inside = |panel: &Panel| {
        let curves = labels(panel).filter(|(series, _)| series.look != Look::Reference);
        curves.filter(|(series, _)| !reaches(figure, panel, series, x)).count()
    };
    wide < style::WIDTH && figure.panels.iter().map(inside).any(|own| own > most)
}

/// The names and labels that a [`Key`] shows: all in a crowded picture, otherwise those of the
/// curves that reach the right edge.
///
/// [`Key`]: super::key::Key
pub(super) fn keyed<'a>(
    figure: &Lines,
    panel: &'a Panel,
    x: (f64, f64),
    wide: f64,
) -> Vec<(&'a str, &'a str)> {
    match is_crowded(figure, x, wide) {
        true => {
            let own = labels(panel).filter(|(series, _)| series.look != Look::Reference);
            own.map(|(series, label)| (series.name.as_str(), label)).collect()
        }
        false => reaching(figure, panel, x).collect(),
    }
}

/// The width (px) right of the frame that labels need; 0 if there are none, or if they do not fit
/// a narrow picture and a [`Key`] shows them above each panel.
///
/// [`Key`]: super::key::Key
pub(super) fn room(figure: &Lines, x: (f64, f64), wide: f64) -> f64 {
    let beside = figure.panels.iter().flat_map(|panel| reaching(figure, panel, x));
    let widest = beside.map(|(_, label)| width(label, TEXT)).fold(0.0, f64::max);
    let is_narrow = wide < style::WIDTH && widest > MOST * wide;
    if widest == 0.0 || is_narrow || is_crowded(figure, x, wide) {
        return 0.0;
    }
    widest.min(MOST * wide) + LEADER + SPOT + 4.0
}

/// The height (px) that the labels of a panel need: those right of the frame stand below each
/// other.
pub(super) fn height(
    figure: &Lines,
    panel: &Panel,
    x: (f64, f64),
    (room, wide): (f64, f64),
) -> f64 {
    if is_crowded(figure, x, wide) {
        return if labels(panel).next().is_some() { CROWDED } else { 0.0 };
    }
    let lines = |label: &str| style::wrapped(label, TEXT, room - LEADER - SPOT).len();
    let beside: usize = match room > 0.0 {
        true => reaching(figure, panel, x).map(|(_, label)| lines(label)).sum(),
        false => 0,
    };
    let least = if figure.panels.len() > 1 { INSIDE.1 } else { INSIDE.0 };
    let has_inside = labels(panel).count() > reaching(figure, panel, x).count();
    f64::max(LINE * beside as f64, if has_inside { least } else { 0.0 })
}

/// The last point that can be shown.
fn last(series: &Series) -> Option<(f64, f64)> {
    series.points.iter().rev().find(|(x, y)| x.is_finite() && y.is_finite()).copied()
}

/// Draws the labels of a panel; those right of the frame, if there is room, end at `edge` (px).
/// With `only_references`, a key shows the others.
pub(super) fn draw(
    canvas: &mut Canvas,
    frame: &Frame,
    (x, panel): (&Axis, &Panel),
    looks: &BTreeMap<&str, Drawn>,
    (edge, only_references): (f64, bool),
) {
    let (mut beside, mut inside, mut wanted) = (Vec::new(), Vec::new(), Vec::new());
    for (series, text) in labels(panel) {
        let mut path = path(frame, (x, panel), series);
        let Some(&at) = path.last() else { continue };
        let color = match looks[series.name.as_str()].color {
            _ if series.look == Look::Theory => style::FAINT_INK,
            color => color,
        };
        let has_marker = series.look != Look::Points;
        let end = End { name: &series.name, text, at, color, has_marker };
        let is_line = series.look == Look::Reference;
        if only_references && !is_line {
            continue;
        }
        let joins = joins(panel, series);
        let reach = frame.left + reach(series) * (frame.right - frame.left);
        if at.0 > reach && !joins && !is_line {
            beside.push(end);
            continue;
        }
        if joins {
            path.reverse();
        }
        let points = match series.look {
            Look::Points => path.into_iter().rev().collect(),
            _ => along(&path),
        };
        // A straight line is the same everywhere.
        let along = if is_line { 0.0 } else { ALONG };
        inside.push(end);
        wanted.push(Wanted { size: (width(text, TEXT), LINE), points, along });
    }
    if frame.right < edge {
        draw_beside(canvas, frame, beside, (looks, edge));
    }
    if !inside.is_empty() {
        draw_inside(canvas, map(frame, (x, panel)), &inside, &wanted);
    }
}

/// The points of a curve (px), within the frame.
fn path(frame: &Frame, (x, panel): (&Axis, &Panel), series: &Series) -> Vec<(f64, f64)> {
    let place = |&(a, b): &(f64, f64)| {
        let height = b.is_finite().then(|| panel.y.scale.position(b).unwrap_or(frame.y.0))?;
        let (a, b) = frame.place((x.scale.position(a)?, height));
        Some((a.clamp(frame.left, frame.right), b.clamp(frame.top, frame.bottom)))
    };
    series.points.iter().filter_map(place).collect()
}

/// Points of a curve next to which its label can stand, from its end to its start.
fn along(path: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut points: Vec<(f64, f64)> = path.last().copied().into_iter().collect();
    for ends in path.windows(2).rev() {
        for point in steps(ends[1], ends[0], APART) {
            let last = points.last().copied().unwrap_or(point);
            if (point.0 - last.0).hypot(point.1 - last.1) >= APART {
                points.push(point);
            }
        }
    }
    points
}

/// What the curves of a panel and their markers cover.
fn map(frame: &Frame, (x, panel): (&Axis, &Panel)) -> Map {
    let mut map = Map::new(frame);
    let is_drawn = |series: &&Series| series.look != Look::Theory;
    for series in panel.series.iter().filter(is_drawn) {
        let path = path(frame, (x, panel), series);
        match series.look {
            Look::Points => path.iter().for_each(|point| map.marker(*point)),
            _ if series.is_spot() => path.iter().for_each(|point| map.marker(*point)),
            _ => map.line(&path),
        }
    }
    let curves = panel.series.iter().filter(|series| series.look.is_measured()).enumerate();
    for (k, series) in curves.filter(|(_, series)| series.look == Look::Measured) {
        let path = path(frame, (x, panel), series);
        marker_places(&path, frame.left, k).into_iter().for_each(|point| map.marker(point));
    }
    map
}

fn draw_beside(
    canvas: &mut Canvas,
    frame: &Frame,
    mut ends: Vec<End<'_>>,
    (looks, edge): (&BTreeMap<&str, Drawn>, f64),
) {
    let order: Vec<&str> = ends.iter().map(|end| end.name).collect();
    let place = |end: &End<'_>| order.iter().position(|name| *name == end.name);
    ends.sort_by(|a, b| a.at.1.total_cmp(&b.at.1));
    // Ends at the same height keep the order of the curves.
    for group in ends.chunk_by_mut(|a, b| (b.at.1 - a.at.1).abs() < LEVEL) {
        group.sort_by_key(|end| place(end));
    }
    let left = frame.right + LEADER;
    let texts: Vec<_> =
        ends.iter().map(|end| style::wrapped(end.text, TEXT, edge - left - SPOT)).collect();
    let sizes: Vec<_> = texts.iter().map(|lines| LINE * lines.len() as f64).collect();
    let wanted: Vec<_> = ends.iter().map(|end| end.at.1).collect();
    let places = apart(&wanted, &sizes, (frame.top - 8.0, frame.bottom + 8.0));
    let is_shared = |k: usize| {
        let near = |other: &End<'_>| (other.at.1 - ends[k].at.1).abs() < SAME;
        ends.iter().filter(|other| near(other)).count() > 2
    };
    for (k, (end, lines)) in ends.iter().zip(texts).enumerate() {
        let (middle, size) = (places[k], sizes[k]);
        open(canvas, end);
        let (start, bend) = ((frame.right, end.at.1), frame.right + LEADER / 2.0);
        let stop = left - 3.0 + if end.has_marker { 0.0 } else { SPOT };
        match is_shared(k) {
            true => {
                let path = [start, (bend, end.at.1), (bend, middle), (stop, middle)];
                lead(canvas, end, &path);
            }
            false => lead(canvas, end, &[end.at, start, (stop, middle)]),
        }
        if end.has_marker {
            looks[end.name].mark(canvas, &[(left + 3.0, middle)]);
        }
        for (k, line) in lines.iter().enumerate() {
            let y = middle - size / 2.0 + LINE * (k as f64 + 0.5) + 4.5;
            canvas.text((left + SPOT, y), Anchor::Start, TEXT, INK, line);
        }
        canvas.raw("</g>\n");
    }
}

fn draw_inside(canvas: &mut Canvas, mut map: Map, ends: &[End<'_>], labels: &[Wanted]) {
    for (end, place) in ends.iter().zip(map.labels(labels)) {
        let Some(place) = place else { continue };
        open(canvas, end);
        lead(canvas, end, &[place.from, place.to()]);
        canvas.raw(
            "<g stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\" \
             stroke-linejoin=\"round\">",
        );
        let Place { middle: (x, y), .. } = place;
        canvas.text((x, y + 4.5), Anchor::Middle, TEXT, INK, end.text);
        canvas.raw("</g></g>\n");
    }
}

/// Opens the group of a label, which shows and hides its curve on a page.
fn open(canvas: &mut Canvas, end: &End<'_>) {
    canvas.raw(&format!("<g class=\"entry\" data-series=\"{}\">\n", escape(end.name)));
}

fn lead(canvas: &mut Canvas, end: &End<'_>, path: &[(f64, f64)]) {
    canvas.layer("stroke-linejoin=\"round\"", |layer| {
        let path: Vec<_> = path.iter().map(|(x, y)| (fine(*x), fine(*y))).collect();
        layer.draw(&PathElement::new(path, stroke(end.color, 1.0)))
    });
}

/// The middles of intervals of these sizes, near the wanted places (sorted) and within the limits
/// if they fit: overlapping intervals form a block around the mean of what they want.
fn apart(wanted: &[f64], sizes: &[f64], (low, high): (f64, f64)) -> Vec<f64> {
    // A block: the mean start that its members want, their number and their total size.
    let mut blocks: Vec<(f64, usize, f64)> = Vec::new();
    let within = |start: f64, size: f64| start.min(high - size).max(low);
    for (at, size) in wanted.iter().zip(sizes) {
        let mut block = (at - size / 2.0, 1, *size);
        while let Some(&(start, count, length)) = blocks.last() {
            if within(start, length) + length <= within(block.0, block.2) {
                break;
            }
            let total = (count + block.1) as f64;
            let mean = (start * count as f64 + (block.0 - length) * block.1 as f64) / total;
            block = (mean, count + block.1, length + block.2);
            blocks.pop();
        }
        blocks.push(block);
    }
    let mut middles = Vec::new();
    for (start, count, length) in blocks {
        let mut at = within(start, length);
        for _ in 0..count {
            let size = sizes[middles.len()];
            middles.push(at + size / 2.0);
            at += size;
        }
    }
    middles
}
