//! Line charts over a common x axis, in one panel or several stacked ones.

use std::collections::BTreeMap;

use plotters::prelude::*;

use super::axis::{Axis, Scale, Tick};
use super::canvas::{Anchor, Canvas, Frame, dashes, escape, fine, stroke};
use super::cut::cut;
use super::ends;
use super::key::Key;
use super::legend::{self, Drawn, Legend};
use super::marker::{draw_rings, draw_zeros, marker_places};
use super::panel::Panel;
use super::points::{self, Placed};
use super::series::{Look, Series};
use super::simplify::simplified;
use super::style::{self, FAINT_INK, GRID, INK, TEXT, width};
use crate::csv;
use crate::figure::Figure;
use crate::number::readable;

/// The space right of the plots in px.
pub(super) const MARGIN: f64 = 12.0;

/// The width for a tick on the x axis in px, and that for one at the data.
const TICK: f64 = 90.0;
const CLOSE: f64 = 54.0;

/// The distance from one panel to the next in px.
const BETWEEN: f64 = 44.0;

/// The lengths of ticks without labels in px: where the linear part of an axis ends, and others.
const LONG: f64 = 12.0;
const SHORT: f64 = 4.0;

/// The heights of a panel to scale in px, and about what the labels left of it take.
const LOWEST_MAP: f64 = 160.0;
const HIGHEST_MAP: f64 = 640.0;
const LABELS: f64 = 50.0;

/// Bands of theory that end within this fraction of the range beyond it are not cut.
const BEYOND: f64 = 0.2;
/// Height of a line of the legend in px.
pub(super) const ROW: f64 = 24.0;

/// Curves over a common x axis; several panels are stacked.
///
/// ```
/// use lcplab_page::figure::Figure;
/// use lcplab_page::plot::{Axis, Lines, Series};
///
/// let points = || vec![(0.0, 1.0), (1.0, 0.25)];
/// let series = vec![
///     Series::measured("pgs", points()).labeled("rate ¼"),
///     Series::points("samples", points()),
///     Series::theory("theory, pgs", points()),
///     Series::reference("tolerance", vec![(0.0, 0.1), (1.0, 0.1)]),
/// ];
/// let (x, y) = (Axis::linear("sweep", ""), Axis::log("residual", ""));
/// assert_eq!(series[0].size(), 1.0); // the largest magnitude
/// assert_eq!(Series::spot("pgs", "half", (0.5, 0.5)).points.len(), 1); // a ring on its curve
/// let lines = Lines::new("rate", "PGS converges by ¼ per sweep", "", x, y, series);
/// let lines = lines.with_scales_explained(); // adds nothing: no axis is symmetric
/// assert!(lines.svg().contains("rate ¼"));
/// assert_eq!(lines.csv().lines().count(), 1 + 8); // a heading, and a record for each point
/// ```
#[derive(Debug, Clone)]
pub struct Lines {
    /// See [`Figure::id`].
    pub id: String,
    /// See [`Figure::title`].
    pub title: String,
    /// See [`Figure::caption`].
    pub caption: String,
    /// The common x axis of all panels.
    pub x: Axis,
    /// From top to bottom.
    pub panels: Vec<Panel>,
}

impl Lines {
    /// Curves in a single panel.
    pub fn new(
        id: impl Into<String>,
        title: impl Into<String>,
        caption: impl Into<String>,
        x: Axis,
        y: Axis,
        series: Vec<Series>,
    ) -> Self {
        let (id, title, caption) = (id.into(), title.into(), caption.into());
        Lines { id, title, caption, x, panels: vec![Panel { y, series }] }
    }

    /// The same; the caption explains symmetric axes, if there are any.
    pub fn with_scales_explained(mut self) -> Self {
        let is_symmetric = |panel: &Panel| matches!(panel.y.scale, Scale::Symmetric(_));
        if self.panels.iter().any(is_symmetric) {
            self.caption += " An axis with 0 and powers of ten is linear near 0, up to the long ticks, and logarithmic \
                 beyond; the short ticks are 1, 2 and 5 times powers of ten.";
        }
        self
    }

