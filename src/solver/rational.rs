//! A boxed LCP in rational numbers, and what one active set contributes to its solutions.

use dashu_ratio::RBig;

use super::active_set::Side;
use crate::lcp::Lcp;

/// A problem without coupling in rational numbers.
pub(super) struct Exact {
    a: Vec<Vec<RBig>>,
    b: Vec<RBig>,
    /// `None` for −∞.
    lo: Vec<Option<RBig>>,
    /// `None` for ∞.
    hi: Vec<Option<RBig>>,
    /// Free rows whose column of A depends on those of other free rows; their x is 0.
    dependent: Vec<usize>,
}

impl Exact {
    /// The problem, if it has at most so many active sets.
    pub(super) fn new(lcp: &Lcp, max_sets: usize) -> Option<Self> {
        let n = lcp.len();
        let sides = |i: usize| sides(lcp.lo()[i], lcp.hi()[i]).len();
        let sets = (0..n).try_fold(1usize, |sets, i| sets.checked_mul(sides(i)));
        if sets.is_none_or(|sets| sets > max_sets) {
            return None;
        }
        let number = |x: f64| RBig::try_from(x).ok();
        let row = |i| (0..n).map(|j| number(lcp.matrix().entry(i, j))).collect();
        let a: Vec<Vec<RBig>> = (0..n).map(row).collect::<Option<_>>()?;
        let b: Vec<RBig> = lcp.b().iter().map(|&b| number(b)).collect::<Option<_>>()?;
        let bound = |bounds: &[f64]| bounds.iter().map(|&b| number(b)).collect();
        let (lo, hi) = (bound(lcp.lo()), bound(lcp.hi()));
        let mut exact = Exact { a, b, lo, hi, dependent: Vec::new() };
        exact.dependent = exact.dependent_rows();
        Some(exact)
    }

    /// Free rows that can be moved, together with other free rows, without any w being moved.
    fn dependent_rows(&self) -> Vec<usize> {
        let free = |&i: &usize| self.lo[i].is_none() && self.hi[i].is_none();
        let free: Vec<usize> = (0..self.b.len()).filter(free).collect();
        let row = |i: usize| free.iter().map(|&j| self.a[i][j].clone()).collect();
        let asked = (0..self.b.len()).filter(|&i| !self.is_pinned(i));
        let pivots = Echelon::of(asked.map(row).collect(), free.len()).pivots;
        (0..free.len()).filter(|k| !pivots.contains(k)).map(|k| free[k]).collect()
    }

    fn is_pinned(&self, i: usize) -> bool {
        self.lo[i].is_some() && self.lo[i] == self.hi[i]
    }

    /// All active sets, row 0 changing fastest.
    pub(super) fn active_sets(lcp: &Lcp) -> impl Iterator<Item = Vec<Side>> {
        let choices: Vec<&[Side]> =
            lcp.lo().iter().zip(lcp.hi()).map(|(&lo, &hi)| sides(lo, hi)).collect();
        let count = choices.iter().map(|sides| sides.len()).product();
        (0..count).map(move |mut number: usize| {
            let mut digit = |sides: &&[Side]| {
                let side = sides[number % sides.len()];
                number /= sides.len();
                side
            };
            choices.iter().map(&mut digit).collect()
        })
    }

    /// The solutions with this active set: none, one, or the corners of a polyhedron.
    pub(super) fn solutions(&self, sides: &[Side]) -> Vec<Vec<RBig>> {
        let (free, bound): (Vec<usize>, Vec<usize>) =
            (0..sides.len()).partition(|&i| sides[i] == Side::Free);
        let solves = |x: &Vec<RBig>| self.satisfies(sides, x);
        let open = match self.point(sides, &free) {
            Point::None => return Vec::new(),
            Point::One(x) => return Some(x).filter(solves).into_iter().collect(),
            Point::Many { open } => open,
        };
        let bound: Vec<usize> = bound.into_iter().filter(|&i| !self.is_pinned(i)).collect();
        let corner = |more: Vec<usize>| match self.point(sides, &[&free[..], &more].concat()) {
            Point::One(x) => Some(x).filter(solves),
            _ => None,
        };
        subsets(&bound, open).into_iter().filter_map(corner).collect()
    }

