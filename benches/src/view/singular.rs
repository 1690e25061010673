//! What an exact answer costs where contacts are redundant.

use super::goal::{self, Asked, Goal};
use super::yardstick;
use crate::study::singular::Plan;
use crate::study::yardstick::{Finding, Times};
use lcplab::plot::{Axis, Lines, Panel, Series};
use lcplab::report::view::attempt::tolerance;
use lcplab::report::view::{Document, Outcome, View};

impl View for Plan {
    const TITLE: &'static str = "Right where contacts are redundant";

    fn show(&self, findings: &[Finding], document: &mut Document) {
        document.text(format!(
            "A cube on a cube touches it at four corners, where three would hold it: A is singular, the \
             impulses are not unique, and a pivot that should vanish is rounding. Each solver is asked for a \
             scaled residual of {}, its claim is judged; nobody may add to the diagonal but where \
             the problem says so (*regularised*). Clarabel, an interior-point code, is the yardstick: it is \
             asked for no smaller gap than it needs to arrive there too.",
            tolerance(self.tolerance)
        ));
        let title = "Redundant contacts: what the judge says";
        document.table("singular", yardstick::claims(title, findings));
    }

    fn show_times(&self, times: &[Times], document: &mut Document) {
        let goals: Vec<Goal> = self.solvers.iter().map(|name| self.goal_of(name, times)).collect();
        let command = "cargo bench -p lcplab-benches --bench singular";
        let title = "Exact answers to redundant contacts: goals";
        document.table("singular_goals", goal::table(title, command, &goals));
        document.figure(self.figure(times));
        document.table("singular_times", yardstick::seconds("Time to an exact answer", times));
    }

    fn outcome(&self, findings: &[Finding]) -> Outcome {
        yardstick::outcome("redundant contacts", findings)
    }
}

impl Plan {
    /// The worst of the problems that clarabel solves; a solver that fails one of all has no such time.
    fn goal_of(&self, solver: &str, times: &[Times]) -> Goal {
        let ratios: Vec<f64> = times.iter().filter_map(|times| times.ratio(solver)).collect();
        let failed = times.iter().filter(|times| times.failed.iter().any(|f| f == solver)).count();
        let what = match failed {
            0 => format!("{solver}: worst of {} problems that clarabel solves too", ratios.len()),
            failed => format!("{solver}: no answer to {failed} of {} problems", times.len()),
        };
        let worst = ratios.into_iter().reduce(f64::max);
        Goal {
            what,
            asked: Asked::AtMost(self.goal),
            unit: "of clarabel's time",
            measured: worst.filter(|_| failed == 0),
        }
    }

    fn figure(&self, times: &[Times]) -> Lines {
        let of = |solver: &String| {
            let point = |times: &Times| Some((times.rows as f64, times.ratio(solver)?));
            Series::points(solver.clone(), times.iter().filter_map(point).collect())
        };
        let rows = || times.iter().map(|times| times.rows as f64);
        let ends = [rows().fold(f64::MAX, f64::min), rows().fold(0.0, f64::max)];
        let at = |value: f64| ends.map(|rows| (rows, value)).to_vec();
        let lines = [
            Series::reference("as fast as clarabel", at(1.0)),
            Series::reference("must", at(self.goal)),
        ];
        Lines {
            id: "singular_times".into(),
            title: "Time to an exact answer, in times of clarabel's".into(),
            caption:
                "A marker each problem, by the best of all rounds; lower is faster. Stacks with \
                      and without friction, singular and regularised, share the axis."
                    .into(),
            x: Axis::log("rows", ""),
            panels: vec![Panel {
                y: Axis::log("time over clarabel's", ""),
                series: self.solvers.iter().map(of).chain(lines).collect(),
            }],
        }
    }
}
