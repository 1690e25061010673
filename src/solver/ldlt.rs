//! The factorisation A_CC = L D Lᵀ of a growing and shrinking set C of rows.
//!
//! Appending a row solves one triangular system, O(c²) for c rows. Removing row k deletes it from L
//! and repairs the rows below by a positive rank-1 update (method C1 of Gill, Golub, Murray &
//! Saunders 1974), which is stable because d_k > 0.

/// L D Lᵀ with unit lower triangular L and positive diagonal D.
#[derive(Debug, Clone, Default)]
pub struct Ldlt {
    /// Row i of L without its unit diagonal: i entries.
    lower: Vec<Vec<f64>>,
    diagonal: Vec<f64>,
}

impl Ldlt {
    /// The factors of a largest independent set of rows of the n × n matrix with these entries, and
    /// the set in the order it was chosen: always the row that has lost the least of its diagonal
    /// entry, until all others have lost all but this part of it.
    pub fn pivoted(
        n: usize,
        independent: f64,
        entry: impl Fn(usize, usize) -> f64,
    ) -> (Vec<usize>, Self) {
        let mut pivot: Vec<f64> = (0..n).map(|r| entry(r, r)).collect();
        let mut lower: Vec<Vec<f64>> = vec![Vec::new(); n];
        let (mut chosen, mut left) = (Vec::new(), (0..n).collect::<Vec<usize>>());
        let mut factor = Ldlt::default();
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
            let scaled: Vec<f64> = row.iter().zip(&factor.diagonal).map(|(l, d)| l * d).collect();
            for &r in &left {
                let l = (entry(r, p) - crate::lcp::dot(&lower[r], &scaled)) / d;
                lower[r].push(l);
                pivot[r] -= l * l * d;
            }
            factor.lower.push(row);
            factor.diagonal.push(d);
            chosen.push(p);
        }
        (chosen, factor)
    }

    /// The solution z of L D Lᵀ z = rhs, in place.
    pub fn solve(&self, rhs: &mut [f64]) {
        self.solve_lower(rhs);
        for (z, d) in rhs.iter_mut().zip(&self.diagonal) {
            *z /= d;
        }
        for i in (0..self.lower.len()).rev() {
            let z = rhs[i];
            for (r, l) in rhs.iter_mut().zip(&self.lower[i]) {
                *r -= l * z; // rhs ← L⁻ᵀ rhs, by rows of L
            }
        }
    }

    /// Adds a row with `column` = A_Ci and the Schur complement of its diagonal entry.
    pub fn append(&mut self, column: &[f64], schur: f64) {
        let mut l = column.to_vec();
        self.solve_lower(&mut l);
        for (l, d) in l.iter_mut().zip(&self.diagonal) {
            *l /= d;
        }
        self.lower.push(l);
        self.diagonal.push(schur);
    }

    /// Removes the row at position k.
    pub fn remove(&mut self, k: usize) {
        self.lower.remove(k);
        let mut alpha = self.diagonal.remove(k);
        let below = &mut self.lower[k..];
        let mut v: Vec<f64> = below.iter_mut().map(|row| row.remove(k)).collect();
        for j in 0..v.len() {
            // L D Lᵀ + α v vᵀ, one column of L at a time
            let (p, d) = (v[j], self.diagonal[k + j]);
            let d_new = d + alpha * p * p;
            let beta = alpha * p / d_new;
            alpha *= d / d_new;
            self.diagonal[k + j] = d_new;
            for r in j + 1..v.len() {
                let l = &mut below[r][k + j];
                v[r] -= p * *l;
                *l += beta * v[r];
            }
        }
    }

    fn solve_lower(&self, rhs: &mut [f64]) {
        for i in 0..self.lower.len() {
            rhs[i] -= crate::lcp::dot(&self.lower[i], &rhs[..i]); // rhs ← L⁻¹ rhs
        }
    }
}
