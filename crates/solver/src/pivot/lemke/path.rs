//! Lemke's path: from the entry of the covering variable, pivot by pivot, to its end.

use std::collections::HashSet;
use std::ops::ControlFlow;

use super::PIVOTS_TO_RENEWAL;
use super::end::from_active_set;
use crate::linalg::elimination::difference;
use crate::pivot::ratio_test::{Blocking, Candidate, least};
use crate::pivot::standard_form::StandardForm;
use crate::tolerances::{CANCELLATION_TOLERANCE, UNCERTAIN_PIVOT};
use crate::{Event, Iterate, Leaving, Observer, Settings, Status, StepDetail, Tableau, Variable};
use lcplab_lcp::Lcp;

/// A path in progress.
pub(super) struct Path<'a> {
    pub(super) lcp: &'a Lcp,
    pub(super) form: StandardForm,
    /// The basic variables before the first pivot.
    first: Vec<Variable>,
    renews: bool,
    /// Whether some pivot may have been only rounding.
    pub(super) is_doubtful: bool,
    /// x after the last pivot.
    pub(super) x: Vec<f64>,
    pub(super) pivots: usize,
    /// The observer already knows the pivots up to this number.
    reported: usize,
}

impl<'a> Path<'a> {
    /// The start of the path, after `pivots` pivots on other paths; an observer receives the pivots
    /// after number `reported`.
    pub(super) fn new(lcp: &'a Lcp, pivots: usize, reported: usize) -> Self {
        let mut form = StandardForm::of(lcp);
        form.dictionary.cancellation_tolerance = 0.0;
        let (x, first) = (form.x(lcp), form.dictionary.basic()[..form.pairs].to_vec());
        Path { lcp, form, first, renews: false, is_doubtful: false, x, pivots, reported }
    }

    /// The same, with tableaux recomputed periodically and larger thresholds for zero.
    pub(super) fn with_renewals(mut self) -> Self {
        self.form.dictionary.cancellation_tolerance = CANCELLATION_TOLERANCE;
        Path { renews: true, ..self }
    }

    /// x at the end of the path, with its status.
    pub(super) fn solve(
        &mut self,
        settings: &Settings,
        observer: &mut dyn Observer,
    ) -> (Vec<f64>, Status) {
        let end = self.follow(settings.max_iterations, observer);
        let point = from_active_set(self.lcp, &self.form.active_set(), &self.x);
        let (claim, x) = (point.claim(self.lcp, settings.tolerance), point.x);
        match (claim, end) {
            (status, ControlFlow::Continue(())) => (x, status),
            // z₀ was zero up to rounding
            (Status::Solved, ControlFlow::Break(Status::Ray { .. } | Status::NotFinite)) => {
                (x, Status::Solved)
            }
            (_, ControlFlow::Break(status)) => (self.x.clone(), status),
        }
    }

    /// Pivots until the covering variable has left the basis.
    fn follow(&mut self, limit: usize, observer: &mut dyn Observer) -> ControlFlow<Status> {
        let start = self.pivots;
        if self.form.dictionary.constant()[..self.form.pairs].iter().all(|&c| c >= 0.0) {
            return ControlFlow::Continue(());
        }
        let mut entering = Variable::Cover;
        let mut seen = HashSet::new();
        loop {
            let column = self.form.name_column(entering);
            let Some(c) = column else { return ControlFlow::Break(Status::Stalled) };
            let blocking = self.blocking(c);
            let leaving = blocking.map(|blocking| self.name_leaving(blocking));
            self.report(Some(c), leaving, observer);
            let Some(leaving) = leaving else { return ControlFlow::Break(self.endless(c)) };
            if self.pivots >= limit {
                return ControlFlow::Break(Status::IterationLimit);
            }
            let left = self.pivot(leaving, c, observer)?;
            if left == Variable::Cover {
                self.report(None, None, observer);
                return ControlFlow::Continue(());
            }
            if !seen.insert(self.form.dictionary.basis()) {
                // Only rounding can lead back to an earlier basis.
                return ControlFlow::Break(Status::Stalled);
            }
            if self.renews && (self.pivots - start).is_multiple_of(PIVOTS_TO_RENEWAL) {
                self.renew();
            }
            entering = left.partner();
        }
    }

    /// Reports the tableau and the entering and leaving variables to an observer of step details.
    fn report(
        &self,
        entering: Option<usize>,
        leaving: Option<Leaving>,
        observer: &mut dyn Observer,
    ) {
        if observer.wants_details() {
            let d = &self.form.dictionary;
            let range = |&v: &Variable| self.form.range(self.lcp, v);
            observer.part(&StepDetail::Tableau(Tableau {
                basic: d.basic(),
                nonbasic: d.nonbasic(),
                constant: d.constant(),
                rows: &d.rows(),
                ranges: &d.basic().iter().map(range).collect::<Vec<_>>(),
                pairs: self.form.pairs,
                entering,
                leaving,
            }));
        }
    }

