//! Gradients of a weighted sum of x and u with respect to all data: one linear solve.

use dashu_ratio::RBig;

use super::active::Rows;
use super::linear::{dot, solve};
use super::motion::{Motion, MotionPullback};
use super::{Gradient, Status, failure, numbers};
use lcplab_lcp::error::Result;

/// The gradient of Σ v_i x_i + Σ c_j u_j with respect to the data. If x is not unique, only
/// `motion` has a gradient, and the other lists are empty.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Pullback {
    /// With respect to b.
    pub b: Vec<RBig>,
    /// With respect to μ.
    pub mu: Vec<RBig>,
    /// With respect to lo; of fixed rows, whose bounds move together, with respect to the one that
    /// w pushes against.
    pub lo: Vec<RBig>,
    /// With respect to hi.
    pub hi: Vec<RBig>,
    /// The solution: the gradient with respect to A is b xᵀ.
    pub x: Vec<RBig>,
    /// With respect to the key `motion`, if the problem has it.
    pub motion: Option<MotionPullback>,
}

impl Pullback {
    /// With respect to entry (i, j) of A.
    ///
    /// ```
    /// use lcplab_analysis::gradient::Gradient;
    /// use lcplab_lcp::file::Problem;
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// // x = 1/a at b = −1: dx/da = −1/a².
    /// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
    /// let gradient = Gradient::of(&Problem::new("contact", lcp), &[0.5])?;
    /// assert_eq!(gradient.pullback(&[1.0], None)?.a(0, 0).to_string(), "-1/4");
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Panics
    /// If x is not unique.
    pub fn a(&self, i: usize, j: usize) -> RBig {
        &self.b[i] * &self.x[j]
    }
}

impl Gradient {
    /// The gradient of vᵀx + cᵀu with respect to all data, by one solve with the transposed matrix.
    ///
    /// # Errors
    /// At a kink, and if x is not unique, except for the motion alone (v = 0) where it has a
    /// derivative.
    pub fn pullback(&self, v: &[f64], c: Option<&[f64]>) -> Result<Pullback> {
        let n = self.rows.len();
        let v = numbers("v", v, n)?;
        let is_of_motion = self.is_of_motion() && v.iter().all(|v| *v == RBig::ZERO);
        if self.status != Status::Differentiable && !is_of_motion {
            return Err(failure(self.refusal()));
        }
        let motion = match (&self.motion, c) {
            (Err(why), Some(_)) => return Err(failure(why.clone())),
            (motion, _) => motion.as_ref().ok(),
        };
        let k = motion.map_or(0, Motion::len);
        let c = c.map_or_else(|| Ok(vec![RBig::ZERO; k]), |c| numbers("c", c, k))?;
        let through = motion.map_or_else(|| vec![RBig::ZERO; n], |motion| motion.of_rows(&c));
        let seed: Vec<RBig> = v.iter().zip(through).map(|(v, more)| v + more).collect();
        let whole = match &self.basis {
            Some((rows, basis)) => adjoint(rows, &seed, basis),
            None => adjoint(&self.rows, &seed, &self.rows.free()),
        };
        let whole = whole.ok_or_else(|| failure(self.refusal()))?;
        let motion = motion.map(|motion| motion.pullback(&whole.b, &c, is_of_motion));
        let whole = if is_of_motion { Pullback::default() } else { whole };
        Ok(Pullback { motion, ..whole })
    }
}

/// The multipliers −b of these free rows, and what follows from them.
fn adjoint(rows: &Rows, v: &[RBig], free: &[usize]) -> Option<Pullback> {
    let k = rows.matrix(free, free);
    let transposed: Vec<Vec<RBig>> =
        (0..free.len()).map(|c| k.iter().map(|row| row[c].clone()).collect()).collect();
    let multipliers = solve(&transposed, &[rows.reduced(v, free)])?.remove(0);
    let mut b = vec![RBig::ZERO; v.len()];
    free.iter().zip(multipliers).for_each(|(&i, own)| b[i] = -own);
    let rest = |(j, v): (usize, &RBig)| v + dot(&b, rows.a.iter().map(|row| &row[j]));
    let rest: Vec<RBig> = v.iter().enumerate().map(rest).collect();
    let [mu, lo, hi] = rows.bound_gradients(&rest);
    Some(Pullback { b, mu, lo, hi, x: rows.x.clone(), motion: None })
}
