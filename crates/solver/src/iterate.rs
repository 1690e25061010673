//! The loop that all iterative methods share; each method provides only its step.

use std::ops::ControlFlow;

use super::{Event, Iterate, Observer, Settings, Solution, Status};
use crate::tolerances::{RAY_CURVATURE, RAY_ENTRY, RAY_SLOPE};
use lcplab_lcp::{Complementarity, Lcp, dot};

/// Repeats `step` from x until the scaled residual is within the tolerance, the limit is reached,
/// the observer asks to stop, or an iterate is not finite.
///
/// A step moves x and returns what it did, or leaves x unchanged and returns why it cannot
/// continue. Iterations are counted from `first`, which is above 0 when an earlier loop continues
/// with other bounds.
///
/// If there is no solution, x diverges along a ray and the residual becomes small *relative to x*.
/// Therefore the loop tests the last step and the total displacement from the start before it
/// reports a status. An x that is no nearer to a solution than Π(0) is not accepted: at the
/// iteration limit its status is `Diverged`.
pub(super) fn iterate(
    problem: &impl Complementarity,
    x: Vec<f64>,
    first: usize,
    settings: &Settings,
    observer: &mut dyn Observer,
    mut step: impl FnMut(&mut [f64]) -> ControlFlow<Status, Event>,
) -> Solution {
    iterate_in_parts(problem, x, first, settings, observer, |x, _| step(x))
}

/// The same for a step that reports its details to the observer.
pub(super) fn iterate_in_parts(
    problem: &impl Complementarity,
    mut x: Vec<f64>,
    first: usize,
    settings: &Settings,
    observer: &mut dyn Observer,
    mut step: impl FnMut(&mut [f64], &mut dyn Observer) -> ControlFlow<Status, Event>,
) -> Solution {
    let Settings { tolerance, max_iterations, check_every, .. } = *settings;
    let lcp = problem.lcp();
    let mut last_outside = 0;
    let mut is_within = |x: &[f64]| problem.is_within(x, tolerance, &mut last_outside);
    let is_better = |x: &[f64]| problem.improves_on_zero(x, tolerance);
    let is_finite = |x: &[f64]| x.iter().all(|x| x.is_finite());
    let start = x.clone();
    let (mut before, mut last_finite, mut event) = (x.clone(), x.clone(), Event::Start);
    for iteration in first..=max_iterations {
        if iteration > first {
            before.copy_from_slice(&x);
            match step(&mut x, observer) {
                ControlFlow::Continue(done) => event = done,
                ControlFlow::Break(status) => {
                    let is_solved = is_within(&x) && is_better(&x);
                    let status = if is_solved { Status::Solved } else { status };
                    let x = if is_finite(&x) { x } else { last_finite };
                    return Solution::new(lcp, x, status, iteration - 1);
                }
            }
        }
        if iteration > first || first == 0 {
            let iterate = Iterate { iteration, x: &x, event };
            if observer.observe(&iterate).is_break() {
                let x = if is_finite(&x) { x } else { last_finite };
                return Solution::new(lcp, x, Status::Stopped, iteration);
            }
        }
        if iteration % check_every == 0 || iteration == first || iteration == max_iterations {
            if !is_finite(&x) {
                return Solution::new(lcp, last_finite, Status::Diverged, iteration);
            }
            if is_within(&x) {
                let status = if is_better(&x) { Status::Solved } else { Status::Diverged };
                let end = finish(problem, [&before, &start], x.clone(), status, iteration);
                if end.status != Status::Diverged {
                    return end;
                }
            }
            last_finite.copy_from_slice(&x);
        }
    }
    let has_run_off = is_within(&x);
    let status = if has_run_off { Status::Diverged } else { Status::IterationLimit };
    finish(problem, [&before, &start], x, status, max_iterations)
}

/// The solution x, unless the displacement from one of the earlier points shows that none exists.
pub(super) fn finish(
    problem: &impl Complementarity,
    before: [&[f64]; 2],
    x: Vec<f64>,
    status: Status,
    iterations: usize,
) -> Solution {
    let lcp = problem.lcp();
    for before in before {
        let direction = long_part(lcp, &x, before);
        if problem.recedes(&direction) && is_unbounded_descent(lcp, &direction) {
            let ray = Status::Ray { row: largest(&direction), direction };
            return Solution::new(lcp, before.to_vec(), ray, iterations);
        }
    }
    Solution::new(lcp, x, status, iterations)
}

/// x − before without the entries that are small relative to the others, each measured by √a_ii:
/// the part of a long displacement that follows a ray.
fn long_part(lcp: &Lcp, x: &[f64], before: &[f64]) -> Vec<f64> {
    let length = |i: usize, d: f64| d.abs() * lcp.matrix().diagonal(i).abs().sqrt();
    let mut direction: Vec<f64> = x.iter().zip(before).map(|(x, before)| x - before).collect();
    let longest = direction.iter().enumerate().map(|(i, &d)| length(i, d)).fold(0.0, f64::max);
    for (i, d) in direction.iter_mut().enumerate() {
        if length(i, *d) < RAY_ENTRY * longest {
            *d = 0.0;
        }
    }
    direction
}

/// Whether the objective decreases along d at a constant rate: A d = 0, bᵀd < 0. A slope that is
/// small compared with the effect of forces of the problem's scale is no ray: redundant rows then
/// contradict each other only by drift or rounding.
fn is_unbounded_descent(lcp: &Lcp, d: &[f64]) -> bool {
    let term = |i: usize| (lcp.b()[i].abs() + lcp.matrix().diagonal(i) * lcp.scale()) * d[i].abs();
    let slope_terms: f64 = (0..d.len()).map(term).sum();
    if !(dot(lcp.b(), d) < -RAY_SLOPE * slope_terms) {
        return false;
    }
    let (mut curvature, mut terms) = (0.0, 0.0);
    for i in 0..d.len() {
        for (j, a) in lcp.matrix().row(i).iter() {
            curvature += d[i] * a * d[j];
            terms += (d[i] * a * d[j]).abs();
        }
    }
    f64::abs(curvature) <= RAY_CURVATURE * terms && lcp.matrix().is_symmetric()
}

/// The row with the largest |d_i|.
pub(super) fn largest(d: &[f64]) -> usize {
    (0..d.len()).max_by(|&i, &j| d[i].abs().total_cmp(&d[j].abs())).unwrap_or(0)
}
