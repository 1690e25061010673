//! Gauss's program with M scaled to a diagonal near 1, and interval enclosures of its quantities.
//!
//! Columns are scaled by powers of two, which is exact: u = d ũ, M̃ = d M d, J̃ = J d. Norms |·|_M
//! do not change.

use faer::Mat;

use super::Unproved;
use super::mass::{Mass, power};
use crate::error_bound::least_eigenvalue;
use crate::interval::{Interval, add_up, div_up, mul_up, norm_up, sqrt_up};
use lcplab_lcp::Gauss;

/// Problems with more rows or columns are too large for dense matrices.
const MOST: usize = 2_000;

pub(super) struct Scaled<'a> {
    pub(super) gauss: &'a Gauss,
    /// Πx: the given x, projected onto its bounds.
    pub(super) x: &'a [f64],
    /// Jᵀx.
    impulse: Vec<Interval>,
    mass: Mass,
    jacobian: Vec<Vec<(usize, f64)>>,
    target: Vec<f64>,
    equations: Vec<usize>,
    /// 1 / √λ_min(A_EE) with rows scaled by these powers of two, rounded up; `None` if no bound was
    /// found.
    stiffness: Option<(f64, Vec<f64>)>,
}

impl<'a> Scaled<'a> {
    pub(super) fn new(gauss: &'a Gauss, x: &'a [f64]) -> Result<Self, Unproved> {
        let (k, n) = (gauss.target.len(), x.len());
        if k > MOST || n > MOST {
            return Err(Unproved::TooLarge);
        }
        let mass = Mass::new(&gauss.mass, k)?;
        let d = &mass.scales;
        let scale = |row: &Vec<(usize, f64)>| row.iter().map(|&(j, v)| (j, v * d[j])).collect();
        let jacobian: Vec<Vec<(usize, f64)>> = gauss.jacobian.iter().map(scale).collect();
        let mut impulse = vec![Interval::ZERO; k];
        for (row, &x) in jacobian.iter().zip(x) {
            for &(j, value) in row {
                impulse[j] = impulse[j] + Interval::from(value) * x.into();
            }
        }
        let free = |i: &usize| gauss.lo[*i].is_infinite() && gauss.hi[*i].is_infinite();
        let equations: Vec<usize> =
            (0..n).filter(|&i| gauss.compliance[i] == 0.0).filter(free).collect();
        let stiffness = stiffness(&mass, &jacobian, &equations);
        Ok(Scaled {
            gauss,
            x,
            impulse,
            jacobian,
            target: gauss.target.iter().zip(d).map(|(u, d)| u / d).collect(),
            mass,
            equations,
            stiffness,
        })
    }

    /// u(x) = u* + M⁻¹Jᵀx, rounded.
    pub(super) fn motion(&self) -> Vec<f64> {
        let impulse: Vec<f64> = self.impulse.iter().map(|f| f.middle()).collect();
        self.mass.solve(&impulse).iter().zip(&self.target).map(|(du, u)| u + du).collect()
    }

    /// M⁻¹ J_Fᵀ y, rounded.
    pub(super) fn response(&self, rows: &[usize], y: &[f64]) -> Vec<f64> {
        let mut f = vec![0.0; self.target.len()];
        for (&i, y) in rows.iter().zip(y) {
            for &(j, value) in &self.jacobian[i] {
                f[j] += value * y;
            }
        }
        self.mass.solve(&f)
    }

    /// A = J M⁻¹ Jᵀ + γ in these rows, rounded.
    pub(super) fn delassus(&self, rows: &[usize]) -> Mat<f64> {
        let columns: Vec<Vec<f64>> = rows.iter().map(|&i| self.response(&[i], &[1.0])).collect();
        Mat::from_fn(rows.len(), rows.len(), |r, c| {
            let product = |&(j, value): &(usize, f64)| value * columns[c][j];
            let compliance = if r == c { self.gauss.compliance[rows[r]] } else { 0.0 };
            self.jacobian[rows[r]].iter().map(product).sum::<f64>() + compliance
        })
    }

    /// w_i = (J u + bias + γ x)_i.
    pub(super) fn w(&self, i: usize, u: &[f64]) -> Interval {
        let row = self.jacobian[i].iter().map(|&(j, value)| (value.into(), u[j].into()));
        let soft = Interval::from(self.gauss.compliance[i]) * self.x[i].into();
        Interval::dot(row) + self.gauss.bias[i].into() + soft
    }

    /// Σ |J_ij u_j| + |bias_i|: the size of w_i without cancellation.
    pub(super) fn size(&self, i: usize, u: &[f64]) -> f64 {
        let row = self.jacobian[i].iter().map(|&(j, value)| (value * u[j]).abs());
        row.sum::<f64>() + self.gauss.bias[i].abs()
    }

    pub(super) fn is_equation(&self, i: usize) -> bool {
        self.equations.binary_search(&i).is_ok()
    }

    /// Whether some values of w_i make P infinite.
    pub(super) fn is_hard(&self, i: usize) -> bool {
        let (lo, hi) = (self.gauss.lo[i], self.gauss.hi[i]);
        self.gauss.compliance[i] == 0.0 && (lo.is_infinite() || hi.is_infinite())
    }

    /// The sign of w_i that an inequality requires: 1 if x has only a lower bound, −1 if it has
    /// only an upper bound, 0 for other rows.
    pub(super) fn open_side(&self, i: usize) -> f64 {
        let is_infinite = |bound: f64| f64::from(u8::from(bound.is_infinite()));
        is_infinite(self.gauss.hi[i]) - is_infinite(self.gauss.lo[i])
    }

