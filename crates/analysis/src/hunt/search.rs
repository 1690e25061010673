//! The search for a problem on which a solver fails: random starts, a climb from each, then
//! shrinking of the best.
//!
//! A start is a problem of the [kinds](super::KINDS) or of a family of the library, if it is valid
//! for the search, or JJᵀ of small integers, + I if it must be definite. A climb makes small random
//! changes and keeps those that do not lower the measure, until there has been no gain for a long
//! time. Climbs run in parallel in rounds of a fixed size, each with its own random numbers, so
//! that the same seed and budget find the same problem on any number of threads; a time limit only
//! ends the search sooner.

use std::ops::RangeInclusive;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use rayon::prelude::*;

use lcplab_lcp::Lcp;
use lcplab_lcp::error::{Defects, Result};
use lcplab_lcp::library;
use lcplab_solver::Stop;

use super::measure::{Measure, Score, Target};
use super::numbers::{Numbers, Random};
use super::problem;

/// Number of parallel climbs, independent of the number of threads.
const ROUND: usize = 16;
/// Maximum number of evaluations in a climb, and of those without a gain.
const CLIMB: usize = 4000;
const PATIENCE: usize = 500;
/// While a problem is shrunk, its measure must stay above this fraction of the original.
const KEPT: f64 = 0.9;
/// The same for yes-or-no measures: the value may become small, but must stay visible.
const KEPT_OF_A_LIE: f64 = 0.1;
/// A changed problem is evaluated up to this multiple of the current iterations, once they are
/// above the minimum.
const GROWTH: usize = 4;
const LEAST_ITERATIONS: usize = 2000;

/// The parameters of a search.
///
/// ```
/// use lcplab_analysis::hunt::{Finding, Friction, Measure, Search, Target};
/// use lcplab_solver::{MatrixClass, Options, Registry, Stop};
///
/// // A problem of two or three rows, without friction, on which PGS needs many sweeps.
/// let target = Target {
///     measure: Measure::Iterations,
///     solver: Registry::standard().method("pgs", None)?.clone(),
///     baseline: None,
///     options: Options::default().with_max_iterations(1000),
///     model: None,
///     within: MatrixClass::Definite,
///     friction: Friction::Never,
///     allows_single_tangents: false,
///     best_omega: false,
/// };
/// target.validate()?;
/// let search = Search { rows: 2..=3, evaluations: 30, seed: 1, at_least: None, from: vec![] };
/// search.validate(&target)?;
/// let found = search.run(&target, &Stop::default(), &|_| ());
/// assert_eq!(found.useless("pgs"), None); // PGS solved some of them
/// let worst = found.counterexample.unwrap();
/// assert_eq!(target.score(&worst.lcp, 1000).value, worst.value); // the number of sweeps
/// let finding = Finding::of(&worst, &target, search.seed);
/// assert_eq!(finding.problem.lcp.len(), worst.lcp.len());
/// println!("{}{}", finding.equations(), finding.answers()); // the problem, and both x
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Search {
    /// The allowed numbers of rows.
    pub rows: RangeInclusive<usize>,
    /// The number of problems to try before the best one is shrunk.
    pub evaluations: usize,
    /// The seed of the random numbers.
    pub seed: u64,
    /// The search ends once the measure reaches this value.
    pub at_least: Option<f64>,
    /// Initial problems, of any size.
    pub from: Vec<Lcp>,
}

/// A counterexample.
#[derive(Debug, Clone)]
pub struct Counterexample {
    /// The smallest problem that shows the behavior.
    pub lcp: Lcp,
    /// Its measure.
    pub value: f64,
    /// The number of iterations of the solver.
    pub iterations: usize,
    /// The measure of the problem before shrinking.
    pub value_at_first: f64,
    /// Its number of rows.
    pub rows_at_first: usize,
    /// The number of the evaluation that found it, from 1.
    pub evaluation: usize,
    /// The number of evaluations for shrinking it.
    pub shrinking: usize,
}

