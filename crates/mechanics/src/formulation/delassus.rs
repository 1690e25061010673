//! A = J M⁻¹ Jᵀ + diag(γ), the Delassus operator: entry ij couples rows that share a moving body.
//!
//! ```text
//! A_ij = Σ over shared bodies k of   (M_k⁻¹ J_ikᵀ) · J_jk
//! ```
//!
//! Only the upper triangle is computed and then mirrored, so A is exactly symmetric. If contacts
//! slide ([`Slide`]), the columns t contribute to column n, and A is not symmetric.

use nalgebra::Vector6;

use super::Slide;
use crate::assembly::{Assembly, Part};
use lcplab_lcp::Matrix;
use lcplab_lcp::error::Result;
use lcplab_lcp::memory::Memory;

/// A matrix with up to this many rows is dense, regardless of its fill.
const SMALL: usize = 32;
/// A larger matrix is dense if at least this fraction of its entries is stored.
const FULL: f64 = 0.25;

/// Memory per entry while A is built, in numbers: its position and value, twice, and A itself.
const ENTRY: usize = 8;

/// Checks the memory limit for A: each pair of rows that share a body is an entry.
pub(super) fn check(assembly: &Assembly, most: Memory) -> Result<()> {
    let mut rows_of = vec![0; assembly.blocks.len()];
    for part in assembly.rows.iter().flat_map(|row| row.parts()) {
        rows_of[part.block] += 1;
    }
    let pairs: usize = rows_of.iter().map(|rows: &usize| rows * rows).sum();
    let what = format!("A of {} rows with up to {pairs} entries", assembly.rows.len());
    most.check(what, Memory::numbers(ENTRY).times(pairs))
}

pub(super) fn matrix(assembly: &Assembly, compliance: &[f64], slides: &[Slide]) -> Matrix {
    let n = assembly.rows.len();
    let mut entries = entries(assembly);
    for (i, j, a) in &mut entries {
        *a += if i == j { compliance[*i] } else { 0.0 };
    }
    drag(&mut entries, n, slides);
    if n > SMALL && (entries.len() as f64) < FULL * (n * n) as f64 {
        return Matrix::sparse(n, &entries);
    }
    let mut dense = vec![0.0; n * n];
    for (i, j, a) in entries {
        dense[i * n + j] += a;
    }
    Matrix::dense(n, &dense)
}

/// A_in += Σ_t (x_t/x_n) A_it for sliding contacts.
fn drag(entries: &mut Vec<(usize, usize, f64)>, n: usize, slides: &[Slide]) {
    let mut follows = vec![None; n];
    for slide in slides {
        for &(t, part) in &slide.drag {
            follows[t] = Some((slide.normal, part));
        }
    }
    let dragged = |&(i, t, a): &(usize, usize, f64)| {
        let (normal, part) = follows[t]?;
        Some((i, normal, part * a))
    };
    let more: Vec<_> = entries.iter().filter_map(dragged).collect();
    entries.extend(more);
}

/// The entries of A without duplicates.
fn entries(assembly: &Assembly) -> Vec<(usize, usize, f64)> {
    // For each body, its rows in ascending order, with their part of J.
    let mut rows_of: Vec<Vec<(usize, Vector6<f64>)>> = vec![Vec::new(); assembly.blocks.len()];
    for (i, row) in assembly.rows.iter().enumerate() {
        for part in row.parts() {
            rows_of[part.block].push((i, part.jacobian));
        }
    }
    let mut entries = Vec::new();
    for (i, row) in assembly.rows.iter().enumerate() {
        let mut upper: Vec<(usize, f64)> = Vec::new();
        for part in row.parts() {
            let response = response(assembly, part);
            let above = rows_of[part.block].partition_point(|&(j, _)| j < i);
            let others = &rows_of[part.block][above..];
            upper.extend(others.iter().map(|(j, other)| (*j, response.dot(other))));
        }
        upper.sort_by_key(|&(j, _)| j);
        upper.dedup_by(|next, sum| {
            let same = next.0 == sum.0;
            if same {
                sum.1 += next.1;
            }
            same
        });
        for (j, a) in upper {
            entries.push((i, j, a));
            if j != i {
                entries.push((j, i, a));
            }
        }
    }
    entries
}

/// M⁻¹ Jᵀ of one part; a point mass has no rotation.
fn response(assembly: &Assembly, part: &Part) -> Vector6<f64> {
    assembly.blocks[part.block].accelerate(&part.jacobian)
}
