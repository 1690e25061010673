//! `verify`: the closed forms.

use clap::Args;
use lcplab::error::Result;
use lcplab::report::study::verification::{self, Row, Size};
use lcplab::report::{text, view};
use serde_json::json;

use super::{Outcome, bar, print};

/// Compare simulations with closed-form results, at several lengths of the step
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  lcplab verify
  lcplab verify --only pendulum --json
  lcplab verify --long      # a pendulum and a stack of ten for a minute, by every scheme: an hour
  lcplab verify --long --only long-stack-xpbd-coupled-box

Each closed form is measured with dt, dt/2, dt/4 and dt/8. Errors that depend on dt must
fall at the theoretical order, within 0.1; others must be small at every dt. Exit code 1 if a check fails,
2 for bad input.")]
pub struct Verify {
    /// One case, by the name in the first column
    #[arg(long)]
    only: Option<String>,
    /// The cases of a simulated minute instead, at two step lengths
    #[arg(long, conflicts_with = "fast")]
    long: bool,
    /// Leave out dt/8
    #[arg(long)]
    fast: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

impl Verify {
    pub fn run(&self) -> Result<Outcome> {
        let size = if self.fast { Size::Fast } else { Size::Full };
        let rows = match self.long {
            true => {
                let count = self.only.as_ref().map_or(verification::long_cases(), |_| 1);
                let progress = bar(count as u64, "simulated minutes");
                verification::run_long(self.only.as_deref(), &|| progress.inc(1))?
            }
            false => verification::run(size, self.only.as_deref())?,
        };
        let passed = rows.iter().filter(|row| row.passes()).count();
        if self.json {
            let verdicts: Vec<_> = rows.iter().map(with_verdict).collect();
            print(&format!("{}\n", json!({ "rows": verdicts, "passed": passed })))?;
        } else {
            print(&text::table(&view::verification_table(&rows)))?;
            print(&format!("{passed} of {} rows pass\n", rows.len()))?;
        }
        Ok(if passed == rows.len() { Outcome::Good } else { Outcome::Refuted })
    }
}

/// A row with what follows from it.
fn with_verdict(row: &Row) -> serde_json::Value {
    let observed = row.derived_order().map(|_| lcplab::lcp::file::number(row.observed_order()));
    json!({ "row": row, "observed_order": observed, "passes": row.passes() })
}
