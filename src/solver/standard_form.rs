//! A boxed problem as a standard one: pairs of variables that are not negative and not both positive.
//!
//! ```text
//! pinned, lo = hi     x = lo                leaves the problem
//! from below          x = lo + y            0 ≤ y ⟂ w ≥ 0
//! from above          x = hi − y            0 ≤ y ⟂ −w ≥ 0
//! from both sides     x = lo + y            0 ≤ y ⟂ w + v ≥ 0,   0 ≤ v ⟂ t = hi − lo − y ≥ 0
//! free                x solved for in w = 0, and leaves the pairs
//! ```
//!
//! v is the force with which the upper bound pushes back. Free rows are solved by elimination with
//! complete pivoting, which puts the Schur complement of A in place of A. What is left of them when
//! no pivot is left, because A is singular there, is split: x = y − v with 0 ≤ y ⟂ w ≥ 0 and
//! 0 ≤ v ⟂ t = −w ≥ 0. None of this changes that A is positive semidefinite.

use super::active_set::{ActiveSet, Side, unit};
use super::dictionary::Dictionary;
use crate::lcp::{Lcp, merit::RowTerms};

/// What a constant may lose to rounding in a block of exchanges, relative to its terms.
pub(super) const FORGIVEN: f64 = 1e-11;
/// Units of w that differ by more than this factor are far apart.
const FAR_APART: f64 = 1024.0;

/// A variable of Lemke's standard form; the number is the row of the boxed problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variable {
    /// y, the distance of x from its bound.
    Y(usize),
    /// The partner of y: w, −w or w + v.
    W(usize),
    /// v, the force of the other bound.
    V(usize),
    /// The partner of v: the distance of x from the other bound.
    T(usize),
    /// Lemke's covering variable.
    Cover,
}

impl Variable {
    /// The other one of its pair.
    pub(super) fn partner(self) -> Self {
        match self {
            Variable::Y(i) => Variable::W(i),
            Variable::W(i) => Variable::Y(i),
            Variable::V(i) => Variable::T(i),
            Variable::T(i) => Variable::V(i),
            Variable::Cover => Variable::Cover,
        }
    }

    /// The row of the boxed problem; none for the covering variable.
    pub fn row(self) -> Option<usize> {
        match self {
            Variable::Y(i) | Variable::W(i) | Variable::V(i) | Variable::T(i) => Some(i),
            Variable::Cover => None,
        }
    }
}

/// How a row of the boxed problem enters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Pinned,
    Below,
    Above,
    Both,
    Free,
}

impl Kind {
    fn of(lo: f64, hi: f64) -> Self {
        match (lo.is_finite(), hi.is_finite()) {
            _ if lo == hi => Kind::Pinned,
            (true, true) => Kind::Both,
            (true, false) => Kind::Below,
            (false, true) => Kind::Above,
            (false, false) => Kind::Free,
        }
    }
}

/// The standard form of a boxed problem, and the way back.
#[derive(Debug, Clone)]
pub(super) struct StandardForm {
    kind: Vec<Kind>,
    /// x = base + sign · y.
    base: Vec<f64>,
    sign: Vec<f64>,
    /// The equations; the first `pairs` rows are those of variables that must not be negative.
    pub(super) dictionary: Dictionary<Variable>,
    /// The number of pairs.
    pub(super) pairs: usize,
    /// Whether the rows have very different units.
    needs_units: bool,
}

impl StandardForm {
    /// The standard form of a problem without coupling; the W and T are basic.
    pub(super) fn of(lcp: &Lcp) -> Self {
        let n = lcp.len();
        let kind: Vec<Kind> = (0..n).map(|i| Kind::of(lcp.lo()[i], lcp.hi()[i])).collect();
        let base: Vec<f64> = (0..n)
            .map(|i| match kind[i] {
                Kind::Free => 0.0,
                Kind::Above => lcp.hi()[i],
                Kind::Pinned | Kind::Below | Kind::Both => lcp.lo()[i],
            })
            .collect();
        let sign: Vec<f64> =
            kind.iter().map(|&kind| if kind == Kind::Above { -1.0 } else { 1.0 }).collect();
        let rows: Vec<usize> = (0..n).filter(|&i| kind[i] != Kind::Pinned).collect();
        let entry = |i: usize, j: usize| sign[i] * lcp.matrix().entry(i, j) * sign[j];
        let dictionary = Dictionary {
            basic: rows.iter().map(|&i| Variable::W(i)).collect(),
            nonbasic: rows.iter().map(|&i| Variable::Y(i)).collect(),
            constant: rows.iter().map(|&i| sign[i] * lcp.row_w(i, &base)).collect(),
            terms: rows.iter().map(|&i| RowTerms::at(lcp, i, &base).magnitude).collect(),
            forgives: FORGIVEN,
            rows: rows.iter().map(|&i| rows.iter().map(|&j| entry(i, j)).collect()).collect(),
        };
        let units = rows.iter().map(|&i| unit(lcp, i));
        let (least, most) = units.fold((f64::INFINITY, 0.0), |(l, m), u| (u.min(l), u.max(m)));
        let needs_units = most > FAR_APART * least;
        let mut form = StandardForm { kind, base, sign, dictionary, pairs: 0, needs_units };
        form.eliminate_free();
        form.split_free();
        form.add_upper_bounds(lcp);
        form.put_pairs_first();
        form
    }

