//! The drawing surface of a figure: layers drawn by plotters, in groups, with text written
//! directly.
//!
//! plotters writes integers, so a layer is drawn in tenths of a px and scaled down. Properties that
//! its backend does not support (dashes, joins, marker outlines, the name of a line) are attributes
//! of the group around a layer, which the shapes inherit.

use std::fmt::Write;

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use super::style::{self, FONTS, PAPER, WIDTH};
pub use crate::escape::xml_line as escape;

/// The number of drawing units per px.
const FINE: f64 = 10.0;
/// The width of bold text relative to that of normal text.
const BOLD: f64 = 1.17;
/// The height of a line of the title in px.
const LINE: f64 = 22.0;

/// A wide picture whose height is above this part of its width takes both columns of a sheet; above
/// the other part, a narrow one does not fit beside a table.
const BROAD: f64 = 0.85;
const TALL: f64 = 1.5;

/// The drawing area of plotters.
pub type Layer<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// A layer with axis positions as coordinates.
pub(super) type Plane<'a> =
    DrawingArea<SVGBackend<'a>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// The reference point of a text.
#[derive(Clone, Copy)]
pub enum Anchor {
    /// Its start.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}

/// The rectangle of a plot and the axis positions at its edges; sizes in px.
pub(super) struct Frame {
    pub x: (f64, f64),
    pub y: (f64, f64),
    pub left: f64,
    pub right: f64,
    pub top: f64,
    pub bottom: f64,
}

impl Frame {
    /// The layer with axis positions as coordinates.
    pub fn plane<'a>(&self, layer: &Layer<'a>) -> Plane<'a> {
        let columns = fine(self.left)..fine(self.right);
        let rows = fine(self.bottom)..fine(self.top);
        let coordinates = Cartesian2d::new(self.x.0..self.x.1, self.y.0..self.y.1, (columns, rows));
        layer.clone().apply_coord_spec(coordinates)
    }

    /// The point in px at these axis positions.
    pub fn place(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let across = (x - self.x.0) / (self.x.1 - self.x.0);
        let up = (y - self.y.0) / (self.y.1 - self.y.0);
        (self.left + across * (self.right - self.left), self.bottom - up * (self.bottom - self.top))
    }
}

/// An SVG document under construction.
///
/// ```
/// use lcplab_page::plot::canvas::{Anchor, Canvas, hex};
/// use lcplab_page::plot::style::INK;
///
/// let mut canvas = Canvas::new(100.0, 50.0);
/// canvas.raw(&format!(r#"<path d="M0 0H100" stroke="{}"/>"#, hex((0, 114, 178))));
/// canvas.text((50.0, 20.0), Anchor::Middle, 12.0, INK, "9.81 m/s²");
/// let svg = canvas.finish("g", "Gravity", "A line and a number.");
/// let (_, more) = Canvas::titled(100.0, 50.0, "A title of several lines");
/// assert!(more > 0.0); // px
/// assert!(svg.starts_with("<svg") && svg.contains("#0072b2") && svg.contains("9.81 m/s²"));
/// ```
pub struct Canvas {
    width: f64,
    height: f64,
    body: String,
}

impl Canvas {
    /// An empty canvas of this width and height (px).
    pub fn new(width: f64, height: f64) -> Self {
        let mut canvas = Canvas { width, height, body: String::new() };
        let corner = (fine(width), fine(height));
        canvas.layer("class=\"paper\"", |layer| {
            layer.draw(&Rectangle::new([(0, 0), corner], PAPER.filled()))
        });
        canvas
    }

    /// A canvas of this width, with a title in as many lines as it needs; `height` is that below
    /// the first line. Returns the height (px) of its other lines, too.
    pub fn titled(width: f64, height: f64, title: &str) -> (Self, f64) {
        let lines = style::balanced(title, style::TITLE * BOLD, width - 2.0 * style::EDGE);
        let more = LINE * lines.len().saturating_sub(1) as f64;
        let mut canvas = Canvas::new(width, height + more);
        for (k, line) in lines.iter().enumerate() {
            let at = (style::EDGE, 28.0 + LINE * k as f64);
            canvas.text(at, Anchor::Start, style::TITLE, style::INK, line);
        }
        (canvas, more)
    }

