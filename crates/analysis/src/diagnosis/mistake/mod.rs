//! Finds the known mistakes that give exactly this x.
//!
//! Most wrong answers of solvers come from a few mistakes. Each known mistake is applied to the
//! same problem, and its answer is compared with the given x, as is the exact solution nearest to
//! x: an x near a solution is near everything that converges to it. A mistake is reported only if
//! it explains x at least a hundred times better than the solution does, in more numbers than were
//! fitted to x; all mistakes that explain it equally well are reported.
//!
//! ```
//! use lcplab_lcp::friction::ProblemForm;
//! use lcplab_lcp::{Lcp, Matrix};
//! use lcplab_analysis::diagnosis::find_mistakes;
//!
//! // Three balls on each other; after two sweeps x = (2, 1.5, 0.25).
//! let a = Matrix::dense(3, &[1.0, -1.0, 0.0, -1.0, 2.0, -1.0, 0.0, -1.0, 2.0]);
//! let lcp = Lcp::new(a, vec![-1.0, -1.0, 1.0], vec![0.0; 3], vec![f64::INFINITY; 3])?;
//! let problem = ProblemForm::Boxed(lcp);
//! let found = find_mistakes(&problem, &[2.0, 1.5, 0.25], None);
//! assert_eq!(found.mistakes[0].what, "projected Gauss-Seidel, stopped after 2 sweeps");
//! assert_eq!(found.mistakes[0].distance, 0.0);
//! // The solution (4, 3, 1) but for a thousandth in one entry: no known mistake.
//! assert!(find_mistakes(&problem, &[4.001, 3.0, 1.0], None).mistakes.is_empty());
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

mod active_set;
mod changed;
mod comparison;
mod contact_attempts;
mod contact_sweeps;
mod flawed_sweep;
mod friction_law;
mod kind;
mod moved_answer;
mod nearest;
mod precision;
mod sweeps;

pub use kind::MistakeKind;
pub use precision::Precision;
pub use sweeps::SweepLimits;

use lcplab_judge::regularity::regularity;
use lcplab_judge::{Demand, Verdict, judge_friction};
use lcplab_lcp::friction::{Contact, ProblemForm};
use lcplab_lcp::number::{counted, readable};
use lcplab_lcp::{Lcp, Matrix, merit};
use lcplab_solver::{Settings, Solver, Start};

use changed::{
    Changed, changed_problems, compliant, factor_of_b, free_rows, is_homogeneous,
    with_factor_of_mu, with_last_normals,
};
use comparison::{Agreement, Comparison};
use contact_sweeps::ContactSweeps;
use flawed_sweep::{Flaw, flawed_sweeps, scaled_start};
use friction_law::{Contacts, other_laws, rows, variants};
use nearest::{distance, nearest_solution, on_active_set, solution};
use sweeps::{SweepMatch, gauss_seidel, methods, single_precision_sweep, sweep};

/// Maximum number of rows for which mistakes are searched.
const LARGEST: usize = 500;
/// x solves a changed problem if its scaled residual is smaller by this factor there.
const MUCH_SMALLER: f64 = 1e3;
/// The residuals of x may differ from those of the mistake's answer by this part of the largest.
const OWN_ERROR: f64 = 0.5;
/// The same where rows are redundant, and x is one of many answers with its motion.
const OWN_ERROR_OF_MOTION: f64 = 0.01;
/// A solution this near to x, as a part of its largest entry, may be the one that x is.
const BESIDE: f64 = 1e-6;
/// Maximum number of rows that a mistake names.
const LARGEST_LIST: usize = 6;

/// A mistake whose answer is this x.
#[derive(Debug, Clone, PartialEq)]
pub struct Mistake {
    /// The kind of mistake.
    pub kind: MistakeKind,
    /// What was computed, with numbers.
    pub what: String,
    /// max |x − y| for the mistake's answer y, relative to the largest entry of x and of the
    /// solution.
    pub distance: f64,
    /// Whether x has too few digits to exclude that it agrees by chance.
    pub may_be_chance: bool,
}

/// The result of a search for the mistakes behind an answer.
#[derive(Debug, Clone, PartialEq)]
pub struct MistakeSearch {
    /// The judge's verdict on x.
    pub verdict: Verdict,
    /// The precision of x.
    pub precision: Precision,
    /// How the search ended.
    pub conclusion: Conclusion,
    /// The mistakes that give this x equally well within its digits; the nearest first, at equal
    /// distance the simplest.
    pub mistakes: Vec<Mistake>,
    /// The number of sweeps that were compared with x; 0 if nothing was compared.
    pub limits: SweepLimits,
    /// The number of rows of A that depend on others; with any, x need not be unique.
    pub redundant_rows: usize,
}