    /// Ticks at the data, with this space (px per unit of position); `None` if they would be too
    /// close, or are not at whole numbers of a linear axis.
    fn at_data(&self, space: f64) -> Option<Vec<Tick>> {
        let series = self.panels.iter().flat_map(|panel| &panel.series);
        let measured = series.filter(|series| series.look.is_measured());
        let mut data: Vec<f64> = measured.flat_map(|own| own.points.iter().map(|p| p.0)).collect();
        data.sort_by(f64::total_cmp);
        data.dedup();
        let tick = |at: f64| {
            let digits = if at.fract() == 0.0 { 16 } else { 3 };
            let is_shown = self.x.scale == Scale::Log || digits > 3;
            Some(Tick { at: self.x.scale.position(at)?, label: readable(at, digits) })
                .filter(|_| is_shown)
        };
        let ticks: Vec<Tick> = data.into_iter().map(tick).collect::<Option<_>>()?;
        let gaps = ticks.windows(2).map(|pair| pair[1].at - pair[0].at);
        let least = space * gaps.fold(f64::INFINITY, f64::min);
        (ticks.len() > 1 && least >= CLOSE).then_some(ticks)
    }
}

impl Figure for Lines {
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
        let legend = Legend::new(self, wide);
        let all = || self.panels.iter().flat_map(|panel| &panel.series);
        let x = range(self.x.scale, all(), |(x, _)| x);
        let room = ends::room(self, x, wide);
        let header = 44.0 + ROW * legend.rows as f64;
        let usual = match (self.panels.len() < 2, wide < style::WIDTH) {
            (true, false) => 340.0,
            (true, true) => 230.0,
            (false, false) if self.panels.len() > 2 => 170.0,
            (false, false) => 200.0,
            (false, true) if self.panels.len() > 2 => 110.0,
            (false, true) => 150.0,
        };
        let map = |panel: &Panel| {
            let y = range(panel.y.scale, panel.series.iter(), |(_, y)| y);
            (wide - MARGIN - room - LABELS) * (y.1 - y.0) / (x.1 - x.0)
        };
        let plot = |panel: &Panel| match panel.y.is_to_scale {
            true => map(panel).clamp(LOWEST_MAP, HIGHEST_MAP),
            false => ends::height(self, panel, x, (room, wide)).max(usual),
        };
        let heights: Vec<f64> = self.panels.iter().map(plot).collect();
        let key = |panel| match room > 0.0 {
            true => None,
            false => Some(Key::new(panel, self, x, wide)),
        };
        let keys: Vec<Option<Key>> = self.panels.iter().map(key).collect();
        let above = |k: usize| keys[k].as_ref().map_or(0.0, |key| key.height);
        let total: f64 =
            heights.iter().enumerate().map(|(k, plot)| above(k) + plot + BETWEEN).sum();
        let height = header + total + 36.0;
        let (mut canvas, lower) = Canvas::titled(wide, height, &self.title);
        let crowded = ends::is_crowded(self, x, wide);
        let header = header + lower;
        legend.draw(&mut canvas, lower);