    /// Draws a layer into a group with these attributes.
    pub(crate) fn layer<T, E: std::fmt::Debug>(
        &mut self,
        attributes: &str,
        draw: impl FnOnce(&Layer) -> Result<T, E>,
    ) {
        let mut document = String::new();
        let size = (fine(self.width) as u32, fine(self.height) as u32);
        let layer = SVGBackend::with_string(&mut document, size).into_drawing_area();
        draw(&layer).expect("a string takes all that is written to it");
        drop(layer);
        let shapes = document.split_once('\n').map_or("", |(_, shapes)| shapes);
        let shapes = shapes.trim_end().trim_end_matches("</svg>");
        let shapes = shapes.replace(" opacity=\"1\"", "").replace(" \"/>", "\"/>");
        if !shapes.trim().is_empty() {
            self.raw(&format!("<g transform=\"scale(0.1)\" {attributes}>\n{shapes}</g>\n"));
        }
    }

    /// Draws the thin frame around a matrix or a panel, from its upper left corner.
    pub(super) fn outline(&mut self, (left, top): (f64, f64), (width, height): (f64, f64)) {
        let (right, bottom) = (left + width, top + height);
        let corners = [(left, top), (right, top), (right, bottom), (left, bottom), (left, top)];
        self.layer("class=\"frame\"", |layer| {
            let corners = corners.map(|(x, y)| (fine(x), fine(y)));
            layer.draw(&PathElement::new(corners, stroke(style::FAINT_INK, 1.0)))
        });
    }

    /// Writes a text with its baseline at y.
    pub fn text(&mut self, at: (f64, f64), anchor: Anchor, size: f64, color: RGBColor, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let weight = if size > style::TEXT { " font-weight=\"600\"" } else { "" };
        let _ = writeln!(
            self.body,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\" font-size=\"{size}\"{weight} \
             fill=\"{}\">{}</text>",
            at.0,
            at.1,
            hex((color.0, color.1, color.2)),
            escape(text)
        );
    }

    /// Appends markup unchanged.
    pub fn raw(&mut self, markup: &str) {
        self.body.push_str(markup);
    }

    /// The document, with its title and description for screen readers; without a title the
    /// description is its name.
    pub fn finish(self, id: &str, title: &str, description: &str) -> String {
        let title = if title.is_empty() { description } else { title };
        let (id, title, description) = (escape(id), escape(title), escape(description));
        let class = match self.height / self.width {
            ratio if self.width >= WIDTH && ratio > BROAD => " class=\"broad\"",
            ratio if self.width < WIDTH && ratio > TALL => " class=\"tall\"",
            _ => "",
        };
        // To a screen reader an image is one thing, so that links in it could not be reached.
        let role = if self.body.contains("<a ") { "group" } else { "img" };
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\"{class} width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" role=\"{role}\" aria-labelledby=\"{id}-title {id}-desc\" \
             font-family=\"{FONTS}\">\n<title id=\"{id}-title\">{title}</title>\n\
             <desc id=\"{id}-desc\">{description}</desc>\n{body}</svg>\n",
            width = self.width,
            height = self.height,
            body = self.body
        )
    }
}

/// A length in px in plotters' units.
pub(crate) fn fine(px: f64) -> i32 {
    (px * FINE).round() as i32
}

/// A line of this width in px.
pub(crate) fn stroke(color: RGBColor, width: f64) -> ShapeStyle {
    color.stroke_width(fine(width) as u32)
}

/// The group attributes for a dashed line.
pub(super) fn dashes(pattern: &[u32]) -> String {
    let lengths: Vec<_> = pattern.iter().map(|length| fine((*length).into()).to_string()).collect();
    let dash = match lengths.is_empty() {
        true => String::new(),
        false => format!(" stroke-dasharray=\"{}\"", lengths.join(" ")),
    };
    format!("stroke-linejoin=\"round\"{dash}")
}

/// A color as `#0072b2`.
pub fn hex((r, g, b): (u8, u8, u8)) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}
