//! Time-dependent vectors: the forces on bodies, and the motion of supports.

use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::range;
use lcplab_lcp::error::Defects;

/// A vector (N or m, world axes) as a function of time.
///
/// ```
/// use lcplab_mechanics::scene::TimeFunction;
///
/// let ramp = TimeFunction::Table(vec![[0.0; 4], [2.0, 6.0, 0.0, 0.0]]); // rows of t, x, y, z
/// assert_eq!(ramp.at(1.0).x, 3.0);
/// assert_eq!(ramp.mean(0.0, 2.0).x, 3.0);
/// assert_eq!(ramp.at(5.0).x, 6.0); // before the first row and after the last it stays
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum TimeFunction {
    /// Rows of a time (s), ascending, and the vector's x, y and z at that time; linear in between.
    Table(Vec<[f64; 4]>),
    /// amplitude · sin(angular_frequency · t + phase).
    Sine(Sine),
}

/// A sine along a direction.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sine {
    /// The vector at its largest (N or m).
    pub amplitude: [f64; 3],
    /// The angular frequency (rad/s).
    pub angular_frequency: f64,
    /// The phase at time 0 (rad).
    #[serde(default)]
    pub phase: f64,
}

impl TimeFunction {
    /// The vector at a time (s).
    pub fn at(&self, time: f64) -> Vector3<f64> {
        match self {
            TimeFunction::Table(rows) => between(rows, time),
            TimeFunction::Sine(sine) => sine.wave(time),
        }
    }

    /// The mean over the time from `from` to `from + h` (s), h > 0.
    pub fn mean(&self, from: f64, h: f64) -> Vector3<f64> {
        match self {
            TimeFunction::Table(rows) => mean(rows, from, h),
            TimeFunction::Sine(sine) => {
                let half = 0.5 * sine.angular_frequency * h;
                sine.wave(from + 0.5 * h) * (libm::sin(half) / half)
            }
        }
    }

    /// Checks that it is valid.
    pub(super) fn check(&self, defects: &mut Defects, place: &str) {
        match self {
            TimeFunction::Table(rows) => {
                let numbers = rows.iter().flatten();
                if rows.is_empty() {
                    defects.add(format!("{place}.table"), "has no rows");
                } else if let Some(bad) = numbers.clone().find(|x| !x.is_finite()) {
                    defects.add(format!("{place}.table"), format!("must be finite, has {bad}"));
                } else if let Some(pair) = rows.windows(2).find(|pair| pair[0][0] >= pair[1][0]) {
                    let [before, after] = [pair[0][0], pair[1][0]];
                    let reason = format!("times must ascend, {after} s comes after {before} s");
                    defects.add(format!("{place}.table"), reason);
                }
            }
            TimeFunction::Sine(Sine { amplitude, angular_frequency, phase }) => {
                let place = format!("{place}.sine");
                range::vector(defects, &format!("{place}.amplitude"), amplitude);
                let what = ["angular frequency", "rad/s"];
                range::divisor(
                    defects,
                    format!("{place}.angular_frequency"),
                    what,
                    *angular_frequency,
                );
                if !phase.is_finite() {
                    defects.add(format!("{place}.phase"), format!("must be finite, is {phase}"));
                }
            }
        }
    }
}

impl Sine {
    fn wave(&self, time: f64) -> Vector3<f64> {
        Vector3::from(self.amplitude) * libm::sin(self.angular_frequency * time + self.phase)
    }
}

fn value(&[_, x, y, z]: &[f64; 4]) -> Vector3<f64> {
    Vector3::new(x, y, z)
}

/// The value of a table at a time.
fn between(rows: &[[f64; 4]], time: f64) -> Vector3<f64> {
    let next = rows.partition_point(|row| row[0] <= time);
    match (next.checked_sub(1).map(|k| &rows[k]), rows.get(next)) {
        (Some(a), Some(b)) => {
            let part = (time - a[0]) / (b[0] - a[0]);
            value(a) + (value(b) - value(a)) * part
        }
        (Some(only), None) | (None, Some(only)) => value(only),
        (None, None) => Vector3::zeros(),
    }
}

/// The mean of a table by the trapezoidal rule, exact for linear segments.
fn mean(rows: &[[f64; 4]], from: f64, h: f64) -> Vector3<f64> {
    let to = from + h;
    let corners = rows.iter().map(|row| row[0]).filter(|&time| from < time && time < to);
    let (mut sum, mut last) = (Vector3::zeros(), from);
    for time in corners.chain([to]) {
        sum += (between(rows, last) + between(rows, time)) * (0.5 * (time - last));
        last = time;
    }
    sum / (to - from)
}
