//! Bounds the distance of an answer's motion from the exact one, by Gauss's principle in rational
//! arithmetic.
//!
//! ```text
//! |u(x) − û|_M ≤ √S + √G,   S = |M⁻¹Jᵀ(x − p)|²_M,   G = 2 (P(v) + D(p)) = fᵀM⁻¹f + 2 Σ g_i
//! p = Πx,   f = M (v − u*) − Jᵀp,   w = J v + bias + γ p
//! g_i = |w_i| times the room that p_i has to lo_i where w_i > 0, to hi_i where w_i < 0;
//!       at most w_i² / 2γ_i
//! ```
//!
//! √G bounds the error of the motion of p, the answer projected onto its bounds, and √S is the
//! difference between the motions of the answer and of p. `docs/proofs.md` derives both.

use std::collections::BTreeMap;

use dashu_int::IBig;
use dashu_ratio::RBig;

use lcplab_judge::motion_bound::{Unproved, motion_bound};
use lcplab_lcp::exact::dyadic::{dyadic, integers, rational};
use lcplab_lcp::exact::modular::{rank_profile, solve};
use lcplab_lcp::exact::rounded_up;
use lcplab_lcp::{Gauss, Lcp};

use crate::claim::{Bounded, Motion};

/// With more rows the equations are not solved exactly.
const MOST_EQUATIONS: usize = 500;
/// An equation whose remainder, relative to its length, is below this depends on others.
const DEPENDENT: f64 = 1e-9;
/// The reason if the problem has no data for a claim about the motion.
pub(crate) const NO_BODIES: &str = "the problem has no key motion";

pub(crate) fn exact(value: f64) -> RBig {
    rational(&dyadic(value))
}

/// The squares of the two parts of the bound.
pub struct Squares {
    /// S: the difference between the motions of the answer and of p.
    beyond: RBig,
    /// G: the bound on the error of the motion of p.
    within: RBig,
}

impl Squares {
    /// The squares for an answer x and a motion v, with the bounds that coupled rows have at this
    /// x.
    ///
    /// # Errors
    /// If M is not positive definite, or P(v) is infinite.
    pub fn of(lcp: &Lcp, data: &Gauss, x: &[RBig], v: &[RBig]) -> Result<Squares, String> {
        let p: Vec<RBig> = (0..x.len()).map(|i| moved_into(bounds(lcp, x, i), &x[i])).collect();
        let gap = |i| row_gap(bounds(lcp, x, i), data, &p[i], v, i);
        let gaps: Result<Vec<RBig>, String> = (0..x.len()).map(gap).collect();
        Self::with_gaps(data, x, &p, v, gaps?)
    }

    /// The squares for an answer x, forces p inside their bounds or cones, a motion v, and the g of
    /// rows or contacts.
    ///
    /// # Errors
    /// If M is not positive definite.
    pub(crate) fn with_gaps(
        data: &Gauss,
        x: &[RBig],
        p: &[RBig],
        v: &[RBig],
        gaps: Vec<RBig>,
    ) -> Result<Squares, String> {
        let mut beyond = vec![RBig::ZERO; v.len()];
        let mut within = vec![RBig::ZERO; v.len()];
        for &(i, j, mass) in &data.mass {
            within[i] += exact(mass) * (&v[j] - exact(data.target[j]));
            if i != j {
                within[j] += exact(mass) * (&v[i] - exact(data.target[i]));
            }
        }
        for (i, row) in data.jacobian.iter().enumerate() {
            for &(j, value) in row {
                beyond[j] += exact(value) * (&x[i] - &p[i]);
                within[j] -= exact(value) * &p[i];
            }
        }
        let gaps = gaps.into_iter().fold(RBig::ZERO, |sum, gap| sum + gap);
        let within = square(data, within)? + RBig::from(2) * gaps;
        Ok(Squares { beyond: square(data, beyond)?, within })
    }

    /// Whether √S + √G ≤ bound, without square roots: 4 S G ≤ (bound² − S − G)², and bound² − S − G
    /// ≥ 0.
    pub fn prove(&self, bound: f64) -> bool {
        let rest = exact(bound) * exact(bound) - &self.beyond - &self.within;
        let product = RBig::from(4) * &self.beyond * &self.within;
        bound >= 0.0 && rest >= RBig::ZERO && product <= &rest * &rest
    }

