//! The terms of all rows of a dense A in one pass, as needed for a residual.
//!
//! ```text
//! w_i = Σ_j a_ij x_j + b_i,   Σ_j |a_ij x_j| + |b_i|
//! ```
//!
//! Both sums are updated with each product in one pass, four rows at a time; each w is bitwise
//! identical to [`Lcp::row_w`].

use super::lanes::{Lanes, Width, Work, sum};
use lcplab_lcp::merit::{RowTerms, row_scale};
use lcplab_lcp::{Lcp, Matrix};

/// Number of rows whose sums are computed together.
const TOGETHER: usize = 4;

/// The [`RowTerms`] of all rows at x; for a sparse A they are computed row by row.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::kernel::{Width, terms};
///
/// let a = Matrix::dense(2, &[2.0, -1.0, -1.0, 2.0]);
/// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let terms = terms(&lcp, &[3.0, 1.0], Width::widest());
/// assert_eq!((terms[0].w, terms[0].magnitude), (4.0, 8.0)); // 6 − 1 − 1
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
///
/// # Panics
/// If x does not have n entries.
pub fn terms(lcp: &Lcp, x: &[f64], width: Width) -> Vec<RowTerms> {
    let n = lcp.len();
    assert_eq!(x.len(), n, "one x per row");
    let Matrix::Dense(dense) = lcp.matrix() else {
        return (0..n).map(|i| of_stored(lcp, i, x)).collect();
    };
    let sums = match x.iter().all(|&x| x == 0.0) {
        true => vec![[0.0; 2]; n],
        false => width.run(Sums { a: dense.entries(), x }),
    };
    let terms = |(i, [product, size]): (usize, [f64; 2])| {
        let b = lcp.b()[i];
        RowTerms::of_sums(lcp, product + b, size + b.abs(), row_scale(lcp, i))
            .unwrap_or_else(|| RowTerms::at(lcp, i, x))
    };
    sums.into_iter().enumerate().map(terms).collect()
}

/// The terms of a row of a sparse A, including its diagonal entry.
fn of_stored(lcp: &Lcp, i: usize, x: &[f64]) -> RowTerms {
    let (mut w, mut size, mut diagonal) = (0.0, 0.0, 0.0);
    for (j, a) in lcp.matrix().row(i).iter() {
        let product = a * x[j];
        w += product;
        size += f64::abs(product);
        if j == i {
            diagonal = f64::abs(a);
        }
    }
    let b = lcp.b()[i];
    let terms = RowTerms::of_sums(lcp, w + b, size + b.abs(), diagonal);
    terms.filter(|_| diagonal > 0.0).unwrap_or_else(|| RowTerms::at(lcp, i, x))
}

/// Σ_j a_ij x_j and Σ_j |a_ij x_j| of all rows.
struct Sums<'a> {
    a: &'a [f64],
    x: &'a [f64],
}

impl Work for Sums<'_> {
    type Output = Vec<[f64; 2]>;

    #[inline(always)]
    fn run<V: Lanes>(self) -> Vec<[f64; 2]> {
        let Sums { a, x } = self;
        let n = x.len();
        let mut sums = Vec::with_capacity(n);
        // Otherwise there are too few registers.
        let in_fours = if V::WIDE { n - n % TOGETHER } else { 0 };
        let (fours, rest) = a.split_at(in_fours * n);
        for four in fours.chunks_exact(TOGETHER * n) {
            let mut rows = [four; TOGETHER];
            for r in 0..TOGETHER {
                rows[r] = &four[r * n..(r + 1) * n];
            }
            sums.extend(of_rows::<V, TOGETHER>(rows, x));
        }
        for row in rest.chunks_exact(n) {
            sums.extend(of_rows::<V, 1>([row], x));
        }
        sums
    }
}

#[inline(always)]
fn of_rows<V: Lanes, const R: usize>(rows: [&[f64]; R], x: &[f64]) -> [[f64; 2]; R] {
    let (x_blocks, x_tail) = x.as_chunks::<8>();
    let (count, start) = (x_blocks.len(), x.len() - x_tail.len());
    let mut blocks = [x_blocks; R];
    for r in 0..R {
        blocks[r] = &rows[r].as_chunks::<8>().0[..count];
    }
    let zero = V::splat(0.0);
    let (mut products, mut sizes) = ([zero; R], [zero; R]);
    for k in 0..count {
        let x = V::load(&x_blocks[k]);
        for r in 0..R {
            let product = V::load(&blocks[r][k]) * x;
            products[r] = products[r] + product;
            sizes[r] = sizes[r] + product.max(zero - product);
        }
    }
    let mut sums = [[0.0; 2]; R];
    for r in 0..R {
        let tail = || (start..x.len()).map(|j| rows[r][j] * x[j]);
        sums[r] = [
            sum(products[r].to_array()) + tail().sum::<f64>(),
            sum(sizes[r].to_array()) + tail().map(f64::abs).sum::<f64>(),
        ];
    }
    sums
}
