//! Problem families × solvers, and performance profiles.

mod failures;

use super::attempt::{listed, tolerance};
use super::{Headline, Outcome, ReportPage, View};
use crate::number::readable;
use crate::plot::profile::{Curve, Group as Line, Profiles};
use crate::plot::{Axis, Bar, Bars, Figure};
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::profiles::{
    Cost, FamilyAttempts, Plan, Profile, costs, of_all, profiles,
};
use crate::report::study::solver_times::Record;
use crate::report::study::trial::{self, Attempt};
use crate::solver::{Entry, Group, Registry};

const PROFILE: &str = r"
A performance profile (Dolan & Moré 2002) compares the solvers problem by problem. Let $t_{ps}$ be the cost of solver s on
problem p, in multiplications, or ∞ if it did not solve it. Then

$$r_{ps} = \frac{t_{ps}}{\min_s t_{ps}}, \qquad \rho_s(\tau) = \frac{|\{p \in P : r_{ps} \le \tau\}|}{|P|}$$

$P$ are all problems that have a solution, also those that a specialized solver declines.
";

impl View for Plan {
    const TITLE: &'static str = "All solvers on all families";

    fn show(&self, tried: &[FamilyAttempts], document: &mut ReportPage) {
        let solvers = solvers(tried);
        if solvers.is_empty() {
            return;
        }
        document.text(
            "Every solver is run on every problem, at each precision, from $x = 0$. *Solved* means that the solver \
             reports a solution and the judge accepts it.",
        );
        document.text(self.words(tried, &solvers));
        document.figure(self.by_work(tried, &solvers));
        document.aside("What a performance profile is", PROFILE);
        document.table("profiles_cost", iteration_costs());
        document.table("profiles_solvers", self.by_solver(tried, &solvers));
        for (k, tolerance) in self.tolerances.iter().enumerate() {
            document.table(
                &format!("profiles_families_{}", k + 1),
                matrix(tried, &solvers, k, *tolerance),
            );
        }
        document.table("profiles_failures", failures::table(tried, &self.tolerances));
    }

    fn headline(&self, tried: &[FamilyAttempts]) -> Headline {
        let solvers = solvers(tried);
        let figure = self.solved(tried, &solvers).map(|bars| Box::new(bars) as Box<dyn Figure>);
        Headline { figure, result: self.result(tried), ..Headline::of(self.answer(tried)) }
    }

    fn outcome(&self, tried: &[FamilyAttempts]) -> Outcome {
        let all = |of| count(tried, None, None, of);
        let rejected = all(|attempt| attempt.outcome == trial::Outcome::Rejected);
        let says = format!(
            "{} attempts: {} reported as solved, {} answers accepted by the judge, {rejected} false claims",
            all(|attempt| attempt.outcome.is_attempt()),
            all(|attempt| attempt.outcome.is_claim()),
            all(|attempt| attempt.outcome.is_solved()),
        );
        Outcome { good: rejected == 0, says }
    }
}

impl Plan {
    /// The solvers that solve most problems.
    fn answer(&self, tried: &[FamilyAttempts]) -> Option<String> {
        let last = self.tolerances.len().checked_sub(1)?;
        let (solvers, costs) = (solvers(tried), costs(tried, last));
        let (best, named) = best_of_all(&solvers, &costs)?;
        let of_contacts = |solver: &str| semidefinite(tried, solver, last);
        let most = named.iter().map(|solver| of_contacts(solver).0).max()?;
        let (advised, equal): (Vec<_>, Vec<_>) =
            named.into_iter().partition(|solver| of_contacts(solver).0 == most);
        let italic = |those: &[&str]| -> Vec<String> {
            those.iter().map(|solver| format!("*{solver}*")).collect()
        };
        let with = match equal[..] {
            [] => String::new(),
            _ => format!(" (with {})", listed(&italic(&equal))),
        };
        let others = match costs.iter().filter(|row| !row.iter().any(is_solved)).count() {
            0 => String::new(),
            count => format!("; no solver solves {count} problems"),
        };
        let (_, all) = of_contacts(advised[0]);
        let as_good = solvers.iter().filter(|solver| of_contacts(solver).0 == most).count();
        let record = Record::shipped().ok();
        let fast = record.as_ref().and_then(Record::recommended).map(|own| own.solver);
        let fast =
            fast.filter(|solver| of_contacts(solver).0 == most).map_or(String::new(), |solver| {
                format!(" Among these choose by measured time (`lcplab report`): *{solver}*.")
            });
        let of_kind = if most == all { "all of them".into() } else { most.to_string() };
        Some(format!(
            "**Use {} for an LCP of any kind: {} {best} of the {} problems that have a solution, the most of {} \
             solvers{with}.** Contacts and joints have a symmetric semidefinite A; of the {all} problems of this kind {as_good} solvers solve {of_kind}.{fast} \
             (Tolerance {}{others}.)",
            italic(&advised).join(" or "),
            if advised.len() == 1 { "it solves" } else { "each solves" },
            costs.len(),
            solvers.len(),
            tolerance(self.tolerances[last])
        ))
    }

