//! The standard form of a boxed problem: pairs of nonnegative variables of which at most one is
//! positive.
//!
//! ```text
//! pinned, lo = hi     x = lo                leaves the problem
//! from below          x = lo + y            0 ≤ y ⟂ w ≥ 0
//! from above          x = hi − y            0 ≤ y ⟂ −w ≥ 0
//! from both sides     x = lo + y            0 ≤ y ⟂ w + v ≥ 0,   0 ≤ v ⟂ t = hi − lo − y ≥ 0
//! free                x solved for in w = 0, and leaves the pairs
//! ```
//!
//! v is the force of the upper bound. A row bounded on both sides still needs only one equation and
//! one column. t is y measured from the other bound. v is nonzero only if t is 0, so w + v ≠ 0 (the
//! partner of y) or v ≠ 0, but never both: v is −w, measured from the other bound. The dictionary
//! contains whichever of the two must not be negative, and [mirrors](Dictionary::mirror_row) one
//! into the other.
//!
//! Free rows are solved by elimination with complete pivoting, which replaces A by its Schur
//! complement. Free rows without a pivot, because A is singular there, are split: x = y − v with
//! 0 ≤ y ⟂ w ≥ 0 and 0 ≤ v ⟂ t = −w ≥ 0. A stays positive semidefinite in all of this.

use super::active_set::{ActiveSet, Side, unit};
use super::dictionary::{Dictionary, RenamedLine};
use super::variable::Variable;
use crate::tolerances::{CANCELLATION_TOLERANCE, UNITS_FAR_APART};
use lcplab_lcp::{Lcp, merit::RowTerms};

/// How a row of the boxed problem enters the standard form.
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

/// The standard form of a boxed problem, with the transformation back.
#[derive(Debug, Clone)]
pub(crate) struct StandardForm {
    kind: Vec<Kind>,
    /// x = base + sign · y.
    base: Vec<f64>,
    sign: Vec<f64>,
    /// The equations; the first `pairs` rows are those of variables that must not be negative.
    pub(crate) dictionary: Dictionary,
    /// The number of pairs.
    pub(crate) pairs: usize,
}

impl StandardForm {
    /// The standard form of a problem without coupling; the W are basic. The covering variable is
    /// in the last column.
    pub(crate) fn of(lcp: &Lcp) -> Self {
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
        let dictionary = equations(lcp, &rows, &base, &sign);
        let mut form = StandardForm { kind, base, sign, dictionary, pairs: rows.len() };
        if form.kind.contains(&Kind::Free) {
            form.eliminate_free();
        }
        form.add_cover(lcp);
        form
    }

    /// Solves w = 0 for the free x, removes their w, splits the free x that no remaining equation
    /// of a free row contains, and moves the solved ones below the pairs.
    fn eliminate_free(&mut self) {
        let is_free = |v: Variable| v.row().is_some_and(|i| self.kind[i] == Kind::Free);
        let d = &mut self.dictionary;
        d.exchange(
            |v| matches!(v, Variable::W(_)) && is_free(v),
            |v| matches!(v, Variable::Y(_)) && is_free(v),
        );
        let take = |(index, &name): (usize, &Variable)| RenamedLine { name, index, sign: 1.0 };
        let of_basic = d.basic().iter().enumerate().map(take);
        let (mut pairs, solved): (Vec<RenamedLine>, Vec<RenamedLine>) =
            of_basic.partition(|row| matches!(row.name, Variable::W(_)));
        let of_nonbasic = d.nonbasic().iter().enumerate().map(take);
        let mut columns: Vec<RenamedLine> =
            of_nonbasic.filter(|column| !matches!(column.name, Variable::W(_))).collect();
        let cover = columns.pop();
        let left_rows: Vec<usize> = (0..pairs.len()).filter(|&r| is_free(pairs[r].name)).collect();
        let left_columns: Vec<RenamedLine> =
            columns.iter().filter(|column| is_free(column.name)).copied().collect();
        for (r, column) in left_rows.into_iter().zip(left_columns) {
            let Variable::Y(i) = column.name else { continue };
            // Any of the remaining equations works.
            pairs[r].name = Variable::W(i);
            pairs.push(RenamedLine { name: Variable::T(i), sign: -1.0, ..pairs[r] });
            columns.push(RenamedLine { name: Variable::V(i), sign: -1.0, ..column });
        }
        columns.extend(cover);
        self.pairs = pairs.len();
        pairs.extend(solved);
        self.dictionary = d.selection(&pairs, &columns);
    }

    /// Adds the covering variable to the equation of every basic variable that may be negative.
    fn add_cover(&mut self, lcp: &Lcp) {
        let (d, lifts) = (&mut self.dictionary, lifts(lcp));
        let last = d.nonbasic().len() - 1;
        for r in 0..self.pairs {
            let lift = d.basic()[r].row().map_or(1.0, |i| lifts[i]);
            d.set(r, last, lift);
        }
    }

    /// The range of the variable from 0: ∞ except for the distances from two finite bounds.
    pub(crate) fn range(&self, lcp: &Lcp, variable: Variable) -> f64 {
        match variable {
            Variable::Y(i) | Variable::T(i) if self.kind[i] == Kind::Both => {
                lcp.hi()[i] - lcp.lo()[i]
            }
            _ => f64::INFINITY,
        }
    }

