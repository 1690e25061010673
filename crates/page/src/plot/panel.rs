//! One plot of a stack: a vertical axis and its curves.

use super::axis::Axis;
use super::series::{Look, Series};
use crate::number::counted;

/// Curves coincide where they differ by at most this part of the axis: the width of the band.
const COINCIDES: f64 = 0.015;

/// One plot of a stack.
#[derive(Debug, Clone)]
pub struct Panel {
    /// The vertical axis.
    pub y: Axis,
    /// The curves; a name looks the same in every panel.
    pub series: Vec<Series>,
}

impl Panel {
    /// The same, with one label `law and 3 engines` at the curve with this name and at those that
    /// coincide with it, which have labels of the kind `noun`.
    ///
    /// ```
    /// use lcplab_page::plot::{Axis, Panel, Series};
    ///
    /// let line = || vec![(0.0, 0.0), (1.0, 2.0)];
    /// let names = ["Bullet", "Drake"].map(|name| Series::measured(name, line()).labeled(name));
    /// let series = [vec![Series::theory("law", line()).labeled("law")], names.to_vec()].concat();
    /// let panel = Panel { y: Axis::linear("speed", "m/s"), series };
    /// let panel = panel.with_one_label("law", "engine");
    /// assert_eq!(panel.series[0].end.as_deref(), Some("law and 2 engines"));
    /// ```
    pub fn with_one_label(mut self, law: &str, noun: &str) -> Self {
        let scale = self.y.scale;
        let height = |(_, y): &(f64, f64)| scale.position(*y);
        let all = self.series.iter().flat_map(|own| own.points.iter().filter_map(height));
        let (lo, hi) =
            all.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), at| (lo.min(at), hi.max(at)));
        let Some(own) = self.series.iter().find(|own| own.name == law) else { return self };
        let points = own.points.clone();
        let is_near = |(a, b): (&(f64, f64), &(f64, f64))| {
            let heights = height(a).zip(height(b));
            heights.is_some_and(|(a, b)| (a - b).abs() <= COINCIDES * (hi - lo))
        };
        let coincides = |own: &Series| {
            own.look == Look::Measured
                && own.points.len() == points.len()
                && own.points.iter().zip(&points).all(is_near)
        };
        let mut count = 0;
        for series in self.series.iter_mut().filter(|own| coincides(own)) {
            series.end = Some(String::new());
            count += 1;
        }
        if let Some(own) = self.series.iter_mut().find(|own| own.name == law && count > 0) {
            own.end = Some(format!("{law} and {}", counted(count, noun)));
        }
        self
    }
}
