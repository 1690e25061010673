//! Derivatives in a direction, one-sided ones at kinks.

use dashu_ratio::RBig;
use serde::Deserialize;

use super::active::{Change, Rows};
use super::linear::solve;
use super::{Gradient, Status, entry, failure, numbers};
use lcplab_lcp::error::{Error, Result};

/// A change of the data; empty lists change nothing. Changes of A are entries (row, column, value);
/// for a symmetric A name both. The last five are of the key `motion`; A and b then change by
/// A = J M⁻¹Jᵀ + diag(γ), b = J u* + bias. An off-diagonal entry of `mass` stands for both.
///
/// ```
/// use lcplab_analysis::gradient::Direction;
///
/// let direction = Direction::read(r#"{"b": [1, 0], "A": [[0, 1, 0.5]]}"#, "direction.json")?;
/// assert_eq!((direction.b, direction.a), (vec![1.0, 0.0], vec![(0, 1, 0.5)]));
/// assert!(Direction::read(r#"{"c": 1}"#, "direction.json").is_err());
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Direction {
    /// Changes of b, n numbers.
    pub b: Vec<f64>,
    /// Changes of entries of A.
    #[serde(rename = "A")]
    pub a: Vec<(usize, usize, f64)>,
    /// Changes of the coefficients of friction.
    pub mu: Vec<f64>,
    /// Changes of lo.
    pub lo: Vec<f64>,
    /// Changes of hi.
    pub hi: Vec<f64>,
    /// Changes of u*, k numbers.
    pub target: Vec<f64>,
    /// Changes of the bias.
    pub bias: Vec<f64>,
    /// Changes of γ.
    pub compliance: Vec<f64>,
    /// Changes of entries of M, in the upper triangle.
    pub mass: Vec<(usize, usize, f64)>,
    /// Changes of entries of J.
    pub jacobian: Vec<(usize, usize, f64)>,
}

impl Direction {
    /// The direction that a JSON object states under the names of the fields, with `A` for a.
    ///
    /// # Errors
    /// If the text is not such an object.
    pub fn read(text: &str, input: &str) -> Result<Self> {
        serde_json::from_str(text).map_err(|cause| lcplab_lcp::json::fault(text, input, &cause))
    }

    fn is_of_motion(&self) -> bool {
        let lists = [&self.target, &self.bias, &self.compliance];
        lists.iter().any(|list| !list.is_empty())
            || !(self.mass.is_empty() && self.jacobian.is_empty())
    }

    /// Whether only u* and the masses change.
    fn keeps_rows(&self) -> bool {
        let lists = [&self.b, &self.mu, &self.lo, &self.hi, &self.bias, &self.compliance];
        lists.iter().all(|list| list.is_empty()) && self.a.is_empty() && self.jacobian.is_empty()
    }
}

/// The derivative of a solution in one direction.
#[derive(Debug, Clone, PartialEq)]
pub struct Derivative {
    /// dx; `None` if x is not unique.
    pub x: Option<Vec<RBig>>,
    /// du, if the problem states masses and rows.
    pub u: Option<Vec<RBig>>,
}

impl Gradient {
    /// The derivatives in a direction: for a small positive step, and (x(p) − x(p − h dp)) / h for
    /// a small step back. Both are the same where x is differentiable.
    ///
    /// # Errors
    /// If x has no derivative in this direction, or the direction does not belong to the problem.
    pub fn directional(&self, direction: &Direction) -> Result<[Derivative; 2]> {
        let (change, moved) = self.change(direction)?;
        let right = self.along(&change, &moved, &failure)?;
        if self.kink.is_none() {
            return Ok([right.clone(), right]);
        }
        let back: Vec<RBig> = moved.iter().map(|u| -u).collect();
        let left = self.along(&change.reversed(), &back, &failure)?;
        let minus = |v: Option<Vec<RBig>>| v.map(|v| v.iter().map(|y| -y).collect());
        Ok([right, Derivative { x: minus(left.x), u: minus(left.u) }])
    }