    /// The number of problems that each solver solves at the last tolerance, the most first.
    fn solved(&self, tried: &[FamilyAttempts], solvers: &[String]) -> Option<Bars> {
        let last = self.tolerances.len().checked_sub(1)?;
        let costs = costs(tried, last);
        let (best, named) = best_of_all(solvers, &costs)?;
        let bar = |(k, solver): (usize, &String)| {
            let all = costs.iter().filter(|row| is_solved(&row[k])).count();
            Bar {
                name: solver.clone(),
                accent: all == best,
                value: semidefinite(tried, solver, last).0 as f64,
                amount: all.to_string(),
                others: vec![all as f64],
            }
        };
        let mut bars: Vec<Bar> = solvers.iter().enumerate().map(bar).collect();
        bars.sort_by(|a, b| b.others[0].total_cmp(&a.others[0]).then(b.value.total_cmp(&a.value)));
        let least = bars.last()?;
        Some(Bars {
            id: "profiles_solved".into(),
            title: format!(
                "{} {} {best} of {} problems, {} {}",
                listed(&named),
                if named.len() == 1 { "solves" } else { "solve" },
                costs.len(),
                least.name,
                least.amount
            ),
            caption: format!(
                "The number of problems with a solution that each solver solves (tolerance {}). Dark: those with symmetric \
                 semidefinite A, as contacts and joints have; pale: the others.",
                tolerance(self.tolerances[last])
            ),
            x: Axis::linear("problems solved", ""),
            bars,
            limit: Some((costs.len() as f64, format!("all {}", costs.len()))),
        })
    }

    /// The accepted answers, the most problems that a solver solves, and those solvers.
    fn result(&self, tried: &[FamilyAttempts]) -> Option<([usize; 2], String)> {
        let last = self.tolerances.len().checked_sub(1)?;
        let (solvers, costs) = (solvers(tried), costs(tried, last));
        if solvers.is_empty() {
            return None;
        }
        let all = |of| count(tried, None, None, of);
        let [solved, claimed] =
            [all(|own| own.outcome.is_solved()), all(|own| own.outcome.is_claim())];
        let words = format!(
            "claimed solutions accepted by an independent judge: {} solvers, {} problems, {} tolerances",
            solvers.len(),
            costs.len(),
            self.tolerances.len()
        );
        Some(([solved, claimed], words))
    }

    /// By multiplications, at the last tolerance.
    fn by_work(&self, tried: &[FamilyAttempts], solvers: &[String]) -> Profiles {
        let costs = costs(tried, self.tolerances.len().saturating_sub(1));
        let caption = format!(
            "A curve is the share of the {} problems that a solver solves within τ times the cheapest solver's \
             multiplications (tolerance {}). The left end shows how often the solver is the cheapest, the right end how \
             often it succeeds at all. The curves of other groups are pale.",
            costs.len(),
            self.tolerances.last().map_or(String::new(), |own| tolerance(*own))
        );
        drawn(caption, solvers, &profiles(&of_all(&costs)))
    }

