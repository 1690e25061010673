//! How far the motion of an answer is from the exact one, by Gauss's principle in fractions.
//!
//! ```text
//! 2 (P(v) + D(x)) = fᵀM⁻¹f + 2 Σ g_i,    f = M (v − u*) − Jᵀx,    w = J v + bias + γ x
//! g_i = |w_i| times the room that x_i has to lo_i where w_i > 0, to hi_i where w_i < 0;   at most w_i² / 2γ_i
//! ```
//!
//! `docs/proofs.md` shows that no motion û of least P is farther from u(x) than the root of it.

use std::collections::BTreeMap;

use dashu_int::IBig;
use dashu_ratio::RBig;

use lcplab_judge::motion_bound::{Unproved, motion_bound};
use lcplab_problem::exact::dyadic::{dyadic, integers, rational};
use lcplab_problem::exact::modular::{rank_profile, solve};
use lcplab_problem::exact::rounded_up;
use lcplab_problem::file::Problem;
use lcplab_problem::{Gauss, Lcp};

use crate::claim::{Bounded, Motion};

/// With more rows the equations are not solved.
const MOST_EQUATIONS: usize = 500;
/// What is left of an equation that follows from others, beside its length.
const DEPENDENT: f64 = 1e-9;

fn exact(value: f64) -> RBig {
    rational(&dyadic(value))
}

/// 2 (P(v) + D(x)), with the bounds of coupled rows at this x.
///
/// # Errors
/// If x is beyond a bound, M is not positive definite, or P(v) is infinite.
pub fn gap(lcp: &Lcp, data: &Gauss, x: &[RBig], v: &[RBig]) -> Result<RBig, String> {
    let mut force = vec![RBig::ZERO; v.len()];
    for &(i, j, mass) in &data.mass {
        force[i] += exact(mass) * (&v[j] - exact(data.target[j]));
        if i != j {
            force[j] += exact(mass) * (&v[i] - exact(data.target[i]));
        }
    }
    let mut rows = RBig::ZERO;
    for (i, row) in data.jacobian.iter().enumerate() {
        row.iter().for_each(|&(j, value)| force[j] -= exact(value) * &x[i]);
        rows += row_gap(lcp, data, x, v, i)?;
    }
    Ok(square(data, force)? + RBig::from(2) * rows)
}

/// (J v + bias)_i.
fn speed(data: &Gauss, v: &[RBig], i: usize) -> RBig {
    data.jacobian[i].iter().fold(exact(data.bias[i]), |sum, &(j, value)| sum + exact(value) * &v[j])
}

/// g_i.
fn row_gap(lcp: &Lcp, data: &Gauss, x: &[RBig], v: &[RBig], i: usize) -> Result<RBig, String> {
    let (lo, hi) = bounds(lcp, x, i);
    if lo.as_ref().is_some_and(|lo| x[i] < *lo) || hi.as_ref().is_some_and(|hi| x[i] > *hi) {
        return Err(format!("the answer is beyond a bound in row {i}"));
    }
    let compliance = exact(data.compliance[i]);
    let w = speed(data, v, i) + &compliance * &x[i];
    let room = match w > RBig::ZERO {
        true => lo.map(|lo| &x[i] - lo),
        false => hi.map(|hi| hi - &x[i]),
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

/// The bounds of row i at x.
fn bounds(lcp: &Lcp, x: &[RBig], i: usize) -> (Option<RBig>, Option<RBig>) {
    let own = |bound: f64| bound.is_finite().then(|| exact(bound));
    match lcp.coupled_to(i) {
        Some((k, mu)) => {
            let reach = exact(mu) * x[k].clone().max(RBig::ZERO);
            (Some(-reach.clone()), Some(reach))
        }
        None => (own(lcp.lo()[i]), own(lcp.hi()[i])),
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

/// A bound on the motion of an answer, moved into its bounds, and what shows it.
///
/// # Errors
/// Why there is none.
pub fn search(problem: &Problem, answer: &[f64]) -> Result<Bounded, String> {
    let data = problem.motion.as_ref().ok_or("the problem has no key motion")?;
    if !answer.iter().all(|x| x.is_finite()) {
        return Err("the answer is not finite".into());
    }
    let lcp = &problem.lcp;
    let x = within_bounds(lcp, answer);
    let exact_x: Vec<RBig> = x.iter().map(|&x| exact(x)).collect();
    let (lo, hi) = (0..lcp.len()).map(|i| lcp.bounds(i, &x)).unzip();
    let frozen = Gauss { lo, hi, ..data.clone() };
    let start = match motion_bound(&frozen, &x) {
        Err(Unproved::DependentEquations) => motion_bound(&relaxed(&frozen, &x), &x),
        other => other,
    };
    let motion = obeying_equations(&frozen, &start.map_err(|reason| reason.to_string())?.motion)?;
    let v = motion.entries();
    let gap = gap(lcp, data, &exact_x, &v)?;
    let mut bound = rounded_up(&gap).sqrt();
    if !bound.is_finite() {
        return Err("the bound is not finite".into());
    }
    while exact(bound) * exact(bound) < gap {
        bound = bound.next_up();
    }
    Ok(Bounded { answer: x, motion, bound })
}

/// The nearest numbers within the exact bounds.
fn within_bounds(lcp: &Lcp, answer: &[f64]) -> Vec<f64> {
    let mut x = answer.to_vec();
    lcp.project_all(&mut x);
    for i in 0..x.len() {
        let Some((k, mu)) = lcp.coupled_to(i) else { continue };
        // μ x_k is rounded in `project_all`, here it is not.
        let reach = exact(mu) * exact(x[k].max(0.0));
        while exact(x[i].abs()) > reach {
            x[i] = x[i].signum() * x[i].abs().next_down();
        }
    }
    x
}

/// The rows that a motion has to obey exactly.
fn equations(data: &Gauss) -> Vec<usize> {
    let is_equation = |i: &usize| {
        data.compliance[*i] == 0.0 && data.lo[*i].is_infinite() && data.hi[*i].is_infinite()
    };
    (0..data.bias.len()).filter(is_equation).collect()
}

/// Equations that follow from others, but for rounding, get bounds: so a motion is found near which the exact
/// one may be.
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

/// The motion in floating point, moved in some columns to where it obeys all equations exactly.
fn obeying_equations(data: &Gauss, motion: &[f64]) -> Result<Motion, String> {
    let rows = equations(data);
    if rows.len() > MOST_EQUATIONS {
        return Err(format!("{} equations are too many", rows.len()));
    }
    let mut v: Vec<RBig> = motion.iter().map(|&v| exact(v)).collect();
    // J e = −w, each row of J and its w as integers.
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
                "no motion obeys all equations: in their last digits they contradict each other"
                    .into(),
            );
        }
    }
    Ok(Motion::of(&v))
}
