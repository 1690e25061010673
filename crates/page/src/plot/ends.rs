//! Labels at the ends of curves: right of the frame where a curve reaches it, otherwise upright
//! next to its last point. Labels are moved apart, and a thin line leads to the end.

use std::collections::BTreeMap;

use plotters::prelude::*;

use super::axis::Axis;
use super::canvas::{Anchor, Canvas, Frame, escape, fine, stroke};
use super::legend::Drawn;
use super::line::{Lines, Look, Panel, Series};
use super::style::{self, INK, TEXT, width};

/// The height of a line of text, and the length of the line to a label, in px.
const LINE: f64 = 16.0;
const LEADER: f64 = 14.0;
/// A curve whose last point is within this fraction of the right edge reaches it.
const REACHES: f64 = 0.93;
/// The largest fraction of a figure's width that the labels take.
const MOST: f64 = 0.36;

/// With more upright labels, those of a narrow picture cover the curves, and a [`Key`] shows all.
///
/// [`Key`]: super::key::Key
const MOST_UPRIGHT: usize = 2;
/// The least height of the panel that then has them above it, in px.
const CROWDED: f64 = 230.0;

/// A label, the end of its curve (px), and its color.
struct End<'a> {
    name: &'a str,
    text: &'a str,
    at: (f64, f64),
    color: RGBColor,
    /// The distance of an upright label from the end (px).
    shift: f64,
}

/// The names and labels of a panel's curves.
fn labels(panel: &Panel) -> impl Iterator<Item = (&Series, &str)> {
    let labels = panel.series.iter().filter_map(|series| Some((series, series.end.as_deref()?)));
    labels.filter(|(_, label)| !label.is_empty())
}

/// Whether a curve reaches the right edge of the axis with these ends.
fn reaches(figure: &Lines, series: &Series, x: (f64, f64)) -> bool {
    let last = last(series).and_then(|point| figure.x.scale.position(point.0));
    last.is_some_and(|last| last > x.0 + REACHES * (x.1 - x.0))
}

/// The names and labels of a panel's curves that reach the right edge of the axis with these ends.
fn reaching<'a>(
    figure: &Lines,
    panel: &'a Panel,
    x: (f64, f64),
) -> impl Iterator<Item = (&'a str, &'a str)> {
    let own = labels(panel).filter(move |(series, _)| reaches(figure, series, x));
    own.map(|(series, label)| (series.name.as_str(), label))
}

/// Whether a picture of this width has no room for the upright labels.
pub(super) fn is_crowded(figure: &Lines, x: (f64, f64), wide: f64) -> bool {
    let upright = |panel| labels(panel).filter(|(series, _)| !reaches(figure, series, x)).count();
    wide < style::WIDTH && figure.panels.iter().map(upright).any(|own| own > MOST_UPRIGHT)
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
        true => labels(panel).map(|(series, label)| (series.name.as_str(), label)).collect(),
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
    widest.min(MOST * wide) + LEADER + 4.0
}

/// The height (px) that the labels of a panel need: those right of the frame below each other,
/// those inside upright in one half.
pub(super) fn height(
    figure: &Lines,
    panel: &Panel,
    x: (f64, f64),
    (room, wide): (f64, f64),
) -> f64 {
    if is_crowded(figure, x, wide) {
        return if labels(panel).next().is_some() { CROWDED } else { 0.0 };
    }
    let lines = |label: &str| style::wrapped(label, TEXT, room - LEADER).len();
    let beside: usize = match room > 0.0 {
        true => reaching(figure, panel, x).map(|(_, label)| lines(label)).sum(),
        false => 0,
    };
    let longest = labels(panel).map(|(_, label)| width(label, TEXT)).fold(0.0, f64::max);
    let upright = labels(panel).count() > reaching(figure, panel, x).count();
    f64::max(LINE * beside as f64, if upright { 2.4 * longest } else { 0.0 })
}

/// The last point that can be shown.
fn last(series: &Series) -> Option<(f64, f64)> {
    series.points.iter().rev().find(|(x, y)| x.is_finite() && y.is_finite()).copied()
}

