//! The legend of a line figure: the names and the drawing style of each.

use std::collections::BTreeMap;

use plotters::prelude::*;

use super::canvas::{Anchor, Canvas, dashes, escape, fine, stroke};
use super::line::{Lines, MARGIN, ROW};
use super::marker::{draw_markers, draw_rings, draw_zeros};
use super::series::Look;
use super::style::{self, FAINT_INK, INK, Marker, Style, TEXT, THEORY, width};

/// The legend's text for the mark of a zero, which a logarithmic axis cannot show.
const EXACTLY_ZERO: &str = "exactly 0";
/// The entry of all theories that belong to curves.
const THEORIES: &str = "theory";
/// The length in px of the piece of a curve beside its name.
pub(super) const SAMPLE: f64 = 40.0;

/// The drawing style of a name in this figure.
pub(super) struct Drawn {
    pub color: RGBColor,
    /// The line width; 0 for markers only.
    pub width: f64,
    pub dash: &'static [u32],
    marker: Option<Marker>,
}

impl Drawn {
    /// Draws a piece of the curve, with a marker, to the right of this point (px).
    pub fn sample(&self, canvas: &mut Canvas, (x, y): (f64, f64)) {
        let ends = [(x, y), (x + SAMPLE, y)].map(|(x, y)| (fine(x), fine(y)));
        if self.width > 0.0 {
            canvas.layer(&dashes(self.dash), |layer| {
                layer.draw(&PathElement::new(ends, stroke(self.color, self.width)))
            });
        }
        self.mark(canvas, &[(x + SAMPLE / 2.0, y)]);
    }

    /// Draws the curve's markers at these points in px.
    pub fn mark(&self, canvas: &mut Canvas, spots: &[(f64, f64)]) {
        if let Some(marker) = self.marker {
            draw_markers(canvas, spots, marker, self.color);
        }
    }
}

/// The names above the panels, and the drawing style of each.
pub(super) struct Legend<'a> {
    /// The names in order of appearance, with their positions in px.
    entries: Vec<(&'a str, (f64, f64))>,
    pub looks: BTreeMap<&'a str, Drawn>,
    /// The entry of the spots.
    spots: Option<&'a str>,
    pub rows: usize,
}

impl<'a> Legend<'a> {
    /// The legend of a figure of this width (px).
    pub fn new(figure: &'a Lines, room: f64) -> Self {
        let mut kinds: Vec<(&str, Look)> = Vec::new();
        for series in figure.panels.iter().flat_map(|panel| &panel.series) {
            if kinds.iter().all(|(name, _)| *name != series.name) {
                kinds.push((&series.name, series.look));
            }
        }
        kinds.sort_by_key(|(_, look)| !look.is_measured());
        let named = |wanted| kinds.iter().filter(move |(_, look)| *look == wanted);
        let measured: Vec<_> = kinds.iter().filter(|(_, look)| look.is_measured()).collect();
        let names: Vec<&str> = measured.iter().map(|(name, _)| *name).collect();
        let mut looks: BTreeMap<&str, Drawn> = BTreeMap::new();
        looks.extend(measured.into_iter().zip(style::styles(&names)).map(
            |((name, look), style)| {
                let Style { color: (r, g, b), dash, marker } = style;
                let color = RGBColor(r, g, b);
                let width = if *look == Look::Points { 0.0 } else { style::LINE };
                (*name, Drawn { color, width, dash, marker: Some(marker) })
            },
        ));
        // The band of a curve has a pale tint of its color.
        let tints: Vec<(&str, RGBColor)> = named(Look::Theory)
            .filter_map(|(name, _)| {
                let curve = looks.iter().find(|(curve, _)| belongs(name, curve))?;
                Some((*name, style::tint(curve.1.color)))
            })
            .collect();
        looks.extend(named(Look::Theory).map(|(name, _)| {
            let tint = tints.iter().find(|(own, _)| own == name).map(|(_, tint)| *tint);
            let color = tint.unwrap_or(THEORY);
            (*name, Drawn { color, width: style::BAND, dash: &[], marker: None })
        }));
        // A spot has the color of its curve.
        let colors: Vec<RGBColor> = named(Look::Reference)
            .map(|(name, _)| {
                let curve = looks.iter().find(|(curve, _)| belongs(name, curve));
                curve.map_or(INK, |(_, drawn)| drawn.color)
            })
            .collect();
        looks.extend(named(Look::Reference).zip(colors).map(|((name, _), color)| {
            (*name, Drawn { color, width: style::THIN, dash: &[], marker: None })
        }));

        let (mut x, mut row) = (style::EDGE, 0);
        let mut entries = Vec::new();
        let zero = figure.has_zeros().then_some(EXACTLY_ZERO);
        // A curve with a label at its end has no entry; the theories of curves share one.
        let series = || figure.panels.iter().flat_map(|panel| &panel.series);
        let labeled = |name: &str| series().any(|other| other.end.is_some() && other.name == name);
        let belongs = |name: &str| figure.names().any(|other| belongs(name, other));
        let is_listed = |name: &&str| !labeled(name) && !belongs(name);
        let theory = shared(&kinds, Look::Theory, belongs);
        let spots = shared(&kinds, Look::Reference, belongs);
        if let Some(theory) = theory {
            let band = Drawn { color: THEORY, width: style::BAND, dash: &[], marker: None };
            looks.insert(theory, band);
        }
        let listed = kinds.iter().map(|(name, _)| *name).filter(is_listed);
        for name in listed.chain(theory).chain(spots).chain(zero) {
            let length = SAMPLE + 8.0 + width(name, TEXT);
            if x + length > room - MARGIN && x > style::EDGE {
                (x, row) = (style::EDGE, row + 1);
            }
            entries.push((name, (x, 53.0 + ROW * row as f64)));
            x += length + 20.0;
        }
        Legend { rows: if entries.is_empty() { 0 } else { row + 1 }, entries, looks, spots }
    }

