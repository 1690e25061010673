//! A plot in one expression, with the style of all other plots.

use crate::plot::{Axis, Figure, Lines, Panel, Series};

/// A plot that is built with one call per curve.
///
/// ```
/// use lcplab::lesson::Plot;
///
/// let error = |rho: f64| (0..20).map(|k| (f64::from(k), rho.powi(k))).collect();
/// let plot = Plot::new("contraction", "Error of each sweep")
///     .x("sweep", "")
///     .log_y("error", "N s")
///     .measured("pgs", error(0.74))
///     .theory("ρ^k", error(0.75))
///     .caption("The measured curve runs along the theory's.");
/// ```
#[derive(Debug, Clone)]
pub struct Plot(Lines);

impl Plot {
    /// A plot without curves; `id` is unique in its notebook.
    pub fn new(id: &str, title: &str) -> Self {
        let panel = Panel { y: Axis::linear("", ""), series: Vec::new() };
        Plot(Lines {
            id: id.into(),
            title: title.into(),
            caption: String::new(),
            x: Axis::linear("", ""),
            panels: vec![panel],
        })
    }

    /// The caption, a sentence that says what the reader should see.
    pub fn caption(mut self, words: &str) -> Self {
        self.0.caption = words.into();
        self
    }

    /// The horizontal axis: quantity and unit.
    pub fn x(mut self, label: &str, unit: &str) -> Self {
        self.0.x = Axis::linear(label, unit);
        self
    }

    /// A logarithmic horizontal axis.
    pub fn log_x(mut self, label: &str, unit: &str) -> Self {
        self.0.x = Axis::log(label, unit);
        self
    }

    /// The vertical axis.
    pub fn y(self, label: &str, unit: &str) -> Self {
        self.vertical(Axis::linear(label, unit))
    }

    /// A logarithmic vertical axis.
    pub fn log_y(self, label: &str, unit: &str) -> Self {
        self.vertical(Axis::log(label, unit))
    }

    /// A measured curve.
    pub fn measured(self, name: &str, points: Vec<(f64, f64)>) -> Self {
        self.with(Series::measured(name, points))
    }

    /// Points without a connecting line.
    pub fn points(self, name: &str, points: Vec<(f64, f64)>) -> Self {
        self.with(Series::points(name, points))
    }

    /// A curve predicted by a formula.
    pub fn theory(self, name: &str, points: Vec<(f64, f64)>) -> Self {
        self.with(Series::theory(name, points))
    }

    /// A known value or limit.
    pub fn reference(self, name: &str, points: Vec<(f64, f64)>) -> Self {
        self.with(Series::reference(name, points))
    }

    fn vertical(mut self, axis: Axis) -> Self {
        self.0.panels[0].y = axis;
        self
    }

    fn with(mut self, series: Series) -> Self {
        self.0.panels[0].series.push(series);
        self
    }
}

impl Figure for Plot {
    fn id(&self) -> &str {
        self.0.id()
    }

    fn title(&self) -> &str {
        self.0.title()
    }

    fn caption(&self) -> &str {
        self.0.caption()
    }

    fn drawn(&self, width: f64, id: &str) -> String {
        self.0.drawn(width, id)
    }

    fn csv(&self) -> String {
        self.0.csv()
    }
}
