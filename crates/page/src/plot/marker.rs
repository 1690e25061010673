//! Markers on curves.

use plotters::prelude::*;

use super::canvas::{Canvas, fine, hex};
use super::style::{self, Marker};

/// Distance between two markers of one curve in px.
const MARKER_DISTANCE: f64 = 92.0;
/// Radius of a ring in px.
const RING: f64 = 5.5;

/// The points of the k-th curve that get a marker: all points of a short curve, otherwise one per
/// [`MARKER_DISTANCE`], staggered between curves.
pub(super) fn marker_places(points: &[(f64, f64)], left: f64, k: usize) -> Vec<(f64, f64)> {
    if points.len() <= 8 {
        return points.to_vec();
    }
    let mut next = left + MARKER_DISTANCE * (0.2 + 0.37 * k as f64).fract();
    let mut spots = Vec::new();
    for point in points {
        if point.0 >= next {
            spots.push(*point);
            next += MARKER_DISTANCE * ((point.0 - next) / MARKER_DISTANCE).floor().max(0.0)
                + MARKER_DISTANCE;
        }
    }
    if spots.is_empty() {
        points[points.len() / 2..].iter().take(1).copied().collect()
    } else {
        spots
    }
}

/// Draws markers with a white rim, so that they stand out from the line.
pub(super) fn draw_markers(
    canvas: &mut Canvas,
    spots: &[(f64, f64)],
    marker: Marker,
    color: RGBColor,
) {
    canvas.layer("stroke=\"#ffffff\" stroke-width=\"12\" paint-order=\"stroke\"", |layer| {
        spots
            .iter()
            .try_for_each(|spot| layer.draw(&Polygon::new(marker.outline(*spot), color.filled())))
    });
}

/// Draws hollow wedges where a curve is exactly zero on a logarithmic axis.
pub(super) fn draw_zeros(canvas: &mut Canvas, spots: &[(f64, f64)], color: RGBColor) {
    let outline = hex((color.0, color.1, color.2));
    canvas.layer(&format!("stroke=\"{outline}\" stroke-width=\"14\""), |layer| {
        spots.iter().try_for_each(|spot| {
            layer.draw(&Polygon::new(Marker::Wedge.outline(*spot), style::PAPER.filled()))
        })
    });
}

/// Draws rings around places on a curve.
pub(super) fn draw_rings(canvas: &mut Canvas, spots: &[(f64, f64)], color: RGBColor) {
    for (x, y) in spots {
        canvas.raw(&format!(
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{RING}\" fill=\"#ffffff\" stroke=\"{}\" \
             stroke-width=\"2.4\"/>\n",
            hex((color.0, color.1, color.2))
        ));
    }
}

impl Marker {
    /// The corners around a center given in px, in the units of a layer.
    fn outline(self, (x, y): (f64, f64)) -> Vec<(i32, i32)> {
        const R: f64 = style::MARKER;
        let turned = |corners: u32, radius: f64, start: f64| {
            (0..corners)
                .map(|k| (start + 360.0 * f64::from(k) / f64::from(corners)).to_radians())
                .map(|angle| (x + radius * angle.cos(), y + radius * angle.sin()))
                .collect::<Vec<_>>()
        };
        let corners = match self {
            Marker::Circle => turned(16, R, 0.0),
            Marker::Square => turned(4, 1.25 * R, 45.0),
            Marker::Diamond => turned(4, 1.35 * R, 0.0),
            Marker::Triangle => turned(3, 1.4 * R, -90.0),
            Marker::Wedge => turned(3, 1.4 * R, 90.0),
            Marker::Tick => [(-0.8, -5.5), (0.8, -5.5), (0.8, 5.5), (-0.8, 5.5)]
                .map(|(dx, dy)| (x + dx, y + dy))
                .to_vec(),
            Marker::Cap => [(-12.0, -1.5), (12.0, -1.5), (12.0, 1.5), (-12.0, 1.5)]
                .map(|(dx, dy)| (x + dx, y + dy))
                .to_vec(),
            Marker::Plus => {
                let (long, short) = (1.25 * R, 0.42 * R);
                let quarter = [(short, -long), (short, -short), (long, -short), (long, short)];
                let rest = [(short, short), (short, long), (-short, long), (-short, short)];
                let last = [(-long, short), (-long, -short), (-short, -short), (-short, -long)];
                let all = quarter.into_iter().chain(rest).chain(last);
                all.map(|(dx, dy)| (x + dx, y + dy)).collect()
            }
        };
        corners.into_iter().map(|(x, y)| (fine(x), fine(y))).collect()
    }
}