    /// Makes a nonbasic variable appear under this name, mirroring it if necessary; returns its
    /// column.
    pub(crate) fn name_column(&mut self, variable: Variable) -> Option<usize> {
        let d = &mut self.dictionary;
        d.column_of(variable).or_else(|| {
            let is_boxed = variable.row().is_some_and(|i| self.kind[i] == Kind::Both);
            let c = d.column_of(variable.mirrored()).filter(|_| is_boxed)?;
            // v = −w
            d.mirror_column(c, 0.0);
            Some(c)
        })
    }

    /// Mirrors the variables to match another dictionary of this problem.
    pub(crate) fn mirror_as(&mut self, lcp: &Lcp, other: &Dictionary) {
        for i in (0..self.kind.len()).filter(|&i| self.kind[i] == Kind::Both) {
            let d = &mut self.dictionary;
            if let (Some(c), true) = (d.column_of(Variable::Y(i)), other.has(Variable::T(i))) {
                d.mirror_column(c, lcp.hi()[i] - lcp.lo()[i]);
            }
            if let (Some(r), true) = (d.row_of(Variable::W(i)), other.has(Variable::V(i))) {
                d.mirror_row(r, 0.0);
            }
        }
    }

    /// x while all nonbasic variables are 0.
    pub(crate) fn x(&self, lcp: &Lcp) -> Vec<f64> {
        let d = &self.dictionary;
        let x = |i: usize| match self.kind[i] {
            Kind::Pinned => self.base[i],
            Kind::Free => d.value(Variable::Y(i)) - d.value(Variable::V(i)),
            Kind::Both if !d.has(Variable::Y(i)) => lcp.hi()[i] - d.value(Variable::T(i)),
            _ => self.base[i] + self.sign[i] * d.value(Variable::Y(i)),
        };
        (0..self.kind.len()).map(|i| x(i).max(lcp.lo()[i]).min(lcp.hi()[i])).collect()
    }

    /// The rate of change of x while the nonbasic variable of column c grows at rate 1.
    pub(crate) fn direction(&self, c: usize) -> Vec<f64> {
        let d = &self.dictionary;
        let rate = |i: usize| match self.kind[i] {
            Kind::Pinned => 0.0,
            Kind::Free => d.rate(Variable::Y(i), c) - d.rate(Variable::V(i), c),
            Kind::Both => d.rate(Variable::Y(i), c) - d.rate(Variable::T(i), c),
            _ => self.sign[i] * d.rate(Variable::Y(i), c),
        };
        (0..self.kind.len()).map(rate).collect()
    }

    /// The sides of the rows while all nonbasic variables are 0.
    pub(crate) fn active_set(&self) -> ActiveSet {
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

/// The size of the covering variable's coefficient in each row: 1, or the unit of w if the units of
/// the rows that are not pinned differ so much that large ones would swamp small ones.
fn lifts(lcp: &Lcp) -> Vec<f64> {
    let units: Vec<f64> = (0..lcp.len()).map(|i| unit(lcp, i)).collect();
    let moving = (0..lcp.len()).filter(|&i| lcp.lo()[i] < lcp.hi()[i]).map(|i| units[i]);
    let (least, most) = moving.fold((f64::INFINITY, 0.0), |(l, m), u| (u.min(l), u.max(m)));
    if most > UNITS_FAR_APART * least { units } else { vec![1.0; lcp.len()] }
}

/// The coefficient of the covering variable in the w of each row, with the sign that moves w away
/// from the wrong side of zero; 0 if x is free or pinned.
pub(crate) fn cover(lcp: &Lcp) -> Vec<f64> {
    let of_row = |(i, lift): (usize, f64)| match Kind::of(lcp.lo()[i], lcp.hi()[i]) {
        Kind::Pinned | Kind::Free => 0.0,
        Kind::Above => -lift,
        Kind::Below | Kind::Both => lift,
    };
    lifts(lcp).into_iter().enumerate().map(of_row).collect()
}

/// w = b + A x in these rows as equations in their y, with a column of zeros for the covering
/// variable.
fn equations(lcp: &Lcp, rows: &[usize], base: &[f64], sign: &[f64]) -> Dictionary {
    let mut column = vec![None; lcp.len()];
    rows.iter().enumerate().for_each(|(c, &j)| column[j] = Some(c));
    let mut dictionary = Dictionary::new(
        rows.iter().map(|&i| Variable::W(i)).collect(),
        rows.iter().map(|&i| Variable::Y(i)).chain([Variable::Cover]).collect(),
        rows.iter().map(|&i| sign[i] * lcp.row_w(i, base)).collect(),
        rows.iter().map(|&i| RowTerms::at(lcp, i, base).magnitude).collect(),
    );
    dictionary.cancellation_tolerance = CANCELLATION_TOLERANCE;
    for (r, &i) in rows.iter().enumerate() {
        for (j, a) in lcp.matrix().row(i).iter() {
            if let Some(c) = column[j] {
                dictionary.set(r, c, sign[i] * a * sign[j]);
            }
        }
    }
    dictionary
}
