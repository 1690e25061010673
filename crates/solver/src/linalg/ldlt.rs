//! The factorization A_CC = L D Lᵀ of a set C of rows that grows and shrinks.
//!
//! Appending row i computes its row of L, D⁻¹ L⁻¹ A_Ci, which is the forward substitution: O(c²)
//! for c rows, or free if that system has already been solved. Removing row k deletes it from L and
//! updates the rows below by a positive rank-1 update (method C1 of Gill, Golub, Murray & Saunders
//! 1974), which is stable because d_k > 0.
//!
//! A removed row is replaced by a row of the identity, a *hole*, so that no other row moves; when
//! an eighth of the rows are holes, L is compacted. The inner loops are in
//! [`kernel`](crate::kernel).

use crate::kernel::Width;
use crate::kernel::panels::{Lane8, Panels, Tile};

/// The number of holes that are always allowed.
const HOLES: usize = 8;

/// L D Lᵀ with unit lower triangular L and positive diagonal D.
#[derive(Debug, Clone)]
pub struct Ldlt {
    lower: Panels,
    /// D; 1 in a hole and past the last row.
    diagonal: Vec<Lane8>,
    /// The position of each row of C in L, ascending.
    places: Vec<usize>,
}

/// A partial solution of A_CC z = a, with the row of L that a row with this column would get.
#[derive(Debug, Clone, Default)]
pub struct Elimination {
    /// D⁻¹ L⁻¹ a: the row of L.
    row: Vec<Lane8>,
    /// The block of eight in which it begins.
    begin: usize,
    solution: Vec<Lane8>,
    sums: Vec<Tile>,
}

impl Elimination {
    /// An empty elimination with storage for n rows.
    pub(crate) fn with_room(n: usize) -> Self {
        let eights = n.div_ceil(8);
        Elimination {
            row: Vec::with_capacity(eights),
            begin: 0,
            solution: Vec::with_capacity(eights),
            sums: Vec::with_capacity(eights),
        }
    }
}

impl Default for Ldlt {
    fn default() -> Self {
        Ldlt::new(Width::widest())
    }
}

impl Ldlt {
    /// The factors for an empty C.
    pub fn new(width: Width) -> Self {
        Ldlt { lower: Panels::new(width), diagonal: Vec::new(), places: Vec::new() }
    }

    /// The factors of a maximal independent set of rows of the n × n matrix with these entries, and
    /// the set in pivot order. The next pivot is always the row that has kept the largest fraction
    /// of its diagonal entry, until all remaining rows are below the given fraction.
    pub fn pivoted(
        n: usize,
        independent: f64,
        entry: impl Fn(usize, usize) -> f64,
    ) -> (Vec<usize>, Self) {
        let mut pivot: Vec<f64> = (0..n).map(|r| entry(r, r)).collect();
        let mut lower: Vec<Vec<f64>> = vec![Vec::new(); n];
        let (mut chosen, mut left) = (Vec::new(), (0..n).collect::<Vec<usize>>());
        let (mut factor, mut diagonal) = (Ldlt::default(), Vec::new());
        let part = |pivot: f64, r: usize| pivot / entry(r, r);
        while let Some(k) = (0..left.len())
            .filter(|&k| part(pivot[left[k]], left[k]) > independent)
            .max_by(|&a, &b| {
                part(pivot[left[a]], left[a])
                    .total_cmp(&part(pivot[left[b]], left[b]))
                    .then(b.cmp(&a))
            })
        {
            let p = left.remove(k);
            let (d, row) = (pivot[p], std::mem::take(&mut lower[p]));
            let scaled: Vec<f64> = row.iter().zip(&diagonal).map(|(l, d)| l * d).collect();
            for &r in &left {
                let l = (entry(r, p) - lcplab_lcp::dot(&lower[r], &scaled)) / d;
                lower[r].push(l);
                pivot[r] -= l * l * d;
            }
            factor.push(&row, d);
            diagonal.push(d);
            chosen.push(p);
        }
        (chosen, factor)
    }

