//! The equations of the active set at an exact solution, and their derivative.
//!
//! ```text
//! free row          v_i = 0,   v = A y + dA x + db,   y = dx
//! row at a bound    y_i = dlo_i or dhi_i;   of a friction row ±(dμ_i x_k + μ_i y_k)
//! ```
//!
//! With y = T y_F + t the unknowns are those of the free rows: A_F T y_F = −(A t + dA x + db)_F.

use dashu_ratio::RBig;

use super::linear::{dot, number};
use lcplab_lcp::Lcp;
use lcplab_lcp::exact::dyadic::{dyadic, rational};

/// A row this close to a kink, relative to its terms, is at it up to rounding.
const NEAR: f64 = 1e-12;

/// How x_i follows the data.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RowState {
    /// Strictly between its bounds: w_i stays 0.
    Free,
    /// At its lower bound with w_i > 0, or fixed by equal bounds: x_i stays at the bound.
    Lower,
    /// At its upper bound with w_i < 0.
    Upper,
    /// At its lower bound with w_i = 0: a kink.
    WeakLower,
    /// At its upper bound with w_i = 0: a kink.
    WeakUpper,
    /// A friction row with w_i = 0 of a contact that is at a kink and has no force.
    WeakBoth,
    /// A friction row with w_i = 0 of a contact that stays open, or with μ = 0: x_i stays 0.
    Held,
}

impl RowState {
    /// The word that tables and JSON use.
    pub fn name(self) -> &'static str {
        match self {
            RowState::Free => "free",
            RowState::Lower => "lower",
            RowState::Upper => "upper",
            RowState::WeakLower | RowState::WeakUpper | RowState::WeakBoth => "kink",
            RowState::Held => "held",
        }
    }

    /// Whether an arbitrarily small change can put the row on either side.
    pub fn is_weak(self) -> bool {
        self.name() == "kink"
    }

    /// −1 at the lower bound, 1 at the upper one.
    fn sign(self) -> Option<RBig> {
        match self {
            RowState::Lower => Some(-RBig::ONE),
            RowState::Upper => Some(RBig::ONE),
            _ => None,
        }
    }
}

/// A change of the data, of which only q = dA x + db matters.
#[derive(Debug, Clone)]
pub(super) struct Change {
    pub q: Vec<RBig>,
    pub mu: Vec<RBig>,
    pub lo: Vec<RBig>,
    pub hi: Vec<RBig>,
}

impl Change {
    pub fn none(n: usize) -> Self {
        let zero = vec![RBig::ZERO; n];
        Change { q: zero.clone(), mu: zero.clone(), lo: zero.clone(), hi: zero }
    }

    pub fn reversed(&self) -> Self {
        let minus = |v: &Vec<RBig>| v.iter().map(|x| -x).collect();
        let (q, mu, lo, hi) = (minus(&self.q), minus(&self.mu), minus(&self.lo), minus(&self.hi));
        Change { q, mu, lo, hi }
    }
}

/// The rows at an exact solution.
#[derive(Debug, Clone)]
pub(super) struct Rows {
    pub a: Vec<Vec<RBig>>,
    pub mu: Vec<RBig>,
    /// The row that bounds each friction row.
    pub normal: Vec<Option<usize>>,
    pub x: Vec<RBig>,
    pub w: Vec<RBig>,
    pub states: Vec<RowState>,
    /// Whether the bounds are numbers and equal.
    pub is_fixed: Vec<bool>,
    /// Rows within rounding of a kink, but not at it.
    pub near: Vec<usize>,
}