/// How a search for mistakes ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Conclusion {
    /// The judge accepts x, so there is no mistake to find.
    Accepted,
    /// An entry of x is not a finite number.
    NotFinite {
        /// Its row.
        row: usize,
    },
    /// The problem has more rows than the limit.
    TooManyRows {
        /// The maximum number of rows.
        limit: usize,
    },
    /// No solution of the problem is known, so the distance of x to one is unknown.
    NoSolutionKnown,
    /// x is an exact solution rounded to the digits of x.
    RoundedSolution {
        /// max |x − s| relative to the largest entry of both.
        distance: f64,
    },
    /// Every known mistake was compared with x.
    Compared {
        /// max |x − s| for the nearest known solution s, relative to the largest entry of both.
        solution_distance: f64,
    },
}

/// The known mistakes that give this x. `last` is the answer to the previous step, if it is known:
/// sweeps may start or should have started from it, and friction may still be limited by its normal
/// forces.
///
/// # Panics
/// If x or the last answer does not have one entry per row.
pub fn find_mistakes(problem: &ProblemForm, x: &[f64], last: Option<&[f64]>) -> MistakeSearch {
    let lcp = rows(problem);
    assert_eq!(x.len(), lcp.len(), "one entry per row");
    assert!(last.is_none_or(|last| last.len() == lcp.len()), "one entry per row");
    let mut search = MistakeSearch {
        verdict: judge_friction(problem, x, &Demand::default()).verdict,
        precision: Precision::of(x),
        conclusion: Conclusion::Accepted,
        mistakes: Vec::new(),
        limits: SweepLimits::default(),
        redundant_rows: 0,
    };
    if search.verdict.is_solution() {
        return search;
    }
    if let Some(row) = x.iter().position(|x| !x.is_finite()) {
        search.conclusion = Conclusion::NotFinite { row };
        return search;
    }
    if lcp.len() > LARGEST {
        search.conclusion = Conclusion::TooManyRows { limit: LARGEST };
        return search;
    }
    let limits = SweepLimits::of(lcp);
    search.redundant_rows = regularity(lcp.matrix()).map_or(0, |found| found.dependencies.len());
    let mut attempts = Attempts {
        lcp,
        x,
        limits,
        redundant_rows: search.redundant_rows,
        posed: problem,
        residuals: friction_law::residuals(problem, x),
        found: Vec::new(),
        last_iterates: Vec::new(),
    };
    let solution = match problem {
        ProblemForm::Boxed(_) => {
            attempts.unchanged(last);
            nearest_solution(lcp, x, &attempts.last_iterates)
        }
        ProblemForm::Polyhedral(_) | ProblemForm::Cone(_) => {
            attempts.unchanged_contacts(last);
            attempts.nearest_known()
        }
    };
    let Some(solution) = solution else {
        search.conclusion = Conclusion::NoSolutionKnown;
        return search;
    };
    let comparison = Comparison::new(x, &solution, search.precision);
    let solution_distance = comparison.solution_distance();
    if comparison.is_rounded_solution() {
        search.conclusion = Conclusion::RoundedSolution { distance: solution_distance };
        return search;
    }
    if let ProblemForm::Boxed(_) = problem {
        attempts.changed(last);
        attempts.fitted(&solution);
        attempts.flawed();
    }
    attempts.of_any_law(&solution);
    attempts.changed_contacts(last);
    search.conclusion = Conclusion::Compared { solution_distance };
    search.limits = limits;
    let posed = Posed { problem, residuals: &attempts.residuals, redundant: search.redundant_rows };
    search.mistakes = explanations(&comparison, &posed, attempts.found);
    if search.mistakes.is_empty() {
        let own = wrong_active_set(problem, x);
        search.mistakes = explanations(&comparison, &posed, own);
    }
    search
}