    /// A bound that these squares prove, within a few units in the last place of the smallest one;
    /// not finite if there is none.
    pub(crate) fn bound(&self) -> f64 {
        let mut bound = rounded_up(&self.beyond).sqrt() + rounded_up(&self.within).sqrt();
        while bound.is_finite() && !self.prove(bound) {
            bound = bound.next_up();
        }
        bound
    }
}

/// (J v + bias)_i.
pub(crate) fn speed(data: &Gauss, v: &[RBig], i: usize) -> RBig {
    data.jacobian[i].iter().fold(exact(data.bias[i]), |sum, &(j, value)| sum + exact(value) * &v[j])
}

/// A row's bounds; `None` if infinite.
pub(crate) type Bounds = (Option<RBig>, Option<RBig>);

/// The bounds of row i at x.
pub(crate) fn bounds(lcp: &Lcp, x: &[RBig], i: usize) -> Bounds {
    let own = |bound: f64| bound.is_finite().then(|| exact(bound));
    match lcp.coupled_to(i) {
        Some((k, mu)) => {
            let reach = exact(mu) * x[k].clone().max(RBig::ZERO);
            (Some(-reach.clone()), Some(reach))
        }
        None => (own(lcp.lo()[i]), own(lcp.hi()[i])),
    }
}

/// The nearest number between these bounds.
fn moved_into((lo, hi): Bounds, x: &RBig) -> RBig {
    let above = lo.map_or(x.clone(), |lo| lo.max(x.clone()));
    hi.map_or(above.clone(), |hi| hi.min(above))
}

/// g_i for a p_i within these bounds.
pub(crate) fn row_gap(
    (lo, hi): Bounds,
    data: &Gauss,
    p: &RBig,
    v: &[RBig],
    i: usize,
) -> Result<RBig, String> {
    let compliance = exact(data.compliance[i]);
    let w = speed(data, v, i) + &compliance * p;
    let room = match w > RBig::ZERO {
        true => lo.map(|lo| p - lo),
        false => hi.map(|hi| hi - p),
    };
    let size = if w < RBig::ZERO { -w.clone() } else { w.clone() };
    let hard = room.map(|room| room * &size);
    let soft = (compliance > RBig::ZERO).then(|| &size * &size / (RBig::from(2) * compliance));
    match (hard, soft) {
        _ if w == RBig::ZERO => Ok(RBig::ZERO),
        (Some(hard), Some(soft)) => Ok(hard.min(soft)),
        (Some(gap), None) | (None, Some(gap)) => Ok(gap),
        (None, None) => Err(format!("the motion breaks row {i}")),
    }
}

/// fᵀM⁻¹f, by elimination: M = L D Lᵀ and Σ (L⁻¹f)_c² / D_c.
fn square(data: &Gauss, mut f: Vec<RBig>) -> Result<RBig, String> {
    let mut rows = vec![BTreeMap::new(); f.len()];
    for &(i, j, mass) in data.mass.iter().filter(|entry| entry.2 != 0.0) {
        rows[i].insert(j, exact(mass));
    }
    let mut sum = RBig::ZERO;
    for c in 0..f.len() {
        let own = std::mem::take(&mut rows[c]);
        let pivot = own.get(&c).filter(|pivot| **pivot > RBig::ZERO);
        let pivot = pivot.ok_or("the mass matrix is not positive definite")?;
        let top = f[c].clone();
        sum += &top * &top / pivot;
        for (&r, value) in own.range(c + 1..) {
            let factor = value / pivot;
            f[r] -= &factor * &top;
            for (&s, value) in own.range(r..) {
                *rows[r].entry(s).or_insert(RBig::ZERO) -= &factor * value;
            }
        }
    }
    Ok(sum)
}