/// The result of a search.
#[derive(Debug, Clone)]
pub struct SearchResult {
    /// The counterexample, if there is one: a false claim or a failure, or the largest measure
    /// above 0.
    pub counterexample: Option<Counterexample>,
    /// The number of problems tried before the shrinking.
    pub evaluations: usize,
    /// The number of problems that the solver answered correctly.
    pub solved: usize,
    /// The number of problems without an answer: the solver crashed, timed out or wrote unreadable
    /// output.
    pub unanswered: usize,
    /// The solver's message on the first problem without an answer, or on the first problem if it
    /// answered none correctly.
    pub trouble: Option<String>,
}

impl SearchResult {
    /// Why the search says nothing about the solver: it answered no problem correctly, or some not
    /// at all.
    pub fn useless(&self, solver: &str) -> Option<String> {
        let trouble = self
            .trouble
            .as_ref()
            .filter(|_| self.counterexample.is_none() && self.evaluations > 0)?;
        let (count, all) = (self.unanswered, self.evaluations);
        Some(match self.solved {
            0 => format!(
                "{solver} solves none of {all} problems; reason for the first one: {trouble}"
            ),
            _ => format!(
                "{solver} gives no answer to {count} of {all} problems; reason for the first one: {trouble}"
            ),
        })
    }
}

/// The best problem of a climb.
struct Climb {
    numbers: Numbers,
    score: Score,
    /// The evaluation that found it, within the climb, and the number of all evaluations.
    at: usize,
    used: usize,
    /// How many of them the solver answered correctly, and how many not at all.
    solved: usize,
    unanswered: usize,
    /// The first without an answer.
    first_unanswered: Option<Numbers>,
}

impl Climb {
    /// A climb that has arrived here after this number of evaluations.
    fn at(numbers: Numbers, score: Score, used: usize) -> Self {
        Climb { numbers, score, at: 0, used, solved: 0, unanswered: 0, first_unanswered: None }
    }
}

impl Score {
    fn is_above(&self, other: &Score) -> bool {
        (self.is_found, self.value) > (other.is_found, other.value)
    }
}

impl Search {
    /// Checks that the search can start.
    ///
    /// # Errors
    /// If the range of rows is empty, exceeds what exact arithmetic can handle, or is too small for
    /// a contact with friction; or if an initial problem is not valid for the search.
    pub fn validate(&self, target: &Target) -> Result<()> {
        let (least, most) = (*self.rows.start(), *self.rows.end());
        let mut defects = Defects::default();
        if least == 0 || least > most || most > 60 {
            defects.add("n", format!("must lie within 1..60, is {least}..{most}"));
        } else if target.needs_friction() && most < contact_rows(target) {
            let rows = contact_rows(target);
            let reason = format!("a contact with friction has {rows} rows, the most is {most}");
            defects.add("n", reason);
        }
        if self.evaluations == 0 {
            defects.add("evaluations", "must be at least 1, is 0");
        }
        for (k, lcp) in self.from.iter().enumerate() {
            if let Some(reason) = target.unfair(lcp) {
                defects.add(format!("starting problem {}", k + 1), reason.to_string());
            }
        }
        defects.into_result("search")
    }

