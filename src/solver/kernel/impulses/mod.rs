//! Sweeps over A = J M⁻¹ Jᵀ that never form it: "sequential impulses".
//!
//! With M⁻¹ = L Lᵀ and velocities in units where all masses are 1, v = L⁻¹ u, every row of J has one
//! row Ĵ_i of Ĵ = J L, at most two bodies and twelve entries long, and A = Ĵ Ĵᵀ:
//!
//! ```text
//! w_i = Ĵ_i v + b_i,   x_i ← Π_i(x_i − w_i / a_ii),   v ← v + Ĵ_iᵀ δ_i,   a_ii = Ĵ_i Ĵ_iᵀ
//! ```
//!
//! v = Ĵᵀ x holds before and after. That is Gauss-Seidel on A in exact arithmetic; a row costs 24 products
//! whatever it touches, where a row of A has as many entries as rows meet in its two bodies. Once
//! scaled, the same twelve numbers serve w and v, so a sweep reads half of what J and M⁻¹Jᵀ
//! ([`storage::Factored`](crate::storage::Factored)) hold.
//!
//! [`RowByRow`] waits for each row's sum before the next begins: some 60 cycles a row, nearly all of them
//! latency. [`EightPairs`] takes eight pairs of bodies that share none at once; for that the pairs are
//! sorted by colour, and another order needs another number of sweeps (more, for tall stacks).
//!
//! Compliance (γ on A's diagonal) is not in these sweeps.

mod colour;
mod octet;
mod rows;

pub use octet::EightPairs;
pub use rows::RowByRow;

use crate::lcp::Lcp;
use crate::solver::Status;

/// Velocity components of a body.
pub const WIDTH: usize = 6;

/// A row of Ĵ: two bodies, the first three entries of each for its motion, the others for its turning.
/// A row with one moving body has zeros for the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// The bodies, counted from 0; equal where there is only one.
    pub bodies: [usize; 2],
    /// The entries of each, √(1/kg) and √(1/(kg m²)) times those of J.
    pub jacobian: [[f64; WIDTH]; 2],
}

impl Row {
    /// a_ii.
    fn diagonal(&self) -> f64 {
        self.jacobian.as_flattened().iter().map(|j| j * j).sum()
    }
}

/// An LCP whose A is Ĵ Ĵᵀ.
#[derive(Debug, Clone)]
pub struct System<'a> {
    bodies: usize,
    rows: &'a [Row],
    /// Its b and bounds; its own A is not read.
    lcp: &'a Lcp,
    /// 1 / a_ii.
    inverse: Vec<f64>,
}

impl<'a> System<'a> {
    /// The rows of Ĵ with the b and the bounds of an LCP.
    ///
    /// # Errors
    /// [`Status::ZeroDiagonal`] for a row of zeros.
    ///
    /// # Panics
    /// If there are not as many rows as the LCP has, or a body is not below their number.
    pub fn new(bodies: usize, rows: &'a [Row], lcp: &'a Lcp) -> Result<Self, Status> {
        assert_eq!(rows.len(), lcp.len(), "a row of Ĵ for each of the LCP");
        assert!(rows.iter().flat_map(|row| row.bodies).all(|body| body < bodies), "bodies");
        let inverse = |(i, row): (usize, &Row)| {
            let inverse = row.diagonal().recip();
            if inverse.is_finite() { Ok(inverse) } else { Err(Status::ZeroDiagonal { row: i }) }
        };
        let inverse = rows.iter().enumerate().map(inverse).collect::<Result<_, _>>()?;
        Ok(System { bodies, rows, lcp, inverse })
    }

    /// The number of bodies.
    pub fn bodies(&self) -> usize {
        self.bodies
    }

    /// The rows of Ĵ.
    pub fn rows(&self) -> &'a [Row] {
        self.rows
    }

    /// b and the bounds.
    pub fn lcp(&self) -> &'a Lcp {
        self.lcp
    }

    /// a_ii.
    pub fn diagonal(&self, i: usize) -> f64 {
        self.rows[i].diagonal()
    }

    /// v = Ĵᵀ x, [`WIDTH`] components a body.
    pub fn transposed_product(&self, x: &[f64]) -> Vec<f64> {
        let mut v = vec![[0.0; WIDTH]; self.bodies];
        for pair in self.pairs() {
            let mut sum = [[0.0; WIDTH]; 2];
            for (row, x) in self.rows[pair.clone()].iter().zip(&x[pair.clone()]) {
                let entries = row.jacobian.as_flattened();
                sum.as_flattened_mut().iter_mut().zip(entries).for_each(|(sum, j)| *sum += j * x);
            }
            for (body, sum) in self.rows[pair.start].bodies.into_iter().zip(&sum) {
                v[body].iter_mut().zip(sum).for_each(|(v, sum)| *v += sum);
            }
        }
        v.as_flattened().to_vec()
    }

    /// Ĵ v.
    pub fn product(&self, v: &[f64]) -> Vec<f64> {
        let (v, _) = v.as_chunks::<WIDTH>();
        let row = |row: &Row| {
            let [p, q] = row.bodies;
            let [j_p, j_q] = &row.jacobian;
            (0..WIDTH).map(|k| j_p[k] * v[p][k] + j_q[k] * v[q][k]).sum()
        };
        self.rows.iter().map(row).collect()
    }

    /// w = Ĵ Ĵᵀ x + b.
    pub fn w(&self, x: &[f64]) -> Vec<f64> {
        let product = self.product(&self.transposed_product(x));
        product.iter().zip(self.lcp.b()).map(|(w, b)| w + b).collect()
    }

    /// The row whose x bounds that of row i, and μ.
    fn follows(&self, i: usize) -> Option<(usize, f64)> {
        let coupling = self.lcp.coupling()?;
        Some((coupling.index(i)?, coupling.mu(i)))
    }

    /// Runs of rows between the same two bodies.
    pub(in crate::solver) fn pairs(&self) -> impl Iterator<Item = std::ops::Range<usize>> {
        let mut end = 0;
        self.rows.chunk_by(|a, b| a.bodies == b.bodies).map(move |run| {
            end += run.len();
            end - run.len()..end
        })
    }
}

/// The velocities of all bodies, eight numbers each for the sake of whole cache lines: six, and two zeros.
type Velocities = Vec<[f64; 8]>;