    /// Solves w = 0 for the free x, and drops their w.
    fn eliminate_free(&mut self) {
        let is_free = |i: usize| self.kind[i] == Kind::Free;
        self.dictionary.exchange(
            |v| matches!(v, Variable::W(i) if is_free(i)),
            |v| matches!(v, Variable::Y(i) if is_free(i)),
        );
        for c in (0..self.dictionary.nonbasic.len()).rev() {
            if matches!(self.dictionary.nonbasic[c], Variable::W(_)) {
                self.dictionary.drop_column(c);
            }
        }
    }

    /// Splits the free x that no equation of a free row contains any more.
    fn split_free(&mut self) {
        let d = &mut self.dictionary;
        let is_free = |v: Variable| v.row().is_some_and(|i| self.kind[i] == Kind::Free);
        let columns: Vec<usize> =
            (0..d.nonbasic.len()).filter(|&c| is_free(d.nonbasic[c])).collect();
        let rows: Vec<usize> = (0..d.basic.len())
            .filter(|&r| matches!(d.basic[r], Variable::W(_)) && is_free(d.basic[r]))
            .collect();
        for (r, c) in rows.into_iter().zip(columns) {
            let Variable::Y(i) = d.nonbasic[c] else { continue };
            d.basic[r] = Variable::W(i); // any of the leftover equations will do
            let column: Vec<f64> = d.rows.iter().map(|row| -row[c]).collect();
            d.add_column(Variable::V(i), |r| column[r]);
            let opposite = d.rows[r].iter().map(|entry| -entry).collect();
            d.add_row(Variable::T(i), -d.constant[r], opposite);
        }
    }

    fn add_upper_bounds(&mut self, lcp: &Lcp) {
        let d = &mut self.dictionary;
        for i in (0..lcp.len()).filter(|&i| self.kind[i] == Kind::Both) {
            let force_row = d.row_of(Variable::W(i));
            d.add_column(Variable::V(i), |r| f64::from(Some(r) == force_row));
            let distance = |&v: &Variable| if v == Variable::Y(i) { -1.0 } else { 0.0 };
            let row = d.nonbasic.iter().map(distance).collect();
            d.add_row(Variable::T(i), lcp.hi()[i] - lcp.lo()[i], row);
        }
    }

    /// Puts the solved free x below the pairs.
    fn put_pairs_first(&mut self) {
        let d = &mut self.dictionary;
        let is_pair = |&r: &usize| !matches!(d.basic[r], Variable::Y(_));
        let (pairs, free): (Vec<usize>, Vec<usize>) = (0..d.basic.len()).partition(is_pair);
        self.pairs = pairs.len();
        let order: Vec<usize> = pairs.into_iter().chain(free).collect();
        d.basic = order.iter().map(|&r| d.basic[r]).collect();
        d.constant = order.iter().map(|&r| d.constant[r]).collect();
        d.terms = order.iter().map(|&r| d.terms[r]).collect();
        d.rows = order.iter().map(|&r| std::mem::take(&mut d.rows[r])).collect();
    }

    /// How much the covering variable lifts this basic variable: 1 for all but distances to an upper
    /// bound, which are not negative to begin with; or the row's unit of w, if the units differ so
    /// much that the large would swallow the small.
    pub(super) fn cover(&self, lcp: &Lcp, variable: Variable) -> f64 {
        match variable {
            Variable::T(i) if self.kind[i] != Kind::Free => 0.0,
            Variable::W(i) | Variable::T(i) if self.needs_units => unit(lcp, i),
            Variable::W(_) | Variable::T(_) => 1.0,
            _ => 0.0,
        }
    }

    /// x while all nonbasic variables are 0.
    pub(super) fn x(&self, lcp: &Lcp) -> Vec<f64> {
        let d = &self.dictionary;
        let x = |i: usize| match self.kind[i] {
            Kind::Pinned => self.base[i],
            Kind::Free => d.value(Variable::Y(i)) - d.value(Variable::V(i)),
            _ => self.base[i] + self.sign[i] * d.value(Variable::Y(i)),
        };
        (0..self.kind.len()).map(|i| x(i).max(lcp.lo()[i]).min(lcp.hi()[i])).collect()
    }

    /// How x moves while the nonbasic variable of column c grows at rate 1.
    pub(super) fn direction(&self, c: usize) -> Vec<f64> {
        let d = &self.dictionary;
        let rate = |i: usize| match self.kind[i] {
            Kind::Pinned => 0.0,
            Kind::Free => d.rate(Variable::Y(i), c) - d.rate(Variable::V(i), c),
            _ => self.sign[i] * d.rate(Variable::Y(i), c),
        };
        (0..self.kind.len()).map(rate).collect()
    }

    /// The sides of the rows while all nonbasic variables are 0.
    pub(super) fn active_set(&self) -> ActiveSet {
        let is_zero = |v| self.dictionary.column_of(v).is_some();
        let side = |i: usize| match self.kind[i] {
            Kind::Pinned => Side::Lower,
            Kind::Below | Kind::Both if is_zero(Variable::Y(i)) => Side::Lower,
            Kind::Above if is_zero(Variable::Y(i)) => Side::Upper,
            Kind::Both if is_zero(Variable::T(i)) => Side::Upper,
            _ => Side::Free,
        };
        ActiveSet((0..self.kind.len()).map(side).collect())
    }
}
