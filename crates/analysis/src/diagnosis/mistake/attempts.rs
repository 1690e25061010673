//! The attempts on a problem of any law, and on boxes: changed problems, sweeps, answers moved
//! back.

use lcplab_judge::regularity::regularity;
use lcplab_lcp::friction::{Contact, ProblemForm};
use lcplab_lcp::number::{counted, readable};
use lcplab_lcp::{Lcp, Matrix};
use lcplab_solver::{Settings, Solver, Start};

use super::changed::{
    Changed, changed_problems, compliant, factor_of_b, free_rows, is_homogeneous,
    with_factor_of_mu, with_last_normals,
};
use super::flawed_sweep::{Flaw, flawed_sweeps, scaled_start};
use super::friction_law::{self, Contacts, other_laws, variants};
use super::moved_answer;
use super::nearest::{distance, solution};
use super::sweeps::{
    SweepLimits, SweepMatch, gauss_seidel, methods, single_precision_sweep, sweep,
};
use super::{Attempt, MistakeKind};

/// x solves a changed problem if its scaled residual is smaller by this factor there.
const MUCH_SMALLER: f64 = 1e3;
/// A solution this near to x, as a part of its largest entry, may be the one that x is.
const SAME_SOLUTION: f64 = 1e-6;

/// Sweeps that reach their result sooner than this are reported with their number.
const FEW_SWEEPS: usize = 10;

/// The number of these rows that depend on others of them.
fn redundant_among(lcp: &Lcp, rows: &[usize]) -> usize {
    let entry = |k: usize, l: usize| (k, l, lcp.matrix().entry(rows[k], rows[l]));
    let all = (0..rows.len()).flat_map(|k| (0..rows.len()).map(move |l| (k, l)));
    let entries: Vec<_> = all.map(|(k, l)| entry(k, l)).filter(|own| own.2 != 0.0).collect();
    let part = Matrix::sparse(rows.len(), &entries);
    regularity(&part).map_or(rows.len(), |found| found.dependencies.len())
}

/// All attempts on a problem.
pub(super) struct Attempts<'a> {
    pub(super) posed: &'a ProblemForm,
    /// Its A, b and bounds.
    pub(super) lcp: &'a Lcp,
    pub(super) x: &'a [f64],
    pub(super) limits: SweepLimits,
    pub(super) redundant_rows: usize,
    /// The scaled residual of each row at x.
    pub(super) residuals: Vec<f64>,
    pub(super) found: Vec<Attempt>,
    /// The limits of sweeps from 0 on the original problem: a solution, if they converge.
    pub(super) last_iterates: Vec<Vec<f64>>,
}

impl Attempts<'_> {
    /// The original problem: nothing done, or sweeps stopped early.
    pub(super) fn unchanged(&mut self, last: Option<&[f64]>) {
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
    pub(super) fn flawed(&mut self) {
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
    pub(super) fn stopped_if_other(
        &mut self,
        kind: MistakeKind,
        name: &str,
        swept: SweepMatch,
        right: usize,
    ) {
        let ends_wrong = swept.stays_at_nearest() && !self.last_iterates.contains(&swept.last);
        if ends_wrong || self.found[..right].iter().all(|own| own.y != swept.nearest) {
            self.stopped(kind, name, swept);
        }
    }

    pub(super) fn last_unchanged(&mut self, last: &[f64]) {
        let what = "the last answer, not updated";
        self.add(MistakeKind::NothingDone, what.into(), last.to_vec());
    }

    pub(super) fn start_unchanged(&mut self) {
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
    pub(super) fn scaled_warm_start(
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
    pub(super) fn of_any_law(&mut self, solution: &[f64]) {
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
    pub(super) fn judged(
        &self,
        kind: MistakeKind,
        what: &str,
        residuals: Vec<f64>,
    ) -> Option<Attempt> {
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
    pub(super) fn changed(&mut self, last: Option<&[f64]>) {
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
    pub(super) fn fitted(&mut self, solution: &[f64]) {
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
        let is_near = y.as_ref().is_some_and(|y| distance(self.x, y) <= SAME_SOLUTION * size);
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
    pub(super) fn stopped(&mut self, kind: MistakeKind, name: &str, swept: SweepMatch) {
        let stays = swept.stays_at_nearest();
        let SweepMatch { sweeps, nearest: y, is_converged, .. } = swept;
        if sweeps > 0 {
            let count = counted(sweeps, "sweep");
            let what = match (stays, is_converged) {
                (true, true) if sweeps < FEW_SWEEPS => format!("{name}, after {count} or more"),
                (_, true) => format!("{name}, converged"),
                (true, false) => format!("{name}, after {count} or more"),
                (false, false) => format!("{name}, stopped after {count}"),
            };
            self.found.push(Attempt { sweeps, ..Attempt::new(kind, what, y) });
        }
    }
}