/// The accuracy of single precision: the scaled residuals of x and of the solution, both rounded to
/// it, if a solver finds one.
///
/// ```
/// use lcplab_analysis::diagnosis::single_precision;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // w = 3 x − 1: ⅓ has an error of 1e-8 in 32 bits.
/// let lcp = Lcp::new(Matrix::from([[3.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
/// let [own, rounded] = single_precision(&lcp, &[1.0 / 3.0]).unwrap();
/// assert!(own < 1e-15 && 1e-9 < rounded && rounded < 1e-7);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn single_precision(lcp: &Lcp, x: &[f64]) -> Option<[f64; 2]> {
    let rounded: Vec<f64> = solution(lcp)?.iter().map(|&x| f64::from(x as f32)).collect();
    Some([merit::scaled_residual(lcp, x), merit::scaled_residual(lcp, &rounded)])
}

/// The answer of a mistake.
struct Attempt {
    kind: MistakeKind,
    what: String,
    y: Vec<f64>,
    /// The number of sweeps; 1 if none were done.
    sweeps: usize,
    /// The number of values that were fitted to x.
    fitted: usize,
    /// The scaled residual of each row in the changed problem, if y is x itself.
    residuals: Option<Vec<f64>>,
}

impl Attempt {
    fn new(kind: MistakeKind, what: String, y: Vec<f64>) -> Self {
        Attempt { kind, what, y, sweeps: 1, fitted: 0, residuals: None }
    }
}

/// The equations of the active set of x, in which the rows at a bound are as in x.
fn wrong_active_set(problem: &ProblemForm, x: &[f64]) -> Vec<Attempt> {
    let found = match problem {
        ProblemForm::Boxed(lcp) => on_active_set(lcp, x),
        ProblemForm::Polyhedral(_) | ProblemForm::Cone(_) => {
            ContactSweeps::of(problem).and_then(|own| active_set::on_active_set(&own, x))
        }
    };
    let attempt = |(y, fitted): (Vec<f64>, usize)| {
        let what = "the equations of its own active set, which is not that of a solution".into();
        Attempt { fitted, ..Attempt::new(MistakeKind::WrongActiveSet, what, y) }
    };
    found.map(attempt).into_iter().collect()
}

/// The problem as posed, with the scaled residual of each row at x.
struct Posed<'a> {
    problem: &'a ProblemForm,
    residuals: &'a [f64],
    /// The number of rows that depend on others.
    redundant: usize,
}

impl Posed<'_> {
    /// Whether y violates the problem as x does. If y is right, or nearly, the error of x is its
    /// own, however near y is: of many solutions, the answer of a mistake may be one.
    fn is_violated_alike(&self, y: &[f64]) -> bool {
        let largest = self.residuals.iter().copied().fold(0.0, f64::max);
        let part = if self.redundant > 0 { OWN_ERROR_OF_MOTION } else { OWN_ERROR };
        let own = friction_law::residuals(self.problem, y);
        distance(self.residuals, &own) <= part * largest
            && !judge_friction(self.problem, y, &Demand::default()).verdict.is_solution()
    }
}

/// The attempts that explain x: the nearest first, then all that are as near.
fn explanations(
    comparison: &Comparison<'_>,
    posed: &Posed<'_>,
    attempts: Vec<Attempt>,
) -> Vec<Mistake> {
    let count = attempts.len();
    let agreement = |attempt: Attempt| {
        let agreement = match &attempt.residuals {
            Some(changed) => comparison.judged(posed.residuals, changed, attempt.fitted),
            None => comparison.agreement(&attempt.y, attempt.fitted)?,
        };
        let is_found = agreement.is_no_chance(count * attempt.sweeps);
        (is_found && posed.is_violated_alike(&attempt.y)).then_some((attempt, agreement))
    };
    let mut found: Vec<(Attempt, Agreement)> = attempts.into_iter().filter_map(agreement).collect();
    // The sort is stable: the simplest first.
    found.sort_by(|(_, a), (_, b)| a.distance.total_cmp(&b.distance));
    let nearest = found.first().map(|(_, agreement)| *agreement);
    found.retain(|(_, own)| nearest.is_some_and(|nearest| own.is_as_near_as(&nearest)));
    let mistake = |(attempt, agreement): (Attempt, Agreement)| Mistake {
        kind: attempt.kind,
        may_be_chance: agreement.may_be_chance(count * attempt.sweeps),
        what: attempt.what,
        distance: comparison.relative(agreement.distance),
    };
    found.into_iter().map(mistake).collect()
}

