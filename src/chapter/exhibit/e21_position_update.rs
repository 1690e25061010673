//! E21: the position update omits the old position, K&M (16).

use super::setting::G;
use super::{Finding, Measure};
use crate::error::Result;
use crate::plot::{Axis, Lines, Series};

/// Height (m) and velocity (m/s) at the start, and the step (s).
const X: f64 = 100.0;
const V: f64 = 2.0;
const DT: f64 = 0.01;

/// Time between two points of the figure (s).
const SHOWN: f64 = 0.2;

/// The flight of the body over two seconds, with this update of its position from the last one and
/// the new velocity.
fn flight(update: impl Fn(f64, f64) -> f64) -> Vec<(f64, f64)> {
    let (mut x, mut v) = (X, V);
    let mut points = vec![(0.0, x)];
    for k in 1..=200 {
        v -= G * DT;
        x = update(x, v);
        if k % 20 == 0 {
            points.push((f64::from(k) * DT, x));
        }
    }
    points
}

/// One step of a falling body.
pub(super) fn example() -> Result<Finding> {
    let (x, v, a, dt) = (X, V, -G, DT);
    let v_next = v + a * dt;
    let printed = v_next + a * dt;
    let corrected = x + v_next * dt;
    let truth = x + v * dt + 0.5 * a * dt * dt;
    let height = Measure::new("height after the step", "m", printed, corrected);
    let fall = |k: usize| x + v * k as f64 * SHOWN + 0.5 * a * (k as f64 * SHOWN).powi(2);
    let lines = Lines::new(
        "e21",
        "A stone thrown upward from 100 m",
        "The printed formula uses a velocity as the height: after one step the stone is at 1.8 m, because the \
                  formula drops the old position. The corrected formula follows free fall.",
        Axis::linear("time", "s"),
        Axis::linear("height", "m"),
        vec![
            Series::measured("printed", flight(|_, v| v + a * dt)),
            Series::measured("corrected", flight(|x, v| x + v * dt)),
            Series::theory("free fall", (0..=10).map(|k| (k as f64 * SHOWN, fall(k))).collect()),
        ],
    );
    Ok(Finding::new(
        "A body at 100 m rises at 2 m/s; g = 9.81 m/s², one step of 0.01 s. The corrected step differs from free \
         fall by ½ g dt² = 0.49 mm: this is the error of the method, and it shrinks with dt.",
    )
    .measure(height.truth(&[truth], "closed form", 5e-4))
    .plot(&lines))
}