    /// The solvers that solved everything they attempted, and the cheapest ones, at the last
    /// tolerance.
    fn words(&self, tried: &[FamilyAttempts], solvers: &[String]) -> String {
        let Some(last) = self.tolerances.len().checked_sub(1) else { return String::new() };
        let costs = costs(tried, last);
        let profiles = profiles(&costs);
        let share = |profile: &Profile| profile.steps.last().map_or(0.0, |(_, share)| *share);
        let named = || solvers.iter().zip(&profiles);
        let all: Vec<String> = named()
            .filter(|(_, profile)| profile.attempted > 0 && share(profile) == 1.0)
            .map(|(solver, profile)| format!("*{solver}* ({})", profile.attempted))
            .collect();
        let rejected =
            count(tried, None, None, |attempt| attempt.outcome == trial::Outcome::Rejected);
        let unsolved = costs.iter().filter(|row| !row.iter().any(is_solved)).count();
        let mut text = format!("At {} ", tolerance(self.tolerances[last]));
        text += &match all.is_empty() {
            true => "no solver solved all solvable problems that it attempted. ".to_string(),
            false => {
                format!(
                    "{} solved all solvable problems that they attempted (number in brackets). ",
                    listed(&all)
                )
            }
        };
        let uncounted: Vec<String> = named()
            .filter(|(_, profile)| profile.attempted == 0)
            .map(|(solver, _)| format!("*{solver}*"))
            .collect();
        if !uncounted.is_empty() {
            text += &format!(
                "Not in the figure, because their multiplications are unknown or they attempted nothing: {}. ",
                listed(&uncounted)
            );
        }
        if unsolved > 0 {
            text += &format!("No solver solved {unsolved} of {} problems. ", costs.len());
        }
        text + &format!("False claims at all precisions: {rejected}.")
    }

    fn by_solver(&self, tried: &[FamilyAttempts], solvers: &[String]) -> Table {
        let mut rows = Vec::new();
        for solver in solvers {
            for (k, value) in self.tolerances.iter().enumerate() {
                let count = |of: fn(&Attempt) -> bool| count(tried, Some(solver), Some(k), of);
                let attempted = count(|attempt| attempt.outcome.is_attempt());
                let claimed = count(|attempt| attempt.outcome.is_claim());
                let rejected = count(|attempt| attempt.outcome == trial::Outcome::Rejected);
                let solved = count(|attempt| attempt.outcome.is_solved());
                rows.push(vec![
                    Cell::text(solver),
                    Cell { value: Some(*value), ..Cell::text(tolerance(*value)) },
                    Cell::count(attempted),
                    Cell::count(count(|attempt| !attempt.outcome.is_attempt())),
                    Cell::count(claimed),
                    Cell::count(solved),
                    Cell::count(count(|attempt| attempt.outcome == trial::Outcome::Proved)),
                    Cell::count(rejected).marked(if rejected == 0 {
                        Mark::Plain
                    } else {
                        Mark::Bad
                    }),
                    Cell::count(attempted - claimed),
                    {
                        let (solved, all) = semidefinite(tried, solver, k);
                        Cell::text(format!("{solved} of {all}"))
                    },
                    Cell::count(false_claims(tried, solver, k)).marked(
                        if false_claims(tried, solver, k) == 0 { Mark::Plain } else { Mark::Note },
                    ),
                ]);
            }
        }
        Table::new(
            "Solvers on all problems of the families",
            "*attempted*: the solver attempted the problem. *outside*: the solver reports that \
             the problem is outside its class. *claimed*: the solver reports a solution; *accepted* and \
             *proved*: the judge's verdicts on these claims; *rejected* must be 0. *failed*: attempted but not \
             claimed; the table of failures has the reasons. *semidefinite*: accepted answers to the problems \
             with symmetric semidefinite A, such as contact problems. \
             *no solution*: accepted answers to problems without a solution, which are possible only if they \
             cannot be distinguished from solvable ones at this precision.",
            "solver | #precision | #attempted | #outside | #claimed | #accepted | #proved | \
             #rejected | #failed | #semidefinite | #no solution",
            rows,
        )
    }
}

/// The most problems that a solver solves, and the solvers that do.
fn best_of_all<'a>(solvers: &'a [String], costs: &[Vec<Cost>]) -> Option<(usize, Vec<&'a str>)> {
    let solved = |solver: usize| costs.iter().filter(|row| is_solved(&row[solver])).count();
    let best = (0..solvers.len()).map(solved).max().filter(|best| *best > 0)?;
    let those = (0..solvers.len()).filter(|solver| solved(*solver) == best);
    Some((best, those.map(|solver| solvers[solver].as_str()).collect()))
}