    /// The x with these sides and w = 0 in these rows.
    fn point(&self, sides: &[Side], rows: &[usize]) -> Point {
        let bound = |i: usize| match sides[i] {
            Side::Lower => self.lo[i].clone().unwrap_or_default(),
            Side::Upper => self.hi[i].clone().unwrap_or_default(),
            Side::Free => RBig::ZERO,
        };
        let mut x: Vec<RBig> = (0..sides.len()).map(bound).collect();
        let unknown = |i: &usize| sides[*i] == Side::Free && !self.dependent.contains(i);
        let unknown: Vec<usize> = (0..sides.len()).filter(unknown).collect();
        let equation = |&i: &usize| {
            let known = -self.w(i, &x);
            unknown.iter().map(|&j| self.a[i][j].clone()).chain([known]).collect()
        };
        let system = Echelon::of(rows.iter().map(equation).collect(), unknown.len() + 1);
        if system.pivots.last() == Some(&unknown.len()) {
            return Point::None; // 0 = 1
        }
        if system.pivots.len() < unknown.len() {
            return Point::Many { open: unknown.len() - system.pivots.len() };
        }
        for (&j, row) in unknown.iter().zip(&system.rows) {
            x[j] = row[unknown.len()].clone();
        }
        Point::One(x)
    }

    fn w(&self, i: usize, x: &[RBig]) -> RBig {
        let terms = self.a[i].iter().zip(x).filter(|(_, x)| **x != RBig::ZERO);
        terms.fold(self.b[i].clone(), |sum, (a, x)| sum + a * x)
    }

    fn satisfies(&self, sides: &[Side], x: &[RBig]) -> bool {
        let within = |i: usize| {
            self.lo[i].as_ref().is_none_or(|lo| *lo <= x[i])
                && self.hi[i].as_ref().is_none_or(|hi| x[i] <= *hi)
        };
        (0..x.len()).all(|i| match sides[i] {
            _ if self.is_pinned(i) => true,
            Side::Lower => self.w(i, x) >= RBig::ZERO,
            Side::Upper => self.w(i, x) <= RBig::ZERO,
            Side::Free => within(i) && self.w(i, x) == RBig::ZERO,
        })
    }
}

/// The sides that a row can be on.
fn sides(lo: f64, hi: f64) -> &'static [Side] {
    match (lo.is_finite(), hi.is_finite()) {
        _ if lo == hi => &[Side::Lower],
        (false, false) => &[Side::Free],
        (true, false) => &[Side::Lower, Side::Free],
        (false, true) => &[Side::Upper, Side::Free],
        (true, true) => &[Side::Lower, Side::Free, Side::Upper],
    }
}

/// The x that an active set and some equations leave.
enum Point {
    None,
    One(Vec<RBig>),
    /// So many unknowns are left open.
    Many {
        open: usize,
    },
}

/// A reduced row echelon form: row k has a 1 in column `pivots[k]`, which is 0 in all other rows.
struct Echelon {
    rows: Vec<Vec<RBig>>,
    pivots: Vec<usize>,
}

impl Echelon {
    /// Gauss-Jordan elimination of a matrix with so many columns.
    fn of(mut rows: Vec<Vec<RBig>>, columns: usize) -> Self {
        let mut pivots = Vec::new();
        for c in 0..columns {
            let top = pivots.len();
            let Some(r) = (top..rows.len()).find(|&r| rows[r][c] != RBig::ZERO) else { continue };
            rows.swap(top, r);
            let mut pivot = std::mem::take(&mut rows[top]);
            let scale = pivot[c].clone();
            pivot[c..].iter_mut().for_each(|entry| *entry /= &scale);
            for row in rows.iter_mut().filter(|row| row.get(c).is_some_and(|a| *a != RBig::ZERO)) {
                let factor = row[c].clone();
                for (entry, pivot) in row[c..].iter_mut().zip(&pivot[c..]) {
                    *entry -= &factor * pivot;
                }
            }
            rows[top] = pivot;
            pivots.push(c);
        }
        Echelon { rows, pivots }
    }
}

/// All subsets of k elements.
fn subsets(of: &[usize], k: usize) -> Vec<Vec<usize>> {
    match (k, of) {
        (0, _) => vec![Vec::new()],
        (_, []) => Vec::new(),
        (_, [first, rest @ ..]) => {
            let mut with = subsets(rest, k - 1);
            with.iter_mut().for_each(|set| set.push(*first));
            with.extend(subsets(rest, k));
            with
        }
    }
}
