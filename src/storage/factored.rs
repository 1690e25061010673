//! A = J M⁻¹ Jᵀ that is never assembled: two factors, and the rows of each body.
//!
//! ```text
//! A_ij = Σ over shared bodies k of   (M_k⁻¹ J_ikᵀ) · J_jk
//! A x  = J (M⁻¹ Jᵀ x)
//! ```
//!
//! Kept are the blocks of J and, beside each, its response M_k⁻¹ J_ikᵀ: 100 bytes a block, so memory
//! grows with the constraints and not with how many of them meet in a body. A product needs two passes
//! over the blocks. So does a sweep of Gauss-Seidel that carries the velocities u = M⁻¹ Jᵀ x along, which
//! engines know as *sequential impulses*: w_i = J_i u + b_i, then u ← u + M⁻¹ J_iᵀ δx_i.

use nalgebra::{Matrix6, Vector6};

use super::blocks::{BlockRows, WIDTH};
use super::sweep::updated;
use super::{Error, Result, Storage, check_length, check_place, check_product, check_row};
use crate::lcp::Lcp;

/// The operator J M⁻¹ Jᵀ.
///
/// ```
/// use lcplab::storage::{BlockRows, Factored, Storage};
/// use nalgebra::Matrix6;
///
/// let mut j = BlockRows::new(2, 12); // two bodies over each other; gravity along y
/// j.load(&[(0, 1, 1.0), (1, 1, -1.0), (1, 7, 1.0)])?;
/// let a = Factored::new(j, &[Matrix6::identity(), Matrix6::identity()])?;
/// assert_eq!(a.row(0)?, [(0, 1.0), (1, -1.0)]);
/// assert_eq!(a.row(1)?, [(0, -1.0), (1, 2.0)]);
/// # Ok::<(), lcplab::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Factored {
    jacobian: BlockRows,
    /// M⁻¹ Jᵀ of each block.
    responses: Vec<[f64; WIDTH]>,
    /// Of each body, the first of its blocks in `blocks`; and the number of all.
    starts: Vec<u32>,
    /// The row and number of each body's blocks, rows ascending.
    blocks: Vec<(u32, u32)>,
}

impl Factored {
    /// The operator of a J with six columns a body, and one inverse mass (the blocks of M⁻¹, in units of
    /// 1/kg and 1/(kg m²)) a body.
    ///
    /// # Errors
    /// [`Error::Length`] if there are not six columns an inverse mass; [`Error::TooManyBodies`].
    pub fn new(jacobian: BlockRows, inverse_masses: &[Matrix6<f64>]) -> Result<Self> {
        check_length("J's columns", jacobian.columns(), WIDTH * inverse_masses.len())?;
        let mut blocks = Vec::with_capacity(jacobian.stored() / WIDTH);
        let mut responses = Vec::with_capacity(jacobian.stored() / WIDTH);
        let mut starts = vec![0; inverse_masses.len() + 1];
        for row in 0..jacobian.rows() {
            let range = jacobian.range(row);
            if range.len() > 2 {
                return Err(Error::TooManyBodies { row, blocks: range.len() });
            }
            for k in range {
                let (body, block) = jacobian.block(k);
                let response = inverse_masses[body] * Vector6::from_row_slice(block);
                responses.push(response.into());
                blocks.push((row as u32, k as u32));
                starts[body + 1] += 1;
            }
        }
        for body in 1..starts.len() {
            starts[body] += starts[body - 1];
        }
        blocks.sort_by_key(|&(row, k)| (jacobian.block(k as usize).0, row));
        Ok(Factored { jacobian, responses, starts, blocks })
    }

    /// J.
    pub fn jacobian(&self) -> &BlockRows {
        &self.jacobian
    }

    /// One sweep of projected Gauss-Seidel over the rows, with velocities u (six a body) that are M⁻¹ Jᵀ x
    /// before and after; compliance is not in A here.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::Diagonal`].
    pub fn sweep(&self, lcp: &Lcp, x: &mut [f64], u: &mut [f64]) -> Result<()> {
        check_length("x", x.len(), self.rows())?;
        check_length("b", lcp.len(), self.rows())?;
        check_length("u", u.len(), self.jacobian.columns())?;
        for i in 0..x.len() {
            let (mut w, mut diagonal) = (lcp.b()[i], 0.0);
            for k in self.jacobian.range(i) {
                let (body, block) = self.jacobian.block(k);
                w += dot(block, &u[WIDTH * body..]); // w_i = J_i u + b_i
                diagonal += dot(block, &self.responses[k]);
            }
            let change = updated(lcp, x, i, w, diagonal)? - x[i];
            x[i] += change;
            for k in self.jacobian.range(i) {
                let body = self.jacobian.block(k).0;
                add(change, &self.responses[k], &mut u[WIDTH * body..]); // u ← u + M⁻¹ J_iᵀ δx_i
            }
        }
        Ok(())
    }

