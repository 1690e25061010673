//! Attempts on contacts, sweep by sweep.

use lcplab_solver::Start;

use super::attempts::Attempts;
use super::contact_sweeps::{ContactSweeps, Rule, Step};
use super::flawed_sweep::Flaw;
use super::friction_law;
use super::nearest::distance;
use super::sweeps::{contact_sweep, gauss_seidel, sweep};
use super::{Attempt, MistakeKind};

/// Maximum number of sweeps of each textbook variant.
const SWEEPS: usize = 500;
/// A limit of sweeps with this scaled residual is a solution.
const SOLVED: f64 = 1e-10;
/// The name of the method.
const METHOD: &str = "projected Gauss-Seidel, contact by contact";

impl Attempts<'_> {
    /// The original problem: nothing done, or sweeps stopped early, right or flawed.
    pub(super) fn unchanged_contacts(&mut self, last: Option<&[f64]>) {
        if let Some(last) = last {
            self.last_unchanged(last);
        }
        self.start_unchanged();
        if let Some(swept) = contact_sweep(self.posed, self.limits.of_problem, self.x) {
            self.last_iterates.push(swept.last.clone());
            self.stopped(MistakeKind::StoppedSweeps, METHOD, swept);
        }
        let Some(sweeps) = ContactSweeps::of(self.posed) else { return };
        let most = self.limits.of_problem.min(SWEEPS);
        let mut zero = vec![0.0; self.lcp.len()];
        self.lcp.project_all(&mut zero);
        if let Some(last) = last {
            self.warm_contacts(&sweeps, last, most);
        }
        let (kind, cold) = match last {
            Some(_) => (MistakeKind::MissingWarmStart, " from 0 (a missing warm start)"),
            None => (MistakeKind::StoppedSweeps, ""),
        };
        for step in Step::ALL {
            let swept = sweeps.nearest((Rule::Right, step), &zero, most, self.x);
            self.last_iterates.push(swept.last.clone());
            self.stopped(kind, &format!("{METHOD}{cold}"), swept);
        }
        let right = self.found.len();
        for (flaw, step) in Flaw::ALL.into_iter().flat_map(|flaw| Step::ALL.map(|own| (flaw, own)))
        {
            let swept = sweeps.nearest((Rule::Flawed(flaw), step), &zero, most, self.x);
            self.stopped_if_other(flaw.kind(), flaw.name(), swept, right);
        }
        let solver = gauss_seidel(self.limits.of_changed);
        let boxes = sweeps.friction().coupled_box();
        let swept = sweep(&solver, &boxes, &Start::default(), self.x);
        let name = "projected Gauss-Seidel with each tangent clamped on its own";
        self.stopped_if_other(MistakeKind::OtherLaw, name, swept, right);
    }

    /// Sweeps from the last answer, from a multiple of it, or from that of other contacts.
    fn warm_contacts(&mut self, sweeps: &ContactSweeps<'_>, last: &[f64], most: usize) {
        let contacts = sweeps.friction().contacts();
        let shifted = |by: usize| {
            let mut start = last.to_vec();
            for (k, contact) in contacts.iter().enumerate() {
                contact.put(contacts[(k + by) % contacts.len()].of(last), &mut start);
            }
            start
        };
        for step in Step::ALL {
            let method = (Rule::Right, step);
            let swept = sweeps.nearest(method, last, most, self.x);
            self.stopped(
                MistakeKind::StoppedSweeps,
                &format!("{METHOD}, from the last answer"),
                swept,
            );
            if contacts.len() > 1 {
                for (to, by) in [("up", 1), ("down", contacts.len() - 1)] {
                    let swept = sweeps.nearest(method, &shifted(by), most, self.x);
                    let name = format!("{METHOD}, from the last answer, shifted {to} by a contact");
                    self.stopped(MistakeKind::MisplacedWarmStart, &name, swept);
                }
            }
            self.scaled_warm_start(last, &format!("{METHOD},"), |start, count| {
                sweeps.sweeps(method, start, count, |_, _| ())
            });
        }
    }

    /// The solution nearest to x among those of solvers, of sweeps, and of sweeps from x.
    pub(super) fn nearest_known(&self) -> Option<Vec<f64>> {
        let from_x = ContactSweeps::of(self.posed).map(|own| own.refined(Rule::Right, self.x));
        let swept = self.last_iterates.iter().cloned().chain(from_x).filter(|y| {
            friction_law::residuals(self.posed, y).into_iter().fold(0.0, f64::max) <= SOLVED
        });
        let all = swept.chain(friction_law::solution(self.posed));
        all.min_by(|y, z| distance(self.x, y).total_cmp(&distance(self.x, z)))
    }

    /// Contacts with another rule, if x solves them.
    pub(super) fn changed_contacts(&mut self, last: Option<&[f64]>) {
        let Some(sweeps) = ContactSweeps::of(self.posed) else { return };
        let count = sweeps.friction().contacts().len();
        let mut all = vec![
            (MistakeKind::MissingBound, "lower bounds not applied", Rule::WithoutNormalBound),
            (
                MistakeKind::UnlimitedFriction,
                "friction without a limit",
                Rule::WithoutFrictionLimit,
            ),
        ];
        if count > 1 {
            all.extend([
                (
                    MistakeKind::OtherNormals,
                    "friction limited by the normal force of the next contact",
                    Rule::OtherNormals(1),
                ),
                (
                    MistakeKind::OtherNormals,
                    "friction limited by the normal force of the previous contact",
                    Rule::OtherNormals(count - 1),
                ),
            ]);
        }
        if let Some(last) = last {
            let what = "friction limited by the normal forces of the previous step";
            all.push((MistakeKind::LastNormals, what, Rule::NormalsOf(last)));
        }
        for (kind, what, rule) in all {
            let what = format!("the solution with {what}");
            let residuals = sweeps.residuals(rule, self.x);
            let is_solved = residuals.iter().all(|own| *own <= SOLVED);
            if let Some(own) = self.judged(kind, &what, residuals) {
                self.found.push(own);
            } else if is_solved {
                let y = sweeps.refined(rule, self.x);
                self.found.push(Attempt::new(kind, what, y));
            }
        }
    }
}
