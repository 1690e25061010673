//! Sweeps while no row changes: what theory says of them.
//!
//! Rows that are free at the solution stay free, those at a bound stay there, and friction that
//! slides follows its normal force. Then a sweep multiplies the error by a matrix G, and in the
//! long run by the largest eigenvalue ρ below 1: its eigenvector is the pattern that goes slowest.
//! Nothing is factored; the sweeps are done.

use lcplab_problem::Lcp;

use super::yard::Yard;

/// ρ has settled when it changes by less than this part of 1 − ρ.
const SETTLED: f64 = 1e-4;

/// Rows have changed where so large a part of what is missing lies outside the bounds.
const OUTSIDE: f64 = 0.5;

/// What a row does while no row changes.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Role {
    /// It is solved for.
    Free,
    /// It stays where the solution has it.
    Held,
    /// x_i = factor · x_normal.
    Follows { normal: usize, factor: f64 },
}

/// How the rows are swept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Way {
    /// The factor of relaxation.
    pub omega: f64,
    /// Whether the last row comes first.
    pub is_reversed: bool,
}

impl Way {
    /// Gauss-Seidel.
    pub const PLAIN: Way = Way { omega: 1.0, is_reversed: false };
}

/// The slowest pattern of Gauss-Seidel.
#[derive(Debug, Clone, PartialEq)]
pub struct Slowest {
    /// What a sweep leaves of it, ρ.
    pub rate: f64,
    /// Its forces, an entry a row.
    pub forces: Vec<f64>,
    /// After so many sweeps, theory says, `GOOD` is missing.
    pub sweeps: f64,
}

/// Sweeps of relaxation whose rows do not change.
#[derive(Debug, Clone)]
pub struct Linear<'a> {
    yard: &'a Yard<'a>,
    lcp: &'a Lcp,
    roles: Vec<Role>,
}

impl<'a> Linear<'a> {
    /// The sweeps of a problem beside its solution.
    pub fn new(lcp: &'a Lcp, yard: &'a Yard<'a>) -> Self {
        let free = yard.free_rows();
        let role = |i: usize| {
            let normal = lcp.coupling().and_then(|coupling| coupling.index(i));
            match normal {
                _ if free[i] => Role::Free,
                Some(normal) if yard.exact[normal] > 0.0 => {
                    Role::Follows { normal, factor: yard.exact[i] / yard.exact[normal] }
                }
                _ => Role::Held,
            }
        };
        Linear { yard, lcp, roles: (0..lcp.len()).map(role).collect() }
    }

    /// What should be missing after so many sweeps from x on; `None` if rows change on the way, so
    /// that theory is silent.
    pub fn missing(&self, x: &[f64], way: Way, sweeps: usize) -> Option<f64> {
        let mut x = self.placed(x);
        for _ in 0..sweeps {
            self.sweep(&mut x, way);
        }
        let missing = self.yard.missing(&x);
        let inside: Vec<f64> = (0..x.len()).map(|i| self.lcp.project(i, x[i], &x)).collect();
        let outside = self.yard.apart(&x, &inside);
        (outside <= OUTSIDE * missing).then_some(missing)
    }

    /// The pattern that is left in the end, looked for in at most so many sweeps; `None` if nothing
    /// is.
    pub fn slowest(&self, start: &[f64], target: f64, most: usize) -> Option<Slowest> {
        let mut x = self.placed(start);
        let (mut before, mut rate, mut reached) = (self.yard.missing(&x), 0.0, None);
        let mut sweeps = 0;
        while sweeps < most {
            self.sweep(&mut x, Way::PLAIN);
            sweeps += 1;
            let missing = self.yard.missing(&x);
            let next = missing / before;
            if !(next > 0.0 && next < 1.0) {
                break;
            }
            if missing <= target && reached.is_none() {
                reached = Some(sweeps);
            }
            let is_settled = (next - rate).abs() < SETTLED * (1.0 - next);
            (rate, before) = (next, missing);
            if is_settled || missing < SETTLED * target {
                break;
            }
        }
        let left = || sweeps as f64 + (target / before).ln() / rate.ln();
        let sweeps = reached.map_or_else(left, |sweeps| sweeps as f64);
        let forces = x.iter().zip(&self.yard.exact).map(|(x, exact)| x - exact).collect();
        (rate > 0.0).then_some(Slowest { rate, forces, sweeps })
    }

    /// x with the rows that are not free where they belong.
    fn placed(&self, x: &[f64]) -> Vec<f64> {
        let mut x = x.to_vec();
        for (i, role) in self.roles.iter().enumerate() {
            if *role == Role::Held {
                x[i] = self.yard.exact[i];
            }
        }
        self.follow(&mut x);
        x
    }

    fn follow(&self, x: &mut [f64]) {
        for (i, role) in self.roles.iter().enumerate() {
            if let Role::Follows { normal, factor } = *role {
                x[i] = factor * x[normal];
            }
        }
    }

    fn sweep(&self, x: &mut [f64], Way { omega, is_reversed }: Way) {
        let last = x.len() - 1;
        for k in 0..x.len() {
            let i = if is_reversed { last - k } else { k };
            match self.roles[i] {
                Role::Free => x[i] -= omega * self.lcp.row_w(i, x) / self.lcp.matrix().diagonal(i),
                Role::Follows { normal, factor } => x[i] = factor * x[normal],
                Role::Held => {}
            }
        }
    }
}