    /// An upper bound on √A_ii without γ: the change of the row under a motion of length 1.
    pub(super) fn row_length(&self, i: usize) -> f64 {
        div_up(norm_up(self.jacobian[i].iter().map(|&(_, v)| v.into())), self.mass.least_root)
    }

    /// An upper bound on g_i for a w_i in this interval.
    pub(super) fn gap(&self, i: usize, w: Interval) -> f64 {
        let (x, lo, hi) = (self.x[i], self.gauss.lo[i], self.gauss.hi[i]);
        let soft = |w: f64| match self.gauss.compliance[i] {
            0.0 => f64::INFINITY,
            compliance => div_up(mul_up(w, w), 2.0 * compliance),
        };
        let cost = |w: f64, room: f64| if w <= 0.0 { 0.0 } else { mul_up(w, room).min(soft(w)) };
        cost(w.hi, add_up(x, -lo)).max(cost(-w.lo, add_up(hi, -x)))
    }

    /// An upper bound on |e|_M of the motion e that moves the equations from these w to 0.
    pub(super) fn length_of_correction(&self, w: &[Interval]) -> Result<f64, Unproved> {
        if self.equations.iter().all(|&i| w[i] == Interval::ZERO) {
            return Ok(0.0);
        }
        let (stiffness, scales) = self.stiffness.as_ref().ok_or(Unproved::DependentEquations)?;
        let scaled = self.equations.iter().zip(scales).map(|(&i, &s)| w[i] * s.into());
        Ok(mul_up(norm_up(scaled), *stiffness))
    }

    /// An upper bound on |u − u(x)|_M; `change` approximates u − u(x).
    pub(super) fn deviation(&self, u: &[f64], change: &[f64]) -> f64 {
        let moved: Vec<Interval> =
            u.iter().zip(&self.target).map(|(&u, &t)| Interval::from(u) - t.into()).collect();
        let force = self.mass.times(&moved);
        let force: Vec<Interval> = force.iter().zip(&self.impulse).map(|(&f, &i)| f - i).collect();
        self.mass.length_of(change, &force)
    }

    /// An upper bound on |M⁻¹Jᵀ(x − Πx)|_M; Πx is the x of this problem.
    pub(super) fn motion_beyond_bounds(&self, x: &[f64]) -> f64 {
        let mut force = vec![Interval::ZERO; self.target.len()];
        for (i, row) in self.jacobian.iter().enumerate().filter(|(i, _)| x[*i] != self.x[*i]) {
            let beyond = Interval::from(x[i]) - self.x[i].into();
            row.iter().for_each(|&(j, value)| force[j] = force[j] + Interval::from(value) * beyond);
        }
        let middles: Vec<f64> = force.iter().map(|f| f.middle()).collect();
        self.mass.length_of(&self.mass.solve(&middles), &force)
    }

    /// An upper bound on √(M⁻¹)_jj in the units of the problem: entry j of a motion of length 1 is
    /// at most this.
    pub(super) fn largest_motion(&self, j: usize) -> f64 {
        let mut unit = vec![0.0; self.target.len()];
        unit[j] = 1.0;
        let guess = self.mass.solve(&unit);
        let force: Vec<Interval> = unit.into_iter().map(Interval::from).collect();
        mul_up(self.mass.scales[j], self.mass.length_of(&guess, &force))
    }

    /// The motion in the units of the problem.
    pub(super) fn unscaled(&self, u: &[f64]) -> Vec<f64> {
        u.iter().zip(&self.mass.scales).map(|(u, d)| u * d).collect()
    }
}

/// 1 / √λ_min of A_EE from λ_min(J_E J_Eᵀ) / λ_max(M), with rows scaled to a unit diagonal.
fn stiffness(
    mass: &Mass,
    jacobian: &[Vec<(usize, f64)>],
    equations: &[usize],
) -> Option<(f64, Vec<f64>)> {
    let (n, k) = (equations.len(), mass.scales.len());
    if n == 0 {
        // Without equations there is nothing to scale.
        return None;
    }
    let square = |&i: &usize| jacobian[i].iter().map(|&(_, v)| v * v).sum::<f64>();
    let scales: Vec<f64> = equations.iter().map(square).map(power).collect::<Option<_>>()?;
    let mut products = vec![vec![Interval::ZERO; n]; n];
    for (r, &i) in equations.iter().enumerate() {
        let mut row = vec![0.0; k];
        jacobian[i].iter().for_each(|&(j, value)| row[j] = scales[r] * value);
        for (c, &i) in equations.iter().enumerate() {
            let entries = jacobian[i].iter().filter(|(j, _)| row[*j] != 0.0);
            let terms = entries.map(|&(j, value)| (row[j].into(), (scales[c] * value).into()));
            products[r][c] = Interval::dot(terms);
        }
    }
    let gram = Mat::from_fn(n, n, |r, c| products[r][c].middle());
    let errors = (0..n).flat_map(|r| (0..n).map(move |c| (r, c)));
    let errors = errors.map(|(r, c)| (products[r][c] - gram[(r, c)].into()).magnitude());
    let least = least_eigenvalue(&gram)? - errors.fold(0.0, add_up);
    let most = mass.largest_row_sum();
    (least > 0.0).then(|| (sqrt_up(div_up(most, least.next_down())), scales))
}
