//! Derivatives of the motion u = u* + M⁻¹Jᵀx, and of x with respect to masses and rows.
//!
//! The key `motion` states A = J M⁻¹Jᵀ + diag(γ) and b = J u* + bias. With g = M⁻¹Jᵀx:
//!
//! ```text
//! f  = du* + M⁻¹(dJᵀ x − dM g)                  what u changes if x does not
//! q  = dA x + db = dJ u + J f + dbias + dγ x
//! du = f + M⁻¹Jᵀ dx
//! ```
//!
//! If the free rows are dependent, x is not unique, but u is: forces that differ by a null vector
//! of A_FF act alike. u* and M change neither the null vectors nor the rows, so that the same rows
//! stay free, and u is differentiable; changes of single rows can separate the dependent ones.

use dashu_ratio::RBig;
use faer::Mat;
use faer::linalg::solvers::Solve;

use super::linear::{dot, number, solve};
use super::{Direction, entry, exact, numbers};
use lcplab_lcp::error::Result;
use lcplab_lcp::{Gauss, Lcp};

/// A and b may differ by this fraction from those of the masses and rows.
const ROUNDING: f64 = 1e-6;

/// The gradient with respect to the key `motion`. Where x is not unique, only `target` and `mass`
/// have one, and the others are empty.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionPullback {
    /// With respect to u*.
    pub target: Vec<RBig>,
    /// With respect to the bias.
    pub bias: Vec<RBig>,
    /// With respect to γ.
    pub compliance: Vec<RBig>,
    /// With respect to the entries of M in the upper triangle, k × k; an entry off the diagonal
    /// stands for both.
    pub mass: Vec<Vec<RBig>>,
    /// With respect to the entries of J, n × k.
    pub jacobian: Vec<Vec<RBig>>,
}

/// The masses and rows at a solution.
#[derive(Debug, Clone)]
pub(super) struct Motion {
    mass: Vec<Vec<RBig>>,
    jacobian: Vec<Vec<RBig>>,
    x: Vec<RBig>,
    /// M⁻¹Jᵀx.
    g: Vec<RBig>,
    /// u* + g.
    u: Vec<RBig>,
}

impl Motion {
    /// The reason, if A and b are not those of the masses and rows.
    pub fn new(gauss: &Gauss, lcp: &Lcp, x: &[RBig]) -> std::result::Result<Self, String> {
        let k = gauss.target.len();
        let mut mass = vec![vec![RBig::ZERO; k]; k];
        for &(i, j, value) in &gauss.mass {
            mass[i][j] = exact(value);
            mass[j][i] = exact(value);
        }
        let mut jacobian = vec![vec![RBig::ZERO; k]; lcp.len()];
        for (own, row) in jacobian.iter_mut().zip(&gauss.jacobian) {
            row.iter().for_each(|&(j, value)| own[j] = exact(value));
        }
        let (x, g, u) = (x.to_vec(), Vec::new(), Vec::new());
        let mut motion = Motion { mass, jacobian, x, g, u };
        if let Some((i, j)) = motion.different_entry(gauss, lcp) {
            return Err(format!(
                "A[{i}][{j}] or b[{i}] is not that of A = J M⁻¹Jᵀ + diag(γ), b = J u* + bias, \
                 not even up to 1e-6: the key motion is ignored"
            ));
        }
        let of_x = motion.transposed(&motion.x);
        motion.g = motion.inverse(&of_x).ok_or("the mass matrix is singular")?;
        motion.u = motion.g.iter().zip(&gauss.target).map(|(g, u)| g + exact(*u)).collect();
        Ok(motion)
    }

    /// An entry of A, or of b in its row, that the masses and rows do not give.
    fn different_entry(&self, gauss: &Gauss, lcp: &Lcp) -> Option<(usize, usize)> {
        let (n, k) = (lcp.len(), self.len());
        let mass = Mat::from_fn(k, k, |i, j| number(&self.mass[i][j]));
        let rows = Mat::from_fn(n, k, |i, j| number(&self.jacobian[i][j]));
        let a = &rows * mass.partial_piv_lu().solve(rows.transpose());
        let entry = |i: usize, j: usize| a[(i, j)] + if i == j { gauss.compliance[i] } else { 0.0 };
        let differs = |i: usize, j: usize| {
            let size = (entry(i, i) * entry(j, j)).sqrt();
            !((lcp.matrix().entry(i, j) - entry(i, j)).abs() <= ROUNDING * size)
        };
        let b_differs = |i: usize| {
            let terms = || gauss.jacobian[i].iter().map(|&(j, value)| value * gauss.target[j]);
            let b = terms().sum::<f64>() + gauss.bias[i];
            let size = terms().map(f64::abs).sum::<f64>() + gauss.bias[i].abs();
            !((lcp.b()[i] - b).abs() <= ROUNDING * size)
        };
        let places = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        places.into_iter().find(|&(i, j)| differs(i, j) || b_differs(i))
    }

