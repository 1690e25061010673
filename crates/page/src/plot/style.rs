//! The common style of all figures: the look of each name, sizes and gray tones.
//!
//! The hues are those of Okabe and Ito, which color-blind readers can distinguish; dash and marker
//! repeat the difference for gray prints. SOR is one family, darker with increasing ω. A variant
//! after a comma (`velocity, dt/2`) keeps the color of the name before it.

use plotters::style::RGBColor;

pub use crate::figure::WIDTH;

/// Size of all text except the title in px.
pub const TEXT: f64 = 14.0;
/// Size of the title in px.
pub const TITLE: f64 = 17.0;
/// Width of a measured line in px.
pub const LINE: f64 = 2.0;
/// Width of theory, reference and frame lines in px.
pub(crate) const THIN: f64 = 1.3;
/// Distance of text from the left edge in px.
pub const EDGE: f64 = 6.0;
/// Radius of a marker in px.
pub const MARKER: f64 = 4.2;

/// The background.
pub(crate) const PAPER: RGBColor = RGBColor(255, 255, 255);
/// The main text color.
pub const INK: RGBColor = RGBColor(34, 38, 45);
/// The color of less important text.
pub const FAINT_INK: RGBColor = RGBColor(92, 98, 108);
/// Lines of the grid.
pub const GRID: RGBColor = RGBColor(228, 230, 234);
/// Lines of theory.
pub(crate) const THEORY: RGBColor = RGBColor(112, 112, 112);

/// Fonts available on the reader's machine.
pub(crate) const FONTS: &str = "system-ui, -apple-system, 'Segoe UI', Roboto, 'Helvetica Neue', \
                                'Noto Sans', 'Liberation Sans', Arial, sans-serif";

/// Dash patterns in px; the first is a solid line.
const DASHES: [&[u32]; 6] = [&[], &[9, 4], &[2, 3], &[9, 3, 2, 3], &[5, 3], &[12, 3, 2, 3, 2, 3]];

/// Dash patterns of theory lines, in order of appearance in a figure.
pub(super) const THEORY_DASHES: [&[u32]; 3] = [&[6, 4], &[2, 3], &[8, 3, 2, 3]];

/// The shape of the markers on a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marker {
    /// A disk.
    Circle,
    /// A square.
    Square,
    /// A triangle, point up.
    Triangle,
    /// A square on its corner.
    Diamond,
    /// A triangle, point down.
    Wedge,
    /// A plus sign.
    Plus,
}

const MARKERS: [Marker; 6] = [
    Marker::Circle,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
    Marker::Wedge,
    Marker::Plus,
];

/// The look of a line or bar.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Style {
    /// Red, green, blue.
    pub color: (u8, u8, u8),
    /// Lengths of stroke and gap in px, in turn; empty for a solid line.
    pub dash: &'static [u32],
    /// The marker on the line.
    pub marker: Marker,
}

/// Red, green, blue.
type Rgb = (u8, u8, u8);

const BLUE: Rgb = (0, 114, 178);
const SKY: Rgb = (70, 165, 220);
const GREEN: Rgb = (0, 138, 100);
const PURPLE: Rgb = (190, 95, 150);
const OCHRE: Rgb = (176, 134, 0);
const BLACK: Rgb = (45, 45, 50);
const VERMILION: Rgb = (205, 85, 0);

/// The colors of unknown names.
const HUES: [Rgb; 6] = [BLUE, VERMILION, GREEN, PURPLE, OCHRE, SKY];

