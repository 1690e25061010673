//! The matrix of a scene's contacts and joints, entry by entry, next to a picture of the scene;
//! below it, patterns of factors.

use std::fmt::Write;

use super::canvas::{Anchor, Canvas, escape, hex};
use super::small::{INDICES, Small};
use super::style::{self, FAINT_INK, INK, TEXT};
use crate::csv;
use crate::figure::Figure;

/// The width and height of the scene in px, and the gap between the parts.
pub const SCENE: (f64, f64) = (240.0, 400.0);
const GAP: f64 = 18.0;
const TOP: f64 = 58.0;
/// The maximum width of a factor with its indices in px.
const FACTOR: f64 = 260.0;
/// The height of the names of the colors in px.
const KEY: f64 = 34.0;
/// The matrix stands beside the scene if at least this width is left for it.
const LEAST: f64 = 300.0;
/// The colors of an entry between two rows of the first kind, of both kinds, of the second kind.
const COLORS: [(u8, u8, u8); 3] = [(0, 94, 170), (150, 90, 170), (226, 100, 10)];
/// The parts of white in a color: for entries of the largest size, and below two limits of
/// |a| relative to the largest.
const WHITE: [(f64, f64); 3] = [(0.3, 0.0), (0.03, 0.4), (0.0, 0.7)];

/// A scene, the matrix A of one of its steps, and factors.
#[derive(Debug, Clone)]
pub struct SceneMatrix {
    /// See [`Figure::id`].
    pub id: String,
    /// See [`Figure::title`].
    pub title: String,
    /// See [`Figure::caption`].
    pub caption: String,
    /// The scene as SVG of the size [`SCENE`], without an `<svg>` element, in which a group with
    /// the attribute `data-body` is the body of that number; empty without one.
    pub scene: String,
    /// Block with the same bodies, from first to last.
    pub blocks: Vec<Block>,
    /// The names of the two kinds of rows.
    pub kinds: [String; 2],
    /// The entries of A: row, column, value.
    pub entries: Vec<(usize, usize, f64)>,
    /// Patterns below the matrix.
    pub factors: Vec<Small>,
}

/// Consecutive rows with the same bodies.
#[derive(Debug, Clone)]
pub struct Block {
    /// Its name.
    pub name: String,
    /// The numbers of its moving bodies.
    pub bodies: Vec<usize>,
    /// For each row, whether it is of the second kind.
    pub second: Vec<bool>,
}

impl SceneMatrix {
    /// The first row of each block, and the number of rows.
    fn starts(&self) -> Vec<usize> {
        let mut starts = vec![0];
        starts.extend(self.blocks.iter().scan(0, |row, block| {
            *row += block.second.len();
            Some(*row)
        }));
        starts
    }

    /// The entries as one path for each color and size, in units of an entry.
    fn cells(&self) -> String {
        let second: Vec<bool> = self.blocks.iter().flat_map(|block| block.second.clone()).collect();
        let largest = self.entries.iter().map(|(.., a)| a.abs()).fold(0.0, f64::max);
        let mut paths = vec![String::new(); COLORS.len() * WHITE.len()];
        for &(i, j, a) in &self.entries {
            let kind = usize::from(second[i]) + usize::from(second[j]);
            let level = WHITE.iter().position(|(limit, _)| a.abs() >= limit * largest).unwrap_or(0);
            let _ = write!(paths[kind * WHITE.len() + level], "M{j} {i}h.84v.84h-.84z");
        }
        let mut markup = String::new();
        for (k, path) in paths.iter().enumerate().filter(|(_, path)| !path.is_empty()) {
            let color = tinted(COLORS[k / WHITE.len()], WHITE[k % WHITE.len()].1);
            let _ = writeln!(markup, "<path fill=\"{}\" d=\"{path}\"/>", hex(color));
        }
        markup
    }

