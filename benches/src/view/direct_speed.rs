//! What direct and Newton-like solvers cost by the number of rows.

use super::goal::{self, Asked, Goal};
use super::yardstick;
use crate::study::direct_speed::{Bounds, Plan};
use crate::study::yardstick::{Finding, Times, YARDSTICK};
use lcplab::plot::{Axis, Lines, Panel, Series};
use lcplab::report::view::attempt::tolerance;
use lcplab::report::view::{Document, Outcome, View};

impl View for Plan {
    const TITLE: &'static str = "Direct and Newton-like methods on definite problems";

    fn show(&self, findings: &[Finding], document: &mut Document) {
        document.text(format!(
            "Random dense problems with a definite A, its condition about {}, and an answer that was \
             chosen first. One-sided: half of the rows are at their bound. Two-sided: a third at each, a \
             third between. All are asked for a scaled residual of {}, and every answer is judged.",
            self.condition,
            tolerance(self.tolerance)
        ));
        document
            .table(Self::ID, yardstick::claims("Definite problems: what the judge says", findings));
    }

    fn show_times(&self, times: &[Times], document: &mut Document) {
        let title = "Direct and Newton-like methods: goals";
        let goals =
            goal::table(title, "cargo bench -p lcplab-benches --bench direct", &self.goals(times));
        document.table("direct_speed_goals", goals);
        document.figure(self.figure(times));
        let title = "Time to an answer of a definite problem";
        document.table("direct_speed_times", yardstick::seconds(title, times));
    }

    fn outcome(&self, findings: &[Finding]) -> Outcome {
        yardstick::outcome("definite problems", findings)
    }
}

impl Plan {
    const ID: &'static str = "direct_speed";

    fn goals(&self, times: &[Times]) -> Vec<Goal> {
        let sizes = self.one_sided.iter().filter(|n| **n >= self.goal.from);
        let goal = |&n: &usize| {
            let problem = Bounds::OneSided.problem(n);
            let times = times.iter().find(|times| times.problem == problem);
            let ratio = times.and_then(|times| times.ratio(&self.goal.solver));
            Goal {
                what: format!("{}: {problem}", self.goal.solver),
                asked: Asked::AtLeast(self.goal.faster),
                unit: "times as fast as clarabel",
                measured: ratio.map(f64::recip),
            }
        };
        sizes.map(goal).collect()
    }

    fn figure(&self, times: &[Times]) -> Lines {
        let panels = [(Bounds::OneSided, &self.one_sided), (Bounds::TwoSided, &self.two_sided)];
        let panels = panels.into_iter().filter(|(_, sizes)| !sizes.is_empty());
        Lines {
            id: "direct_speed_times".into(),
            title: format!("Time to a scaled residual of {}", tolerance(self.tolerance)),
            caption: "By the best of all rounds. The dashed line is as steep as a dense factorisation, eight \
                      times the time for twice the rows; its height means nothing. Only accepted \
                      answers have a marker."
                .into(),
            x: Axis::log("rows n", ""),
            panels: panels.map(|(bounds, sizes)| self.panel(bounds, sizes, times)).collect(),
        }
    }

    fn panel(&self, bounds: Bounds, sizes: &[usize], times: &[Times]) -> Panel {
        let at = |n: usize| {
            let problem = bounds.problem(n);
            times.iter().find(move |times| times.problem == problem)
        };
        let curve = |solver: &str| {
            let point = |&n: &usize| Some((n as f64, 1e3 * at(n)?.of(solver)?.best));
            Series::measured(solver, sizes.iter().filter_map(point).collect())
        };
        let names = [YARDSTICK].into_iter().chain(self.solvers.iter().map(String::as_str));
        let mut series: Vec<Series> = names.map(curve).collect();
        let last = series[0].points.last().copied();
        if let Some((n, slowest)) = last {
            let cubic = |&m: &usize| (m as f64, slowest * (m as f64 / n).powi(3));
            series.push(Series::theory("~ n³", sizes.iter().map(cubic).collect()));
        }
        Panel { y: Axis::log(format!("{}: time", bounds.name()), "ms"), series }
    }
}