/// The number of these rows that depend on others of them.
fn redundant_among(lcp: &Lcp, rows: &[usize]) -> usize {
    let entry = |k: usize, l: usize| (k, l, lcp.matrix().entry(rows[k], rows[l]));
    let all = (0..rows.len()).flat_map(|k| (0..rows.len()).map(move |l| (k, l)));
    let entries: Vec<_> = all.map(|(k, l)| entry(k, l)).filter(|own| own.2 != 0.0).collect();
    let part = Matrix::sparse(rows.len(), &entries);
    regularity(&part).map_or(rows.len(), |found| found.dependencies.len())
}

/// All attempts on a problem.
struct Attempts<'a> {
    posed: &'a ProblemForm,
    /// Its A, b and bounds.
    lcp: &'a Lcp,
    x: &'a [f64],
    limits: SweepLimits,
    redundant_rows: usize,
    /// The scaled residual of each row at x.
    residuals: Vec<f64>,
    found: Vec<Attempt>,
    /// The limits of sweeps from 0 on the original problem: a solution, if they converge.
    last_iterates: Vec<Vec<f64>>,
}

impl Attempts<'_> {
    /// The original problem: nothing done, or sweeps stopped early.
    fn unchanged(&mut self, last: Option<&[f64]>) {
        let most = self.limits.of_problem;
        if let Some(last) = last {
            self.last_unchanged(last);
            for (kind, name, solver) in methods(most) {
                let swept = sweep(&*solver, self.lcp, &Start::at(last), self.x);
                self.stopped(kind, &format!("{name} from the last answer"), swept);
            }
            self.misplaced(last);
        }
        self.start_unchanged();
        let cold = if last.is_some() { " from 0 (a missing warm start)" } else { "" };
        for (kind, name, solver) in methods(most) {
            let kind = match kind {
                MistakeKind::StoppedSweeps if last.is_some() => MistakeKind::MissingWarmStart,
                kind => kind,
            };
            let swept = sweep(&*solver, self.lcp, &Start::default(), self.x);
            self.last_iterates.push(swept.last.clone());
            self.stopped(kind, &format!("{name}{cold}"), swept);
        }
        let swept = single_precision_sweep(self.lcp, most, self.x);
        let name = "projected Gauss-Seidel in single precision";
        self.stopped(MistakeKind::SinglePrecision, name, swept);
    }

    /// Sweeps on the original problem whose bounds are applied wrongly. They are compared with
    /// right ones in their own order: those in another order may end at the same x by chance.
    fn flawed(&mut self) {
        let most = self.limits.of_problem;
        for flaw in Flaw::ALL {
            let Some(swept) = flawed_sweeps(flaw, self.lcp, most, self.x) else { continue };
            let right = sweep(&gauss_seidel(most), self.lcp, &Start::default(), self.x);
            let ends_wrong = swept.stays_at_nearest() && !self.last_iterates.contains(&swept.last);
            if ends_wrong || right.nearest != swept.nearest {
                self.stopped(flaw.kind(), flaw.name(), swept);
            }
        }
    }

    /// Flawed sweeps that differ from the first attempts, which are right ones. Where no bound
    /// acts, a wrong clamp changes nothing. Where it does, the first sweeps may be right ones, and
    /// only the end is not.
    fn stopped_if_other(&mut self, kind: MistakeKind, name: &str, swept: SweepMatch, right: usize) {
        let ends_wrong = swept.stays_at_nearest() && !self.last_iterates.contains(&swept.last);
        if ends_wrong || self.found[..right].iter().all(|own| own.y != swept.nearest) {
            self.stopped(kind, name, swept);
        }
    }

    fn last_unchanged(&mut self, last: &[f64]) {
        let what = "the last answer, not updated";
        self.add(MistakeKind::NothingDone, what.into(), last.to_vec());
    }

    fn start_unchanged(&mut self) {
        let mut start = vec![0.0; self.lcp.len()];
        self.lcp.project_all(&mut start);
        let moved = if start.iter().all(|&x| x == 0.0) { "" } else { " clamped to its bounds" };
        let what = format!("the start, x = 0{moved}, not updated");
        self.add(MistakeKind::NothingDone, what, start);
    }

    /// Sweeps from the last answer of other rows, or from a multiple of it.
    fn misplaced(&mut self, last: &[f64]) {
        let (n, solver) = (self.lcp.len(), gauss_seidel(self.limits.of_changed));
        let first_normal = self.lcp.contacts().len() > 1;
        let shifts = [("a row", 1), ("a contact", 3)];
        for (what, by) in shifts.into_iter().take(if first_normal { 2 } else { 1 }) {
            for (to, by) in [("up", by), ("down", n - by)] {
                let start: Vec<f64> = (0..n).map(|i| last[(i + by) % n]).collect();
                let swept = sweep(&solver, self.lcp, &Start::at(&start), self.x);
                let name =
                    format!("projected Gauss-Seidel from the last answer, shifted {to} by {what}");
                self.stopped(MistakeKind::MisplacedWarmStart, &name, swept);
            }
        }
        let lcp = self.lcp;
        self.scaled_warm_start(last, "projected Gauss-Seidel", |start, sweeps| {
            gauss_seidel(sweeps).solve(lcp, &Start::at(start), &mut ()).x
        });
    }

    /// Sweeps from a multiple of the last answer.
    fn scaled_warm_start(
        &mut self,
        last: &[f64],
        method: &str,
        sweeps: impl Fn(&[f64], usize) -> Vec<f64>,
    ) {
        let Some((factor, swept)) = scaled_start(last, self.x, sweeps) else { return };
        let factor = readable(factor, 6);
        let what = match swept.sweeps {
            0 => format!("the last answer times {factor}, not updated"),
            _ => format!(
                "{method} from the last answer times {factor}, stopped after {}",
                counted(swept.sweeps, "sweep")
            ),
        };
        let own = Attempt::new(MistakeKind::ScaledWarmStart, what, swept.nearest);
        self.found.push(Attempt { fitted: 1, ..own });
    }

    /// What does not depend on the friction law: other laws, and answers that were changed.
    fn of_any_law(&mut self, solution: &[f64]) {
        let own = Contacts::of(self.posed);
        let contacts = own.as_ref().map_or(&[][..], |own| own.friction.contacts());
        self.found.extend(moved_answer::moved_answers(contacts, solution, self.x));
        if self.redundant_rows > 0 {
            self.moved_back(contacts);
        }
        if !is_homogeneous(self.lcp) {
            self.found.extend(moved_answer::scaled(solution, self.x));
        }
        let mut all = Vec::new();
        if let Some(own) = own.as_ref().filter(|_| !contacts.is_empty()) {
            all.extend(other_laws(self.posed, own));
        }
        if !matches!(self.posed, ProblemForm::Boxed(_)) {
            all.extend(variants(self.posed, self.x, solution, self.redundant_rows > 0));
        }
        for variant in all {
            let (kind, fitted) = (variant.kind, variant.fitted);
            let what = format!("the solution with {}", variant.what);
            if let Some(own) = self.judged(kind, &what, variant.residuals(self.x)) {
                self.found.push(Attempt { fitted: own.fitted + fitted, ..own });
            } else if let Some(y) = variant.solution() {
                self.found.push(Attempt { fitted, ..Attempt::new(kind, what, y) });
            }
        }
    }

    /// x with its rows in another order solves the problem.
    fn moved_back(&mut self, contacts: &[Contact]) {
        let orders = moved_answer::orders(self.lcp.len(), contacts);
        let count = orders.len();
        for (what, order) in orders {
            let moved: Vec<f64> = order.iter().map(|&i| self.x[i]).collect();
            let residuals = friction_law::residuals(self.posed, &moved);
            let own = self.judged_at(&moved, MistakeKind::OtherRows, &what, residuals);
            if let Some(own) = own {
                self.found.push(Attempt { sweeps: count, ..own });
            }
        }
    }

    /// x as an answer of a changed problem with these residuals, if rows are redundant: then x may
    /// be another solution of it than a solver finds.
    fn judged(&self, kind: MistakeKind, what: &str, residuals: Vec<f64>) -> Option<Attempt> {
        let own = self.judged_at(self.x, kind, what, residuals);
        own.filter(|_| self.redundant_rows > 0)
    }

    /// The same where the changed answer is `moved`. Its free rows that are redundant among
    /// themselves leave as many entries of it free.
    fn judged_at(
        &self,
        moved: &[f64],
        kind: MistakeKind,
        what: &str,
        residuals: Vec<f64>,
    ) -> Option<Attempt> {
        let largest = |all: &[f64]| all.iter().copied().fold(0.0, f64::max);
        let most = Settings::default().tolerance.min(largest(&self.residuals) / MUCH_SMALLER);
        (largest(&residuals) <= most).then(|| Attempt {
            fitted: redundant_among(self.lcp, &friction_law::free_rows(self.posed, moved)),
            residuals: Some(residuals),
            ..Attempt::new(kind, what.to_string(), self.x.to_vec())
        })
    }

    /// Changed problems, solved, or swept from 0.
    fn changed(&mut self, last: Option<&[f64]>) {
        // If a change does not affect the sweeps, it does not explain them.
        let distances = self.found.iter().map(|own| distance(self.x, &own.y));
        let nearest = distances.fold(f64::INFINITY, f64::min);
        for changed in changed_problems(self.lcp) {
            self.solved(changed.kind, &changed.what, &changed.lcp);
            self.swept(&changed, nearest, "", &Start::default());
        }
        let Some(last) = last else { return };
        if let Some(changed) = with_last_normals(self.lcp, last) {
            self.solved(changed.kind, &changed.what, &changed.lcp);
            self.swept(&changed, nearest, " from the last answer", &Start::at(last));
            self.swept(&changed, nearest, " from 0", &Start::default());
        }
    }

    /// Changed problems with a number fitted to x.
    fn fitted(&mut self, solution: &[f64]) {
        let free = free_rows(self.lcp, self.x);
        let compliant = compliant(self.lcp, self.x, &free);
        let friction = with_factor_of_mu(self.lcp, self.x).map(|(factor, lcp)| {
            (MistakeKind::FactorOfMu, format!("μ times {}", readable(factor, 6)), lcp)
        });
        // The solution of a multiple of b may be that multiple of another solution than this one.
        let known = (self.redundant_rows == 0).then_some(None);
        let ways = known.into_iter().chain([Some(&free[..])]);
        let mut scaled: Vec<_> = ways
            .filter_map(|some| {
                let factor = factor_of_b(self.lcp, self.x, solution, some)?;
                let b = self.lcp.b().iter().map(|b| factor * b).collect();
                let lcp = self.lcp.with_b(b).ok()?;
                let what =
                    format!("b times {} (check the time step and the unit)", readable(factor, 6));
                Some((MistakeKind::FactorOfB, what, lcp))
            })
            .collect();
        scaled.dedup_by(|(_, first, _), (_, second, _)| first == second);
        for (kind, what, lcp) in compliant.into_iter().chain(scaled).chain(friction) {
            self.solved(kind, &what, &lcp);
            if let Some(own) = self.found.last_mut().filter(|own| own.kind == kind) {
                own.fitted += 1;
            }
        }
    }

    fn add(&mut self, kind: MistakeKind, what: String, y: Vec<f64>) {
        self.found.push(Attempt::new(kind, what, y));
    }

    /// The solution of a changed problem, if a solver finds it, or x if it is one.
    fn solved(&mut self, kind: MistakeKind, what: &str, changed: &Lcp) {
        let what = format!("the solution with {what}");
        let residuals = friction_law::residuals(&ProblemForm::Boxed(changed.clone()), self.x);
        if let Some(own) = self.judged(kind, &what, residuals.clone()) {
            self.found.push(own);
            return;
        }
        let y = solution(changed);
        let size = self.x.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let is_near = y.as_ref().is_some_and(|y| distance(self.x, y) <= BESIDE * size);
        // With coupled friction x may be another of several solutions without redundant rows too.
        let other = self.judged_at(self.x, kind, &what, residuals);
        match other.filter(|_| self.lcp.has_coupled_rows() && !is_near) {
            Some(own) => self.found.push(own),
            None => self.found.extend(y.map(|y| Attempt::new(kind, what, y))),
        }
    }

    /// Gauss-Seidel on a changed problem, if it comes nearer to x than `nearest`.
    fn swept(&mut self, changed: &Changed, nearest: f64, from: &str, start: &Start) {
        let solver = gauss_seidel(self.limits.of_changed);
        let swept = sweep(&solver, &changed.lcp, start, self.x);
        if distance(self.x, &swept.nearest) < nearest {
            let name = format!("{}, projected Gauss-Seidel{from}", changed.what);
            self.stopped(changed.kind, &name, swept);
        }
    }

    /// Sweeps stopped where they come nearest to x.
    fn stopped(&mut self, kind: MistakeKind, name: &str, swept: SweepMatch) {
        let stays = swept.stays_at_nearest() && swept.sweeps < self.limits.of_changed;
        let SweepMatch { sweeps, nearest: y, .. } = swept;
        if sweeps > 0 {
            let count = counted(sweeps, "sweep");
            let what = match stays {
                true => format!("{name}, after {count} or more"),
                false => format!("{name}, stopped after {count}"),
            };
            self.found.push(Attempt { sweeps, ..Attempt::new(kind, what, y) });
        }
    }
}
