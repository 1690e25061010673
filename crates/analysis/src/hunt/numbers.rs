//! The mutable numbers of a problem, and the random number generator.

use std::ops::Range;

use oorandom::Rand64;

use lcplab_lcp::error::Result;
use lcplab_lcp::{Coupling, Lcp, Matrix};

/// A stream of random numbers.
pub(super) struct Random(Rand64);

impl Random {
    /// The stream of problem k of a seed.
    pub(super) fn new(seed: u64, k: usize) -> Self {
        Random(Rand64::new((u128::from(seed) << 64) | k as u128))
    }

    pub(super) fn whole(&mut self, least: i64, most: i64) -> i64 {
        least + self.0.rand_range(0..(most - least + 1) as u64) as i64
    }

    pub(super) fn number(&mut self, size: i64) -> f64 {
        self.whole(-size, size) as f64
    }

    pub(super) fn one_of<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.whole(0, list.len() as i64 - 1) as usize]
    }
}

/// A problem that is being modified.
#[derive(Clone, Debug)]
pub(super) struct Numbers {
    pub a: Vec<Vec<f64>>,
    pub b: Vec<f64>,
    pub lo: Vec<f64>,
    pub hi: Vec<f64>,
    /// The [scale](Lcp::scale) of x.
    pub least: f64,
    /// The rows that bound the others, and μ.
    pub friction: Option<(Vec<Option<usize>>, Vec<f64>)>,
}

impl Numbers {
    /// Contacts with these numbers.
    pub fn new(a: Vec<Vec<f64>>, b: Vec<f64>) -> Numbers {
        let n = b.len();
        Numbers { a, b, lo: vec![0.0; n], hi: vec![f64::INFINITY; n], least: 0.0, friction: None }
    }

    /// The numbers of a problem.
    pub fn of(lcp: &Lcp) -> Numbers {
        let n = lcp.len();
        let row = |i| (0..n).map(|j| lcp.matrix().entry(i, j)).collect();
        let friction = lcp.coupling().map(|c| (0..n).map(|i| (c.index(i), c.mu(i))).unzip());
        Numbers {
            a: (0..n).map(row).collect(),
            b: lcp.b().to_vec(),
            lo: lcp.lo().to_vec(),
            hi: lcp.hi().to_vec(),
            least: lcp.scale(),
            friction,
        }
    }

    /// Builds the problem.
    ///
    /// # Errors
    /// If the numbers are invalid: an entry that is not finite, lo > hi.
    pub fn lcp(self) -> Result<Lcp> {
        let matrix = Matrix::dense(self.len(), &self.a.concat());
        let lcp = Lcp::new(matrix, self.b, self.lo, self.hi)?.with_scale(self.least)?;
        match self.friction {
            None => Ok(lcp),
            Some((index, mut mu)) => {
                let rows = mu.iter_mut().zip(&index);
                rows.filter(|(_, k)| k.is_none()).for_each(|(mu, _)| *mu = 0.0);
                lcp.with_coupling(Coupling::new(index, mu)?)
            }
        }
    }

    pub fn len(&self) -> usize {
        self.b.len()
    }

    pub fn is_symmetric(&self) -> bool {
        (0..self.len()).all(|i| (0..i).all(|j| self.a[i][j] == self.a[j][i]))
    }

    /// Whether row i is bounded by the x of another one.
    pub fn is_coupled(&self, i: usize) -> bool {
        self.friction.as_ref().is_some_and(|(index, _)| index[i].is_some())
    }

    /// Whether the x of row i bounds another one.
    pub(crate) fn bounds_another(&self, i: usize) -> bool {
        self.friction.as_ref().is_some_and(|(index, _)| index.contains(&Some(i)))
    }

    /// The same without these rows and the rows that they bound.
    pub fn without(&self, rows: Range<usize>) -> Numbers {
        let index = |row: usize| self.friction.as_ref().and_then(|(index, _)| index[row]);
        let is_gone = |row: usize| {
            rows.contains(&row) || index(row).is_some_and(|normal| rows.contains(&normal))
        };
        let kept: Vec<usize> = (0..self.len()).filter(|&row| !is_gone(row)).collect();
        let of = |all: &[f64]| kept.iter().map(|&row| all[row]).collect::<Vec<f64>>();
        let place = |k: usize| kept.iter().position(|&row| row == k);
        let friction = self.friction.as_ref().map(|(index, mu)| {
            (kept.iter().map(|&row| index[row].and_then(place)).collect(), of(mu))
        });
        Numbers {
            a: kept.iter().map(|&row| of(&self.a[row])).collect(),
            b: of(&self.b),
            lo: of(&self.lo),
            hi: of(&self.hi),
            least: self.least,
            friction: friction.filter(|(index, _): &(Vec<_>, _)| index.iter().any(Option::is_some)),
        }
    }
}

/// p · q.
pub(super) fn dot(p: &[f64], q: &[f64]) -> f64 {
    p.iter().zip(q).map(|(p, q)| p * q).sum()
}

/// J Jᵀ for these rows of J.
pub(super) fn gram(j: &[Vec<f64>]) -> Vec<Vec<f64>> {
    j.iter().map(|row| j.iter().map(|other| dot(row, other)).collect()).collect()
}