/// The solvers, in the order of the attempts.
fn solvers(tried: &[FamilyAttempts]) -> Vec<String> {
    let first = tried.iter().flat_map(|family| &family.problems).next();
    let attempts = first.and_then(|problem| problem.attempts.first());
    attempts.into_iter().flatten().map(|attempt| attempt.solver.clone()).collect()
}

/// Profiles as a figure: one panel per group of solvers.
fn drawn(caption: String, solvers: &[String], profiles: &[Profile]) -> Profiles {
    let curve = |solver: usize| Curve {
        name: solvers[solver].clone(),
        columns: vec![(profiles[solver].steps.clone(), profiles[solver].attempted)],
    };
    let group = |group: Option<Group>| Line {
        name: group.map_or("Others", Group::name).into(),
        curves: (0..solvers.len())
            .filter(|solver| group_of(&solvers[*solver]) == group)
            .filter(|solver| profiles[*solver].attempted > 0)
            .map(curve)
            .collect(),
    };
    let groups = Group::ALL.into_iter().map(Some).chain([None]).map(group);
    Profiles {
        id: "performance_profiles".into(),
        title: finding(solvers, profiles),
        caption,
        x: Axis::log("τ: cost relative to the cheapest solver", ""),
        y: Axis::linear("share solved", ""),
        columns: vec![String::new()],
        groups: groups.filter(|group| !group.curves.is_empty()).collect(),
    }
}

/// The finding: the solvers that solve the most problems, and those that are the cheapest most
/// often.
fn finding(solvers: &[String], of_all: &[Profile]) -> String {
    let at_end = |profile: &Profile| profile.steps.last().map_or(0.0, |(_, share)| *share);
    let best = |share: &dyn Fn(&Profile) -> f64, verbs: [&str; 2]| {
        let most = of_all.iter().map(share).fold(0.0, f64::max);
        let named = solvers.iter().zip(of_all).filter(|(_, own)| share(own) == most);
        let named: Vec<String> = named.map(|(solver, _)| solver.clone()).collect();
        format!("{} {}", listed(&named), verbs[usize::from(named.len() > 1)])
            + &format!(" ({}\u{a0}%)", readable(100.0 * most, 2))
    };
    format!(
        "{}; {}",
        best(&at_end, ["solves the most problems", "solve the most problems"]),
        best(&at_one, ["is the cheapest most often", "are the cheapest most often"])
    )
}

fn is_solved(cost: &Cost) -> bool {
    matches!(cost, Cost::Solved(_))
}

/// The share of its problems on which a solver is the cheapest.
fn at_one(profile: &Profile) -> f64 {
    profile.steps.first().filter(|(tau, _)| *tau <= 1.0).map_or(0.0, |(_, share)| *share)
}

/// The number of attempts of a solver at a tolerance (or at all) that satisfy a condition.
fn count(
    tried: &[FamilyAttempts],
    solver: Option<&str>,
    tolerance: Option<usize>,
    of: fn(&Attempt) -> bool,
) -> usize {
    let problems = tried.iter().flat_map(|family| &family.problems);
    let chosen = problems.flat_map(|problem| {
        let at = |k: &usize| tolerance.is_none_or(|wanted| wanted == *k);
        problem.attempts.iter().enumerate().filter(move |(k, _)| at(k)).flat_map(|(_, tried)| tried)
    });
    let by = |attempt: &&Attempt| solver.is_none_or(|solver| solver == attempt.solver);
    chosen.filter(by).filter(|attempt| of(attempt)).count()
}

/// Accepted answers to problems without solution.
fn false_claims(tried: &[FamilyAttempts], solver: &str, tolerance: usize) -> usize {
    let problems = tried.iter().flat_map(|family| &family.problems).filter(|p| p.impossible);
    let attempts = problems.flat_map(|problem| &problem.attempts[tolerance]);
    attempts.filter(|a| a.solver == solver && a.outcome.is_solved()).count()
}

