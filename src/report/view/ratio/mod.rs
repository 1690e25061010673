//! Stacks with a heavy load: sweeps beside theory, and who got there at what cost.

mod words;

use self::words::cheapest;
use super::attempt::{
    iterations, iterations_in_words, outcome, rough, section_id, tolerance, work,
};
use super::{Document, Outcome, View};
use crate::error::Result;
use crate::lcp::file::Problem;
use crate::number::readable;
use crate::plot::{Axis, Bar, Bars, Lines, Panel, Series};
use crate::report::page::{Block, Cell, Column, Mark, Table};
use crate::report::proofs::{Answered, Judged};
use crate::report::study::attempt::{Attempt, Outcome as Came, attempt, entries, options};
use crate::report::study::ratio::{Plan, Stack, System, Tried};
use crate::solver::Entry;
use crate::solver::theory;

/// Predicted and counted sweeps between two precisions that differ by this part are the same.
const SAME: f64 = 0.03;
/// A residual that has not fallen to this part of that of x = 0 is no claim, however small it is.
const WORTH: f64 = 0.1;

impl View for Plan {
    const TITLE: &'static str = "Which solver for a stack with a heavy load on top";

    fn show(&self, stacks: &[Stack], document: &mut Document) {
        if let Some(stack) = self.chosen(stacks) {
            document.add(Block::Note(self.words(stack, stacks)));
        }
        document.text(
            "Put a heavy body on a light one. In each sweep Gauss-Seidel stops the light body against the \
             ground, then the heavy one against the light one, which gives way; so the light one carries \
             a little more in each sweep, and what a sweep leaves of the error is, for two bodies of mass \
             ratio r without friction,",
        );
        document.equation(
            "\\rho = \\frac{r}{1 + r}, \\qquad 1 - \\rho \\approx \\frac{1}{r}",
            "two bodies",
        );
        document.text(
            "So for large r and ten times the ratio a further digit takes ten times the sweeps. For a stack of boxes ρ is the largest eigenvalue \
             below 1 of the iteration matrix, and between two precisions lie",
        );
        document.equation(
            "k = \\frac{\\ln(\\varepsilon_2/\\varepsilon_1)}{\\ln\\rho} \\text{ sweeps}",
            "at the slowest rate",
        );
        let id = section_id(document);
        document.figure(self.figure(&id, stacks));
        if let Some(stack) = self.chosen(stacks) {
            document.figure(self.bars(&id, stack));
            document.table(&format!("{id}_chosen"), self.details(stack));
        }
        document.table(&format!("{id}_names"), self.names());
        document.table(&format!("{id}_theory"), self.theory(stacks));
        for (system, word) in [(System::TwoBodies, "two"), (System::Boxes, "boxes")] {
            let of_system: Vec<&Stack> = stacks.iter().filter(|s| s.system == system).collect();
            if !of_system.is_empty() {
                document.table(&format!("{id}_{word}"), self.table(system, &of_system));
            }
        }
    }

    fn judged(&self, section: &str, task: usize) -> Result<Vec<Judged>> {
        if self.stack(task) != (System::Boxes, self.about) {
            return Ok(Vec::new());
        }
        let lcp = self.posed(task)?.lcp;
        let mut answers = Vec::new();
        for entry in &entries(&self.solvers)? {
            for &precision in &self.tolerances {
                let answer = attempt(entry, &lcp, &options(precision, self.max_iterations)).x;
                answers.push(Answered {
                    table: format!("{section}_chosen"),
                    begins: vec![entry.name.into(), tolerance(precision)],
                    column: "judge",
                    answer,
                });
            }
        }
        let name = format!("{} boxes, ratio {}", self.boxes, self.about);
        Ok(vec![Judged { problem: Problem::new(name, lcp), answers }])
    }

    fn answer(&self, stacks: &[Stack]) -> Option<String> {
        let stack = self.chosen(stacks)?;
        let solved = by_cost(stack);
        let (least, pgs) = (solved.first()?, solved.iter().find(|a| a.solver == "pgs")?);
        Some(format!(
            "**Which solver carries a stack whose top is {} times as heavy?** Of {} boxes, solved once from x = 0 to {}, \
             {}. *pgs* needs {}, {} times as many multiplications, and games stop it long before. {}",
            readable(stack.ratio, 3),
            self.boxes,
            tolerance(*self.tolerances.last()?),
            cheapest(&solved),
            iterations_in_words("pgs", pgs.iterations),
            rough(pgs.work / least.work),
            self.loose(stack)
        ))
    }