    /// Draws the matrix with the lines and names of its blocks.
    fn matrix(&self, canvas: &mut Canvas, (left, top): (f64, f64), side: f64) {
        let starts = self.starts();
        let rows = starts.last().copied().unwrap_or(0).max(1) as f64;
        let scale = side / rows;
        canvas.raw(&format!(
            "<g transform=\"translate({left:.1} {top:.1}) scale({scale:.4})\">\n{}</g>\n",
            self.cells()
        ));
        let at = |row: usize| scale * row as f64;
        let line = hex((FAINT_INK.0, FAINT_INK.1, FAINT_INK.2));
        for &start in &starts {
            canvas.raw(&format!(
                "<path fill=\"none\" stroke=\"{line}\" stroke-width=\".7\" \
                 d=\"M{left:.1} {y:.1}h{side:.1}M{x:.1} {top:.1}v{side:.1}\"/>\n",
                y = top + at(start),
                x = left + at(start)
            ));
        }
        for (k, block) in self.blocks.iter().enumerate() {
            let middle = top + (at(starts[k]) + at(starts[k + 1])) / 2.0 + 4.5;
            canvas.text((left - 7.0, middle), Anchor::End, TEXT, INK, &block.name);
            let (x, y) = (left + middle - top, top - 7.0);
            canvas.raw(&format!("<g transform=\"rotate(-90 {x:.1} {y:.1})\">"));
            canvas.text((x, y), Anchor::Start, TEXT, INK, &block.name);
            canvas.raw("</g>\n");
            for (l, other) in self.blocks.iter().enumerate() {
                let shared: Vec<String> = block
                    .bodies
                    .iter()
                    .filter(|body| other.bodies.contains(body))
                    .map(ToString::to_string)
                    .collect();
                if shared.is_empty() {
                    continue;
                }
                canvas.raw(&format!(
                    "<rect class=\"pair\" data-bodies=\"{}\" fill=\"none\" pointer-events=\"all\" x=\"{:.1}\" \
                     y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\"><title>{} × {}</title></rect>\n",
                    shared.join(" "),
                    left + at(starts[l]),
                    top + at(starts[k]),
                    at(starts[l + 1]) - at(starts[l]),
                    at(starts[k + 1]) - at(starts[k]),
                    escape(&block.name),
                    escape(&other.name)
                ));
            }
        }
    }

    /// Draws the names of the colors from this point on, or farther left if they do not fit.
    fn legend(&self, canvas: &mut Canvas, (left, y): (f64, f64), wide: f64) {
        let [first, second] = &self.kinds;
        let names = [first.clone(), format!("{first} × {second}"), second.clone()];
        let used: Vec<bool> = self.blocks.iter().flat_map(|block| block.second.clone()).collect();
        let is_shown = |k: usize| used.contains(&(k > 0));
        let shown: Vec<_> = (0..names.len()).filter(|&k| is_shown(k)).collect();
        let width = |k: usize| 16.0 + style::width(&names[k], TEXT) + 16.0;
        let total: f64 = shown.iter().map(|&k| width(k)).sum();
        let mut x = left.min(wide - style::EDGE - total).max(style::EDGE);
        for k in shown {
            canvas.raw(&format!(
                "<rect x=\"{x:.1}\" y=\"{:.1}\" width=\"11\" height=\"11\" fill=\"{}\"/>\n",
                y - 10.0,
                hex(COLORS[k])
            ));
            canvas.text((x + 16.0, y), Anchor::Start, TEXT, FAINT_INK, &names[k]);
            x += width(k);
        }
    }

