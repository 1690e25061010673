//! A problem as rows of numbers, and textbook solvers that share nothing with those under test.

use lcplab_lcp::{Coupling, Lcp, Matrix};
use oorandom::Rand64;

/// w = A x + b, bounds, and for friction rows the row that bounds them with μ.
#[derive(Debug, Clone)]
pub struct Plain {
    pub a: Vec<Vec<f64>>,
    pub b: Vec<f64>,
    pub lo: Vec<f64>,
    pub hi: Vec<f64>,
    pub friction: Vec<Option<(usize, f64)>>,
}

/// Where a sweep clamps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Clamp {
    InSweep,
    AfterSweep,
}

impl Plain {
    pub fn len(&self) -> usize {
        self.b.len()
    }

    pub fn lcp(&self) -> Lcp {
        let (n, infinite) = (self.len(), f64::INFINITY);
        let bound = |own: &[f64], free: f64| -> Vec<f64> {
            (0..n).map(|i| if self.friction[i].is_some() { free } else { own[i] }).collect()
        };
        let matrix = Matrix::dense(n, &self.a.concat());
        let (lo, hi) = (bound(&self.lo, -infinite), bound(&self.hi, infinite));
        let lcp = Lcp::new(matrix, self.b.clone(), lo, hi).unwrap();
        let index = self.friction.iter().map(|own| own.map(|(row, _)| row)).collect();
        let mu = self.friction.iter().map(|own| own.map_or(0.0, |(_, mu)| mu)).collect();
        lcp.with_coupling(Coupling::new(index, mu).unwrap()).unwrap()
    }

    pub fn w(&self, x: &[f64], i: usize) -> f64 {
        self.a[i].iter().zip(x).fold(self.b[i], |sum, (a, x)| sum + a * x)
    }

    pub fn clamped(&self, i: usize, value: f64, x: &[f64]) -> f64 {
        match self.friction[i] {
            Some((row, mu)) => value.clamp(-mu * x[row].max(0.0), mu * x[row].max(0.0)),
            None => value.max(self.lo[i]).min(self.hi[i]),
        }
    }

    /// Sweeps over these rows.
    pub fn swept(&self, mut x: Vec<f64>, rows: &[usize], sweeps: usize, clamp: Clamp) -> Vec<f64> {
        for _ in 0..sweeps {
            for &i in rows {
                let value = x[i] - self.w(&x, i) / self.a[i][i];
                x[i] = if clamp == Clamp::InSweep { self.clamped(i, value, &x) } else { value };
            }
            if clamp == Clamp::AfterSweep {
                for i in 0..x.len() {
                    x[i] = self.clamped(i, x[i], &x);
                }
            }
        }
        x
    }

    /// Sweeps in which every row uses the old x.
    pub fn all_at_once(&self, mut x: Vec<f64>, sweeps: usize) -> Vec<f64> {
        for _ in 0..sweeps {
            let moved: Vec<f64> =
                (0..x.len()).map(|i| x[i] - self.w(&x, i) / self.a[i][i]).collect();
            x = moved;
            for i in 0..x.len() {
                x[i] = self.clamped(i, x[i], &x);
            }
        }
        x
    }

    /// x clamped to its bounds, the normal rows first.
    pub fn projected(&self, mut x: Vec<f64>) -> Vec<f64> {
        let (normals, friction): (Vec<usize>, Vec<usize>) =
            (0..x.len()).partition(|&i| self.friction[i].is_none());
        for i in normals.into_iter().chain(friction) {
            x[i] = self.clamped(i, x[i], &x);
        }
        x
    }

