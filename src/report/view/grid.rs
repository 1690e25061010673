//! A grid's curves and tables.

use super::attempt::section_id;
use super::{Document, Outcome, View};
use crate::report::grid::{self, Point};
use crate::report::study::grid::{Found, Plan};

impl View for Plan {
    const TITLE: &'static str = "A grid of settings";

    fn show(&self, found: &[Found], document: &mut Document) {
        document.text(self.grid.text.trim());
        let points = found.iter().filter_map(|Found { task, finding }| {
            let task = self.plan.tasks.get(task - 1)?;
            Some(Point { task, finding: Some(finding), reason: None })
        });
        let points: Vec<Point> = points.collect();
        let id = format!("{}_", section_id(document));
        grid::show(&self.grid, &self.plan, &points, &id, document);
    }

    fn outcome(&self, found: &[Found]) -> Outcome {
        let refuted = found.iter().filter(|own| own.finding.get("refuted") > Some(0.0)).count();
        let says = format!(
            "{} of {} points measured, claims refuted at {refuted}",
            found.len(),
            self.plan.tasks.len()
        );
        Outcome { good: refuted == 0, says }
    }
}