/// A bound on the motion of an answer, and its proof.
///
/// # Errors
/// Why there is none.
pub fn search(lcp: &Lcp, data: Option<&Gauss>, answer: &[f64]) -> Result<Bounded, String> {
    let data = data.ok_or(NO_BODIES)?;
    if !answer.iter().all(|x| x.is_finite()) {
        return Err("the answer is not finite".into());
    }
    let (lo, hi) = (0..lcp.len()).map(|i| lcp.bounds(i, answer)).unzip();
    let frozen = Gauss { lo, hi, ..data.clone() };
    let start = match motion_bound(&frozen, answer) {
        Err(Unproved::DependentEquations) => motion_bound(&relaxed(&frozen, answer), answer),
        other => other,
    };
    let motion = obeying_equations(&frozen, &start.map_err(|reason| reason.to_string())?.motion)?;
    let x: Vec<RBig> = answer.iter().map(|&x| exact(x)).collect();
    let bound = Squares::of(lcp, data, &x, &motion.entries())?.bound();
    match bound.is_finite() {
        true => Ok(Bounded { answer: answer.to_vec(), force: None, motion, bound }),
        false => Err("the bound is not finite".into()),
    }
}

/// The rows that a motion must satisfy exactly.
fn equations(data: &Gauss) -> Vec<usize> {
    let is_equation = |i: &usize| {
        data.compliance[*i] == 0.0 && data.lo[*i].is_infinite() && data.hi[*i].is_infinite()
    };
    (0..data.bias.len()).filter(is_equation).collect()
}

/// The data with equations that depend on others up to rounding turned into bounds, so that a
/// motion can be found close to a possible exact motion.
fn relaxed(data: &Gauss, x: &[f64]) -> Gauss {
    let mut relaxed = data.clone();
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let length = |row: &[f64]| row.iter().map(|v| v * v).sum::<f64>().sqrt();
    for i in equations(data) {
        let mut row = vec![0.0; data.target.len()];
        data.jacobian[i].iter().for_each(|&(j, value)| row[j] = value);
        let whole = length(&row);
        for own in &basis {
            let part: f64 = own.iter().zip(&row).map(|(p, q)| p * q).sum();
            row.iter_mut().zip(own).for_each(|(value, own)| *value -= part * own);
        }
        let rest = length(&row);
        if rest > DEPENDENT * whole {
            row.iter_mut().for_each(|value| *value /= rest);
            basis.push(row);
        } else {
            (relaxed.lo[i], relaxed.hi[i]) = (x[i] - 1.0, x[i] + 1.0);
        }
    }
    relaxed
}

/// The floating-point motion, with some columns changed so that it satisfies all equations exactly.
pub(crate) fn obeying_equations(data: &Gauss, motion: &[f64]) -> Result<Motion, String> {
    let rows = equations(data);
    if rows.len() > MOST_EQUATIONS {
        return Err(format!("{} equations are too many", rows.len()));
    }
    let mut v: Vec<RBig> = motion.iter().map(|&v| exact(v)).collect();
    // J e = −w; each row of J and its w are scaled to integers.
    let equation = |&i: &usize| {
        let mut row = vec![dyadic(0.0); motion.len()];
        data.jacobian[i].iter().for_each(|&(j, value)| row[j] = dyadic(value));
        let terms = data.jacobian[i].iter().map(|&(j, value)| dyadic(value) * dyadic(motion[j]));
        row.push(-terms.fold(dyadic(data.bias[i]), |sum, term| sum + term));
        integers(&row)
    };
    let mut system: Vec<Vec<IBig>> = rows.iter().map(equation).collect();
    let misses: Vec<IBig> = system.iter_mut().filter_map(Vec::pop).collect();
    if misses.iter().any(|miss| *miss != IBig::ZERO) {
        let basis = rank_profile(&system);
        let regular: Vec<Vec<IBig>> = basis
            .rows
            .iter()
            .map(|&r| basis.columns.iter().map(|&c| system[r][c].clone()).collect())
            .collect();
        let right: Vec<IBig> = basis.rows.iter().map(|&r| misses[r].clone()).collect();
        let (change, denominator) =
            solve(&regular, &right).ok_or("the equations could not be solved")?;
        let denominator = RBig::from(denominator);
        for (&c, change) in basis.columns.iter().zip(change) {
            v[c] += RBig::from(change) / &denominator;
        }
        if rows.iter().any(|&i| speed(data, &v, i) != RBig::ZERO) {
            return Err(
                "no motion satisfies all equations: their last digits contradict each other".into(),
            );
        }
    }
    Ok(Motion::of(&v))
}
