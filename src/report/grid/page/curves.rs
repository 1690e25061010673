//! The results of a grid as curves across one axis.

use crate::number::readable;
use crate::report::grid::collect::Point;
use crate::report::grid::file::{Grid, REPEAT};
use crate::report::grid::measure::Measure;
use crate::report::grid::plan::Plan;

/// The results as curves across one axis.
pub(super) struct Curves<'a> {
    /// The path of the axis.
    pub path: String,
    /// Its label.
    pub across: String,
    /// One for each point of the other axes.
    pub curves: Vec<Curve<'a>>,
}

/// The points that differ only in the first axis and in the repetition.
pub(super) struct Curve<'a> {
    /// The settings of the other axes.
    pub name: String,
    points: Vec<(f64, Point<'a>)>,
}

/// Cost measures, which are omitted where there is no answer.
const COSTS: [&str; 3] = ["iterations", "work", "seconds"];

impl<'a> Curves<'a> {
    /// `None` if no axis has numbers.
    pub fn of(grid: &Grid, plan: &Plan, points: &[Point<'a>]) -> Option<Self> {
        let is_number = |path: &&String| plan.tasks.iter().all(|task| task.number(path).is_some());
        let first = plan.axes.iter().filter(|path| *path != REPEAT).find(is_number)?;
        let zipped = grid.axes.iter().find(|axis| axis.paths.contains(first))?;
        let is_other = |path: &&String| !zipped.paths.contains(path) && *path != REPEAT;
        let others: Vec<&String> = plan.axes.iter().filter(is_other).collect();
        let mut curves: Vec<Curve> = Vec::new();
        for point in points {
            let task = point.task;
            let parts = others.iter().map(|path| match task.number(path) {
                Some(value) => format!("{} = {}", grid.label(path), readable(value, 15)),
                // The name of a solver or family has its own style.
                None => task.shown(path),
            });
            let name = parts.collect::<Vec<_>>().join(", ");
            let name = if name.is_empty() { "measured".to_string() } else { name };
            let point = (task.number(first)?, *point);
            match curves.iter_mut().find(|curve| curve.name == name) {
                Some(curve) => curve.points.push(point),
                None => curves.push(Curve { name, points: vec![point] }),
            }
        }
        Some(Curves { path: first.clone(), across: grid.label(first), curves })
    }

    /// The unit of the axis.
    pub fn unit(&self) -> &'static str {
        if self.path == "step.dt" { "s" } else { "" }
    }

    /// The position of a curve's minimum along the axis, according to theory.
    pub fn optimum(&self, curve: &Curve<'_>) -> Option<f64> {
        let predicted = || curve.points.iter().find_map(|(_, point)| point.get("optimum"));
        (self.path == "solver.omega").then(predicted)?
    }
}

impl Curve<'_> {
    /// A measure by position; NaN if it was not taken, or for a cost if there was no answer.
    pub(crate) fn measured(&self, measure: &Measure) -> Vec<(f64, f64)> {
        let is_cost = COSTS.contains(&measure.name);
        self.by_place(|point| point.get(measure.name).filter(|_| !is_cost || point.is_solved()))
    }

    /// The prediction for a measure by position; NaN if there is none.
    pub(crate) fn predicted(&self, measure: &Measure) -> Vec<(f64, f64)> {
        self.by_place(|point| point.predicted(measure.name).map(|own| own.value))
    }

    /// The positions of all points.
    pub(crate) fn places(&self) -> impl Iterator<Item = f64> {
        self.points.iter().map(|(x, _)| *x)
    }

    /// Values by position, ascending; the median of repetitions.
    fn by_place(&self, value: impl Fn(&Point) -> Option<f64>) -> Vec<(f64, f64)> {
        let place = |(x, point): &(f64, Point)| (*x, value(point).unwrap_or(f64::NAN));
        let mut points: Vec<(f64, f64)> = self.points.iter().map(place).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let groups = points.chunk_by(|a, b| a.0 == b.0);
        groups.map(|group| group[(group.len() - 1) / 2]).collect()
    }
}
