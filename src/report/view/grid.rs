//! A grid's curves and tables.

use super::attempt::section_id;
use super::{Outcome, ReportPage, View};
use crate::report::grid::{self, Finding, Point};
use crate::report::study::grid::{Plan, PointResult, Seconds};

impl View for Plan {
    const TITLE: &'static str = "A grid of settings";

    fn show(&self, found: &[PointResult], document: &mut ReportPage) {
        document.text(grid::text(&self.grid, &self.plan, &self.points(found)));
        let id = format!("{}_", section_id(document));
        grid::show(&self.grid, &self.plan, &self.points(found), &id, document);
    }

    fn show_times(&self, times: &[Option<Seconds>], document: &mut ReportPage) {
        let found: Vec<PointResult> = times.iter().flatten().map(Seconds::found).collect();
        let id = format!("{}_", self.grid.name);
        grid::show_seconds(&self.grid, &self.plan, &self.points(&found), &id, document);
    }

    fn outcome(&self, found: &[PointResult]) -> Outcome {
        let rejected = found.iter().filter(|own| own.finding.get("rejected") > Some(0.0)).count();
        let claims: Vec<bool> = found.iter().flat_map(|own| own.finding.claims()).collect();
        let held = claims.iter().filter(|held| **held).count();
        let theory = match claims.len() {
            0 => String::new(),
            all => format!(", {held} of {all} numbers match the closed form"),
        };
        let (points, all) = (found.len(), self.plan.tasks.len());
        let says = format!(
            "{points} of {all} points of the grid measured{theory}, {rejected} with false claims"
        );
        Outcome { good: rejected == 0 && held == claims.len(), says }
    }
}

impl Plan {
    fn points<'a>(&'a self, found: &'a [PointResult]) -> Vec<Point<'a>> {
        let point = |PointResult { task, finding }: &'a PointResult| {
            let task = self.plan.tasks.get(task - 1)?;
            Some(Point { task, finding: Some(finding), reason: None })
        };
        found.iter().filter_map(point).collect()
    }
}

impl Seconds {
    /// The time as a measure.
    fn found(&self) -> PointResult {
        let seconds = self.seconds.map(|seconds| ("seconds".to_string(), seconds.into()));
        let finding = Finding {
            status: "solved".into(),
            values: seconds.into_iter().collect(),
            ..Finding::default()
        };
        PointResult { task: self.task, finding }
    }
}