    /// The places of the parts in a picture of this width.
    fn layout(&self, wide: f64) -> Layout {
        let inner = wide - 2.0 * style::EDGE;
        let names = self.blocks.iter().map(|block| style::width(&block.name, TEXT));
        let names = names.fold(0.0, f64::max) + 10.0;
        let scene = if self.scene.is_empty() { (0.0, 0.0) } else { (SCENE.0 + GAP, SCENE.1) };
        let is_beside = scene.0 + names + LEAST < wide;
        let before = names + if is_beside { scene.0 } else { 0.0 };
        let side = (inner - before).min(SCENE.1);
        let scene_left = if is_beside { style::EDGE } else { (wide - SCENE.0) / 2.0 };
        let matrix_top = if is_beside { 0.0 } else { scene.1 + GAP };
        // The names stand upright above the columns, too.
        let above = names - 10.0;
        let matrix_end =
            matrix_top + if is_beside { (above + side).max(scene.1) } else { above + side };
        let columns = if wide < style::WIDTH { 1 } else { self.factors.len().max(1) };
        let factor = ((inner + GAP) / columns as f64 - GAP).min(FACTOR);
        let words = self.factors.iter().map(|own| own.above(factor)).fold(0.0, f64::max);
        let lines = self.factors.len().div_ceil(columns);
        let has_factors = !self.factors.is_empty();
        let factors_top = matrix_end + KEY + if has_factors { GAP } else { 0.0 };
        let pitch = words + factor - INDICES + GAP;
        let height = TOP + factors_top + lines as f64 * pitch + 10.0;
        let matrix = (style::EDGE + before, matrix_top + above);
        Layout { scene_left, matrix, side, matrix_end, factors_top, factor, columns, pitch, height }
    }
}

/// Where the parts of a picture stand (px), from the line below its title.
struct Layout {
    scene_left: f64,
    /// The left and upper edge of the matrix.
    matrix: (f64, f64),
    /// Its width and height.
    side: f64,
    /// The lower end of scene and matrix.
    matrix_end: f64,
    factors_top: f64,
    /// The width of a factor with its indices, the number side by side, and the distance from one
    /// to the next below it.
    factor: f64,
    columns: usize,
    pitch: f64,
    /// Of the whole picture.
    height: f64,
}

fn tinted((r, g, b): (u8, u8, u8), white: f64) -> (u8, u8, u8) {
    let tint = |c: u8| (f64::from(c) + white * (255.0 - f64::from(c))).round() as u8;
    (tint(r), tint(g), tint(b))
}

impl Figure for SceneMatrix {
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
        let at = self.layout(wide);
        let (mut canvas, lower) = Canvas::titled(wide, at.height, &self.title);
        let top = TOP + lower;
        if !self.scene.is_empty() {
            let (x, scene) = (at.scene_left, &self.scene);
            canvas.raw(&format!("<g transform=\"translate({x:.1} {top:.1})\">\n{scene}</g>\n"));
        }
        let (left, above) = at.matrix;
        self.matrix(&mut canvas, (left, top + above), at.side);
        self.legend(&mut canvas, (left, top + at.matrix_end + 22.0), wide);
        for (k, factor) in self.factors.iter().enumerate() {
            let left = style::EDGE + (k % at.columns) as f64 * (at.factor + GAP);
            let above = top + at.factors_top + (k / at.columns) as f64 * at.pitch;
            factor.draw_named(&mut canvas, (left, above), at.factor);
        }
        let names: Vec<&str> = self.blocks.iter().map(|block| block.name.as_str()).collect();
        canvas.finish(id, &self.title, &format!("blocks of rows: {}", names.join(", ")))
    }

    /// One record per entry, with the blocks of its row and column.
    fn csv(&self) -> String {
        let mut out = String::from("row,column,value,block of the row,block of the column\n");
        let starts = self.starts();
        let block = |row: usize| {
            let k = starts.iter().rposition(|start| *start <= row).unwrap_or(0);
            self.blocks.get(k).map_or(String::new(), |block| block.name.clone())
        };
        for &(i, j, a) in &self.entries {
            csv::record(
                &mut out,
                [i.to_string(), j.to_string(), csv::number(a), block(i), block(j)],
            );
        }
        out
    }
}
