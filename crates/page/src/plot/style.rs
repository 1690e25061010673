//! The common style of all figures: the look of each name, sizes and gray tones.
//!
//! The colors of names that are drawn together differ by at least 12 in the CIEDE2000 distance, on
//! light and on dark pages; dash and marker repeat the difference for gray prints. SOR is one
//! family, darker with increasing ω. A variant after a comma (`velocity, dt/2`) or a colon keeps
//! the hue of the name before it.
//!
//! ```
//! use lcplab_page::plot::style::{style, styles, width};
//!
//! assert_eq!(style("pgs"), style("pgs")); // a name looks the same in every figure
//! let two = styles(&["mine", "mine"]);
//! assert_ne!(two[0], two[1]); // but two lines of one figure differ
//! assert!(width("residual", 12.0) > width("res", 12.0)); // px
//! ```

use plotters::style::RGBColor;

use crate::escape::unbroken;

pub use crate::figure::WIDTH;

/// Size of all text except the title in px.
pub const TEXT: f64 = 14.0;
/// Size of the title in px.
pub const TITLE: f64 = 17.0;
/// Width of a measured line in px.
pub const LINE: f64 = 2.0;
/// Width of reference and frame lines in px.
pub(crate) const THIN: f64 = 1.3;
/// Width of a band of theory, on which the measured line lies, in px.
pub(crate) const BAND: f64 = 8.0;
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
/// Bands of theory.
pub(crate) const THEORY: RGBColor = RGBColor(206, 212, 220);

/// The part of white in a band with the color of its curve.
const PALE: f64 = 0.68;

/// The color of the band behind a curve of this color.
pub(super) fn tint(RGBColor(r, g, b): RGBColor) -> RGBColor {
    let tint = |c: u8| (f64::from(c) + PALE * (255.0 - f64::from(c))).round() as u8;
    RGBColor(tint(r), tint(g), tint(b))
}

/// Fonts available on the reader's machine.
pub(crate) const FONTS: &str = "system-ui, -apple-system, 'Segoe UI', Roboto, 'Helvetica Neue', \
                                'Noto Sans', 'Liberation Sans', Arial, sans-serif";

/// Dash patterns in px; the first is a solid line.
const DASHES: [&[u32]; 6] = [&[], &[9, 4], &[2, 3], &[9, 3, 2, 3], &[5, 3], &[12, 3, 2, 3, 2, 3]];

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
    /// A thin upright bar.
    Tick,
    /// A thin level bar, wider than the others.
    Cap,
}