/// Name, color, index of the dash, index of the marker.
const KNOWN: &[(&str, Rgb, usize, usize)] = &[
    ("pgs", BLUE, 0, 0),
    ("ssor", VERMILION, 5, 0),
    ("red_black", BLUE, 5, 1),
    ("jacobi", SKY, 4, 3),
    ("block_pgs", SKY, 1, 1),
    ("code6", BLACK, 5, 4),
    ("nncg", SKY, 3, 2),
    ("anderson_pgs", VERMILION, 3, 0),
    ("mprgp", VERMILION, 0, 2),
    ("apgd", OCHRE, 0, 3),
    ("spectral", PURPLE, 0, 4),
    ("admm", GREEN, 4, 5),
    ("newton", OCHRE, 4, 0),
    ("fischer_newton", OCHRE, 3, 4),
    ("interior_point", BLACK, 1, 5),
    ("dantzig", GREEN, 0, 1),
    ("lemke", PURPLE, 1, 3),
    ("murty", PURPLE, 2, 2),
    ("block_pivoting", GREEN, 4, 1),
    ("enumeration", BLACK, 5, 5),
    ("clarabel", BLACK, 3, 5),
    ("velocity", BLUE, 0, 0),
    ("acceleration", VERMILION, 0, 1),
    ("velocity_cone", GREEN, 1, 4),
    ("position", GREEN, 0, 2),
    ("soft", PURPLE, 0, 3),
    ("penalty", OCHRE, 0, 4),
    ("split_impulse", GREEN, 1, 5),
    ("gauss_seidel", SKY, 1, 4),
    ("xpbd", BLACK, 3, 3),
    ("sequential_impulses", SKY, 2, 0),
    ("exact", BLACK, 0, 0),
    ("scaled_residual", BLUE, 0, 0),
    ("natural_residual", VERMILION, 1, 1),
    ("fischer_burmeister", GREEN, 2, 2),
    ("siconos", PURPLE, 3, 3),
    ("dart", OCHRE, 4, 4),
    ("mujoco", BLUE, 0, 0),
    ("drake", GREEN, 1, 1),
    ("pybullet", VERMILION, 4, 3),
    ("rapier", PURPLE, 2, 2),
    ("pinocchio", SKY, 3, 4),
    ("k&m_(4)", BLACK, 0, 5),
    ("box", VERMILION, 0, 1),
    ("polygon_4", OCHRE, 1, 3),
    ("polygon_8", PURPLE, 2, 4),
    ("disc", BLUE, 0, 0),
    ("dense", BLACK, 0, 0),
    ("map_of_maps", VERMILION, 0, 1),
    ("linked_list", OCHRE, 1, 2),
    ("tree", GREEN, 4, 3),
    ("b_tree", GREEN, 0, 4),
    ("hash_table", PURPLE, 3, 5),
    ("compressed_rows", BLUE, 0, 0),
    ("block_rows", SKY, 1, 1),
    ("factored", SKY, 0, 3),
    ("r_=_1", SKY, 0, 0),
    ("r_=_10", GREEN, 1, 1),
    ("r_=_100", OCHRE, 2, 2),
    ("r_=_1000", VERMILION, 3, 3),
    ("r_=_10000", PURPLE, 4, 4),
];

/// The look of SOR by its ω: colors at some ω, interpolated between them, and a dash and a marker
/// for each interval.
const SOR: [(f64, Rgb, usize, usize); 6] = [
    (0.4, (232, 190, 110), 2, 5),
    (0.95, (226, 156, 36), 4, 4),
    (1.2, (226, 116, 10), 1, 2),
    (1.4, (200, 66, 10), 3, 1),
    (1.6, (158, 32, 46), 5, 3),
    (1.8, (82, 10, 54), 2, 0),
];

/// The pairs of dash and marker that no name in [`KNOWN`] or [`SOR`] has: those of unknown names,
/// which therefore differ from the known ones in gray.
const FREE: [(usize, usize); 5] = [(1, 0), (2, 1), (2, 3), (4, 2), (5, 2)];

