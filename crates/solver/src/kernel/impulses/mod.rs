//! Sweeps over A = J M⁻¹ Jᵀ that never form A: "sequential impulses".
//!
//! With M⁻¹ = L Lᵀ and velocities v = L⁻¹ u in units where all masses are 1, every row of J becomes
//! a row Ĵ_i of Ĵ = J L with at most two bodies and twelve entries, and A = Ĵ Ĵᵀ:
//!
//! ```text
//! w_i = Ĵ_i v + b_i,   x_i ← Π_i(x_i − w_i / a_ii),   v ← v + Ĵ_iᵀ δ_i,   a_ii = Ĵ_i Ĵ_iᵀ
//! ```
//!
//! v − Ĵᵀ x does not change: it is 0 for the LCP with this b, or the velocities without constraints
//! if b is the term added to Ĵ v. In exact arithmetic this is Gauss-Seidel on A. A row costs 24
//! multiplications regardless of its number of neighbors; a row of A has an entry for every row on
//! the same two bodies. After scaling, the same twelve numbers serve for w and v, so a sweep reads
//! half of the data of J and M⁻¹Jᵀ.
//!
//! [`RowByRow`] waits for the sum of each row before the next begins: about 60 cycles per row,
//! nearly all of them latency. [`SimdPairs`] processes eight pairs that share no body at once:
//! layer by layer from the ground up if enough pairs can be combined, as in a tower; otherwise, as
//! in a single stack, by colors alone. A different order needs a different number of sweeps.
//! Several threads may share a group of pairs with bitwise identical results.
//!
//! These sweeps do not support compliance (γ on A's diagonal).

mod groups;
mod pair_lanes;
mod rows;
mod simd_pairs;
mod thread_pool;
mod velocities;

pub use rows::RowByRow;
pub use simd_pairs::SimdPairs;

use crate::Status;
use lcplab_lcp::Lcp;

/// Number of velocity components of a body.
pub const WIDTH: usize = 6;

/// The velocity of a body in units where its mass is 1: √kg m/s, √(kg m²) rad/s.
pub type Velocity = [f64; WIDTH];

/// A row of Ĵ: two bodies, with three entries for the linear and three for the angular velocity of
/// each. A row with one moving body has zeros for the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// The indices of the bodies, from 0; equal if there is only one.
    pub bodies: [usize; 2],
    /// The entries for each body, √(1/kg) and √(1/(kg m²)) times those of J.
    pub jacobian: [[f64; WIDTH]; 2],
}

/// The target of a row: its offset and bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowTarget {
    /// The term added to Ĵ v.
    pub b: f64,
    /// The lower bound of x.
    pub lo: f64,
    /// The upper bound of x; μ if the bounds depend on another row.
    pub hi: f64,
    /// The row k with −μ max(x_k, 0) ≤ x ≤ μ max(x_k, 0).
    pub follows: Option<usize>,
}

impl Row {
    /// a_ii.
    fn diagonal(&self) -> f64 {
        let [j_p, j_q] = &self.jacobian;
        let [a, b, c, d, e, f] = std::array::from_fn(|k| j_p[k] * j_p[k] + j_q[k] * j_q[k]);
        (a + b + c) + (d + e + f)
    }

    /// Ĵ_i v.
    pub fn rate(&self, v: &[Velocity]) -> f64 {
        let [v_p, v_q] = self.bodies.map(|body| &v[body]);
        let [j_p, j_q] = &self.jacobian;
        (0..WIDTH).map(|k| j_p[k] * v_p[k] + j_q[k] * v_q[k]).sum()
    }
}

/// Rows with their targets: an LCP with A = Ĵ Ĵᵀ.
#[derive(Debug, Clone, Default)]
pub struct System {
    bodies: usize,
    rows: Vec<Row>,
    aims: Vec<RowTarget>,
    /// 1 / a_ii.
    inverse: Vec<f64>,
}

impl System {
    /// The rows of Ĵ with b and the bounds of an LCP; the LCP's own A is not used.
    ///
    /// # Errors
    /// [`Status::ZeroDiagonal`] for a row of zeros.
    ///
    /// # Panics
    /// If the number of rows differs from the LCP's, or a body index is out of range.
    pub fn new(bodies: usize, rows: &[Row], lcp: &Lcp) -> Result<Self, Status> {
        assert_eq!(rows.len(), lcp.len(), "one row of Ĵ for each row of the LCP");
        let mut system = System::default();
        system.clear(bodies);
        for (i, row) in rows.iter().enumerate() {
            let (b, lo, hi) = (lcp.b()[i], lcp.lo()[i], lcp.hi()[i]);
            let aim = match lcp.coupled_to(i) {
                Some((normal, mu)) => RowTarget { b, lo, hi: mu, follows: Some(normal) },
                None => RowTarget { b, lo, hi, follows: None },
            };
            system.push(*row, aim)?;
        }
        Ok(system)
    }

    /// Removes all rows and sets the number of bodies; storage is kept.
    pub fn clear(&mut self, bodies: usize) {
        self.bodies = bodies;
        self.rows.clear();
        self.aims.clear();
        self.inverse.clear();
    }

    /// Adds a row.
    ///
    /// # Errors
    /// [`Status::ZeroDiagonal`] for a row of zeros.
    ///
    /// # Panics
    /// If a body index is out of range.
    #[inline]
    pub fn push(&mut self, row: Row, aim: RowTarget) -> Result<(), Status> {
        assert!(row.bodies.iter().all(|body| *body < self.bodies), "bodies");
        let inverse = row.diagonal().recip();
        if !inverse.is_finite() {
            return Err(Status::ZeroDiagonal { row: self.rows.len() });
        }
        self.rows.push(row);
        self.aims.push(aim);
        self.inverse.push(inverse);
        Ok(())
    }

    /// The rows.
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// The targets of the rows.
    pub fn aims(&self) -> &[RowTarget] {
        &self.aims
    }

    /// The targets of the rows, mutable.
    pub fn aims_mut(&mut self) -> &mut [RowTarget] {
        &mut self.aims
    }

    /// v ← v + Ĵᵀ x.
    pub fn push_velocities(&self, x: &[f64], v: &mut [Velocity]) {
        for (row, &x) in self.rows.iter().zip(x) {
            for (&body, j) in row.bodies.iter().zip(&row.jacobian) {
                (0..WIDTH).for_each(|k| v[body][k] += j[k] * x);
            }
        }
    }

    /// Π_i at x.
    fn project(&self, i: usize, value: f64, x: &[f64]) -> f64 {
        let RowTarget { lo, hi, follows, .. } = self.aims[i];
        let (lo, hi) = match follows {
            Some(k) => (-hi * x[k].max(0.0), hi * x[k].max(0.0)),
            None => (lo, hi),
        };
        value.max(lo).min(hi)
    }
}