    /// u ← M⁻¹ Jᵀ x: the velocities (six a body) that the impulses x make.
    ///
    /// # Errors
    /// [`Error::Length`].
    pub fn respond(&self, x: &[f64], u: &mut [f64]) -> Result<()> {
        check_length("x", x.len(), self.rows())?;
        check_length("u", u.len(), self.jacobian.columns())?;
        u.fill(0.0);
        for (row, &x) in x.iter().enumerate() {
            for k in self.jacobian.range(row) {
                let body = self.jacobian.block(k).0;
                add(x, &self.responses[k], &mut u[WIDTH * body..]);
            }
        }
        Ok(())
    }

    /// The blocks of a body from `row` on, rows ascending.
    fn rows_of(&self, body: usize) -> &[(u32, u32)] {
        &self.blocks[self.starts[body] as usize..self.starts[body + 1] as usize]
    }

    /// A_ij; the response is always that of the earlier row, so A is symmetric to the last bit.
    fn entry(&self, i: usize, j: usize) -> f64 {
        let (i, j) = (i.min(j), i.max(j));
        let mut sum = 0.0;
        for k in self.jacobian.range(i) {
            let body = self.jacobian.block(k).0;
            for (_, block) in self.jacobian.blocks(j).filter(|(other, _)| *other == body) {
                sum += dot(&self.responses[k], block);
            }
        }
        sum
    }
}

fn dot(a: &[f64; WIDTH], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |sum, (a, b)| sum + a * b)
}

/// y ← y + factor · x
fn add(factor: f64, x: &[f64; WIDTH], y: &mut [f64]) {
    y.iter_mut().zip(x).for_each(|(y, x)| *y += factor * x);
}

impl Storage for Factored {
    fn name(&self) -> &'static str {
        "factored"
    }

    fn rows(&self) -> usize {
        self.jacobian.rows()
    }

    fn columns(&self) -> usize {
        self.jacobian.rows()
    }

    fn get(&self, row: usize, column: usize) -> Result<f64> {
        check_place(self, row, column)?;
        Ok(self.entry(row, column))
    }

    fn set(&mut self, _: usize, _: usize, _: f64) -> Result<()> {
        Err(Error::Fixed)
    }

    /// The rows of the row's one or two bodies, merged.
    fn visit_row(&self, row: usize, visit: &mut dyn FnMut(usize, f64)) -> Result<()> {
        check_row(self, row)?;
        let mut others = self.jacobian.blocks(row).map(|(body, _)| self.rows_of(body));
        let (mut first, mut second) =
            (others.next().unwrap_or_default(), others.next().unwrap_or_default());
        while let Some(next) = [first, second].iter().filter_map(|rows| rows.first()).min() {
            let column = next.0;
            let value = self.entry(row, column as usize);
            if value != 0.0 {
                visit(column as usize, value);
            }
            for rows in [&mut first, &mut second] {
                if rows.first().is_some_and(|(other, _)| *other == column) {
                    *rows = &rows[1..];
                }
            }
        }
        Ok(())
    }

    fn reset(&mut self, _: usize, _: usize) -> Result<()> {
        Err(Error::Fixed)
    }

    /// The numbers of J and of the responses.
    fn stored(&self) -> usize {
        self.jacobian.stored() + WIDTH * self.responses.len()
    }

    fn bytes(&self) -> usize {
        self.jacobian.bytes()
            + self.responses.capacity() * size_of::<[f64; WIDTH]>()
            + self.starts.capacity() * size_of::<u32>()
            + self.blocks.capacity() * size_of::<(u32, u32)>()
    }

    fn allocations(&self) -> usize {
        self.jacobian.allocations() + 3
    }

    /// A x = J (M⁻¹ Jᵀ x), in two passes over the blocks: other sums than those over the rows of A, so
    /// its last bits may differ. Asks for memory for M⁻¹ Jᵀ x; [`respond`](Factored::respond) does not.
    fn multiply(&self, x: &[f64], y: &mut [f64]) -> Result<()> {
        check_product(self.rows(), self.columns(), x, y)?;
        let mut u = vec![0.0; self.jacobian.columns()];
        self.respond(x, &mut u)?;
        self.jacobian.multiply(&u, y)
    }
}