    /// The number of entries of u.
    pub fn len(&self) -> usize {
        self.mass.len()
    }

    /// The motion.
    pub fn u(&self) -> &[RBig] {
        &self.u
    }

    fn inverse(&self, force: &[RBig]) -> Option<Vec<RBig>> {
        Some(solve(&self.mass, &[force.to_vec()])?.remove(0))
    }

    /// M⁻¹ f; M is known to be regular.
    fn accelerated(&self, force: &[RBig]) -> Vec<RBig> {
        self.inverse(force).unwrap_or_else(|| vec![RBig::ZERO; self.len()])
    }

    fn transposed(&self, y: &[RBig]) -> Vec<RBig> {
        (0..self.len()).map(|j| dot(self.jacobian.iter().map(|row| &row[j]), y)).collect()
    }

    /// M⁻¹Jᵀy.
    pub fn response(&self, y: &[RBig]) -> Vec<RBig> {
        self.accelerated(&self.transposed(y))
    }

    /// J M⁻¹ c.
    pub fn of_rows(&self, c: &[RBig]) -> Vec<RBig> {
        let moved = self.accelerated(c);
        self.jacobian.iter().map(|row| dot(row, &moved)).collect()
    }

    /// q and f.
    pub fn change(&self, direction: &Direction) -> Result<(Vec<RBig>, Vec<RBig>)> {
        let (n, k) = (self.x.len(), self.len());
        let list = |name: &str, given: &[f64], len: usize| match given {
            [] => Ok(vec![RBig::ZERO; len]),
            given => numbers(name, given, len),
        };
        let bias = list("bias", &direction.bias, n)?;
        let compliance = list("compliance", &direction.compliance, n)?;
        let target = list("target", &direction.target, k)?;
        let mut force = vec![RBig::ZERO; k];
        let mut q: Vec<RBig> = (0..n).map(|i| &bias[i] + &compliance[i] * &self.x[i]).collect();
        for &place @ (i, j, _) in &direction.jacobian {
            let change = entry("jacobian", place, (n, k))?;
            force[j] += &change * &self.x[i];
            q[i] += change * &self.u[j];
        }
        for &place @ (i, j, _) in &direction.mass {
            let change = entry("mass", place, (k, k))?;
            force[i] -= &change * &self.g[j];
            if i != j {
                force[j] -= change * &self.g[i];
            }
        }
        let moved = self.accelerated(&force);
        let moved: Vec<RBig> = moved.iter().zip(&target).map(|(own, u)| own + u).collect();
        for (q, row) in q.iter_mut().zip(&self.jacobian) {
            *q += dot(row, &moved);
        }
        Ok((q, moved))
    }

    /// The gradient of L, whose gradients with respect to b and to u (for fixed x) are these.
    pub fn pullback(&self, b: &[RBig], c: &[RBig], is_of_motion: bool) -> MotionPullback {
        let through = self.transposed(b);
        let target: Vec<RBig> = c.iter().zip(&through).map(|(c, own)| c + own).collect();
        let p = self.accelerated(&target);
        let k = self.len();
        let mass = |i: usize, j: usize| match i.cmp(&j) {
            std::cmp::Ordering::Less => -(&p[i] * &self.g[j] + &p[j] * &self.g[i]),
            std::cmp::Ordering::Equal => -(&p[i] * &self.g[i]),
            std::cmp::Ordering::Greater => RBig::ZERO,
        };
        let mass = (0..k).map(|i| (0..k).map(|j| mass(i, j)).collect()).collect();
        if is_of_motion {
            let (bias, compliance, jacobian) = (Vec::new(), Vec::new(), Vec::new());
            return MotionPullback { target, bias, compliance, mass, jacobian };
        }
        let row = |i: usize| {
            (0..k).map(|j| &b[i] * &self.u[j] + &self.x[i] * &p[j]).collect::<Vec<RBig>>()
        };
        let compliance = b.iter().zip(&self.x).map(|(b, x)| b * x).collect();
        let jacobian = (0..b.len()).map(row).collect();
        MotionPullback { target, bias: b.to_vec(), compliance, mass, jacobian }
    }
}
