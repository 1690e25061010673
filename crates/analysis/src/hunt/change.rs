//! Small random changes to a problem, the moves of a search.
//!
//! Half of them keep a symmetric semidefinite A symmetric semidefinite: A ← T A Tᵀ, other units, a
//! larger diagonal.

use super::numbers::{Numbers, Random};
use lcplab_lcp::Lcp;

/// Maximum number of attempts to produce a valid problem; bounds of rows that limit friction are
/// kept.
const TRIES: usize = 20;

impl Numbers {
    /// The problem after one to three changes, with a number of rows within `rows`, if it is valid
    /// for the search; the unchanged problem if no such change was found.
    pub fn changed(
        &self,
        random: &mut Random,
        rows: (usize, usize),
        is_fair: &dyn Fn(&Lcp) -> bool,
    ) -> Numbers {
        for _ in 0..TRIES {
            let mut changed = self.clone();
            for _ in 0..random.whole(1, 3) {
                changed.change(random, rows);
            }
            if changed.clone().lcp().is_ok_and(|lcp| is_fair(&lcp)) {
                return changed;
            }
        }
        self.clone()
    }

    fn change(&mut self, random: &mut Random, rows: (usize, usize)) {
        let n = self.len();
        let i = random.whole(0, n as i64 - 1) as usize;
        let j = random.whole(0, n as i64 - 1) as usize;
        let is_symmetric = self.is_symmetric();
        match random.whole(0, 11) {
            0 | 1 => self.b[i] = another(self.b[i], random),
            2 | 3 => {
                self.a[i][j] = another(self.a[i][j], random);
                if is_symmetric {
                    self.a[j][i] = self.a[i][j];
                }
            }
            4 | 5 if i != j => self.add_row(i, j, random.one_of(&[1.0, -1.0, 2.0, -2.0, 0.5])),
            6 => self.scale(i, 2f64.powi(random.whole(-4, 4) as i32)),
            7 => self.a[i][i] += random.one_of(&[1.0, 0.5, -0.5, 0.125]) * self.a[i][i].abs(),
            8 if i != j && is_symmetric => self.align(i, j),
            9 => self.rub(i, random),
            10 => self.bound(i, random),
            11 if random.whole(0, 1) == 0 && n > rows.0 => {
                let fewer = self.without(i..i + 1);
                if fewer.len() >= rows.0 {
                    *self = fewer;
                }
            }
            11 if n < rows.1 => self.append(random),
            _ => self.b[i] = -self.b[i],
        }
    }

    /// A ← T A Tᵀ with T = I + c e_i e_jᵀ: row and column i get c times those of j.
    fn add_row(&mut self, i: usize, j: usize, c: f64) {
        for k in 0..self.len() {
            self.a[i][k] += c * self.a[j][k];
        }
        for k in 0..self.len() {
            self.a[k][i] += c * self.a[k][j];
        }
    }

    /// Row i in other units: a heavier or lighter body.
    pub fn scale(&mut self, i: usize, unit: f64) {
        for k in 0..self.len() {
            self.a[i][k] *= unit;
        }
        for k in 0..self.len() {
            self.a[k][i] *= unit;
        }
        self.b[i] *= unit;
    }

    /// Makes rows i and j of a symmetric A more nearly parallel, halving the distance.
    fn align(&mut self, i: usize, j: usize) {
        let parallel = (self.a[i][i] * self.a[j][j]).sqrt().copysign(self.a[i][j]);
        if parallel.is_finite() {
            let nearer = 0.5 * (self.a[i][j] + parallel);
            (self.a[i][j], self.a[j][i]) = (nearer, nearer);
        }
    }

    /// Another coefficient of friction.
    fn rub(&mut self, i: usize, random: &mut Random) {
        if let Some((index, mu)) = &mut self.friction
            && let Some(normal) = index[i]
        {
            let other = random.one_of(&[0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 16.0]);
            for (mu, _) in mu.iter_mut().zip(index).filter(|(_, k)| **k == Some(normal)) {
                *mu = other;
            }
        }
    }

    fn bound(&mut self, i: usize, random: &mut Random) {
        if self.is_coupled(i) || self.bounds_another(i) {
            return;
        }
        let (one, other) = (random.number(3), random.number(3));
        (self.lo[i], self.hi[i]) = match random.whole(0, 4) {
            0 | 1 => (0.0, f64::INFINITY),
            2 => (f64::NEG_INFINITY, f64::INFINITY),
            3 => (one.min(other), one.max(other)),
            _ => (f64::NEG_INFINITY, one),
        };
    }

    /// Adds a contact: a combination of the other rows plus a part of its own.
    fn append(&mut self, random: &mut Random) {
        let n = self.len();
        let of: Vec<f64> = (0..n).map(|_| random.number(1)).collect();
        let dot = |row: &Vec<f64>| row.iter().zip(&of).map(|(a, c)| a * c).sum::<f64>();
        let column: Vec<f64> = self.a.iter().map(dot).collect();
        let mut row: Vec<f64> =
            (0..n).map(|j| (0..n).map(|i| of[i] * self.a[i][j]).sum()).collect();
        row.push(dot(&column) + random.whole(0, 2) as f64);
        for (row, value) in self.a.iter_mut().zip(column) {
            row.push(value);
        }
        self.a.push(row);
        self.b.push(random.number(3));
        self.lo.push(0.0);
        self.hi.push(f64::INFINITY);
        if let Some((index, mu)) = &mut self.friction {
            index.push(None);
            mu.push(0.0);
        }
    }
}

/// A number near this one, or a small integer.
fn another(value: f64, random: &mut Random) -> f64 {
    match random.whole(0, 5) {
        0 => value + 1.0,
        1 => value - 1.0,
        2 => -value,
        3 => 2.0 * value,
        4 => 0.5 * value,
        _ => random.number(3),
    }
}