/// The number of accepted answers, and of all, among the solvable problems with symmetric
/// semidefinite A.
fn semidefinite(tried: &[FamilyAttempts], solver: &str, tolerance: usize) -> (usize, usize) {
    let problems = tried.iter().flat_map(|family| &family.problems);
    let solved: Vec<bool> = problems
        .filter(|problem| problem.semidefinite && !problem.impossible)
        .filter_map(|problem| {
            problem.attempts[tolerance].iter().find(|attempt| attempt.solver == solver)
        })
        .map(|attempt| attempt.outcome.is_solved())
        .collect();
    (solved.iter().filter(|solved| **solved).count(), solved.len())
}

/// One row per family, one column per solver, at one tolerance.
fn matrix(tried: &[FamilyAttempts], solvers: &[String], k: usize, value: f64) -> Table {
    let row = |family: &FamilyAttempts| {
        let cells = solvers.iter().map(|solver| {
            let attempts = family.problems.iter().flat_map(|problem| {
                problem.attempts[k].iter().filter(|attempt| attempt.solver == *solver)
            });
            let attempts: Vec<&Attempt> = attempts.collect();
            let impossible = family.problems.iter().any(|problem| problem.impossible);
            let attempted = attempts.iter().filter(|a| a.outcome.is_attempt()).count();
            let solved = attempts.iter().filter(|a| a.outcome.is_solved()).count();
            let proved = attempts.iter().filter(|a| a.outcome == trial::Outcome::Proved).count();
            match (attempted, solved) {
                (0, _) => Cell::text("·"),
                (_, 0) if impossible => Cell::text("none").marked(Mark::Plain),
                (n, s) if impossible => Cell::text(format!("{s}/{n}")).marked(Mark::Note),
                (n, s) if s < n => Cell::text(format!("{s}/{n}")).marked(Mark::Note),
                (n, _) if proved == n => Cell::text("proved").marked(Mark::Good),
                (_, _) => Cell::text("yes").marked(Mark::Good),
            }
        });
        let rows = family.problems.iter().map(|problem| problem.rows).max().unwrap_or(0);
        let head = [Cell::text(&family.family), Cell::count(rows)];
        head.into_iter().chain(cells).collect()
    };
    let heads = [Column::words("family"), Column::numbers("rows", "")];
    let solvers_heads = solvers.iter().map(Column::words);
    Table {
        title: format!("Families and solvers at {}", tolerance(value)),
        how_to_read: "*proved*: every problem of the family was claimed, accepted, and proved to have an exact \
         solution with this active set. *yes*: all were claimed and accepted. A fraction: the accepted part of \
         the attempted problems. ·: outside the class of the solver. *none*: no solution exists and none was \
         claimed."
            .into(),
        columns: heads.into_iter().chain(solvers_heads).collect(),
        rows: tried.iter().map(row).collect(),
        ..Table::default()
    }
}

/// The group of a solver of the library.
fn group_of(solver: &str) -> Option<Group> {
    Registry::standard().entry(solver).ok().map(|entry| entry.group)
}

/// The cost formulas of the registry: one row for the methods of a group with the same formula.
fn iteration_costs() -> Table {
    let mut rows: Vec<(Vec<&str>, &Entry)> = Vec::new();
    for entry in Registry::standard().entries() {
        let key = |e: &Entry| (e.group, e.cost.formula);
        match rows.iter_mut().find(|(_, first)| key(first) == key(entry)) {
            Some((names, _)) => names.push(&entry.name),
            None => rows.push((vec![&entry.name], entry)),
        }
    }
    let row = |(names, entry): &(Vec<&str>, &Entry)| {
        let iteration = entry.group.unit().trim_end_matches('s');
        vec![Cell::text(names.join(", ")), Cell::text(iteration), Cell::text(entry.cost.formula)]
    };
    Table::new(
        "Cost model of an iteration",
        "Multiplications, leading term of each method; n rows, s stored entries of A, f rows \
         between their bounds. The model ignores stop tests, line searches, additions, and zeros of A that a \
         factorization could use.",
        "solver | iteration | multiplications",
        rows.iter().map(row).collect(),
    )
}