    /// Draws it, lower by this distance (px).
    pub fn draw(&self, canvas: &mut Canvas, lower: f64) {
        for (name, (x, y)) in &self.entries {
            let y = y + lower;
            let middle = (x + SAMPLE / 2.0, y);
            let Some(drawn) = self.looks.get(name) else {
                match self.spots == Some(name) {
                    true => draw_rings(canvas, &[middle], FAINT_INK),
                    false => draw_zeros(canvas, &[middle], FAINT_INK),
                }
                self.name(canvas, name, middle);
                continue;
            };
            canvas.raw(&format!("<g class=\"entry\" data-series=\"{}\">\n", escape(name)));
            drawn.sample(canvas, (*x, y));
            self.name(canvas, name, middle);
            canvas.raw("</g>\n");
        }
    }

    fn name(&self, canvas: &mut Canvas, name: &str, (middle, y): (f64, f64)) {
        let at = (middle + SAMPLE / 2.0 + 8.0, y + 5.0);
        canvas.text(at, Anchor::Start, TEXT, INK, name);
    }
}

/// The entry of all theories, or of all spots, that belong to curves: what their names say after a
/// colon, if that is the same.
fn shared<'a>(
    kinds: &[(&'a str, Look)],
    wanted: Look,
    belongs: impl Fn(&str) -> bool,
) -> Option<&'a str> {
    let own = kinds.iter().filter(|(name, look)| *look == wanted && belongs(name));
    let said: Vec<&str> =
        own.map(|(name, _)| name.split_once(": ").map_or(THEORIES, |(_, said)| said)).collect();
    let first = said.first()?;
    Some(if said.iter().all(|own| own == first) { first } else { THEORIES })
}

/// The attribute that names the curve to which a theory belongs; empty without one.
pub(super) fn of<'a>(name: &str, mut names: impl Iterator<Item = &'a str>) -> String {
    let of = names.find(|other| belongs(name, other));
    of.map_or(String::new(), |of| format!(" data-of=\"{}\"", escape(of)))
}

/// Whether a name marks the theory of a curve: `theory, NAME` or `theory, NAME: …`.
fn belongs(theory: &str, curve: &str) -> bool {
    let rest = theory.strip_prefix("theory, ").and_then(|rest| rest.strip_prefix(curve));
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(':'))
}