/// Draws the labels of a panel; those right of the frame, if there is room, end at `edge` (px).
pub(super) fn draw(
    canvas: &mut Canvas,
    frame: &Frame,
    (x, panel): (&Axis, &Panel),
    looks: &BTreeMap<&str, Drawn>,
    edge: f64,
) {
    let end = |series: &'_ Series| -> Option<(f64, f64)> {
        let (a, b) = last(series)?;
        let at = (x.scale.position(a)?, panel.y.scale.position(b).unwrap_or(frame.y.0));
        let (a, b) = frame.place(at);
        Some((a.clamp(frame.left, frame.right), b.clamp(frame.top, frame.bottom)))
    };
    let reach = frame.left + REACHES * (frame.right - frame.left);
    let ends = panel.series.iter().filter_map(|series| {
        let color = match looks[series.name.as_str()].color {
            _ if series.look == Look::Theory => style::FAINT_INK,
            color => color,
        };
        let text = series.end.as_deref().filter(|text| !text.is_empty())?;
        // The label of an upright line stands beside its foot, not on it.
        let (at, shift) = match (end(series)?, series.look) {
            ((x, _), Look::Reference) if x < reach => ((x, frame.bottom), 11.0),
            (at, _) => (at, 0.0),
        };
        Some(End { name: &series.name, text, at, color, shift })
    });
    let (beside, inside): (Vec<_>, Vec<_>) = ends.partition(|end| end.at.0 > reach);
    if frame.right < edge {
        draw_beside(canvas, frame, beside, edge);
    }
    draw_upright(canvas, frame, inside);
}

fn draw_beside(canvas: &mut Canvas, frame: &Frame, mut ends: Vec<End<'_>>, edge: f64) {
    ends.sort_by(|a, b| a.at.1.total_cmp(&b.at.1));
    let left = frame.right + LEADER;
    let texts: Vec<_> =
        ends.iter().map(|end| style::wrapped(end.text, TEXT, edge - left)).collect();
    let sizes: Vec<_> = texts.iter().map(|lines| LINE * lines.len() as f64).collect();
    let wanted: Vec<_> = ends.iter().map(|end| end.at.1).collect();
    let places = apart(&wanted, &sizes, (frame.top - 8.0, frame.bottom + 8.0));
    for ((end, lines), (middle, size)) in ends.iter().zip(texts).zip(places.iter().zip(&sizes)) {
        open(canvas, end);
        lead(canvas, end, &[end.at, (frame.right, end.at.1), (left - 3.0, *middle)]);
        for (k, line) in lines.iter().enumerate() {
            let y = middle - size / 2.0 + LINE * (k as f64 + 0.5) + 4.5;
            canvas.text((left, y), Anchor::Start, TEXT, INK, line);
        }
        canvas.raw("</g>\n");
    }
}

/// Upright labels: down from the end if there is room for it, otherwise up.
fn draw_upright(canvas: &mut Canvas, frame: &Frame, mut ends: Vec<End<'_>>) {
    let goes_up = |end: &End<'_>| end.at.1 + LEADER + width(end.text, TEXT) > frame.bottom;
    // A falling curve arrives from the upper left.
    let beside = |end: &End<'_>| if goes_up(end) && end.shift == 0.0 { 8.0 } else { end.shift };
    let place = |end: &End<'_>| end.at.0 + beside(end);
    ends.sort_by(|a, b| place(a).total_cmp(&place(b)));
    let wanted: Vec<_> = ends.iter().map(place).collect();
    let places = apart(&wanted, &vec![LINE; ends.len()], (frame.left, frame.right));
    for (end, x) in ends.iter().zip(places) {
        let length = width(end.text, TEXT);
        let (y, anchor) = match goes_up(end) {
            true => ((end.at.1 - LEADER).max(frame.top + length), Anchor::Start),
            false => (end.at.1 + LEADER, Anchor::End),
        };
        open(canvas, end);
        if end.shift == 0.0 {
            lead(canvas, end, &[end.at, (x, y)]);
        }
        let base = x + 4.5;
        canvas.raw(&format!(
            "<g transform=\"rotate(-90 {base:.1} {y:.1})\" stroke=\"#ffffff\" stroke-width=\"3.5\" \
             paint-order=\"stroke\" stroke-linejoin=\"round\">"
        ));
        canvas.text((base, y), anchor, TEXT, INK, end.text);
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