    /// Runs the search; `tick` receives the number of additional problems tried.
    pub fn run(&self, target: &Target, stop: &Stop, tick: &(dyn Fn(usize) + Sync)) -> SearchResult {
        let (mut evaluations, mut solved, mut round) = (0, 0, 0);
        let (mut unanswered, mut first_unanswered) = (0, None);
        let mut best = self.given(target, &mut evaluations, &mut solved, stop);
        let mut is_over = best.as_ref().is_some_and(|(climb, _)| self.ends(target, &climb.score));
        while evaluations < self.evaluations && !is_over && stop.reason().is_none() {
            let left = self.evaluations - evaluations;
            let most = |k: usize| (left / ROUND + usize::from(k < left % ROUND)).min(CLIMB);
            let elite = best.as_ref().map(|(climb, _)| &climb.numbers);
            // The first climb of the round that was completed.
            let first = AtomicUsize::new(usize::MAX);
            let climb = |k: usize| {
                let from = elite.filter(|_| k % 2 == 1);
                let is_too_late = || first.load(Relaxed) < k || stop.reason().is_some();
                let climb = self.climb(target, round * ROUND + k, from, most(k), &is_too_late);
                tick(climb.used);
                if self.ends(target, &climb.score) {
                    first.fetch_min(k, Relaxed);
                }
                climb
            };
            for climb in (0..ROUND).into_par_iter().map(climb).collect::<Vec<Climb>>() {
                let at = evaluations + climb.at;
                evaluations += climb.used;
                solved += climb.solved;
                unanswered += climb.unanswered;
                first_unanswered = first_unanswered.or_else(|| climb.first_unanswered.clone());
                is_over = self.ends(target, &climb.score);
                if best.as_ref().is_none_or(|(best, _)| climb.score.is_above(&best.score)) {
                    best = Some((climb, at));
                }
                if is_over {
                    // The climbs after it were stopped early.
                    break;
                }
            }
            round += 1;
        }
        let found = best.filter(|(climb, _)| {
            climb.score.value > 0.0 && target.measure.is_found(climb.score.is_found)
        });
        let counterexample = found.map(|(climb, at)| self.shrunk(target, &climb, at, stop));
        let status_on =
            |numbers: Numbers| Some(target.answer(&numbers.lcp().ok()?).ok()?.status.to_string());
        let trouble = first_unanswered
            .and_then(status_on)
            .or_else(|| (solved == 0).then(|| self.first_trouble(target)).flatten());
        SearchResult { counterexample, evaluations, solved, unanswered, trouble }
    }

    /// The solver's message on the first problem.
    fn first_trouble(&self, target: &Target) -> Option<String> {
        let first = || self.start(target, 0, &mut self.random(0)).lcp().ok();
        let lcp = self.from.first().cloned().or_else(first)?;
        Some(target.answer(&lcp).ok()?.status.to_string())
    }

    /// The random numbers of a climb.
    fn random(&self, climb: usize) -> Random {
        Random::new(self.seed ^ 0x5eed, climb)
    }

    /// The given problem with the largest measure.
    fn given(
        &self,
        target: &Target,
        tried: &mut usize,
        solved: &mut usize,
        stop: &Stop,
    ) -> Option<(Climb, usize)> {
        let mut best: Option<(Climb, usize)> = None;
        for lcp in self.from.iter().take_while(|_| stop.reason().is_none()) {
            *tried += 1;
            let numbers = Numbers::of(lcp);
            let Ok(lcp) = numbers.clone().lcp() else { continue };
            let score = target.score(&lcp, target.options.settings.max_iterations);
            *solved += usize::from(score.is_right);
            if best.as_ref().is_none_or(|(best, _)| score.is_above(&best.score)) {
                best = Some((Climb::at(numbers, score, 1), *tried));
            }
        }
        best
    }

    /// Whether the search is finished.
    fn ends(&self, target: &Target, score: &Score) -> bool {
        match self.at_least {
            Some(least) => score.value >= least && target.measure.is_found(score.is_found),
            None => target.measure.is_yes_or_no() && score.is_found,
        }
    }

    fn climb(
        &self,
        target: &Target,
        k: usize,
        from: Option<&Numbers>,
        most: usize,
        is_too_late: &dyn Fn() -> bool,
    ) -> Climb {
        let random = &mut self.random(k);
        let rows = (*self.rows.start(), *self.rows.end());
        let mut candidate = from.cloned().unwrap_or_else(|| self.start(target, k, random));
        let score = Score { value: -1.0, ..Score::NOTHING };
        let mut climb = Climb::at(candidate.clone(), score, 0);
        let mut gained = 0;
        while climb.used < most && climb.used - gained < PATIENCE && !is_too_late() {
            climb.used += 1;
            if let Ok(lcp) = candidate.clone().lcp()
                && target.is_fair(&lcp)
            {
                let score = target.score(&lcp, most_iterations(target, &climb.score));
                climb.solved += usize::from(score.is_right);
                if !score.is_answered {
                    climb.unanswered += 1;
                    climb.first_unanswered.get_or_insert_with(|| candidate.clone());
                }
                if !climb.score.is_above(&score) {
                    if score.is_above(&climb.score) {
                        (gained, climb.at) = (climb.used, climb.used);
                    }
                    (climb.numbers, climb.score) = (candidate, score);
                }
                if self.ends(target, &climb.score) {
                    break;
                }
            }
            candidate = climb.numbers.changed(random, rows, &|lcp| target.is_fair(lcp));
        }
        climb
    }