impl Rows {
    pub fn new(lcp: &Lcp, x: Vec<RBig>) -> Self {
        let n = lcp.len();
        let exact = |x: f64| rational(&dyadic(x));
        let mut a = vec![vec![RBig::ZERO; n]; n];
        for (i, row) in a.iter_mut().enumerate() {
            lcp.matrix().row(i).iter().for_each(|(j, value)| row[j] = exact(value));
        }
        let w: Vec<RBig> = (0..n).map(|i| dot(&a[i], &x) + exact(lcp.b()[i])).collect();
        let mu =
            (0..n).map(|i| lcp.coupled_to(i).map_or(RBig::ZERO, |(_, mu)| exact(mu))).collect();
        let normal = (0..n).map(|i| lcp.coupled_to(i).map(|(k, _)| k)).collect();
        let states = vec![RowState::Free; n];
        let is_fixed = (0..n).map(|i| !lcp.is_coupled(i) && lcp.lo()[i] == lcp.hi()[i]).collect();
        let mut rows = Rows { a, mu, normal, x, w, states, is_fixed, near: Vec::new() };
        // A friction row needs the state of its normal row.
        for is_friction in [false, true] {
            for i in (0..n).filter(|&i| lcp.is_coupled(i) == is_friction) {
                rows.states[i] = rows.state(lcp, i);
                if rows.is_near(lcp, i) {
                    rows.near.push(i);
                }
            }
        }
        rows.near.sort_unstable();
        rows
    }

    fn bounds(&self, lcp: &Lcp, i: usize) -> (Option<RBig>, Option<RBig>) {
        let finite = |x: f64| x.is_finite().then(|| rational(&dyadic(x)));
        match self.normal[i] {
            Some(k) => {
                let limit = &self.mu[i] * self.x[k].clone().max(RBig::ZERO);
                (Some(-&limit), Some(limit))
            }
            None => (finite(lcp.lo()[i]), finite(lcp.hi()[i])),
        }
    }

    fn state(&self, lcp: &Lcp, i: usize) -> RowState {
        let (lo, hi) = self.bounds(lcp, i);
        let (x, w) = (Some(&self.x[i]), &self.w[i]);
        let (is_low, is_high) = (x == lo.as_ref(), x == hi.as_ref());
        match (is_low, is_high) {
            (false, false) => RowState::Free,
            _ if is_low && *w > RBig::ZERO => RowState::Lower,
            _ if is_high && *w < RBig::ZERO => RowState::Upper,
            (true, false) => RowState::WeakLower,
            (false, true) => RowState::WeakUpper,
            (true, true) => match self.normal[i] {
                Some(k) if self.states[k].is_weak() && self.mu[i] != RBig::ZERO => {
                    RowState::WeakBoth
                }
                Some(_) => RowState::Held,
                None => RowState::Lower,
            },
        }
    }

    /// Whether rounding of the data would put the row at a kink.
    fn is_near(&self, lcp: &Lcp, i: usize) -> bool {
        let (lo, hi) = self.bounds(lcp, i);
        let largest = self.x.iter().map(|x| number(x).abs()).fold(0.0, f64::max);
        match self.states[i] {
            RowState::Free => [lo, hi]
                .into_iter()
                .flatten()
                .any(|bound| number(&(&self.x[i] - bound)).abs() <= NEAR * largest),
            RowState::Lower | RowState::Upper if lo != hi || self.is_of_loose_contact(i) => {
                let terms = self.a[i].iter().zip(&self.x).map(|(a, x)| number(&(a * x)).abs());
                number(&self.w[i]).abs() <= NEAR * (terms.sum::<f64>() + lcp.b()[i].abs())
            }
            _ => false,
        }
    }

    /// Whether the normal row of a friction row is at a kink, at least up to rounding. A fixed row,
    /// and a friction row of an open contact, have none.
    fn is_of_loose_contact(&self, i: usize) -> bool {
        self.normal[i].is_some_and(|k| self.states[k].is_weak() || self.near.contains(&k))
    }

    pub fn len(&self) -> usize {
        self.x.len()
    }

    pub fn rows_that(&self, is_wanted: impl Fn(RowState) -> bool) -> Vec<usize> {
        (0..self.len()).filter(|&i| is_wanted(self.states[i])).collect()
    }

    pub fn free(&self) -> Vec<usize> {
        self.rows_that(|state| state == RowState::Free)
    }