        let wanted = ((wide - room) / TICK) as usize;
        let at_data = self.at_data((wide - MARGIN - room - LABELS) / (x.1 - x.0));
        let columns = at_data.unwrap_or_else(|| self.x.ticks(x, wanted));
        let ranges = self.panels.iter().zip(&heights).map(|(panel, plot)| {
            let y = range(panel.y.scale, panel.series.iter(), |(_, y)| y);
            (y, panel.y.ticks(y, if *plot > 250.0 { 8 } else { 5 }))
        });
        let mut ranges: Vec<_> = ranges.collect();
        let labels = ranges.iter().flat_map(|(_, rows)| rows).map(|row| width(&row.label, TEXT));
        let left = style::EDGE + 8.0 + labels.fold(32.0, f64::max);
        let right = wide - MARGIN - room;
        for (k, (y, rows)) in ranges.iter_mut().enumerate() {
            if self.panels[k].y.is_to_scale {
                let half = 0.5 * heights[k] * (x.1 - x.0) / (right - left);
                *y = (0.5 * (y.0 + y.1) - half, 0.5 * (y.0 + y.1) + half);
                *rows = self.panels[k].y.ticks(*y, (heights[k] / 40.0) as usize);
            }
        }
        let mut top = header + 32.0;
        for (k, (panel, (y, rows))) in self.panels.iter().zip(&ranges).enumerate() {
            let plot = heights[k];
            canvas.text((style::EDGE, top - 12.0), Anchor::Start, TEXT, INK, &panel.y.heading());
            if let Some(key) = &keys[k] {
                key.draw(&mut canvas, top - 4.0, &legend.looks);
            }
            top += above(k);
            let frame = Frame { x, y: *y, left, right, top, bottom: top + plot };
            let last = k + 1 == self.panels.len();
            draw_grid(&mut canvas, &frame, &columns, rows, last);
            draw_minor(&mut canvas, &frame, panel.y.scale);
            canvas.raw(&points::panel(&frame, &self.x, Some(&panel.y)));
            self.draw_curves(&mut canvas, &frame, panel, &legend.looks);
            canvas.raw("</g>\n");
            let axes = (&self.x, panel);
            ends::draw(&mut canvas, &frame, axes, &legend.looks, (wide - MARGIN, crowded));
            if last {
                let middle = (left + right) / 2.0;
                let at = (middle, frame.bottom + 42.0);
                canvas.text(at, Anchor::Middle, TEXT, INK, &self.x.heading());
            }
            top += plot + BETWEEN;
        }
        canvas.finish(id, &self.title, &self.description())
    }

    /// One record per point: series, kind, x, and y in the column of its panel.
    fn csv(&self) -> String {
        let mut out = String::new();
        let mut heads = vec!["series".to_string(), "kind".to_string(), self.x.heading()];
        heads.extend(self.panels.iter().map(|panel| panel.y.heading()));
        csv::record(&mut out, &heads);
        for (k, panel) in self.panels.iter().enumerate() {
            for series in &panel.series {
                for (x, y) in &series.points {
                    let mut fields = vec![String::new(); 3 + self.panels.len()];
                    fields[0] = series.name.clone();
                    fields[1] = series.look.word().into();
                    fields[2] = csv::number(*x);
                    fields[3 + k] = csv::number(*y);
                    csv::record(&mut out, &fields);
                }
            }
        }
        out
    }
}