    /// The start of climb k: a problem valid for the search, if its class has such starts.
    fn start(&self, target: &Target, k: usize, random: &mut Random) -> Numbers {
        let rows = self.rows.clone();
        if target.needs_friction() {
            let tangents = contact_rows(target) - 1;
            let least = (*rows.start()).max(1 + tangents);
            let numbers = problem::whole(random, least..=*rows.end(), problem::own(target.within));
            return numbers.with_contacts(random, tangents);
        }
        let of_size = |lcp: &Lcp| rows.contains(&lcp.len()) && target.is_fair(lcp);
        let found = match k % 3 {
            0 => Some(super::problem(self.seed, k / 3).0).filter(of_size),
            1 => family(random, rows.clone()).filter(of_size),
            _ => None,
        };
        found.map_or_else(
            || problem::whole(random, rows, problem::own(target.within)),
            |lcp| Numbers::of(&lcp),
        )
    }

    /// The smallest problem that shows what the climb found.
    fn shrunk(
        &self,
        target: &Target,
        climb: &Climb,
        evaluation: usize,
        stop: &Stop,
    ) -> Counterexample {
        let kept = if target.measure.is_yes_or_no() { KEPT_OF_A_LIE } else { KEPT };
        let goal = self.at_least.unwrap_or(kept * climb.score.value).min(climb.score.value);
        let rows = *self.rows.start()..=climb.numbers.len();
        let (mut smallest, mut score) = (climb.numbers.clone(), climb.score);
        let shows = |numbers: &Numbers, before: &Score| -> Option<Score> {
            let lcp = numbers.clone().lcp().ok().filter(|lcp| target.is_fair(lcp))?;
            let score = target.score(&lcp, most_iterations(target, before));
            let holds = score.value >= goal && target.measure.is_found(score.is_found);
            holds.then_some(score)
        };
        let (mut tried, mut failed, mut at) = (0, 0, 0);
        let mut simpler = smallest.simpler();
        while failed < simpler.len() && tried < self.evaluations && stop.reason().is_none() {
            let candidate = simpler[at % simpler.len()].than(&smallest);
            let has_rows = rows.contains(&candidate.len());
            tried += 1;
            match if has_rows { shows(&candidate, &score) } else { None } {
                Some(new) => {
                    (smallest, score, failed) = (candidate, new, 0);
                    simpler = smallest.simpler();
                }
                None => (failed, at) = (failed + 1, at + 1),
            }
        }
        Counterexample {
            lcp: smallest.lcp().expect("a problem that was solved"),
            value: score.value,
            iterations: score.iterations,
            value_at_first: climb.score.value,
            rows_at_first: climb.numbers.len(),
            evaluation,
            shrinking: tried,
        }
    }
}

/// The iteration limit for the next problem.
fn most_iterations(target: &Target, before: &Score) -> usize {
    let most = target.options.settings.max_iterations;
    match target.measure {
        Measure::Iterations | Measure::Ratio => {
            before.iterations.saturating_mul(GROWTH).clamp(LEAST_ITERATIONS.min(most), most)
        }
        _ => most,
    }
}

/// A random problem of a family that has such sizes.
fn family(random: &mut Random, rows: RangeInclusive<usize>) -> Option<Lcp> {
    let families: Vec<_> = library::without_games().collect();
    let family = families[random.whole(0, families.len() as i64 - 1) as usize];
    let n = random.whole(*rows.start() as i64, *rows.end() as i64) as f64;
    let seed = random.whole(1, 1000) as f64;
    let has = |name: &str| family.parameters().iter().any(|parameter| parameter.name == name);
    let values: Vec<(&str, f64)> =
        [("n", n), ("seed", seed)].into_iter().filter(|(name, _)| has(name)).collect();
    family.generate(&values).ok().map(|problem| problem.lcp)
}

/// The rows of a contact with friction: its normal and two tangents, or one if that is allowed.
fn contact_rows(target: &Target) -> usize {
    if target.allows_single_tangents { 2 } else { 3 }
}