    /// Solves L D Lᵀ z = rhs in place.
    pub fn solve(&self, rhs: &mut [f64]) {
        let mut elimination = Elimination::default();
        self.eliminate(rhs, &mut elimination);
        for (z, solution) in rhs.iter_mut().zip(self.substitute(&mut elimination)) {
            *z = solution;
        }
    }

    /// The forward substitution; returns aᵀ A_CC⁻¹ a.
    pub fn eliminate(&self, a: &[f64], elimination: &mut Elimination) -> f64 {
        let Elimination { row, begin, .. } = elimination;
        row.clear();
        row.resize(self.diagonal.len(), [0.0; 8]);
        for (a, &place) in a.iter().zip(&self.places) {
            row[place / 8][place % 8] = *a;
        }
        let nonzero = a.iter().position(|a| *a != 0.0);
        *begin = nonzero.map_or(row.len(), |k| self.places[k] / 8);
        self.lower.forward(row, *begin);
        let mut product = [0.0; 8];
        for (row, d) in row.iter_mut().zip(&self.diagonal).skip(*begin) {
            for lane in 0..8 {
                let l = row[lane] / d[lane];
                product[lane] += row[lane] * l;
                row[lane] = l;
            }
        }
        product.iter().sum()
    }

    /// The back substitution: z in the order of C.
    pub fn substitute<'a>(
        &'a self,
        elimination: &'a mut Elimination,
    ) -> impl Iterator<Item = f64> + 'a {
        let Elimination { row, solution, sums, .. } = elimination;
        solution.clone_from(row);
        self.lower.backward(solution, sums);
        self.places.iter().map(|&place| solution[place / 8][place % 8])
    }

    /// Appends a row with `column` = A_Ci and the Schur complement of its diagonal entry.
    pub fn append(&mut self, column: &[f64], schur: f64) {
        let mut elimination = Elimination::default();
        self.eliminate(column, &mut elimination);
        self.enter(&elimination, schur);
    }

    /// Appends the row whose column has been eliminated.
    pub fn enter(&mut self, Elimination { row, begin, .. }: &Elimination, schur: f64) {
        let place = self.places.last().map_or(0, |last| last + 1);
        if place / 8 == self.diagonal.len() {
            self.diagonal.push([1.0; 8]);
        }
        self.lower.set(place, row, *begin);
        self.diagonal[place / 8][place % 8] = schur;
        self.places.push(place);
    }

    /// Appends a row of L and D.
    fn push(&mut self, l: &[f64], d: f64) {
        let mut row = vec![[0.0; 8]; self.diagonal.len()];
        for (l, &place) in l.iter().zip(&self.places) {
            row[place / 8][place % 8] = *l;
        }
        let begin = l.iter().position(|l| *l != 0.0).map_or(row.len(), |k| self.places[k] / 8);
        self.enter(&Elimination { row, begin, ..Elimination::default() }, d);
    }

    /// Removes the row at position k.
    pub fn remove(&mut self, k: usize) {
        self.lower.remove(self.places.remove(k), &mut self.diagonal);
        let end = self.places.last().map_or(0, |last| last + 1);
        self.diagonal.truncate(end.div_ceil(8));
        self.lower.truncate(end.div_ceil(8));
        if end - self.places.len() > HOLES.max(self.places.len() / 8) {
            self.fill_holes();
        }
    }

    fn fill_holes(&mut self) {
        let mut filled = Ldlt::new(self.lower.width());
        for (k, &place) in self.places.iter().enumerate() {
            let first = self.lower.first(place);
            let entry = |&c: &usize| if c < first { 0.0 } else { self.lower.entry(place, c) };
            let row: Vec<f64> = self.places[..k].iter().map(entry).collect();
            filled.push(&row, self.diagonal[place / 8][place % 8]);
        }
        *self = filled;
    }
}
