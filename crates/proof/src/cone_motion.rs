//! Bounds the distance of an answer's motion from the exact one under the associated law, by
//! Gauss's principle in rational arithmetic.
//!
//! The program is convex, so its motion is unique even if redundant contacts slide. As for boxes
//! ([`motion`](crate::motion)), with p in the cones, and for each contact
//!
//! ```text
//! g = p·w where w_n ≥ μ |w_t|; at most Σ w_i² / 2γ_i where all three γ are positive
//! ```

use dashu_ratio::RBig;

use lcplab_lcp::friction::{ConeProblem, Contact, Law};
use lcplab_lcp::{Gauss, Lcp};

use crate::check::point;
use crate::claim::{Bounded, Entry, Vector, over_one_denominator};
use crate::motion::{NO_BODIES, Squares, bounds, exact, obeying_equations, row_gap, speed};

/// The motion is moved into the cones by this part of its speeds, then by ten times as much, and
/// so on.
const FIRST_STEP: f64 = 1e-17;
const MOST_STEPS: i32 = 20;
const MOST_ROUNDS: usize = 2000;

/// Checks a bound.
///
/// # Errors
/// Why it is not proved.
pub fn check(
    problem: &ConeProblem,
    rows: &Lcp,
    data: Option<&Gauss>,
    bounded: &Bounded,
) -> Result<(), String> {
    let data = data.ok_or(NO_BODIES)?;
    if problem.law() != Law::Associated {
        return Err("the motion is unique under the law of the associated cone only".into());
    }
    let force = bounded.force.as_ref().ok_or("the forces are missing")?;
    if force.entries.iter().any(|entry| !matches!(entry, Entry::Numerator(_))) {
        return Err("the forces must be integers".into());
    }
    let p = point(rows, force)?.entries();
    if bounded.answer.len() != rows.len() || bounded.motion.numerators.len() != data.target.len() {
        return Err("the answer or the motion has another length".into());
    }
    let x: Vec<RBig> = bounded.answer.iter().map(|&x| exact(x)).collect();
    match squares(problem, data, &x, &p, &bounded.motion.entries())?.prove(bounded.bound) {
        true => Ok(()),
        false => Err("the motion shows a larger bound only".into()),
    }
}

fn squares(
    problem: &ConeProblem,
    data: &Gauss,
    x: &[RBig],
    p: &[RBig],
    v: &[RBig],
) -> Result<Squares, String> {
    let lcp = problem.friction().lcp();
    let mut gaps = Vec::new();
    for &i in problem.friction().others() {
        let (lo, hi) = bounds(lcp, x, i);
        if lo.as_ref().is_some_and(|lo| p[i] < *lo) || hi.as_ref().is_some_and(|hi| p[i] > *hi) {
            return Err(format!("the force of row {i} is beyond a bound"));
        }
        gaps.push(row_gap((lo, hi), data, &p[i], v, i)?);
    }
    for contact in problem.friction().contacts() {
        let n = contact.rows[0];
        if !is_inside(contact, contact.rows.map(|i| &p[i])) {
            return Err(format!("the force of row {n} is outside its cone"));
        }
        gaps.push(contact_gap(contact, data, p, v)?);
    }
    Squares::with_gaps(data, x, p, v, gaps)
}

fn is_inside(contact: &Contact, [n, t1, t2]: [&RBig; 3]) -> bool {
    let limit = exact(contact.mu) * n;
    *n >= RBig::ZERO && t1 * t1 + t2 * t2 <= &limit * &limit
}

fn contact_gap(contact: &Contact, data: &Gauss, p: &[RBig], v: &[RBig]) -> Result<RBig, String> {
    let w = contact.rows.map(|i| speed(data, v, i) + exact(data.compliance[i]) * &p[i]);
    let sum = |terms: [RBig; 3]| terms.into_iter().fold(RBig::ZERO, |sum, term| sum + term);
    let [w_n, w_1, w_2] = &w;
    let mu = exact(contact.mu);
    let is_dual = *w_n >= RBig::ZERO && w_n * w_n >= &mu * &mu * (w_1 * w_1 + w_2 * w_2);
    let hard = is_dual.then(|| sum([0, 1, 2].map(|k| &w[k] * &p[contact.rows[k]])));
    let is_soft = contact.rows.iter().all(|&i| data.compliance[i] > 0.0);
    let soft = is_soft.then(|| {
        sum([0, 1, 2]
            .map(|k| &w[k] * &w[k] / (RBig::from(2) * exact(data.compliance[contact.rows[k]]))))
    });
    let is_still = w.iter().all(|w| *w == RBig::ZERO);
    match (hard, soft) {
        _ if is_still => Ok(RBig::ZERO),
        (Some(hard), Some(soft)) => Ok(hard.min(soft)),
        (Some(gap), None) | (None, Some(gap)) => Ok(gap),
        (None, None) => Err(format!("the motion breaks the contact of row {}", contact.rows[0])),
    }
}

