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
    }

    /// The finding: the number of sweeps that the ground's impulse needs to reach the top.
    fn title(&self, maps: &[&RowResiduals]) -> String {
        let down = maps.iter().find(|map| map.method == Sweep::Down);
        let arrival = |top: &[f64]| top.iter().position(|residual| *residual > ROUNDING);
        let reached =
            down.and_then(|map| Some((map.residuals.len() - 1, arrival(map.residuals.last()?)?)));
        match reached {
            Some((top, sweeps)) => format!(
                "From the top down, the ground's impulse needs {sweeps} sweeps to reach contact {top}"
            ),
            None => format!("Residuals in {} sweeps", self.sweeps),
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
                      ground is at the bottom, and white is a residual of 0. Gauss-Seidel solves the last row of \
                      a sweep exactly, so that row is white: the top one upward, the bottom one downward. The other \
                      white area shows the rows that the impulse of the ground has not reached. In sweeps from \
                      the ground up it reaches the top in the first one, but halved in each row, so that almost \
                      nothing arrives. With the best ω the residual drops by one row per sweep; with Jacobi's \
                      method, a row changes in every second sweep."
                .into(),
            across: "sweep".into(),
            upwards: "contact, upward".into(),
            value: Axis::log("residual", "m/s"),
            zero: ROUNDING,
            panels: maps.iter().map(panel).collect(),
        }
    }
}
