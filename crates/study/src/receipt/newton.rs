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
    for Cone { rows, roots, slope } in cones {
        let point: Vec<f64> = rows.iter().zip(&roots).map(|(&i, root)| root * wanted[i]).collect();
        let (nearest, derivative) = onto_cone(&point, slope);
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
/// cone in the norm of the compliance.
struct Cone {
    rows: Vec<usize>,
    roots: Vec<f64>,
    slope: f64,
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
        let slopes = own.iter().map(|&row| root(row) * step.friction.mu[row] / root(normal));
        let slope = slopes.sum::<f64>() / own.len() as f64;
        let rows: Vec<usize> = [normal].into_iter().chain(own).collect();
        Cone { roots: rows.iter().map(|&row| root(row)).collect(), rows, slope }
    };
    with_friction.map(cone).collect()
}

/// The nearest point of the circular cone |y_t| ≤ slope · y_n, and its derivative by rows.
fn onto_cone(point: &[f64], slope: f64) -> (Vec<f64>, Vec<f64>) {
    let count = point.len();
    let length = norm(&point[1..]);
    let identity = |at: usize| f64::from(u8::from(at / count == at % count));
    if length <= slope * point[0] {
        return (point.to_vec(), (0..count * count).map(identity).collect());
    }
    if slope * length <= -point[0] {
        return (vec![0.0; count], vec![0.0; count * count]);
    }
    let width = (1.0 + slope * slope).sqrt();
    let axis: Vec<f64> = (0..count)
        .map(|i| if i == 0 { 1.0 / width } else { slope * point[i] / length / width })
        .collect();
    let reach = dot(&axis, point);
    let derivative = |at: usize| {
        let (i, j) = (at / count, at % count);
        let across = match i.min(j) {
            0 => 0.0,
            _ => identity(at) - point[i] * point[j] / (length * length),
        };
        axis[i] * axis[j] + reach * slope / (width * length) * across
    };
    (axis.iter().map(|a| reach * a).collect(), (0..count * count).map(derivative).collect())
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(v: &[f64]) -> f64 {
    dot(v, v).sqrt()
}
