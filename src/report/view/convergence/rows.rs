//! The residual of each row after each sweep, as a shaded map.

use crate::number::readable;
use crate::plot::{Axis, Heat, Shaded};
use crate::report::study::convergence::rows::{RowResiduals, Rows, Sweep};
use crate::report::view::ReportPage;
use crate::report::view::attempt::section_id;

/// A residual (m/s) up to this is rounding.
const ROUNDING: f64 = 1e-14;

impl Rows {
    pub(super) fn show(&self, maps: &[&RowResiduals], document: &mut ReportPage) {
        document.text(format!(
            "**Why sweeps are slow on a stack.** {} bodies have fallen for one step. All of them move at the \
             same speed, so initially only the lowest contact closes, and its impulse stops one body. The \
             effect on the other bodies must propagate from row to row, because a row of A couples only \
             neighbors. Each update halves it.",
            self.bodies
        ));
        document.figure(self.figure(section_id(document) + "_rows", maps));
        document.text(Self::words(maps));
    }

    /// The finding: the largest residual after the last sweep, of the method with the most and of
    /// that with the least.
    fn title(&self, maps: &[&RowResiduals]) -> String {
        let by_left = |a: &&&RowResiduals, b: &&&RowResiduals| largest(a).total_cmp(&largest(b));
        let left = |map: &RowResiduals| {
            format!("{} m/s with {}", readable(largest(map), 2), map.method.name())
        };
        let sweeps = self.sweeps;
        match (maps.iter().max_by(by_left), maps.iter().min_by(by_left)) {
            (Some(most), Some(least)) => format!(
                "After {sweeps} sweeps the largest residual is {}, {}",
                left(most),
                left(least)
            ),
            _ => format!("Residuals in {sweeps} sweeps"),
        }
    }

    fn figure(&self, id: String, maps: &[&RowResiduals]) -> Heat {
        let panel = |map: &&RowResiduals| {
            let name = match map.method {
                Sweep::BestSor => format!("{} = {}", map.method.name(), readable(map.omega, 4)),
                method => method.name().to_string(),
            };
            Shaded { name, rows: map.residuals.clone() }
        };
        Heat {
            id,
            title: self.title(maps),
            caption: "Each small square is the residual of one row after one sweep; the contact with the \
                      ground is at the bottom, and white is a residual of 0. In sweeps from the top down, the \
                      impulse of the ground moves up by one row per sweep: the white area shows the rows that \
                      it has not reached. In sweeps from the ground up, it reaches the top in the first sweep, \
                      but halved in each row, so that almost nothing arrives (the row swept last is always \
                      satisfied). Then the residuals of the lowest rows decrease slowly, and those of the \
                      upper rows rise until all are similar. With the best ω the residual drops row by row \
                      from the top, one row per sweep. With Jacobi's method, a row changes in every second \
                      sweep."
                .into(),
            across: "sweep".into(),
            upwards: "contact, upward".into(),
            value: Axis::log("residual", "m/s"),
            zero: ROUNDING,
            panels: maps.iter().map(panel).collect(),
        }
    }

    fn words(maps: &[&RowResiduals]) -> String {
        // The top row itself is satisfied immediately in a sweep from the ground up.
        let reached = |map: &&RowResiduals| {
            let top = map.residuals.iter().rev().nth(1)?;
            top.iter().position(|residual| *residual > ROUNDING)
        };
        let of = |map: &&RowResiduals| {
            let arrives = reached(map).map_or("never".into(), |sweep| sweep.to_string());
            format!("{arrives} (*{}*)", map.method.name())
        };
        let arrivals: Vec<String> = maps.iter().map(of).collect();
        format!(
            "Number of sweeps until the impulse from the ground reaches the second contact from the top: {}.",
            arrivals.join("; ")
        )
    }
}

/// The largest residual after the last sweep (m/s).
fn largest(map: &RowResiduals) -> f64 {
    let last = map.residuals.iter().filter_map(|row| row.last());
    last.copied().fold(0.0, f64::max)
}