    fn outcome(&self, stacks: &[Stack]) -> Outcome {
        let attempts = || stacks.iter().flat_map(|s| &s.tried).flat_map(|tried| &tried.attempts);
        let refuted = attempts().filter(|attempt| attempt.outcome == Came::Refuted).count();
        let agrees = |stack: &Stack| -> Vec<bool> {
            stack.tried.iter().filter_map(|tried| self.agrees(stack, tried)).collect()
        };
        let counted = |system: System| {
            let gaps = stacks.iter().filter(|stack| stack.system == system).flat_map(agrees);
            let gaps: Vec<bool> = gaps.collect();
            (gaps.iter().filter(|agrees| **agrees).count(), gaps.len())
        };
        let ((two, of_two), (boxes, of_boxes)) =
            (counted(System::TwoBodies), counted(System::Boxes));
        let says = format!(
            "sweeps on two bodies as predicted: {two} of {of_two}; on boxes at most as many: {boxes} of {of_boxes}; \
             {refuted} claims refuted"
        );
        Outcome { good: refuted == 0 && two == of_two && boxes == of_boxes, says }
    }
}

impl Tried {
    fn solver(&self) -> &str {
        self.attempts.first().map_or("", |attempt| &attempt.solver)
    }

    /// The attempt at the last precision.
    fn last(&self) -> Option<&Attempt> {
        self.attempts.last()
    }
}

impl Plan {
    fn name(&self, stack: &Stack) -> String {
        let system = match stack.system {
            System::TwoBodies => "two bodies".to_string(),
            System::Boxes => format!("{} boxes", self.boxes),
        };
        format!("{system}, r = {}", readable(stack.ratio, 3))
    }

    /// Sweeps between the first and the last precision: predicted and counted. A claim that was taken
    /// back took as many to get there.
    fn gap(&self, stack: &Stack, tried: &Tried) -> Option<(f64, usize)> {
        let (first, last) = (tried.attempts.first()?, tried.attempts.last()?);
        let (coarse, fine) = (*self.tolerances.first()?, *self.tolerances.last()?);
        // Of two bodies the residual at the start is known, and with it where a claim is possible.
        let coarse = match stack.system {
            System::TwoBodies => coarse.min(WORTH / (2.0 * (1.0 + stack.ratio))),
            System::Boxes => coarse,
        };
        let reached = |a: &Attempt| a.outcome.is_solved() || a.outcome == Came::Withdrawn;
        if tried.attempts.len() < 2 || !reached(first) || !reached(last) {
            return None;
        }
        let predicted = theory::sweeps_to(fine / coarse, tried.rate?);
        Some((predicted, last.iterations.saturating_sub(first.iterations)))
    }

    /// Whether theory holds: for two bodies the same number but for a few sweeps or 3 %, for boxes no more.
    fn agrees(&self, stack: &Stack, tried: &Tried) -> Option<bool> {
        let (predicted, counted) = self.gap(stack, tried)?;
        let slack = f64::max(4.5, SAME * predicted);
        let over = counted as f64 - predicted;
        Some(over <= slack && (stack.system == System::Boxes || over >= -slack))
    }

    fn figure(&self, id: &str, stacks: &[Stack]) -> Lines {
        let epsilon = self.tolerances.last().copied().unwrap_or(0.0);
        let panel = |system: System, label: &str, theory_name: &str| {
            let of_system: Vec<&Stack> = stacks.iter().filter(|s| s.system == system).collect();
            let solvers: Vec<&str> = of_system
                .first()
                .map(|stack| stack.tried.iter().map(Tried::solver).collect())
                .unwrap_or_default();
            let curve = |solver: &&str| {
                let point = |stack: &&Stack| {
                    let tried = stack.tried.iter().find(|tried| tried.solver() == *solver)?;
                    let attempt = tried.last().filter(|attempt| attempt.outcome.is_solved())?;
                    Some((stack.ratio, attempt.iterations as f64))
                };
                Series::measured(*solver, of_system.iter().filter_map(point).collect())
            };
            let shown = |solver: &&&str| SHOWN.contains(*solver);
            let mut series: Vec<Series> = solvers.iter().filter(shown).map(curve).collect();
            let prediction = |stack: &&Stack| {
                let pgs = stack.tried.iter().find(|tried| tried.solver() == "pgs")?;
                // Of two bodies the residual at the start is known too.
                let share = match system {
                    System::TwoBodies => 2.0 * (1.0 + stack.ratio),
                    System::Boxes => 1.0,
                };
                Some((stack.ratio, theory::sweeps_to(share * epsilon, pgs.rate?)))
            };
            let predicted: Vec<_> = of_system.iter().filter_map(prediction).collect();
            series.push(Series::theory(theory_name, predicted));
            Panel { y: Axis::log(label, ""), series }
        };
        Lines {
            id: format!("{id}_iterations"),
            title: format!("Iterations to {} against the mass ratio", tolerance(epsilon)),
            caption: format!(
                "Above two bodies, below {} boxes with friction, the top one r times as heavy. Sweeps grow \
                 with r: for two bodies along the dashed line, $k = \\ln(2(1 + r)\\varepsilon) / \\ln\\rho$, \
                 for boxes at most as $\\ln\\varepsilon / \\ln\\rho$. Shown are some of each kind; a point that is \
                 missing is a failure (see the tables), and one may hide under another. The lines that stay low do not care for the ratio: what they pay for it is the \
                 price of their iterations, in the bars below.",
                self.boxes
            ),
            x: Axis::log("mass ratio r", ""),
            panels: vec![
                panel(System::TwoBodies, "iterations, two bodies", "pgs, theory"),
                panel(System::Boxes, "iterations, boxes", "pgs, theory: at most"),
            ],
        }
    }