/// A bound on the motion of an answer, and its proof.
///
/// # Errors
/// Why there is none.
pub fn search(
    problem: &ConeProblem,
    data: Option<&Gauss>,
    answer: &[f64],
) -> Result<Bounded, String> {
    if problem.law() != Law::Associated {
        return Err("under Coulomb's law the motion need not be unique".into());
    }
    let data = data.ok_or(NO_BODIES)?;
    if !answer.iter().all(|x| x.is_finite()) {
        return Err("the answer is not finite".into());
    }
    let p = inside(problem, answer);
    let forces: Vec<RBig> = p.iter().map(|&p| exact(p)).collect();
    let x: Vec<RBig> = answer.iter().map(|&x| exact(x)).collect();
    // Only rows without contacts and bounds are equations of the motion.
    let mut equations = data.clone();
    for contact in problem.friction().contacts() {
        contact.rows.iter().for_each(|&i| (equations.lo[i], equations.hi[i]) = (0.0, 0.0));
    }
    let own = motion_of(data, &p);
    let away = separating(problem, data);
    let speed = own.iter().chain(&data.target).fold(0.0, |most, u| f64::max(most, u.abs()));
    for step in 0..MOST_STEPS {
        let by = if step == 0 { 0.0 } else { FIRST_STEP * 10.0_f64.powi(step) * speed };
        let moved: Vec<f64> = own.iter().zip(&away).map(|(u, d)| u + by * d).collect();
        let motion = obeying_equations(&equations, &moved)?;
        let Ok(squares) = squares(problem, data, &x, &forces, &motion.entries()) else { continue };
        let bound = squares.bound();
        if !bound.is_finite() {
            return Err("the bound is not finite".into());
        }
        let (numerators, denominator) = over_one_denominator(&forces);
        let entries = numerators.into_iter().map(Entry::Numerator).collect();
        let force = Some(Vector { denominator, entries });
        return Ok(Bounded { answer: answer.to_vec(), force, motion, bound });
    }
    Err("no motion inside the cones was found".into())
}

/// The answer, moved into its cones and bounds.
fn inside(problem: &ConeProblem, answer: &[f64]) -> Vec<f64> {
    let lcp = problem.friction().lcp();
    let mut p = answer.to_vec();
    for &i in problem.friction().others() {
        p[i] = p[i].max(lcp.lo()[i]).min(lcp.hi()[i]);
    }
    for contact in problem.friction().contacts() {
        let [n, t1, t2] = contact.rows;
        p[n] = p[n].max(0.0);
        let length = f64::hypot(p[t1], p[t2]);
        let mut part = if length > 0.0 { (contact.mu * p[n] / length).min(1.0) } else { 1.0 };
        let (friction, mut shrink) = ([p[t1], p[t2]], f64::EPSILON);
        loop {
            [p[t1], p[t2]] = friction.map(|friction| friction * part);
            if is_inside(contact, [&exact(p[n]), &exact(p[t1]), &exact(p[t2])]) {
                break;
            }
            part = (part * (1.0 - shrink)).max(0.0);
            // A few times suffice, except for friction so small that it is rounded to itself.
            shrink *= 2.0;
        }
    }
    p
}

/// u* + M⁻¹Jᵀp, by conjugate gradients.
fn motion_of(data: &Gauss, p: &[f64]) -> Vec<f64> {
    let mut push = vec![0.0; data.target.len()];
    for (row, p) in data.jacobian.iter().zip(p) {
        row.iter().for_each(|&(j, value)| push[j] += value * p);
    }
    let product = |u: &[f64]| {
        let mut out = vec![0.0; u.len()];
        for &(i, j, mass) in &data.mass {
            out[i] += mass * u[j];
            if i != j {
                out[j] += mass * u[i];
            }
        }
        out
    };
    let mut change = conjugate_gradients(product, &push);
    // Once more for what rounding left.
    let rest: Vec<f64> = push.iter().zip(product(&change)).map(|(p, q)| p - q).collect();
    let more = conjugate_gradients(product, &rest);
    change.iter_mut().zip(more).for_each(|(u, more)| *u += more);
    data.target.iter().zip(change).map(|(u, change)| u + change).collect()
}

/// A motion that separates all contacts with a normal speed of about 1, by least squares.
fn separating(problem: &ConeProblem, data: &Gauss) -> Vec<f64> {
    let mut wanted = vec![0.0; data.jacobian.len()];
    problem.friction().contacts().iter().for_each(|contact| wanted[contact.rows[0]] = 1.0);
    let speeds = |u: &[f64]| -> Vec<f64> {
        let speed = |row: &Vec<(usize, f64)>| row.iter().map(|&(j, value)| value * u[j]).sum();
        data.jacobian.iter().map(speed).collect()
    };
    let pulled = |w: &[f64]| {
        let mut out = vec![0.0; data.target.len()];
        for (row, w) in data.jacobian.iter().zip(w) {
            row.iter().for_each(|&(j, value)| out[j] += value * w);
        }
        out
    };
    conjugate_gradients(|u| pulled(&speeds(u)), &pulled(&wanted))
}

/// a⁻¹ b for a symmetric, positive semidefinite a with b in its range.
fn conjugate_gradients(a: impl Fn(&[f64]) -> Vec<f64>, b: &[f64]) -> Vec<f64> {
    let dot = |p: &[f64], q: &[f64]| p.iter().zip(q).map(|(p, q)| p * q).sum::<f64>();
    let (mut x, mut rest, mut direction) = (vec![0.0; b.len()], b.to_vec(), b.to_vec());
    let mut size = dot(&rest, &rest);
    let last = size * 1e-28;
    for _ in 0..MOST_ROUNDS {
        let image = a(&direction);
        let curvature = dot(&direction, &image);
        if size <= last || !(curvature > 0.0) {
            break;
        }
        let step = size / curvature;
        x.iter_mut().zip(&direction).for_each(|(x, d)| *x += step * d);
        rest.iter_mut().zip(&image).for_each(|(r, image)| *r -= step * image);
        let next = dot(&rest, &rest);
        let turn = next / size;
        direction.iter_mut().zip(&rest).for_each(|(d, r)| *d = r + turn * *d);
        size = next;
    }
    x
}
