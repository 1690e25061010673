//! Newton's method on the engine's problem: an accurate motion, and the number of steps to it.
//!
//! The motion of a step whose rows are all compliant minimizes a smooth convex function (Gauss's
//! principle). A wrong Hessian only converges more slowly. If an engine stopped at its iteration
//! cap, the number of steps with the exact Hessian shows whether the problem was hard. The accurate
//! motion also tightens a loose bound.

use faer::linalg::solvers::Solve;
use faer::{Col, Mat};

use super::limits::rounding;
use super::step::{EngineStep, difference};

/// The largest number of steps, and of rows or degrees of freedom.
pub(crate) const MOST: usize = 100;
const MOST_ROWS: usize = 2_000;
/// The number of bisection steps for a multiplier: full floating-point accuracy.
const HALVINGS: usize = 64;
/// The method stops at this gradient, relative to that of the motion without constraints.
const SMALL: f64 = 1e-12;

/// An accurate motion, and the number of Newton steps to it, if they suffice.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Accurate {
    pub(crate) motion: Vec<f64>,
    pub(crate) steps: Option<usize>,
}

/// The exact motion by Newton's method from the free motion; `None` if a row is rigid, or there are
/// too many.
pub(crate) fn accurate_motion(step: &EngineStep) -> Option<Accurate> {
    let size = step.gauss.target.len();
    let is_rigid = step.gauss.compliance.iter().any(|&compliance| compliance <= 0.0);
    if is_rigid || size.max(step.len()) > MOST_ROWS {
        return None;
    }
    let mass = step.dense_mass();
    let mut motion = step.gauss.target.clone();
    let mut first = 0.0;
    for steps in 0..MOST {
        let laws = laws_at(step, &motion);
        let gradient = gradient(step, &motion, &laws);
        let length = norm(&gradient);
        if steps == 0 {
            first = length;
        }
        if length <= SMALL * first {
            return Some(Accurate { motion, steps: Some(steps) });
        }
        let hessian = hessian(step, &mass, &laws);
        let right = Col::from_fn(size, |j| -gradient[j]);
        let change = hessian.partial_piv_lu().solve(&right);
        let change: Vec<f64> = (0..size).map(|j| change[j]).collect();
        let factor = step_length(step, &motion, &change);
        motion.iter_mut().zip(&change).for_each(|(v, change)| *v += factor * change);
    }
    Some(Accurate { motion, steps: None })
}

/// M (v − u*) − Jᵀx(v).
fn gradient(step: &EngineStep, motion: &[f64], laws: &[Law]) -> Vec<f64> {
    let mut forces = vec![0.0; step.len()];
    for law in laws {
        law.rows.iter().zip(&law.forces).for_each(|(&row, force)| forces[row] = *force);
    }
    let inertia = step.times_mass(&difference(motion, &step.gauss.target));
    difference(&inertia, &step.push(&forces))
}

/// M + Jᵀ S J, S being minus the derivative of the forces.
fn hessian(step: &EngineStep, mass: &Mat<f64>, laws: &[Law]) -> Mat<f64> {
    let mut hessian = mass.clone();
    let jacobian = &step.gauss.jacobian;
    for law in laws {
        let count = law.rows.len();
        for (p, &first) in law.rows.iter().enumerate() {
            for (q, &second) in law.rows.iter().enumerate() {
                let slope = law.slope[p * count + q];
                if slope == 0.0 {
                    continue;
                }
                for &(i, one) in &jacobian[first] {
                    for &(j, other) in &jacobian[second] {
                        hessian[(i, j)] += slope * one * other;
                    }
                }
            }
        }
    }
    hessian
}