    /// What the solvers' names stand for.
    fn names(&self) -> Table {
        let row = |entry: &Entry| {
            [entry.name, entry.group.name(), entry.method, entry.source].map(Cell::text).to_vec()
        };
        Table {
            title: "The solvers, a line each".into(),
            how_to_read: "The name used in figures and tables, the kind of method, what it does, and where it comes from."
                .into(),
            columns: ["solver", "kind", "method", "source"].map(Column::words).to_vec(),
            rows: entries(&self.solvers).unwrap_or_default().iter().map(row).collect(),
            ..Table::default()
        }
    }

    fn theory(&self, stacks: &[Stack]) -> Table {
        let (coarse, fine) = match (self.tolerances.first(), self.tolerances.last()) {
            (Some(coarse), Some(fine)) => (*coarse, *fine),
            _ => (0.0, 0.0),
        };
        let row = |stack: &Stack, tried: &Tried| {
            let rate = tried.rate?;
            let closed = match (stack.system, tried.solver()) {
                (System::TwoBodies, "pgs") => Cell::number(stack.ratio / (1.0 + stack.ratio), 7),
                _ => Cell::text("–"),
            };
            let gap = self.gap(stack, tried);
            Some(vec![
                Cell::text(self.name(stack)),
                Cell::text(tried.solver()),
                closed,
                Cell::number(rate, 7),
                gap.map_or(Cell::text("–"), |(k, _)| Cell::count(k.round() as usize)),
                gap.map_or(Cell::text("not solved"), |(_, counted)| Cell::count(counted)),
                match self.agrees(stack, tried) {
                    Some(true) if stack.system == System::Boxes => {
                        Cell::text("no more").marked(Mark::Good)
                    }
                    Some(true) => Cell::text("agrees").marked(Mark::Good),
                    Some(false) => Cell::text("differs").marked(Mark::Note),
                    None => Cell::text("–"),
                },
            ])
        };
        Table {
            title: format!("Sweeps from {} to {}, predicted and counted", tolerance(coarse), tolerance(fine)),
            how_to_read: "*closed form*: r/(1 + r). *eigenvalue*: the contraction computed from the \
                          iteration matrix with every row free. *predicted*: the sweeps between the two precisions; \
                          the first one counts where the residual has fallen to a tenth of that of x = 0 \
                          too. *agreement*: for two bodies the same to 3 % or a few sweeps; for boxes an upper \
                          bound, marked *no more* where it holds: the slowest component of the error, in \
                          which the load rocks, has little share in a load that was put down straight."
                .into(),
            columns: vec![
                Column::words("stack"),
                Column::words("solver"),
                Column::numbers("closed form", ""),
                Column::numbers("eigenvalue", ""),
                Column::numbers("predicted", "sweeps"),
                Column::numbers("counted", "sweeps"),
                Column::words("agreement"),
            ],
            rows: stacks
                .iter()
                .flat_map(|stack| stack.tried.iter().filter_map(move |tried| row(stack, tried)))
                .collect(),
            ..Table::default()
        }
    }

