//! The factorization A_CC = L D Lᵀ of a set C of rows that grows and shrinks, stored as L⁻¹ and D.
//!
//! Row r of L⁻¹ is a direction m_r: 1 in its own row, other entries only in rows that entered C
//! before, and A m_r is zero in those. Hence the directions are *conjugate*, m_rᵀ A m_q = 0, and
//! with s_r = m_rᵀ A m_r
//!
//! ```text
//! A_CC⁻¹ = L⁻ᵀ D⁻¹ L⁻¹ = Σ_r m_r m_rᵀ / s_r
//! ```
//!
//! Row i enters C with m_i = e_i − A_CC⁻¹ A_Ci and its Schur complement s_i: the direction in which
//! Dantzig's method moves x_i anyway, so that entering is free. When a row leaves, the directions
//! below are combined in pairs so that they no longer contain it; all weights are positive, as in
//! method C1 of Gill, Golub, Murray & Saunders (1974). Both cost O(c²) for c rows. The inner loops
//! are in [`kernel`](crate::kernel).

use crate::kernel::Width;
use crate::kernel::inverse_rows::InverseRows;
use crate::kernel::rows::Rows;
use lcplab_lcp::Matrix;

/// L⁻¹ and D of A_CC = L D Lᵀ, with unit lower triangular L and positive diagonal D.
#[derive(Debug, Clone)]
pub struct Ldlt(InverseRows);

impl Default for Ldlt {
    fn default() -> Self {
        Ldlt::new(Width::widest())
    }
}

impl Ldlt {
    /// The factors for an empty C.
    pub fn new(width: Width) -> Self {
        Ldlt(InverseRows::new(width))
    }

    /// The factors of a maximal independent subset of these rows, and the subset in pivot order.
    /// The next pivot is always the row that has kept the largest fraction of its diagonal entry,
    /// until all remaining rows are below the given fraction.
    pub fn pivoted(matrix: &Matrix, rows: &[usize], independent: f64) -> (Vec<usize>, Self) {
        let (n, width) = (matrix.len(), Width::widest());
        let (a, mut factor, mut chosen) = (Rows::of(matrix, width), Ldlt::new(width), Vec::new());
        let mut left = rows.to_vec();
        let mut schur: Vec<f64> = (0..n).map(|i| matrix.diagonal(i)).collect();
        let mut products = vec![0.0; n];
        loop {
            let part = |i: usize| schur[i] / matrix.diagonal(i);
            let Some(k) = (0..left.len())
                .filter(|&k| part(left[k]) > independent)
                .max_by(|&p, &q| part(left[p]).total_cmp(&part(left[q])).then(q.cmp(&p)))
            else {
                return (chosen, factor);
            };
            let i = left.remove(k);
            let column = chosen.iter().map(|&j| a.row(i).entry(j)).collect();
            let (left_of_one, _) = factor.eliminate(column);
            let mut direction = vec![0.0; n.next_multiple_of(8)];
            direction[i] = 1.0;
            chosen.iter().zip(&left_of_one).for_each(|(&j, entry)| direction[j] = *entry);
            a.products(&left, &direction, &mut products);
            for &j in &left {
                schur[j] -= products[j] * products[j] / schur[i];
            }
            factor.enter(&left_of_one, schur[i]);
            chosen.push(i);
        }
    }

    /// −A_CC⁻¹ a, in the order of C and then zeros, and aᵀ A_CC⁻¹ a.
    pub fn eliminate(&self, mut a: Vec<f64>) -> (Vec<f64>, f64) {
        a.resize(a.len().next_multiple_of(8), 0.0);
        let mut x = vec![0.0; a.len()];
        let product = self.subtract_solution(&a, &mut x);
        (x, product)
    }

    /// x ← x − A_CC⁻¹ a; returns aᵀ A_CC⁻¹ a. Both are in the order of C, with zeros after it at
    /// least up to the next multiple of eight.
    pub(crate) fn subtract_solution(&self, a: &[f64], x: &mut [f64]) -> f64 {
        self.0.subtract_projections(a, x)
    }

    /// Appends row i, given −A_CC⁻¹ A_Ci, as x above, and its Schur complement.
    pub fn enter(&mut self, direction: &[f64], schur: f64) {
        self.0.push(direction, schur);
    }

    /// Removes the row at position k of C.
    pub fn remove(&mut self, k: usize) {
        self.0.remove(k);
    }
}