    /// The derivative along a change, where `moved` is what u changes if x does not.
    fn along(
        &self,
        change: &Change,
        moved: &[RBig],
        error: &dyn Fn(String) -> Error,
    ) -> Result<Derivative> {
        let y = match (&self.status, &self.kink) {
            (Status::Differentiable, _) => smooth(&self.rows, change, &self.rows.free()),
            (Status::Kink(_), Some(kink)) => kink.derivative(&self.rows, change),
            (Status::NotUnique, _) => {
                self.basis.as_ref().and_then(|(rows, basis)| smooth(rows, change, basis))
            }
            _ => None,
        };
        let y = y.ok_or_else(|| error(self.refusal()))?;
        let u = self.motion.as_ref().ok().map(|motion| {
            moved.iter().zip(motion.response(&y)).map(|(own, more)| own + more).collect()
        });
        Ok(Derivative { x: (self.status != Status::NotUnique).then_some(y), u })
    }

    /// The change of the equations in a direction, and what u changes if x does not.
    fn change(&self, direction: &Direction) -> Result<(Change, Vec<RBig>)> {
        let (n, rows) = (self.rows.len(), &self.rows);
        let mut change = Change::none(n);
        let lists = [
            ("b", &direction.b, &mut change.q),
            ("mu", &direction.mu, &mut change.mu),
            ("lo", &direction.lo, &mut change.lo),
            ("hi", &direction.hi, &mut change.hi),
        ];
        for (name, given, own) in lists {
            if !given.is_empty() {
                *own = numbers(name, given, n)?;
            }
        }
        for &place @ (i, j, _) in &direction.a {
            change.q[i] += entry("A", place, (n, n))? * &rows.x[j];
        }
        (0..n).try_for_each(|i| self.check_bounds(&change, i))?;
        let moved = match &self.motion {
            Err(why) if direction.is_of_motion() => return Err(failure(why.clone())),
            Err(_) => Vec::new(),
            Ok(motion) => {
                if self.basis.is_some() && !direction.keeps_rows() {
                    let reason = "x is not unique; the motion has derivatives with respect to target and mass only";
                    return Err(failure(reason.into()));
                }
                let (q, moved) = motion.change(direction)?;
                change.q.iter_mut().zip(q).for_each(|(own, q)| *own += q);
                moved
            }
        };
        Ok((change, moved))
    }

    /// Checks that a change keeps equal bounds equal, and friction limits that are 0.
    fn check_bounds(&self, change: &Change, i: usize) -> Result<()> {
        let rows = &self.rows;
        let invalid = |key: &str, reason: &str| {
            Err(Error::invalid("direction", format!("{key}[{i}]"), reason))
        };
        if rows.is_fixed[i] && change.lo[i] != change.hi[i] {
            return invalid("lo", "differs from that of hi, but the bounds are equal: change both");
        }
        let Some(k) = rows.normal[i] else { return Ok(()) };
        if rows.x[k] == RBig::ZERO && change.lo[k] != RBig::ZERO {
            return invalid("lo", "is that of an open contact with friction: not examined");
        }
        if rows.mu[i] == RBig::ZERO && change.mu[i] != RBig::ZERO && rows.x[k] != RBig::ZERO {
            return invalid(
                "mu",
                "leaves 0, where there is no derivative to the left: not examined",
            );
        }
        Ok(())
    }
}

/// dx where only these free rows keep w = 0.
fn smooth(rows: &Rows, change: &Change, free: &[usize]) -> Option<Vec<RBig>> {
    let t = rows.bound_changes(change);
    let right = free.iter().map(|&i| -(rows.product(i, &t) + &change.q[i])).collect();
    let own = solve(&rows.matrix(free, free), &[right])?.remove(0);
    let mut y = t;
    free.iter().zip(own).for_each(|(&i, own)| y[i] = own);
    Some(rows.completed(change, y))
}
