//! Scenes as animations.

use super::{Outcome, ReportPage, View};
use crate::report::page::markup::literal;
use crate::report::study::scenes::{Finding, Plan};

impl View for Plan {
    const TITLE: &'static str = "Animations of scenes";

    fn show(&self, findings: &[Finding], document: &mut ReportPage) {
        for Finding { title, teaches, animation } in findings {
            document.text(format!("**{}**: {}", literal(&animation.id), literal(title)));
            document.recorded(animation, &literal(teaches.trim()));
        }
    }

    fn outcome(&self, findings: &[Finding]) -> Outcome {
        let comes_to_its_end = |finding: &&Finding| {
            finding.animation.recordings.iter().all(|recording| recording.ending.is_none())
        };
        let whole = findings.iter().filter(comes_to_its_end).count();
        let says = format!("{whole} of {} scenes run to the end", findings.len());
        Outcome { good: whole == findings.len(), says }
    }
}
