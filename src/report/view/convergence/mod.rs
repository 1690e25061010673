//! Convergence of the residual: by sweep, by method and by row.

mod methods;
mod rows;
mod sweeps;

use super::{Headline, Outcome, ReportPage, View};
use crate::report::study::convergence::methods::Progress;
use crate::report::study::convergence::rows::RowResiduals;
use crate::report::study::convergence::sweeps::Rates;
use crate::report::study::convergence::{Finding, Plan};

impl View for Plan {
    const TITLE: &'static str = "Convergence of the residual";

    fn show(&self, findings: &[Finding], document: &mut ReportPage) {
        let FindingsByKind { sweeps, methods, rows, .. } = FindingsByKind::of(findings);
        if !methods.is_empty() {
            methods::show(&methods, document);
        }
        if let (Some(plan), false) = (&self.rows, rows.is_empty()) {
            plan.show(&rows, document);
        }
        if !sweeps.is_empty() {
            sweeps::show(&sweeps, document);
        }
    }

    fn headline(&self, findings: &[Finding]) -> Headline {
        let methods = FindingsByKind::of(findings).methods;
        methods.first().map_or_else(Headline::default, |own| methods::headline(own))
    }

    fn outcome(&self, findings: &[Finding]) -> Outcome {
        let FindingsByKind { sweeps, methods, .. } = FindingsByKind::of(findings);
        let (rates, progress) = (sweeps::outcome(&sweeps), methods::outcome(&methods));
        let mut says = Vec::new();
        if !self.scenes.is_empty() || self.methods.is_none() {
            says.push(rates.says);
        }
        if self.methods.is_some() {
            says.push(progress.says);
        }
        Outcome { good: rates.good && progress.good, says: says.join("; ") }
    }
}

/// The findings by kind.
#[derive(Default)]
struct FindingsByKind<'a> {
    sweeps: Vec<&'a Rates>,
    methods: Vec<&'a Progress>,
    rows: Vec<&'a RowResiduals>,
}

impl<'a> FindingsByKind<'a> {
    fn of(findings: &'a [Finding]) -> Self {
        let mut found = FindingsByKind::default();
        for finding in findings {
            match finding {
                Finding::Sweeps(rates) => found.sweeps.push(rates),
                Finding::Methods(progress) => found.methods.push(progress),
                Finding::Rows(residuals) => found.rows.push(residuals),
            }
        }
        found
    }
}
