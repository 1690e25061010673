//! Errors of energy and of constraints: over time, by cause, and as a function of the step length.

mod ledger;
mod long;
mod order;

use super::{Outcome, ReportPage, View};
use crate::report::study::drift::ledger::Account;
use crate::report::study::drift::long::LongRun;
use crate::report::study::drift::{Finding, Plan, order as measured};

impl View for Plan {
    const TITLE: &'static str = "Drift of energy and constraints";

    fn show(&self, findings: &[Finding], document: &mut ReportPage) {
        let FindingsByKind { long, ledgers, orders } = FindingsByKind::of(findings);
        if !long.is_empty() {
            long::show(&long, document);
        }
        if !ledgers.is_empty() {
            ledger::show(&ledgers, document);
        }
        if !orders.is_empty() {
            order::show(&orders, document);
        }
    }

    fn outcome(&self, findings: &[Finding]) -> Outcome {
        let FindingsByKind { long, ledgers, orders } = FindingsByKind::of(findings);
        let mut parts = Vec::new();
        if !self.scenes.is_empty() || (self.ledgers.is_empty() && self.orders.is_none()) {
            parts.push(long::outcome(&long));
        }
        if !self.ledgers.is_empty() {
            parts.push(ledger::outcome(&ledgers));
        }
        if self.orders.is_some() {
            parts.push(order::outcome(&orders));
        }
        let good = parts.iter().all(|part| part.good);
        let says: Vec<String> = parts.into_iter().map(|part| part.says).collect();
        Outcome { good, says: says.join("; ") }
    }
}

/// The findings by kind.
struct FindingsByKind<'a> {
    long: Vec<&'a LongRun>,
    ledgers: Vec<&'a Account>,
    orders: Vec<&'a measured::Finding>,
}

impl<'a> FindingsByKind<'a> {
    fn of(findings: &'a [Finding]) -> Self {
        let mut found =
            FindingsByKind { long: Vec::new(), ledgers: Vec::new(), orders: Vec::new() };
        for finding in findings {
            match finding {
                Finding::Long(run) => found.long.push(run),
                Finding::Ledger(account) => found.ledgers.push(account),
                Finding::Order(order) => found.orders.push(order),
            }
        }
        found
    }
}