    /// The solution under Coulomb's law: both tangents of a contact are moved with one step and
    /// then into the disk of radius μ x_n, until nothing changes.
    pub fn under_coulomb(&self) -> Option<Vec<f64>> {
        let mut x = vec![0.0; self.len()];
        for _ in 0..40_000 {
            let before = x.clone();
            for n in (0..x.len()).step_by(3) {
                x[n] = (x[n] - self.w(&x, n) / self.a[n][n]).max(0.0);
                let (_, mu) = self.friction[n + 1]?;
                let step = self.a[n + 1][n + 1] + self.a[n + 2][n + 2];
                let moved = [n + 1, n + 2].map(|i| x[i] - self.w(&x, i) / step);
                let share = (mu * x[n] / moved[0].hypot(moved[1])).min(1.0);
                (x[n + 1], x[n + 2]) = (share * moved[0], share * moved[1]);
            }
            let size = x.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let moved = x.iter().zip(&before).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
            if moved <= 1e-16 * size {
                return Some(x);
            }
        }
        None
    }

    /// The solution, by sweeps until nothing changes.
    pub fn solved(&self) -> Option<Vec<f64>> {
        let rows: Vec<usize> = (0..self.len()).collect();
        let mut x = vec![0.0; self.len()];
        for _ in 0..4000 {
            let next = self.swept(x.clone(), &rows, 10, Clamp::InSweep);
            let size = next.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let moved = next.iter().zip(&x).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
            x = next;
            if moved <= 1e-15 * size {
                return Some(x);
            }
        }
        None
    }
}

/// The kind of rows of a random problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rows {
    Contacts,
    Boxes,
    Friction,
}

/// A random definite problem with a solution that was chosen first: w is 0 in rows between their
/// bounds.
pub fn random(random: &mut Rand64, rows: Rows) -> (Plain, Vec<f64>) {
    let mut number = |least: f64, most: f64| least + (most - least) * random.rand_float();
    let n = match rows {
        Rows::Friction => 3 * (1.0 + 3.999 * number(0.0, 1.0)) as usize,
        _ => (2.0 + 10.999 * number(0.0, 1.0)) as usize,
    };
    // Rows of a chain, of a heap, or fully coupled.
    let reach = [1, 3, n][(2.999 * number(0.0, 1.0)) as usize];
    let shift = [0.02, 0.3, 1.0][(2.999 * number(0.0, 1.0)) as usize];
    let mut j = vec![vec![0.0; n]; n];
    for r in 0..n {
        for c in r.saturating_sub(reach)..(r + reach).min(n) {
            j[r][c] = number(-1.0, 1.0);
        }
    }
    let product = |r: usize, c: usize| (0..n).map(|k| j[r][k] * j[c][k]).sum::<f64>();
    let a: Vec<Vec<f64>> = (0..n)
        .map(|r| (0..n).map(|c| product(r, c) + if r == c { shift } else { 0.0 }).collect())
        .collect();
    let infinite = f64::INFINITY;
    let (mut lo, mut hi) = (vec![0.0; n], vec![infinite; n]);
    let (mut x, mut w, mut friction) = (vec![0.0; n], vec![0.0; n], vec![None; n]);
    for i in 0..n {
        // 0: at the lower bound, 1: between the bounds, 2: at the upper bound.
        let place = (2.999 * number(0.0, 1.0)) as usize;
        if rows == Rows::Friction && i % 3 > 0 {
            let (normal, mu) = (i - i % 3, 0.5);
            friction[i] = Some((normal, mu));
            let limit = mu * x[normal];
            (x[i], w[i]) = match place {
                0 => (-limit, number(0.0, 2.0)),
                1 => (limit * number(-0.9, 0.9), 0.0),
                _ => (limit, -number(0.0, 2.0)),
            };
            continue;
        }
        if rows == Rows::Boxes {
            lo[i] =
                if place == 1 && number(0.0, 1.0) < 0.3 { -infinite } else { number(-2.0, 0.0) };
            hi[i] = number(0.5, 2.0);
        }
        let low = lo[i].max(-2.0);
        (x[i], w[i]) = match place {
            0 => (lo[i], number(0.0, 2.0)),
            1 => (number(low + 0.1, hi[i].min(2.0)), 0.0),
            _ if hi[i].is_finite() => (hi[i], -number(0.0, 2.0)),
            _ => (number(0.1, 2.0), 0.0),
        };
    }
    let b = (0..n).map(|i| w[i] - (0..n).map(|k| a[i][k] * x[k]).sum::<f64>()).collect();
    (Plain { a, b, lo, hi, friction }, x)
}