/// The factor at which the slope along a change, which grows with it, is zero: by bisection.
fn step_length(step: &EngineStep, motion: &[f64], change: &[f64]) -> f64 {
    let slope = |factor: f64| {
        let at: Vec<f64> = motion.iter().zip(change).map(|(v, c)| v + factor * c).collect();
        dot(change, &gradient(step, &at, &laws_at(step, &at)))
    };
    if slope(1.0).abs() <= 1e-3 * slope(0.0).abs() {
        return 1.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    while slope(high) < 0.0 && high < 1e6 {
        (low, high) = (high, 2.0 * high);
    }
    for _ in 0..50 {
        let middle = (low + high) / 2.0;
        if slope(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    (low + high) / 2.0
}

/// The forces of one row or cone, and minus their derivative by the velocity of the rows, by rows.
struct Law {
    rows: Vec<usize>,
    forces: Vec<f64>,
    slope: Vec<f64>,
}

/// The forces that compliant rows have at a motion.
fn laws_at(step: &EngineStep, motion: &[f64]) -> Vec<Law> {
    let gauss = &step.gauss;
    let speed = step.along(motion);
    let wanted: Vec<f64> =
        (0..step.len()).map(|i| -(speed[i] + gauss.bias[i]) / gauss.compliance[i]).collect();
    let cones = cones(step);
    let mut is_of_cone = vec![false; step.len()];
    cones.iter().flat_map(|cone| &cone.rows).for_each(|&row| is_of_cone[row] = true);
    let single = |i: usize| {
        let force = wanted[i].max(gauss.lo[i]).min(gauss.hi[i]);
        let slope = if force == wanted[i] { 1.0 / gauss.compliance[i] } else { 0.0 };
        Law { rows: vec![i], forces: vec![force], slope: vec![slope] }
    };
    let mut laws: Vec<Law> = (0..step.len()).filter(|&i| !is_of_cone[i]).map(single).collect();
    for Cone { rows, roots, slopes } in cones {
        let point: Vec<f64> = rows.iter().zip(&roots).map(|(&i, root)| root * wanted[i]).collect();
        let (nearest, derivative) = onto_cone(point, &slopes);
        let forces = nearest.iter().zip(&roots).map(|(y, root)| y / root).collect();
        let count = rows.len();
        let slope = (0..count * count)
            .map(|at| derivative[at] / (roots[at / count] * roots[at % count]))
            .collect();
        laws.push(Law { rows, forces, slope });
    }
    laws
}

/// Whether the forces are, up to rounding, those that the motion requires: the nearest to −(J v +
/// bias) / compliance.
pub(crate) fn are_forces_of_motion(step: &EngineStep) -> bool {
    let gauss = &step.gauss;
    if gauss.compliance.iter().any(|&compliance| compliance <= 0.0) {
        return false;
    }
    let motion = &step.answer.motion;
    let sizes = step.size_along(motion);
    laws_at(step, motion).iter().all(|law| {
        let terms =
            law.rows.iter().map(|&i| (sizes[i] + gauss.bias[i].abs()) / gauss.compliance[i].sqrt());
        let terms = terms.fold(0.0, f64::max);
        law.rows.iter().zip(&law.forces).all(|(&i, force)| {
            let error = gauss.compliance[i].sqrt() * (step.answer.forces[i] - force).abs();
            error <= rounding(step.source.bits) * terms
        })
    })
}

/// The rows of a cone, the normal one first, the roots of their compliance, and the slope of the
/// cone along each axis in the norm of the compliance.
struct Cone {
    rows: Vec<usize>,
    roots: Vec<f64>,
    slopes: Vec<f64>,
}

fn cones(step: &EngineStep) -> Vec<Cone> {
    let mut friction: Vec<Vec<usize>> = vec![Vec::new(); step.len()];
    for (row, normal) in step.friction.index.iter().enumerate() {
        if let Some(normal) = normal {
            friction[*normal].push(row);
        }
    }
    let with_friction = friction.into_iter().enumerate().filter(|(_, own)| !own.is_empty());
    let cone = |(normal, own): (usize, Vec<usize>)| {
        let root = |row: usize| step.gauss.compliance[row].sqrt();
        let slope = |&row: &usize| root(row) * step.friction.mu[row] / root(normal);
        let slopes = own.iter().map(slope).collect();
        let rows: Vec<usize> = [normal].into_iter().chain(own).collect();
        Cone { roots: rows.iter().map(|&row| root(row)).collect(), rows, slopes }
    };
    with_friction.map(cone).collect()
}

/// The nearest point y of the cone √(Σ (y_i/m_i)²) ≤ y_n to a point z with z_n first, and its
/// derivative by rows.
///
/// On the surface y_i = z_i m_i² / (m_i² + t) and y_n = N(t) = √(Σ (z_i m_i / (m_i² + t))²), where
/// t > 0 is the zero of (1 − t) N(t) − z_n, which is decreasing.
fn onto_cone(mut point: Vec<f64>, slopes: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let count = point.len();
    // An axis without friction has no force.
    let has_friction = |i: usize| i == 0 || slopes[i - 1] > 0.0;
    (1..count).filter(|&i| !has_friction(i)).for_each(|i| point[i] = 0.0);
    let axes: Vec<(f64, f64)> = point[1..].iter().copied().zip(slopes.iter().copied()).collect();
    let sum = |term: &dyn Fn(f64, f64) -> f64| axes.iter().map(|&(z, m)| term(z, m)).sum::<f64>();
    let length =
        |t: f64| sum(&|z, m| if z == 0.0 { 0.0 } else { (z * m / (m * m + t)).powi(2) }).sqrt();
    if length(0.0) <= point[0] {
        let derivative =
            |at: usize| f64::from(u8::from(at / count == at % count && has_friction(at % count)));
        return (point, (0..count * count).map(derivative).collect());
    }
    if sum(&|z, m| (z * m).powi(2)).sqrt() <= -point[0] {
        return (vec![0.0; count], vec![0.0; count * count]);
    }
    let by_t = |t: f64, normal: f64| -sum(&|z, m| (z * m).powi(2) / (m * m + t).powi(3)) / normal;
    let t = match circular(slopes) {
        Some(m) => {
            let side = sum(&|z, _| z * z).sqrt();
            let t = m * (side - m * point[0]) / (point[0] + m * side);
            // One step of Newton's method, because the slopes are equal up to rounding only.
            let normal = length(t);
            let slope = (1.0 - t) * by_t(t, normal) - normal;
            t - ((1.0 - t) * normal - point[0]) / slope
        }
        None => multiplier(|t| (1.0 - t) * length(t) > point[0]),
    };
    let normal = length(t);
    // dN/dz_i, dN/dt and dt/dz_i, with z_n first.
    let by_z: Vec<f64> =
        axes.iter().map(|&(z, m)| z * (m / (m * m + t)).powi(2) / normal).collect();
    let by_t = by_t(t, normal);
    let bottom = (1.0 - t) * by_t - normal;
    let of_t: Vec<f64> =
        [1.0 / bottom].into_iter().chain(by_z.iter().map(|by| (t - 1.0) * by / bottom)).collect();
    let mut nearest = vec![normal];
    let mut derivative: Vec<f64> =
        (0..count).map(|j| by_t * of_t[j] + if j == 0 { 0.0 } else { by_z[j - 1] }).collect();
    for (i, &(z, m)) in axes.iter().enumerate() {
        let part = if m > 0.0 { m * m / (m * m + t) } else { 0.0 };
        nearest.push(z * part);
        let own = |j: usize| if j == i + 1 { part } else { 0.0 };
        derivative.extend((0..count).map(|j| own(j) - z * part / (m * m + t) * of_t[j]));
    }
    (nearest, derivative)
}

/// The slope of a cone that is circular up to rounding.
fn circular(slopes: &[f64]) -> Option<f64> {
    let mean = slopes.iter().sum::<f64>() / slopes.len() as f64;
    slopes.iter().all(|slope| (slope - mean).abs() <= 1e-9 * mean).then_some(mean)
}

/// The t > 0 up to which a condition holds, by bisection of t / (1 + t).
fn multiplier(is_below: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if is_below(middle / (1.0 - middle)) { low = middle } else { high = middle }
    }
    high / (1.0 - high)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(v: &[f64]) -> f64 {
    dot(v, v).sqrt()
}
