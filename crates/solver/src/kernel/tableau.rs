//! What a pivot in a tableau costs: the sweep, the ratio test, the move.
//!
//! Rows are whole blocks of eight.

use super::lanes::{Lanes, Width, Work};

/// What is left of a sum below this part of its terms is rounding: sweeps leave more of it than a factor does.
pub(crate) const ROUNDING: f64 = 1e-13;

/// S ← S − f rᵀ with r row k of S and f = r / s_kk; then row and column k ← ± f, and s_kk ← −1 / s_kk. Each row of S is
/// stored from its first block on.
pub(crate) struct Sweep<'a> {
    /// The rows of S, each as long as `row`.
    pub table: &'a mut [f64],
    /// The row that is swept.
    pub k: usize,
    pub row: &'a [f64],
    /// 1 or −1.
    pub sign: f64,
    /// Room for f.
    pub factors: &'a mut [f64],
}

impl Sweep<'_> {
    pub(crate) fn run(self, width: Width) {
        width.run(self);
    }
}

impl Work for Sweep<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Sweep { table, k, row, sign, factors } = self;
        let stride = row.len();
        let pivot = row[k];
        for (factor, s_ik) in factors.iter_mut().zip(row) {
            *factor = s_ik / pivot;
        }
        let blocks = row.as_chunks::<8>().0;
        for (i, own) in table.chunks_exact_mut(stride).enumerate() {
            let factor = factors[i];
            if factor != 0.0 {
                let (lanes, first) = (V::splat(factor), i / 8);
                let own = &mut own.as_chunks_mut::<8>().0[first..];
                for (own, row) in own.iter_mut().zip(&blocks[first..]) {
                    (V::load(own) - lanes * V::load(row)).store(own);
                }
            }
        }
        let first = k - k % 8;
        for (own, factor) in table.chunks_exact_mut(stride).zip(&*factors).take(first + 8) {
            own[k] = sign * factor;
        }
        let own = &mut table[k * stride..][..stride];
        for (s_kj, factor) in own[first..].iter_mut().zip(&factors[first..]) {
            *s_kj = sign * factor;
        }
        own[k] = -1.0 / pivot;
    }
}

/// How far variables can move that keep between limits: the least length.
pub(crate) struct Reach<'a> {
    /// Of each variable its value and its limits.
    pub value: &'a [f64],
    pub low: &'a [f64],
    pub high: &'a [f64],
    /// Its speed is `factor` times `row`, or 0 where |row| is at most `zero`.
    pub factor: &'a [f64],
    pub zero: &'a [f64],
    pub row: &'a [f64],
    /// What `factor` and `zero` are multiplied by.
    pub sign: f64,
    pub size: f64,
    /// The speeds, and the lengths after which each variable is at a limit, ∞ if it never is.
    pub speed: &'a mut [f64],
    pub length: &'a mut [f64],
}

impl Reach<'_> {
    pub(crate) fn run(self, width: Width) -> f64 {
        width.run(self)
    }
}

impl Work for Reach<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<V: Lanes>(self) -> f64 {
        fn blocks(numbers: &[f64], count: usize) -> &[[f64; 8]] {
            &numbers.as_chunks::<8>().0[..count]
        }
        let count = self.row.len() / 8;
        let [value, low, high] = [self.value, self.low, self.high].map(|all| blocks(all, count));
        let [factor, zero, row] = [self.factor, self.zero, self.row].map(|all| blocks(all, count));
        let speeds = &mut self.speed.as_chunks_mut::<8>().0[..count];
        let lengths = &mut self.length.as_chunks_mut::<8>().0[..count];
        let mut least = [f64::INFINITY; 8];
        for b in 0..count {
            for k in 0..8 {
                let entry = row[b][k];
                let moves = entry.abs() > self.size * zero[b][k];
                let speed = if moves { self.sign * factor[b][k] * entry } else { 0.0 };
                let limit = if speed > 0.0 { high[b][k] } else { low[b][k] };
                let length = (limit - value[b][k]) / speed;
                let length = if length > 0.0 { length } else { 0.0 };
                let length = if speed == 0.0 { f64::INFINITY } else { length };
                speeds[b][k] = speed;
                lengths[b][k] = length;
                least[k] = if length < least[k] { length } else { least[k] };
            }
        }
        least.into_iter().fold(f64::INFINITY, f64::min)
    }
}

/// value ← value + t speed, exactly 0 where only rounding is left.
pub(crate) struct Advance<'a> {
    pub value: &'a mut [f64],
    pub speed: &'a [f64],
    pub length: f64,
}

impl Advance<'_> {
    pub(crate) fn run(self, width: Width) {
        width.run(self);
    }
}

impl Work for Advance<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let (length, zero) = (V::splat(self.length), V::splat(ROUNDING));
        let values = self.value.as_chunks_mut::<8>().0;
        for (value, speed) in values.iter_mut().zip(self.speed.as_chunks::<8>().0) {
            let (before, change) = (V::load(value), length * V::load(speed));
            let rounding = zero * (before.abs() + change.abs());
            (before + change).zero_within(rounding).store(value);
        }
    }
}