/// The look of a name, the same in every figure.
pub fn style(name: &str) -> Style {
    let (base, variant) = name.split_once(',').unwrap_or((name, ""));
    let key = base.trim().to_lowercase().replace('\u{202f}', "").replace([' ', '-'], "_");
    let parameter = key
        .strip_prefix("sor")
        .filter(|rest| !rest.starts_with(char::is_alphabetic) || rest.starts_with('ω'));
    let (color, dash, marker) = if let Some(parameter) = parameter {
        sor(first_number(parameter).or(first_number(variant)).unwrap_or(1.4))
    } else if let Some((_, color, dash, marker)) = KNOWN.iter().find(|(known, ..)| *known == key) {
        (*color, *dash, *marker)
    } else {
        let hash = fnv(&key);
        let (dash, marker) = FREE[hash / 6 % FREE.len()];
        (HUES[hash % 6], dash, marker)
    };
    if parameter.is_some() || variant.trim().is_empty() {
        return Style { color, dash: DASHES[dash], marker: MARKERS[marker] };
    }
    // dt is the palest, dt/2 and dt/4 come closer to the full color: finer is stronger. Other
    // variants have their own color.
    let (white, turn, color) = match variant.rsplit('/').next().map(str::trim) {
        Some("2") if variant.contains('/') => (0.25, 1, color),
        Some("4") if variant.contains('/') => (0.0, 2, color),
        Some("dt") => (0.5, 0, color),
        _ => {
            let turn = 1 + fnv(variant) % 5;
            (0.0, turn, HUES[(place(&HUES, &color) + turn) % 6])
        }
    };
    let tint = |c: u8| (f64::from(c) + white * (255.0 - f64::from(c))).round() as u8;
    Style {
        color: (tint(color.0), tint(color.1), tint(color.2)),
        dash: DASHES[(dash + turn) % 6],
        marker: MARKERS[(marker + turn) % 6],
    }
}

fn sor(omega: f64) -> (Rgb, usize, usize) {
    let k = SOR.iter().rposition(|(from, ..)| *from <= omega).unwrap_or(0);
    let (from, below, dash, marker) = SOR[k];
    let (to, above, ..) = SOR[(k + 1).min(SOR.len() - 1)];
    let share = if to > from { ((omega - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
    let blend = |a: u8, b: u8| (f64::from(a) + share * (f64::from(b) - f64::from(a))).round() as u8;
    let color = (blend(below.0, above.0), blend(below.1, above.1), blend(below.2, above.2));
    (color, dash, marker)
}

/// The looks of several names in one figure: that of [`style`], unless an earlier name has it; then
/// the next free dash and marker.
pub fn styles(names: &[&str]) -> Vec<Style> {
    let mut taken: Vec<Style> = Vec::new();
    for name in names {
        let mut look = style(name);
        let (dash, marker) = (place(&DASHES, &look.dash), place(&MARKERS, &look.marker));
        for turn in 0..36 {
            look.dash = DASHES[(dash + turn) % 6];
            look.marker = MARKERS[(marker + turn + turn / 6) % 6];
            if !taken.contains(&look) {
                break;
            }
        }
        taken.push(look);
    }
    taken
}

/// The estimated width of a text in px, sufficient to lay out labels without a font.
pub fn width(text: &str, size: f64) -> f64 {
    let em = |c: char| match c {
        '⁰'..='⁹' | '¹' | '²' | '³' | '⁻' => 0.4,
        'i' | 'j' | 'l' | 't' | 'f' | 'r' | ' ' | '.' | ',' | '(' | ')' | '/' | '|' | '\'' => 0.36,
        'm' | 'w' | 'M' | 'W' => 0.9,
        'A'..='Z' | '×' | '−' | '=' | 'ω' => 0.78,
        _ => 0.61,
    };
    size * text.chars().map(em).sum::<f64>()
}

/// The text in lines of at most this width in px; a longer word has a line of its own.
pub fn wrapped(text: &str, size: f64, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if width(line, size) + width(word, size) <= room => {
                *line += " ";
                *line += word;
            }
            _ => lines.push(word.into()),
        }
    }
    lines
}

/// The same, in as many lines of about the same width.
pub fn balanced(text: &str, size: f64, room: f64) -> Vec<String> {
    let lines = wrapped(text, size, room);
    // Balanced lines need at least half of the room.
    let narrower = (1..=13).map(|k| wrapped(text, size, room * 0.95_f64.powi(k)));
    narrower.take_while(|other| other.len() == lines.len()).last().unwrap_or(lines)
}

fn place<T: PartialEq>(list: &[T], item: &T) -> usize {
    list.iter().position(|other| other == item).unwrap_or(0)
}

fn first_number(text: &str) -> Option<f64> {
    let start = text.find(|c: char| c.is_ascii_digit())?;
    let number = text[start..].split(|c: char| !(c.is_ascii_digit() || c == '.')).next()?;
    number.trim_end_matches('.').parse().ok()
}

fn fnv(text: &str) -> usize {
    let hash =
        text.bytes().fold(0x811c_9dc5_u32, |h, b| (h ^ u32::from(b)).wrapping_mul(0x0100_0193));
    hash as usize
}