impl Lines {
    /// The names of all curves.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.panels.iter().flat_map(|panel| &panel.series).map(|series| series.name.as_str())
    }

    /// A description of the picture in words.
    fn description(&self) -> String {
        let mut text = String::new();
        for panel in &self.panels {
            text += &format!("{} against {}: ", panel.y.heading(), self.x.heading());
            let curves: Vec<_> = panel.series.iter().map(Series::description).collect();
            text += &format!("{}. ", curves.join("; "));
        }
        text.trim().into()
    }

    fn draw_curves(
        &self,
        canvas: &mut Canvas,
        frame: &Frame,
        panel: &Panel,
        looks: &BTreeMap<&str, Drawn>,
    ) {
        let (measured, others): (Vec<&Series>, Vec<&Series>) =
            panel.series.iter().partition(|series| series.look.is_measured());
        // Rings lie above the curves.
        let mut spots = Vec::new();
        for series in others {
            let of = legend::of(&series.name, self.names());
            canvas.raw(&format!(
                "<g class=\"series\" data-series=\"{}\"{of}>\n",
                escape(&series.name)
            ));
            let drawn = &looks[series.name.as_str()];
            let shown = self.draw_line(canvas, frame, panel, series, drawn);
            if series.is_spot() {
                spots.push((shown, drawn.color, of));
            }
            canvas.raw("</g>\n");
        }
        for (k, series) in measured.into_iter().enumerate() {
            let drawn = &looks[series.name.as_str()];
            canvas.raw(&format!(
                "<g class=\"series\" data-series=\"{0}\" data-points=\"{1}\"><title>{0}</title>\n",
                escape(&series.name),
                points::listed(&self.places(frame, panel, series))
            ));
            let shown = self.draw_line(canvas, frame, panel, series, drawn);
            match series.look {
                Look::Points => drawn.mark(canvas, &shown),
                _ => drawn.mark(canvas, &marker_places(&shown, frame.left, k)),
            }
            let mut zeros: Vec<_> = self
                .zeros(panel, series)
                .map(|x| (frame.place((x, frame.y.0)).0, frame.bottom - 6.0))
                .collect();
            zeros.dedup_by(|a, b| (a.0 - b.0).abs() < 14.0);
            draw_zeros(canvas, &zeros, drawn.color);
            canvas.raw("</g>\n");
        }
        for (shown, color, of) in spots {
            canvas.raw(&format!("<g class=\"series\"{of}>\n"));
            draw_rings(canvas, &shown, color);
            canvas.raw("</g>\n");
        }
    }

    /// Draws the curve; returns the points drawn, in px.
    fn draw_line(
        &self,
        canvas: &mut Canvas,
        frame: &Frame,
        panel: &Panel,
        series: &Series,
        drawn: &Drawn,
    ) -> Vec<(f64, f64)> {
        let place =
            |(x, y): &(f64, f64)| Some((self.x.scale.position(*x)?, panel.y.scale.position(*y)?));
        let places: Vec<_> = series.points.iter().map(place).collect();
        if series.look == Look::Points {
            return places.into_iter().flatten().map(|point| frame.place(point)).collect();
        }
        let runs: Vec<Vec<(f64, f64)>> = places
            .split(Option::is_none)
            .map(|run| thin(run.iter().flatten().copied(), |point| frame.place(point)))
            .collect();
        // Predictions are clipped at the frame; measured curves have determined its size.
        let inside = runs.iter().flat_map(|run| cut(run, frame.x, frame.y));
        let inside: Vec<_> =
            inside.map(|run| simplified(&run, |point| frame.place(point))).collect();
        canvas.layer(&dashes(drawn.dash), |layer| {
            let plane = frame.plane(layer);
            inside.iter().filter(|run| run.len() > 1).try_for_each(|run| {
                plane.draw(&PathElement::new(run.clone(), stroke(drawn.color, drawn.width)))
            })
        });
        runs.into_iter().flatten().map(|point| frame.place(point)).collect()
    }

    /// The points of a curve with their positions in px; a zero that the axis cannot show lies on
    /// the frame.
    fn places(&self, frame: &Frame, panel: &Panel, series: &Series) -> Vec<Placed> {
        let place = |&(x, y): &(f64, f64)| {
            let zero = (y == 0.0).then_some(frame.y.0);
            let at = (self.x.scale.position(x)?, panel.y.scale.position(y).or(zero)?);
            Some(frame.place(at))
        };
        series.points.iter().map(|point| (*point, place(point))).collect()
    }

    /// The x at which a curve is exactly zero although its axis cannot show zero.
    fn zeros<'a>(&self, panel: &Panel, series: &'a Series) -> impl Iterator<Item = f64> + 'a {
        let (across, shown) = (self.x.scale, panel.y.scale == Scale::Log);
        let zeros = series.points.iter().filter(move |(_, y)| shown && *y == 0.0);
        zeros.filter_map(move |(x, _)| across.position(*x))
    }

    pub(super) fn has_zeros(&self) -> bool {
        self.panels.iter().any(|panel| {
            let measured = panel.series.iter().filter(|series| series.look.is_measured());
            measured.into_iter().any(|series| self.zeros(panel, series).next().is_some())
        })
    }
}