const MARKERS: [Marker; 8] = [
    Marker::Circle,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
    Marker::Wedge,
    Marker::Plus,
    Marker::Tick,
    Marker::Cap,
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

const BLUE: Rgb = (0, 94, 170);
const SKY: Rgb = (94, 155, 240);
const GREEN: Rgb = (0, 124, 60);
const PURPLE: Rgb = (208, 64, 190);
const OCHRE: Rgb = (186, 151, 14);
const BLACK: Rgb = (50, 50, 55);
const VERMILION: Rgb = (226, 100, 10);

/// The colors of unknown names.
const HUES: [Rgb; 6] = [BLUE, VERMILION, GREEN, PURPLE, OCHRE, SKY];

/// Name, color, index of the dash, index of the marker.
const KNOWN: &[(&str, Rgb, usize, usize)] = &[
    ("pgs", (0, 94, 170), 0, 0),
    ("ssor", (44, 37, 167), 5, 0),
    ("red_black", (112, 102, 125), 5, 1),
    ("jacobi", (120, 150, 225), 4, 3),
    ("block_pgs", (12, 166, 208), 1, 1),
    ("code6", (110, 110, 112), 5, 4),
    ("nncg", (30, 160, 150), 3, 2),
    ("anderson_pgs", (131, 97, 213), 3, 0),
    ("mprgp", (186, 85, 103), 0, 2),
    ("apgd", (186, 151, 14), 0, 3),
    ("spectral", (196, 140, 180), 0, 4),
    ("admm", (111, 109, 43), 4, 5),
    ("newton", (92, 51, 1), 4, 0),
    ("fischer_newton", (134, 108, 89), 3, 4),
    ("interior_point", (50, 50, 55), 1, 5),
    ("dantzig", (0, 124, 60), 0, 1),
    ("lemke", (208, 64, 190), 1, 3),
    ("murty", (120, 40, 90), 2, 2),
    ("block_pivoting", (99, 172, 68), 4, 1),
    ("enumeration", (20, 84, 82), 5, 5),
    ("clarabel", (151, 151, 151), 3, 5),
    ("velocity", (0, 94, 170), 0, 0),
    ("acceleration", (226, 100, 10), 0, 1),
    ("velocity_cone", (40, 170, 150), 1, 4),
    ("position", (104, 120, 88), 0, 2),
    ("soft", (208, 64, 190), 0, 3),
    ("penalty", (191, 148, 52), 0, 4),
    ("split_impulse", (0, 110, 14), 1, 5),
    ("gauss_seidel", (94, 155, 240), 1, 4),
    ("xpbd", (50, 50, 55), 3, 3),
    ("sequential_impulses", (162, 115, 235), 2, 0),
    ("midpoint_rule", (123, 169, 52), 3, 2),
    ("rk4", (116, 13, 23), 5, 3),
    ("active_set_of_pgs_changes", (0, 94, 170), 0, 6),
    ("exact", BLACK, 0, 0),
    ("exact_answers", BLACK, 0, 0),
    ("limits", (140, 146, 156), 0, 7),
    ("gauss_seidel_sweeps", BLUE, 0, 0),
    ("printed", VERMILION, 1, 1),
    ("corrected", BLUE, 0, 0),
    ("scaled_residual", BLUE, 0, 0),
    ("natural_residual", VERMILION, 1, 1),
    ("fischer_burmeister", GREEN, 2, 2),
    ("siconos", (84, 40, 160), 3, 3),
    ("dart", (115, 112, 83), 4, 4),
    ("mujoco", (189, 131, 147), 0, 0),
    ("drake", (4, 66, 59), 1, 1),
    ("pybullet", (12, 160, 200), 0, 3),
    ("rapier", (215, 74, 75), 2, 2),
    ("pinocchio", (140, 142, 149), 3, 4),
    ("k&m_(4)", (121, 121, 130), 0, 5),
    ("kinetic", (0, 52, 141), 0, 0),
    ("potential", (0, 102, 13), 1, 1),
    ("sum", (65, 50, 31), 2, 2),
    ("contact", (226, 90, 40), 3, 3),
    ("restitution", (199, 94, 242), 4, 4),
    ("integrator", (173, 128, 24), 5, 0),
    ("friction", (148, 46, 72), 0, 1),
    ("constraint", (88, 153, 253), 1, 2),
    ("gap", (114, 169, 87), 2, 3),
    ("bias", (35, 166, 172), 3, 4),
    ("spring", (136, 126, 130), 4, 0),
    ("correction", PURPLE, 1, 3),
    ("coupled_box", VERMILION, 0, 1),
    ("polygon_4", OCHRE, 1, 3),
    ("polygon_8", PURPLE, 2, 4),
    ("polygon_16", GREEN, 3, 2),
    ("coulomb_cone", BLUE, 0, 0),
    ("dense", BLACK, 0, 0),
    ("map_of_maps", VERMILION, 0, 1),
    ("linked_list", OCHRE, 1, 2),
    ("tree", GREEN, 4, 3),
    ("b_tree", (99, 172, 68), 0, 4),
    ("hash_table", PURPLE, 3, 5),
    ("compressed_rows", BLUE, 0, 0),
    ("block_rows", SKY, 1, 1),
    ("factored", (131, 97, 213), 0, 3),
];

/// The look of SOR by its ω: colors at some ω, interpolated between them, and a dash and a marker
/// for each interval.
const SOR: [(f64, Rgb, usize, usize); 7] = [
    (0.4, (244, 222, 140), 2, 5),
    (0.95, (228, 188, 40), 4, 4),
    (1.2, (244, 156, 30), 1, 2),
    (1.4, (232, 116, 0), 3, 1),
    (1.6, (198, 62, 14), 5, 3),
    (1.8, (150, 26, 34), 2, 0),
    (2.0, (60, 0, 60), 2, 0),
];

/// The pairs of dash and marker that no name in [`KNOWN`] or [`SOR`] has: those of unknown names,
/// which therefore differ from the known ones in gray.
const FREE: [(usize, usize); 5] = [(1, 0), (2, 1), (2, 3), (4, 2), (5, 2)];

/// The look of a name, the same in every figure.
pub fn style(name: &str) -> Style {
    let known = |name: &str| KNOWN.iter().find(|(known, ..)| *known == key(name));
    if let Some((_, color, dash, marker)) = known(name) {
        return Style { color: *color, dash: DASHES[*dash], marker: MARKERS[*marker] };
    }
    let (base, variant) = name.rsplit_once([',', ':']).unwrap_or((name, ""));
    let key = key(base);
    let parameter = key
        .strip_prefix("sor")
        .filter(|rest| !rest.starts_with(char::is_alphabetic) || rest.starts_with('ω'));
    let (color, dash, marker) = if let Some(parameter) = parameter {
        sor(first_number(parameter).or(first_number(variant)).unwrap_or(1.4))
    } else if let Some((_, color, dash, marker)) = known(base) {
        (*color, *dash, *marker)
    } else {
        let hash = fnv(&key);
        let (dash, marker) = FREE[hash / 6 % FREE.len()];
        (HUES[hash % 6], dash, marker)
    };
    if parameter.is_some() || variant.trim().is_empty() {
        return Style { color, dash: DASHES[dash], marker: MARKERS[marker] };
    }
    // A finer step and a larger number are stronger: dt is the palest.
    let (white, turn) = match variant.rsplit('/').next().map(str::trim) {
        Some("2") if variant.contains('/') => (0.25, 1),
        Some("4") if variant.contains('/') => (0.0, 2),
        Some("dt") => (0.55, 0),
        _ => {
            let shade = first_number(variant).map_or(0.0, |n| 1.1 - 0.65 * n.max(1.0).log10());
            (shade.clamp(-0.4, 0.5), 1 + fnv(variant) % 5)
        }
    };
    let tint = |c: u8| {
        let toward = if white > 0.0 { 255.0 } else { 0.0 };
        (f64::from(c) + f64::abs(white) * (toward - f64::from(c))).round() as u8
    };
    Style {
        color: (tint(color.0), tint(color.1), tint(color.2)),
        dash: DASHES[(dash + turn) % 6],
        marker: MARKERS[(marker + turn) % 6],
    }
}

/// A name in the spelling of [`KNOWN`].
fn key(name: &str) -> String {
    let name = name.trim().to_lowercase().replace([' ', '-'], "_");
    let mut parts = name.split(',');
    let mut key = parts.next().unwrap_or_default().to_string();
    for part in parts {
        // A comma before a digit separates thousands.
        if !part.starts_with(|c: char| c.is_ascii_digit()) {
            key.push(',');
        }
        key += part;
    }
    key
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

/// The colors of the values of a parameter, of the least, of the middle and of the largest.
const RAMP: [Rgb; 3] = [(110, 175, 240), (20, 100, 180), (10, 25, 70)];

/// A parameter with its value, as in `r = 10`; ω has the colors of SOR.
fn parameter(name: &str) -> Option<(&str, f64)> {
    let (label, value) = name.split_once(" = ")?;
    if label.starts_with("sor") {
        None
    } else {
        Some((label, value.replace(',', "").parse().ok()?))
    }
}

/// The look of a value of a parameter of which a figure has at least three.
fn ramp(name: &str, names: &[&str]) -> Option<Style> {
    let (label, value) = parameter(name)?;
    let all = names.iter().filter_map(|name| parameter(name)).filter(|own| own.0 == label);
    let (count, below) = (all.clone().count(), all.filter(|own| own.1 < value).count());
    if count < 3 {
        return None;
    }
    let at = 2.0 * below as f64 / (count - 1) as f64;
    let (k, share) = if at < 1.0 { (0, at) } else { (1, at - 1.0) };
    let blend = |a: u8, b: u8| (f64::from(a) + share * (f64::from(b) - f64::from(a))).round() as u8;
    let ((r, g, b), (s, h, c)) = (RAMP[k], RAMP[k + 1]);
    let color = (blend(r, s), blend(g, h), blend(b, c));
    Some(Style { color, dash: DASHES[0], marker: MARKERS[below % MARKERS.len()] })
}

/// The looks of several names in one figure: that of [`style`], unless an earlier name has it; then
/// the next free dash and marker. The values of a parameter are darker, the larger they are.
pub fn styles(names: &[&str]) -> Vec<Style> {
    let mut taken: Vec<Style> = Vec::new();
    for name in names {
        let mut look = ramp(name, names).unwrap_or_else(|| style(name));
        let (dash, marker) = (place(&DASHES, &look.dash), place(&MARKERS, &look.marker));
        for turn in 1..37 {
            if !taken.contains(&look) {
                break;
            }
            look.dash = DASHES[(dash + turn) % 6];
            look.marker = MARKERS[(marker + turn + turn / 6) % 6];
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
        'm' | 'w' | 'M' | 'W' | '%' => 0.9,
        'A'..='Z' | '×' | '−' | '=' | 'ω' => 0.78,
        _ => 0.61,
    };
    size * text.chars().map(em).sum::<f64>()
}

/// The text in lines of at most this width in px; a longer word has a line of its own.
pub(crate) fn wrapped(text: &str, size: f64, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in unbroken(text).split(' ') {
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
pub(crate) fn balanced(text: &str, size: f64, room: f64) -> Vec<String> {
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
