//! Text stands out from its paper as WCAG 2.2 wants it (1.4.3, level AA), in light and in dark, on
//! the page and in its figures.

use std::collections::BTreeMap;

use lcplab::plot::{Axis, Figure, Lines, Series};

use super::sample;

const AA: f64 = 4.5;
const LIGHT: &str = include_str!("../../../../crates/page/src/page/page.css");
const DARK: &str = include_str!("../../../../crates/page/src/page/dark.css");

type Rgb = [f64; 3];

/// `#0072b2` as parts of 1.
fn color(hex: &str) -> Option<Rgb> {
    let digits = hex.strip_prefix('#')?;
    let part = |k: usize| u8::from_str_radix(digits.get(2 * k..2 * k + 2)?, 16).ok();
    Some([part(0)?, part(1)?, part(2)?].map(|c| f64::from(c) / 255.0))
}

/// The colors among the variables of a style sheet's first rule.
fn variables(css: &str) -> BTreeMap<&str, Rgb> {
    let rule = css.split('}').next().unwrap();
    rule.split([';', '{'])
        .filter_map(|part| part.trim().strip_prefix("--")?.split_once(':'))
        .filter_map(|(name, value)| Some((name, color(value.trim())?)))
        .collect()
}

/// WCAG's relative luminance, and contrast.
fn luminance(color: Rgb) -> f64 {
    let linear = |c: f64| if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) };
    let [r, g, b] = color.map(linear);
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

fn contrast(a: Rgb, b: Rgb) -> f64 {
    let (a, b) = (luminance(a), luminance(b));
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

/// `invert(1) hue-rotate(180deg)` (Filter Effects Module, 9.6).
fn turned(color: Rgb) -> Rgb {
    let [r, g, b] = color.map(|c| 1.0 - c);
    let rows = [[-0.574, 1.430, 0.144], [0.426, 0.430, 0.144], [0.426, 1.430, -0.856]];
    rows.map(|row| (row[0] * r + row[1] * g + row[2] * b).clamp(0.0, 1.0))
}

#[test]
fn contrast_is_that_of_the_standard() {
    let [black, white] = ["#000000", "#ffffff"].map(|hex| color(hex).unwrap());
    assert!((contrast(black, white) - 21.0).abs() < 1e-12);
    // The gray that is known to pass just so on white.
    let gray = color("#767676").unwrap();
    assert!((contrast(gray, white) - 4.54).abs() < 0.005);
    let back = turned(turned(gray));
    assert!(back.iter().zip(gray).all(|(a, b)| (a - b).abs() < 1e-9), "grays turn and turn back");
}

#[test]
fn text_stands_out_in_light_and_dark() {
    for (name, sheet) in [("light", LIGHT), ("dark", DARK)] {
        let colors = variables(sheet);
        for paper in ["paper", "tint"] {
            for text in ["ink", "faint", "link", "good", "bad", "caution"] {
                let found = contrast(colors[text], colors[paper]);
                assert!(found >= AA, "{name}: {text} on {paper}: {found:.2}");
            }
        }
    }
}

#[test]
fn text_in_figures_stands_out_in_light_and_dark() {
    assert!(DARK.contains("--plot: invert(1) hue-rotate(180deg); --sheet: transparent;"));
    let (white, dark) = (color("#ffffff").unwrap(), variables(DARK)["paper"]);
    let svg = sample::halving().svg();
    let texts: Vec<_> = svg.split("<text ").skip(1).collect();
    assert!(texts.len() > 15);
    for text in texts {
        let fill = text.split("fill=\"").nth(1).and_then(|rest| color(rest.get(..7)?)).unwrap();
        assert!(contrast(fill, white) >= AA, "{text}");
        assert!(contrast(turned(fill), dark) >= AA, "{text}");
    }
}

#[test]
fn a_band_of_theory_is_as_visible_in_dark_as_in_light() {
    let (light, dark) = (variables(LIGHT), variables(DARK));
    let theory = Series::theory("theory, pgs", vec![(1.0, 1.0), (2.0, 3.0)]);
    let (x, y) = (Axis::linear("x", ""), Axis::linear("y", ""));
    let svg = Lines::new("band", "Band", "", x, y, vec![theory]).svg();
    // The rule applies to the stroke of the figures.
    let rule = LIGHT.split("{ stroke: var(--band); }").next().unwrap();
    let stroke = rule.rsplit(".plot [").next().unwrap().trim().trim_end_matches(']');
    assert!(svg.contains(stroke), "{stroke}");
    let in_light = contrast(light["band"], light["paper"]);
    let in_dark = contrast(turned(dark["band"]), dark["paper"]);
    assert!(in_light >= 1.3 && in_dark >= in_light, "light {in_light:.2}, dark {in_dark:.2}");
}
