//! The energy balance of a simulation, account by account.

use serde_json::Value;

use crate::lcp::file::number;
use crate::number::readable;
use crate::simulation::Ledger;

/// The energy balance of all steps so far.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct EnergyTotals {
    /// The sum of each account.
    pub(super) work: Ledger,
    /// The largest unexplained energy in a step (J).
    pub(super) remainder: f64,
    /// The largest unexplained energy in a step that exceeds rounding (J).
    pub(super) missed: f64,
}

impl EnergyTotals {
    pub(super) fn with(self, ledger: &Ledger) -> Self {
        let remainder = ledger.remainder().abs();
        let missed = if ledger.closes() { 0.0 } else { remainder };
        EnergyTotals {
            work: self.work + *ledger,
            remainder: self.remainder.max(remainder),
            missed: self.missed.max(missed),
        }
    }

    /// The work of each account (J).
    pub(super) fn by_account(&self) -> Value {
        let accounts = self.work.accounts();
        accounts.iter().map(|(name, work)| (name.to_string(), number(*work))).collect()
    }

    pub(super) fn text(&self) -> String {
        let mut text = self.balance() + ":";
        for (name, work) in self.notable() {
            text += &format!("\n{name:<12} {:>14} J", readable(work, 6));
        }
        text
    }

    /// Whether the accounts explain the change of the energy.
    pub(super) fn balance(&self) -> String {
        match self.missed {
            0.0 => format!("balances to {} J per step", readable(self.remainder, 2)),
            missed => format!("does not balance: error of {} J in one step", readable(missed, 2)),
        }
    }

    /// The work of each account (J) that is more than rounding.
    pub(super) fn notable(&self) -> Vec<(&'static str, f64)> {
        let accounts = self.work.accounts();
        let largest = accounts.iter().fold(0.0f64, |most, (_, work)| most.max(work.abs()));
        accounts.into_iter().filter(|(_, work)| work.abs() > 1e-12 * largest).collect()
    }
}
