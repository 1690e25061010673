//! Linear theory of sweeps while no row changes sides.
//!
//! Rows that are free at the solution stay free, those at a bound stay there, and friction that
//! slides is proportional to its normal force. Then a sweep multiplies the error by a matrix G,
//! asymptotically by its largest eigenvalue ρ below 1, whose eigenvector is the slowest mode.
//! Nothing is factorized; the sweeps are carried out.

use lcplab_lcp::Lcp;

use super::reference::ReferenceSolution;

/// ρ has converged when it changes by less than this fraction of 1 − ρ.
const SETTLED: f64 = 1e-4;

/// Rows are considered to have changed sides if this fraction of the error lies outside the bounds.
const OUTSIDE: f64 = 0.5;

/// The role of a row while no row changes sides.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Role {
    /// The row is solved for.
    Free,
    /// x_i keeps its value in the solution.
    Held,
    /// x_i = factor · x_normal.
    Follows { normal: usize, factor: f64 },
}

/// The parameters of a sweep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SweepParameters {
    /// The relaxation factor.
    pub omega: f64,
    /// Whether the rows are taken from the last to the first.
    pub is_reversed: bool,
}

impl SweepParameters {
    /// Gauss-Seidel.
    pub const PLAIN: SweepParameters = SweepParameters { omega: 1.0, is_reversed: false };
}

/// The slowest mode of Gauss-Seidel.
#[derive(Debug, Clone, PartialEq)]
pub struct Slowest {
    /// The factor ρ by which a sweep multiplies it.
    pub rate: f64,
    /// Its forces, one entry per row.
    pub forces: Vec<f64>,
    /// The number of sweeps after which theory predicts an error of `GOOD`.
    pub sweeps: f64,
}

/// Relaxation sweeps while no row changes sides.
#[derive(Debug, Clone)]
pub struct Linear<'a> {
    reference: &'a ReferenceSolution<'a>,
    lcp: &'a Lcp,
    roles: Vec<Role>,
}

impl<'a> Linear<'a> {
    /// The sweeps of a problem linearized at its solution.
    pub fn new(lcp: &'a Lcp, reference: &'a ReferenceSolution<'a>) -> Self {
        let free = reference.free_rows();
        let role = |i: usize| {
            let normal = lcp.coupling().and_then(|coupling| coupling.index(i));
            match normal {
                _ if free[i] => Role::Free,
                Some(normal) if reference.exact[normal] > 0.0 => {
                    Role::Follows { normal, factor: reference.exact[i] / reference.exact[normal] }
                }
                _ => Role::Held,
            }
        };
        Linear { reference, lcp, roles: (0..lcp.len()).map(role).collect() }
    }

    /// The predicted error after this number of sweeps from x; `None` if rows change sides, so that
    /// the theory does not apply.
    pub fn missing(&self, x: &[f64], way: SweepParameters, sweeps: usize) -> Option<f64> {
        let mut x = self.placed(x);
        for _ in 0..sweeps {
            self.sweep(&mut x, way);
        }
        let missing = self.reference.missing(&x);
        let inside: Vec<f64> = (0..x.len()).map(|i| self.lcp.project(i, x[i], &x)).collect();
        let outside = self.reference.apart(&x, &inside);
        (outside <= OUTSIDE * missing).then_some(missing)
    }

    /// The mode that remains in the end, searched in at most this number of sweeps; `None` if there
    /// is none.
    pub fn slowest(&self, start: &[f64], target: f64, most: usize) -> Option<Slowest> {
        let mut x = self.placed(start);
        let (mut before, mut rate, mut reached) = (self.reference.missing(&x), 0.0, None);
        let mut sweeps = 0;
        while sweeps < most {
            self.sweep(&mut x, SweepParameters::PLAIN);
            sweeps += 1;
            let missing = self.reference.missing(&x);
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
        let forces = x.iter().zip(&self.reference.exact).map(|(x, exact)| x - exact).collect();
        (rate > 0.0).then_some(Slowest { rate, forces, sweeps })
    }

    /// x with the rows that are not free set to their values.
    fn placed(&self, x: &[f64]) -> Vec<f64> {
        let mut x = x.to_vec();
        for (i, role) in self.roles.iter().enumerate() {
            if *role == Role::Held {
                x[i] = self.reference.exact[i];
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

    fn sweep(&self, x: &mut [f64], SweepParameters { omega, is_reversed }: SweepParameters) {
        for k in 0..x.len() {
            let i = if is_reversed { x.len() - 1 - k } else { k };
            match self.roles[i] {
                Role::Free => x[i] -= omega * self.lcp.row_w(i, x) / self.lcp.matrix().diagonal(i),
                Role::Follows { normal, factor } => x[i] = factor * x[normal],
                Role::Held => {}
            }
        }
    }
}