    /// One pivot; returns the variable that has become zero.
    fn pivot(
        &mut self,
        leaving: Leaving,
        c: usize,
        observer: &mut dyn Observer,
    ) -> ControlFlow<Status, Variable> {
        let d = &mut self.form.dictionary;
        let entering = d.nonbasic()[c];
        let left = match leaving {
            Leaving::Basic(r) => {
                self.is_doubtful |= d.part_of_row(r, c) <= UNCERTAIN_PIVOT;
                d.pivot(r, c);
                d.nonbasic()[c]
            }
            Leaving::Mirrored => {
                let range = self.form.range(self.lcp, entering);
                self.form.dictionary.mirror_column(c, range);
                entering.mirrored()
            }
        };
        self.pivots += 1;
        let x = self.form.x(self.lcp);
        if x.iter().any(|x| !x.is_finite()) {
            return ControlFlow::Break(Status::NotFinite);
        }
        self.x = x;
        let driven = entering.row().or(left.row()).unwrap_or(0);
        let event = Event::Pivot { driven, blocking: left.row().unwrap_or(driven) };
        let iterate = Iterate { iteration: self.pivots, x: &self.x, event };
        match self.pivots > self.reported && observer.observe(&iterate).is_break() {
            true => ControlFlow::Break(Status::Stopped),
            false => ControlFlow::Continue(left),
        }
    }

    /// The variable that first becomes zero when that of column c grows; the covering variable
    /// first grows until no other variable is negative.
    fn blocking(&self, c: usize) -> Option<Blocking> {
        let is_cover = self.form.dictionary.nonbasic()[c] == Variable::Cover;
        let candidates = if is_cover { self.lifted(c) } else { self.candidates(c) };
        least(candidates, &self.form.dictionary, &self.first)
    }

    /// Renames the leaving variable to the one of the mirrored pair that becomes zero.
    fn name_leaving(&mut self, blocking: Blocking) -> Leaving {
        match blocking {
            Blocking::Row(r) => Leaving::Basic(r),
            Blocking::Mirrored(r) => {
                let range = self.form.range(self.lcp, self.form.dictionary.basic()[r]);
                self.form.dictionary.mirror_row(r, range);
                Leaving::Basic(r)
            }
            Blocking::Entering => Leaving::Mirrored,
        }
    }

    /// The rows that the covering variable increases.
    fn lifted(&self, c: usize) -> Vec<Candidate> {
        let (value, weight) = (self.form.dictionary.constant(), self.form.dictionary.column(c));
        let row = |r| Candidate { blocking: Blocking::Row(r), value: value[r], weight: weight[r] };
        (0..self.form.pairs).map(row).collect()
    }

    /// The variables that may become zero when that of column c grows.
    fn candidates(&self, c: usize) -> Vec<Candidate> {
        let mut rate = self.form.dictionary.column(c);
        if self.renews {
            for (r, rate) in rate.iter_mut().enumerate() {
                if self.form.dictionary.part_of_row(r, c) <= UNCERTAIN_PIVOT {
                    *rate = 0.0;
                }
            }
        }
        let d = &self.form.dictionary;
        let mut candidates = Vec::new();
        let mut add = |blocking, value, weight| {
            candidates.push(Candidate { blocking, value, weight });
        };
        for r in 0..self.form.pairs {
            let (value, range) = (d.constant()[r], self.form.range(self.lcp, d.basic()[r]));
            if rate[r] < 0.0 {
                add(Blocking::Row(r), value, -rate[r]);
            } else if rate[r] > 0.0 && range.is_finite() {
                add(Blocking::Mirrored(r), difference(range, value), rate[r]);
            }
        }
        let range = self.form.range(self.lcp, d.nonbasic()[c]);
        if range.is_finite() {
            add(Blocking::Entering, range, 1.0);
        }
        candidates
    }

    /// Recomputes the tableau of the current basis from the first one.
    fn renew(&mut self) {
        let now = &self.form.dictionary;
        let mut renewed = StandardForm::of(self.lcp);
        renewed.mirror_as(self.lcp, now);
        renewed.dictionary.exchange(|v| now.column_of(v).is_some(), |v| now.row_of(v).is_some());
        if renewed.dictionary.basic().iter().all(|&v| now.row_of(v).is_some()) {
            self.form = renewed;
        }
    }
}