/// The range of the measured curves on an axis, and of bands of theory that go little beyond; of
/// all curves if none is measured.
fn range<'a>(
    scale: Scale,
    series: impl Iterator<Item = &'a Series> + Clone,
    coordinate: impl Fn((f64, f64)) -> f64,
) -> (f64, f64) {
    let positions = |wanted: fn(Look) -> bool| {
        let chosen = series.clone().filter(move |series| wanted(series.look));
        let points = chosen.flat_map(|series| series.points.iter().copied());
        scale.range(points.filter_map(|point| scale.position(coordinate(point))))
    };
    let Some((lo, hi)) = positions(Look::is_measured) else {
        return positions(|_| true).unwrap_or((0.0, 1.0));
    };
    let theory = positions(|look| look == Look::Theory).unwrap_or((lo, hi));
    let beyond = BEYOND * (hi - lo);
    let lo = if theory.0 > lo - beyond { lo.min(theory.0) } else { lo };
    (lo, if theory.1 < hi + beyond { hi.max(theory.1) } else { hi })
}

fn draw_grid(canvas: &mut Canvas, frame: &Frame, columns: &[Tick], rows: &[Tick], labels: bool) {
    canvas.layer("class=\"grid\"", |layer| {
        let plane = frame.plane(layer);
        let upright = columns.iter().map(|tick| [(tick.at, frame.y.0), (tick.at, frame.y.1)]);
        let level = rows.iter().map(|tick| [(frame.x.0, tick.at), (frame.x.1, tick.at)]);
        upright
            .chain(level)
            .try_for_each(|ends| plane.draw(&PathElement::new(ends, stroke(GRID, 1.0))))?;
        let base = PathElement::new(
            [(frame.x.0, frame.y.0), (frame.x.1, frame.y.0)],
            stroke(FAINT_INK, 1.0),
        );
        plane.draw(&base)
    });
    for tick in rows {
        let (_, y) = frame.place((frame.x.0, tick.at));
        canvas.text((frame.left - 8.0, y + 4.5), Anchor::End, TEXT, FAINT_INK, &tick.label);
    }
    for tick in columns.iter().filter(|_| labels) {
        let (x, _) = frame.place((tick.at, frame.y.0));
        let x = x.min(frame.right + MARGIN - 0.5 * width(&tick.label, TEXT));
        canvas.text((x, frame.bottom + 19.0), Anchor::Middle, TEXT, FAINT_INK, &tick.label);
    }
}

/// Draws the ticks without labels at the left edge.
fn draw_minor(canvas: &mut Canvas, frame: &Frame, scale: Scale) {
    let ticks = scale.minor(frame.y);
    if ticks.is_empty() {
        return;
    }
    canvas.layer("", |layer| {
        ticks.iter().try_for_each(|tick| {
            let (x, y) = frame.place((frame.x.0, tick.at));
            let length = if tick.is_end { LONG } else { SHORT };
            let ends = [(x, y), (x + length, y)].map(|(x, y)| (fine(x), fine(y)));
            layer.draw(&PathElement::new(ends, stroke(FAINT_INK, 1.0)))
        })
    });
}

/// Among consecutive points in the same pixel column, keeps the first, the lowest, the highest and
/// the last: the drawn line is the same.
fn thin(
    points: impl Iterator<Item = (f64, f64)>,
    place: impl Fn((f64, f64)) -> (f64, f64),
) -> Vec<(f64, f64)> {
    let points: Vec<_> = points.collect();
    let column = |point: &(f64, f64)| place(*point).0.floor();
    let mut kept = Vec::new();
    for group in points.chunk_by(|a, b| column(a) == column(b)) {
        let by_height = |a: &&usize, b: &&usize| group[**a].1.total_cmp(&group[**b].1);
        let indices: Vec<usize> = (0..group.len()).collect();
        let lowest = indices.iter().min_by(by_height);
        let highest = indices.iter().max_by(by_height);
        let mut chosen: Vec<_> =
            [indices.first(), lowest, highest, indices.last()].into_iter().flatten().collect();
        chosen.sort();
        chosen.dedup();
        kept.extend(chosen.into_iter().map(|i| group[*i]));
    }
    kept
}
