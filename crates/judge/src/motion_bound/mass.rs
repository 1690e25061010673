//! The mass matrix M in blocks, scaled to a diagonal near 1.

use faer::linalg::solvers::{Llt, Solve};
use faer::{Mat, Side};

use super::Unproved;
use crate::error_bound::least_eigenvalue;
use crate::interval::{Interval, add_up, div_up, norm_up, sqrt_up};

/// d M d for powers of two d, split into independent diagonal blocks.
pub(crate) struct Mass {
    /// d.
    pub(crate) scales: Vec<f64>,
    /// √λ_min, rounded down.
    pub(crate) least_root: f64,
    rows: Vec<Vec<(usize, f64)>>,
    /// The first column of each block, and its Cholesky factor.
    blocks: Vec<(usize, Llt<f64>)>,
}

impl Mass {
    /// From the entries of the upper triangle of a k × k matrix.
    pub(crate) fn new(upper: &[(usize, usize, f64)], k: usize) -> Result<Self, Unproved> {
        let mut diagonal = vec![0.0; k];
        upper.iter().filter(|(i, j, _)| i == j).for_each(|&(i, _, m)| diagonal[i] = m);
        let scales: Vec<f64> =
            diagonal.into_iter().map(power).collect::<Option<_>>().ok_or(Unproved::Mass)?;
        let mut rows = vec![Vec::new(); k];
        for &(i, j, m) in upper.iter().filter(|entry| entry.2 != 0.0) {
            let m = scales[i] * m * scales[j];
            rows[i].push((j, m));
            if i != j {
                rows[j].push((i, m));
            }
        }
        let (mut blocks, mut least) = (Vec::new(), 1.0);
        for columns in ranges(&rows) {
            let first = columns.start;
            let mut block = Mat::zeros(columns.len(), columns.len());
            for i in columns {
                rows[i].iter().for_each(|&(j, m)| block[(i - first, j - first)] = m);
            }
            least = f64::min(least, least_eigenvalue(&block).ok_or(Unproved::Mass)?);
            blocks.push((first, block.llt(Side::Lower).map_err(|_| Unproved::Mass)?));
        }
        Ok(Mass { scales, least_root: least.sqrt().next_down(), rows, blocks })
    }

    /// The largest absolute row sum, an upper bound on λ_max.
    pub(crate) fn largest_row_sum(&self) -> f64 {
        let sum = |row: &Vec<(usize, f64)>| row.iter().fold(0.0, |s, (_, m)| add_up(s, m.abs()));
        self.rows.iter().map(sum).fold(0.0, f64::max)
    }

    /// M⁻¹ f, rounded.
    pub(crate) fn solve(&self, f: &[f64]) -> Vec<f64> {
        let mut v = vec![0.0; f.len()];
        let ends = self.blocks.iter().skip(1).map(|block| block.0).chain([f.len()]);
        for ((first, factor), end) in self.blocks.iter().zip(ends) {
            let mut column = Mat::from_fn(end - first, 1, |i, _| f[first + i]);
            factor.solve_in_place(&mut column);
            (*first..end).for_each(|j| v[j] = column[(j - first, 0)]);
        }
        v
    }

    /// M v.
    pub(crate) fn times(&self, v: &[Interval]) -> Vec<Interval> {
        let product =
            |row: &Vec<(usize, f64)>| Interval::dot(row.iter().map(|&(j, m)| (m.into(), v[j])));
        self.rows.iter().map(product).collect()
    }

    /// An upper bound on |v_j| / |v|_M in the units of the problem, for all v and j.
    pub(crate) fn largest_entry(&self) -> f64 {
        div_up(self.scales.iter().copied().fold(0.0, f64::max), self.least_root)
    }

    /// An upper bound on |M⁻¹ f|_M.
    pub(crate) fn length(&self, f: &[Interval]) -> f64 {
        let guess = self.solve(&f.iter().map(|f| f.middle()).collect::<Vec<_>>());
        self.length_of(&guess, f)
    }

    /// An upper bound on |M⁻¹ f|_M with an approximation `guess` of M⁻¹ f: |guess|_M + |f − M
    /// guess| / √λ_min.
    pub(crate) fn length_of(&self, guess: &[f64], f: &[Interval]) -> f64 {
        let guess: Vec<Interval> = guess.iter().map(|&v| v.into()).collect();
        let product = self.times(&guess);
        let square = Interval::dot(guess.iter().copied().zip(product.iter().copied()));
        let rest = f.iter().zip(&product).map(|(&f, &p)| f - p);
        add_up(sqrt_up(square.hi), div_up(norm_up(rest), self.least_root))
    }
}

/// The power of two p with p² a between ½ and 2, for a > 0.
pub(crate) fn power(a: f64) -> Option<f64> {
    (a > 0.0 && a.is_finite()).then(|| 2f64.powi((0.5 - 0.5 * a.log2()).floor() as i32))
}

/// The column ranges of the smallest independent diagonal blocks.
fn ranges(rows: &[Vec<(usize, f64)>]) -> Vec<std::ops::Range<usize>> {
    let (mut ranges, mut first, mut last) = (Vec::new(), 0, 0);
    for (i, row) in rows.iter().enumerate() {
        last = row.iter().map(|&(j, _)| j).fold(last.max(i), usize::max);
        if last == i {
            ranges.push(first..i + 1);
            first = i + 1;
        }
    }
    ranges
}