    /// One line a solver and precision, one column a ratio.
    fn table(&self, system: System, stacks: &[&Stack]) -> Table {
        let solvers = stacks.first().map_or(0, |stack| stack.tried.len());
        let cell = |attempt: &Attempt| match &attempt.outcome {
            came if came.is_solved() => iterations(attempt),
            Came::Outside(_) => Cell::text("not for it"),
            Came::Withdrawn => Cell::text("taken back").marked(Mark::Note),
            other => outcome(other),
        };
        let row = |solver: usize, k: usize| {
            let tried = stacks.iter().filter_map(|stack| stack.tried.get(solver)?.attempts.get(k));
            let name = stacks.first().map_or("", |stack| stack.tried[solver].solver());
            let value = self.tolerances[k];
            let head =
                [Cell::text(name), Cell { value: Some(value), ..Cell::text(tolerance(value)) }];
            head.into_iter().chain(tried.map(cell)).collect()
        };
        let what = match system {
            System::TwoBodies => "Two bodies, the upper one heavier: iterations".to_string(),
            System::Boxes => {
                format!("{} boxes with friction, the top one heavier: iterations", self.boxes)
            }
        };
        let heads = [Column::words("solver"), Column::numbers("precision", "")];
        let ratios =
            stacks.iter().map(|s| Column::numbers(format!("r = {}", readable(s.ratio, 3)), ""));
        Table {
            title: what,
            how_to_read: "Sweeps, steps or pivots of those that solved it by the judge's word, and why the \
                          others did not. *taken back*: the scaled residual is within the precision, but \
                          the answer is hardly better than x = 0, and the solver makes no claim."
                .into(),
            columns: heads.into_iter().chain(ratios).collect(),
            rows: (0..solvers)
                .flat_map(|solver| (0..self.tolerances.len()).map(move |k| (solver, k)))
                .map(|(solver, k)| row(solver, k))
                .collect(),
            ..Table::default()
        }
    }

    /// All that came out for one stack.
    fn details(&self, stack: &Stack) -> Table {
        let rows = stack.tried.iter().flat_map(|tried| {
            let each = tried.attempts.iter().zip(&tried.missing).zip(&self.tolerances);
            each.map(|((attempt, missing), value)| {
                vec![
                    Cell::text(&attempt.solver),
                    Cell { value: Some(*value), ..Cell::text(tolerance(*value)) },
                    match missing {
                        Some(part) if part.abs() <= CARRIED => outcome(&attempt.outcome),
                        _ => Cell { mark: Mark::Plain, ..outcome(&attempt.outcome) },
                    },
                    iterations(attempt),
                    work(attempt),
                    uncarried(*missing),
                ]
            })
        });
        Table {
            title: format!("{}: all solvers", self.name(stack)),
            how_to_read: format!(
                "*judge*: what came of the claim, or why there was none. *not carried*: the part of \
                          the weight that the ground does not carry in the last iterate, solved or not, marked \
                          above {} %: a small residual does not make it small where the masses differ, and then \
                          the precision that was asked for is too loose.",
                readable(100.0 * CARRIED, 1)
            ),
            columns: vec![
                Column::words("solver"),
                Column::numbers("precision", ""),
                Column::words("judge"),
                Column::numbers("iterations", ""),
                Column::numbers("multiplications", ""),
                Column::numbers("not carried", "% of the weight"),
            ],
            rows: rows.collect(),
            ..Table::default()
        }
    }

    /// The stack of boxes that the words are about.
    fn chosen<'a>(&self, stacks: &'a [Stack]) -> Option<&'a Stack> {
        stacks.iter().find(|s| s.system == System::Boxes && s.ratio == self.about)
    }

    fn bars(&self, id: &str, stack: &Stack) -> Bars {
        let bars = by_cost(stack)
            .into_iter()
            .map(|attempt| Bar { name: attempt.solver.clone(), value: attempt.work })
            .collect();
        let epsilon = self.tolerances.last().copied().unwrap_or(0.0);
        Bars {
            id: format!("{id}_work"),
            title: format!("{}: multiplications to {}", self.name(stack), tolerance(epsilon)),
            caption: "Those that solved it, the cheapest on top; the axis is logarithmic. \
                      The bars are the leading terms of the methods, no times."
                .into(),
            x: Axis::log("multiplications", ""),
            bars,
        }
    }
}

/// The part of the weight that is not carried, in percent; rounding is 0.
fn uncarried(missing: Option<f64>) -> Cell {
    let Some(part) = missing else { return Cell::text("–") };
    let shown = if part.abs() < ROUNDING { 0.0 } else { 100.0 * part };
    let mark = if part.abs() > CARRIED { Mark::Bad } else { Mark::Plain };
    Cell { value: Some(100.0 * part), ..Cell::number(shown, 2) }.marked(mark)
}

/// A part of the weight below this is rounding.
const ROUNDING: f64 = 1e-12;
/// The part of the weight that may be missing in an answer to rely on.
const CARRIED: f64 = 1e-3;

/// The solvers in the figure; the tables have all.
const SHOWN: [&str; 8] =
    ["pgs", "sor", "nncg", "apgd", "mprgp", "interior-point", "newton", "dantzig"];

/// The attempts at the last precision that solved it at a cost that was counted, the cheapest first.
fn by_cost(stack: &Stack) -> Vec<&Attempt> {
    let last = stack.tried.iter().filter_map(Tried::last);
    let is_counted = |attempt: &&Attempt| attempt.outcome.is_solved() && attempt.work.is_finite();
    let mut solved: Vec<&Attempt> = last.filter(is_counted).collect();
    solved.sort_by(|a, b| a.work.total_cmp(&b.work));
    solved
}