    pub fn weak(&self) -> Vec<usize> {
        self.rows_that(RowState::is_weak)
    }

    /// The same rows on these sides.
    pub fn with_states(&self, states: Vec<RowState>) -> Self {
        Rows { states, ..self.clone() }
    }

    /// The normal row and the factor with which a sliding row follows it.
    fn follows(&self, i: usize) -> Option<(usize, RBig)> {
        Some((self.normal[i]?, self.states[i].sign()? * &self.mu[i]))
    }

    /// The rows that follow row k, with their factors.
    fn followers(&self, k: usize) -> Vec<(usize, RBig)> {
        let own = |i: usize| self.follows(i).filter(|(of, _)| *of == k).map(|(_, f)| (i, f));
        (0..self.len()).filter_map(own).collect()
    }

    /// Whether a sliding row follows a row whose x can change.
    pub fn has_sliding(&self) -> bool {
        let moves = |(k, factor): (usize, RBig)| {
            factor != RBig::ZERO && !matches!(self.states[k], RowState::Lower | RowState::Upper)
        };
        (0..self.len()).any(|i| self.follows(i).is_some_and(moves))
    }

    /// A T among these rows and unknowns.
    pub fn matrix(&self, rows: &[usize], unknowns: &[usize]) -> Vec<Vec<RBig>> {
        let followers: Vec<_> = unknowns.iter().map(|&u| self.followers(u)).collect();
        let entry = |i: usize, (&u, followers): (&usize, &Vec<(usize, RBig)>)| {
            followers.iter().fold(self.a[i][u].clone(), |sum, (c, f)| sum + f * &self.a[i][*c])
        };
        let row = |&i: &usize| unknowns.iter().zip(&followers).map(|pair| entry(i, pair)).collect();
        rows.iter().map(row).collect()
    }

    /// Tᵀ v for these unknowns.
    pub fn reduced(&self, v: &[RBig], unknowns: &[usize]) -> Vec<RBig> {
        let entry = |&u: &usize| {
            self.followers(u).iter().fold(v[u].clone(), |sum, (c, f)| sum + f * &v[*c])
        };
        unknowns.iter().map(entry).collect()
    }

    /// t: what rows at their bounds change by themselves.
    pub fn bound_changes(&self, change: &Change) -> Vec<RBig> {
        self.completed(change, vec![RBig::ZERO; self.len()])
    }

    /// T y + t for y of the free and weak rows; other entries of y are ignored.
    pub fn completed(&self, change: &Change, mut y: Vec<RBig>) -> Vec<RBig> {
        for i in (0..self.len()).filter(|&i| self.normal[i].is_none()) {
            match self.states[i] {
                RowState::Lower => y[i] = change.lo[i].clone(),
                RowState::Upper => y[i] = change.hi[i].clone(),
                _ => {}
            }
        }
        for i in 0..self.len() {
            if let (Some(k), Some(sign)) = (self.normal[i], self.states[i].sign()) {
                y[i] = sign * (&change.mu[i] * &self.x[k] + &self.mu[i] * &y[k]);
            }
        }
        y
    }

    /// The adjoint of [`bound_changes`](Self::bound_changes): the gradients with respect to μ, lo
    /// and hi of rᵀt.
    pub fn bound_gradients(&self, r: &[RBig]) -> [Vec<RBig>; 3] {
        let mut gradients = [(); 3].map(|()| vec![RBig::ZERO; self.len()]);
        for i in 0..self.len() {
            match (self.normal[i], self.states[i].sign()) {
                (Some(k), Some(sign)) => gradients[0][i] = sign * &self.x[k] * &r[i],
                (None, Some(sign)) => {
                    let side = if sign < RBig::ZERO { 1 } else { 2 };
                    gradients[side][i] = self.reduced(r, &[i]).remove(0);
                }
                _ => {}
            }
        }
        gradients
    }

    /// (A v)_i.
    pub fn product(&self, i: usize, v: &[RBig]) -> RBig {
        dot(&self.a[i], v)
    }
}
