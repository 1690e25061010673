//! Seeded random numbers. PCG (O'Neill 2014) gives the same numbers on every machine.

use nalgebra::DMatrix;

/// A stream of random numbers.
pub(super) struct Random(oorandom::Rand64);

impl Random {
    pub(super) fn new(seed: usize) -> Self {
        Random(oorandom::Rand64::new(seed as u128))
    }

    /// An integer in least … most.
    pub(super) fn whole(&mut self, least: i64, most: i64) -> i64 {
        least + self.0.rand_range(0..(most - least + 1) as u64) as i64
    }

    /// A multiple of 1/8 in least … most.
    pub(super) fn eighth(&mut self, least: i64, most: i64) -> f64 {
        self.whole(8 * least, 8 * most) as f64 / 8.0
    }

    /// A normally distributed number (Box & Muller 1958).
    pub(super) fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.0.rand_float()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.0.rand_float()).cos()
    }

    /// The same elements in random order (Fisher & Yates).
    pub(super) fn shuffled<T>(&mut self, mut elements: Vec<T>) -> Vec<T> {
        for last in (1..elements.len()).rev() {
            elements.swap(last, self.whole(0, last as i64) as usize);
        }
        elements
    }

    /// An n × k matrix with orthonormal columns in uniformly distributed directions.
    pub(super) fn orthonormal(&mut self, n: usize, k: usize) -> DMatrix<f64> {
        DMatrix::from_fn(n, k, |_, _| self.normal()).qr().q()
    }
}
