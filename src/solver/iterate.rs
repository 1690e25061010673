//! The loop that all iterative methods share. A method is only its step.

use std::ops::ControlFlow;

use super::{Event, Iterate, Observer, Settings, Solution, Status};
use crate::lcp::{Lcp, merit};

/// Repeats `step` from x until the scaled residual is within the tolerance, the limit is reached,
/// the observer asks to stop, or an iterate is not finite.
///
/// A step moves x and says what it did, or leaves x alone and says why it cannot go on. Iterations
/// are counted from `first`, which is above 0 when an earlier loop was continued with other bounds.
pub(super) fn iterate(
    lcp: &Lcp,
    mut x: Vec<f64>,
    first: usize,
    settings: &Settings,
    observer: &mut dyn Observer,
    mut step: impl FnMut(&mut [f64]) -> ControlFlow<Status, Event>,
) -> Solution {
    let Settings { tolerance, max_iterations, check_every } = *settings;
    let is_solved = |x: &[f64]| merit::scaled_residual(lcp, x) <= tolerance;
    let mut event = Event::Start;
    let mut last_finite = x.clone();
    for iteration in first..=max_iterations {
        if iteration > first {
            match step(&mut x) {
                ControlFlow::Continue(done) => event = done,
                ControlFlow::Break(_) if is_solved(&x) => {
                    return Solution::new(lcp, x, Status::Solved, iteration - 1);
                }
                ControlFlow::Break(status) => {
                    return Solution::new(lcp, last_finite, status, iteration - 1);
                }
            }
        }
        if iteration > first || first == 0 {
            let iterate = Iterate { iteration, x: &x, event };
            if observer.observe(&iterate).is_break() {
                return Solution::new(lcp, x, Status::Stopped, iteration);
            }
        }
        if iteration % check_every == 0 || iteration == first || iteration == max_iterations {
            if x.iter().any(|x| !x.is_finite()) {
                return Solution::new(lcp, last_finite, Status::Diverged, iteration);
            }
            if is_solved(&x) {
                return Solution::new(lcp, x, Status::Solved, iteration);
            }
            last_finite.copy_from_slice(&x);
        }
    }
    Solution::new(lcp, x, Status::IterationLimit, max_iterations)
}
