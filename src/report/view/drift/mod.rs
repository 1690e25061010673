//! Errors of energy and of constraints: over time, by cause, and as a function of the step length.

mod ledger;
mod order;
mod steps;

use super::{Document, Outcome, View};
use crate::report::study::drift::ledger::Account;
use crate::report::study::drift::steps::Levels;
use crate::report::study::drift::{Finding, Plan, order as measured};

impl View for Plan {
    const TITLE: &'static str = "Drift of energy and constraints";

    fn show(&self, findings: &[Finding], document: &mut Document) {
        let FindingsByKind { levels, ledgers, orders } = FindingsByKind::of(findings);
        if !levels.is_empty() {
            steps::show(&levels, document);
        }
        if !ledgers.is_empty() {
            ledger::show(&ledgers, document);
        }
        if !orders.is_empty() {
            order::show(&orders, document);
        }
    }

    fn outcome(&self, findings: &[Finding]) -> Outcome {
        let FindingsByKind { levels, ledgers, orders } = FindingsByKind::of(findings);
        let mut parts = Vec::new();
        if !self.scenes.is_empty() || (self.ledgers.is_empty() && self.orders.is_none()) {
            parts.push(steps::outcome(&levels));
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
    levels: Vec<&'a Levels>,
    ledgers: Vec<&'a Account>,
    orders: Vec<&'a measured::Finding>,
}

impl<'a> FindingsByKind<'a> {
    fn of(findings: &'a [Finding]) -> Self {
        let mut found =
            FindingsByKind { levels: Vec::new(), ledgers: Vec::new(), orders: Vec::new() };
        for finding in findings {
            match finding {
                Finding::Levels(levels) => found.levels.push(levels),
                Finding::Ledger(account) => found.ledgers.push(account),
                Finding::Order(order) => found.orders.push(order),
            }
        }
        found
    }
}
