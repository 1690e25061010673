//! Charts of measures over time: one curve per recording, above the animation's time axis.

use std::fmt::Write;

use super::{Animation, Recording, Sample};
use crate::animation::extent;
use crate::plot::Scale;
use crate::plot::canvas::escape;

/// The width of a chart and of the stages above it in px.
pub(super) const WIDTH: f64 = 720.0;
/// The sides of the plot in px: left, right, top, bottom; and the height of the picture.
pub(super) const PLOT: [f64; 4] = [64.0, WIDTH - 10.0, 8.0, 106.0];
const HEIGHT: f64 = 130.0;
/// A measure below this fraction of its reference value is rounding, and not shown.
const NOTHING: f64 = 1e-9;

/// A measure at an instant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// The energy minus that at the start (J).
    Energy,
    /// The largest |c| of an equality row with the unit of length (m).
    Drift,
    /// The deepest overlap (m).
    Penetration,
}

impl Measure {
    /// All of them.
    pub const ALL: [Measure; 3] = [Measure::Energy, Measure::Drift, Measure::Penetration];

    /// Its name in words.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Measure::Energy => "energy change",
            Measure::Drift => "drift",
            Measure::Penetration => "penetration",
        }
    }

    /// Its unit.
    pub(crate) fn unit(self) -> &'static str {
        match self {
            Measure::Energy => "J",
            Measure::Drift | Measure::Penetration => "m",
        }
    }

    fn of(self, sample: &Sample, start: &Sample) -> f64 {
        match self {
            Measure::Energy => sample.motion.energy() - start.motion.energy(),
            Measure::Drift => sample.motion.drift,
            Measure::Penetration => sample.motion.penetration,
        }
    }
}

/// A measure at each instant of a recording.
pub(super) fn values(recording: &Recording, measure: Measure) -> Vec<f64> {
    let Some(start) = recording.samples.first() else { return Vec::new() };
    recording.samples.iter().map(|sample| measure.of(sample, start)).collect()
}

pub(super) fn measures(animation: &Animation) -> Vec<Measure> {
    let matters = |measure: &Measure| {
        let least = least(animation, *measure);
        animation.recordings.iter().any(|recording| recording.worst(*measure).abs() > least)
    };
    Measure::ALL.into_iter().filter(matters).collect()
}

/// The value below which a measure is rounding.
pub(super) fn least(animation: &Animation, measure: Measure) -> f64 {
    NOTHING * most(animation, measure)
}

/// The reference value of a measure: the scene's size, or its weight times that size.
fn most(animation: &Animation, measure: Measure) -> f64 {
    let size = extent::size(&extent::landmarks(&animation.scene, &[]));
    let masses: f64 = animation.scene.bodies.iter().map(|body| body.mass.mass()).sum();
    match measure {
        Measure::Energy => (masses * animation.scene.gravity.norm() * size).max(1.0),
        Measure::Drift | Measure::Penetration => size,
    }
}

/// The values at the bottom and the top of a plot; values beyond the reference are cut off.
pub(super) fn range(animation: &Animation, measure: Measure) -> (f64, f64) {
    let most = most(animation, measure);
    let all = animation.recordings.iter().flat_map(|recording| values(recording, measure));
    let (lo, hi) =
        all.filter(|x| x.is_finite()).fold((0.0f64, 0.0f64), |(lo, hi), x| (lo.min(x), hi.max(x)));
    let (lo, hi) = (lo.max(-most), hi.min(most));
    let margin = 0.06 * (hi - lo).max(NOTHING);
    (if lo < 0.0 { lo - margin } else { 0.0 }, hi + margin)
}

/// The last instant (s).
pub(super) fn end(animation: &Animation) -> f64 {
    animation.times().last().copied().filter(|end| *end > 0.0).unwrap_or(1.0)
}

pub(super) fn svg(animation: &Animation, measure: Measure) -> String {
    let [left, right, top, bottom] = PLOT;
    let ((lo, hi), end) = (range(animation, measure), end(animation));
    let x = |t: f64| left + t / end * (right - left);
    let y = |v: f64| bottom - (v - lo) / (hi - lo) * (bottom - top);
    let mut out = format!(
        "<svg class=\"chart\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" preserveAspectRatio=\"none\" role=\"img\" aria-label=\"{}\">\n",
        escape(&words(animation, measure))
    );
    for tick in Scale::Linear.ticks((lo, hi), 4) {
        let (at, label) = (y(tick.at), tick.label);
        let zero = if tick.at == 0.0 { " class=\"zero\"" } else { "" };
        let _ = writeln!(
            out,
            "<path{zero} d=\"M{left} {at:.1}H{right}\"/><text x=\"{:.1}\" y=\"{:.1}\" \
             text-anchor=\"end\">{label}</text>",
            left - 6.0,
            at + 4.0
        );
    }
    for tick in Scale::Linear.ticks((0.0, end), 6) {
        let (at, label) = (x(tick.at), tick.label);
        let anchor = if at > right - 12.0 { "end" } else { "middle" };
        let unit = if tick.at == 0.0 { " s" } else { "" };
        let _ = writeln!(
            out,
            "<text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\">{label}{unit}</text>",
            bottom + 16.0
        );
    }
    let (w, h) = (right - left, bottom - top);
    let _ = writeln!(
        out,
        "<svg x=\"{left}\" y=\"{top}\" width=\"{w}\" height=\"{h}\" viewBox=\"{left} {top} {w} {h}\">"
    );
    for ((recording, color), k) in animation.recordings.iter().zip(animation.colors()).zip(0..) {
        let points = recording.samples.iter().zip(values(recording, measure));
        let drawn = points.filter(|(_, v)| v.is_finite()).map(|(sample, v)| {
            format!("{:.1} {:.1}", x(sample.motion.time), y(v).clamp(-1e4, 1e4))
        });
        let course: Vec<_> = drawn.collect();
        let _ = writeln!(
            out,
            "<path class=\"curve curve-{}\" style=\"--c:{color}\" d=\"M{}\"/>",
            k % 4,
            course.join("L")
        );
    }
    out += "</svg>";
    // A curve that is cut off says how far it goes.
    let beyond = animation.recordings.iter().filter(|own| {
        let worst = own.worst(measure);
        worst.is_finite() && !(lo..=hi).contains(&worst)
    });
    let beyond: Vec<_> = beyond
        .map(|own| {
            let worst = crate::number::readable(own.worst(measure), 2);
            format!("{}: {worst} {}", own.name, measure.unit())
        })
        .collect();
    if !beyond.is_empty() {
        let (x, y) = (right - 4.0, top + 12.0);
        let text = escape(&format!("↑ {}", beyond.join(", ")));
        let _ = writeln!(out, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"end\">{text}</text>");
    }
    out + "</svg>\n"
}

fn words(animation: &Animation, measure: Measure) -> String {
    let end = crate::number::readable(end(animation), 3);
    let of = |recording: &Recording| {
        let worst = crate::number::readable(recording.worst(measure), 2);
        format!("{} up to {worst} {}", recording.name, measure.unit())
    };
    let recordings: Vec<_> = animation.recordings.iter().map(of).collect();
    format!("{} over {end} s: {}", measure.name(), recordings.join("; "))
}
