//! Axes: the label, the position of a value, and the ticks.

use crate::number::{readable, superscript};

/// An axis.
///
/// ```
/// use lcplab_page::plot::{Axis, Scale, round_step};
///
/// let time = Axis::linear("time", "s");
/// assert_eq!((time.scale, Axis::log("residual", "").scale), (Scale::Linear, Scale::Log));
/// let at: Vec<f64> = time.scale.ticks((0.0, 10.0), 5).iter().map(|tick| tick.at).collect();
/// assert_eq!(at, [0.0, 2.0, 4.0, 6.0, 8.0, 10.0]);
/// assert!(Axis::to_scale("height", "m").is_to_scale);
/// assert_eq!((round_step(3.0), round_step(0.02)), (5.0, 0.02)); // 1, 2 or 5 times a power of ten
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Axis {
    /// The quantity, for example `natural residual`.
    pub label: String,
    /// Its unit, for example `m/s`; empty for a pure number.
    pub unit: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Whether a unit has the same length on this axis as on a linear x axis.
    pub is_to_scale: bool,
}

/// The scale of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Equal differences have equal distances.
    Linear,
    /// Equal ratios have equal distances; only positive values can be shown.
    Log,
    /// Linear up to about this power of ten, logarithmic beyond it, for values of both signs.
    Symmetric(i32),
}

/// The largest value is this many times the median on an axis that is not linear.
const FLATTENED: f64 = 20.0;
/// Values below this part of the largest are rounding errors.
const ROUNDING: f64 = 1e-9;
/// The maximum number of decades that an axis of values of both signs shows.
const DECADES: i32 = 5;

/// A labeled position on an axis.
pub struct Tick {
    /// The position.
    pub at: f64,
    /// The label.
    pub label: String,
}

impl Axis {
    /// A linear axis.
    pub fn linear(label: impl Into<String>, unit: impl Into<String>) -> Self {
        Axis { label: label.into(), unit: unit.into(), scale: Scale::Linear, is_to_scale: false }
    }

    /// A logarithmic axis.
    pub fn log(label: impl Into<String>, unit: impl Into<String>) -> Self {
        Axis { scale: Scale::Log, ..Axis::linear(label, unit) }
    }

    /// A linear axis, or a symmetric one if the largest of these magnitudes, one of each curve,
    /// would hide the others.
    ///
    /// ```
    /// use lcplab_page::plot::{Axis, Scale};
    ///
    /// let axis = |sizes: &[f64]| Axis::fitting("drift", "mm", sizes.iter().copied()).scale;
    /// assert_eq!(axis(&[1.0, 2.0, 3.0]), Scale::Linear);
    /// assert_eq!(axis(&[1.0, 2.0, 3000.0]), Scale::Symmetric(0));
    /// ```
    pub fn fitting(
        label: impl Into<String>,
        unit: impl Into<String>,
        sizes: impl Iterator<Item = f64>,
    ) -> Self {
        let mut sizes: Vec<f64> = sizes.filter(|size| size.is_finite() && *size > 0.0).collect();
        sizes.sort_by(f64::total_cmp);
        let most = sizes.last().copied().unwrap_or(0.0);
        sizes.retain(|size| *size > ROUNDING * most);
        let middle = sizes.get(sizes.len().saturating_sub(1) / 2).copied().unwrap_or(most);
        let linear = Axis::linear(label, unit);
        if most < FLATTENED * middle || most == 0.0 {
            return linear;
        }
        let power = |size: f64| size.log10().floor() as i32;
        Axis { scale: Scale::Symmetric(power(middle).max(power(most) - DECADES)), ..linear }
    }

    /// A linear y axis on which a unit has the same length as on the x axis, as on a map.
    pub fn to_scale(label: impl Into<String>, unit: impl Into<String>) -> Self {
        Axis { is_to_scale: true, ..Axis::linear(label, unit) }
    }

    /// The ticks between two positions, about `wanted` of them; parts of a right angle for degrees.
    pub(super) fn ticks(&self, range: (f64, f64), wanted: usize) -> Vec<Tick> {
        let is_angle = self.unit.starts_with('°') || self.unit.starts_with("degrees");
        let steps = [15.0, 30.0, 45.0, 90.0, 180.0].into_iter().filter(|_| is_angle);
        let all = |step: f64| {
            let (first, last) = ((range.0 / step).ceil() as i32, (range.1 / step).floor() as i32);
            let at = (first..=last).map(|k| step * f64::from(k));
            at.map(|at| Tick { at, label: readable(at, 3) }).collect::<Vec<_>>()
        };
        let few = steps.map(all).find(|ticks| (3..=wanted.max(4)).contains(&ticks.len()));
        few.unwrap_or_else(|| self.scale.ticks(range, wanted))
    }

    /// The label with its unit: `time (s)`.
    pub(crate) fn heading(&self) -> String {
        if self.unit.is_empty() {
            return self.label.clone();
        }
        format!("{} ({})", self.label, self.unit)
    }
}

impl Scale {
    /// The position of a value: the value itself, or its decimal logarithm. `None` if it cannot be
    /// shown.
    pub(super) fn position(self, value: f64) -> Option<f64> {
        let position = match self {
            Scale::Linear => value,
            Scale::Log => value.log10(),
            Scale::Symmetric(power) => {
                value.signum() * (1.0 + value.abs() / 10f64.powi(power)).log10()
            }
        };
        // Above 1e300 the length of the axis itself would overflow.
        (position.is_finite() && position.abs() < 1e300).then_some(position)
    }

    /// The range of the axis for these positions, slightly wider; `None` if there are none.
    pub(super) fn range(self, positions: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
        let (lo, hi) = positions
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), p| (lo.min(p), hi.max(p)));
        if lo > hi {
            return None;
        }
        let length = hi - lo;
        let margin = match self {
            _ if length > 1e-12 * hi.abs().max(lo.abs()) => 0.04 * length,
            Scale::Linear if hi != 0.0 => 0.1 * hi.abs(),
            Scale::Linear => 1.0,
            Scale::Log | Scale::Symmetric(_) => 0.5,
        };
        Some((lo - margin, hi + margin))
    }

    /// The ticks between two positions, about `wanted` of them.
    pub fn ticks(self, (lo, hi): (f64, f64), wanted: usize) -> Vec<Tick> {
        match self {
            Scale::Log if hi - lo > 2.2 => decades(lo, hi, wanted),
            Scale::Log => parts_of_decades(lo, hi),
            Scale::Linear => round_numbers(lo, hi, wanted),
            Scale::Symmetric(power) => self.both_signs((lo, hi), power, wanted),
        }
    }
}

/// A tick without a label on a symmetric axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Minor {
    /// The position.
    pub at: f64,
    /// Whether the linear part ends here.
    pub is_end: bool,
}

impl Scale {
    /// The ends of the linear part of a symmetric axis, and 1, 2 and 5 times the powers of ten
    /// beyond; none on other axes, which need none.
    pub(super) fn minor(self, (lo, hi): (f64, f64)) -> Vec<Minor> {
        let Scale::Symmetric(power) = self else { return Vec::new() };
        let powers = (power..power + 2 * DECADES).map(|exponent| 10f64.powi(exponent));
        let values = powers.flat_map(|power| [power, 2.0 * power, 5.0 * power]);
        let ticks = values.enumerate().flat_map(|(k, value)| {
            let at = self.position(value).unwrap_or(f64::INFINITY);
            [-at, at].map(|at| Minor { at, is_end: k == 0 })
        });
        ticks.filter(|tick| (lo..=hi).contains(&tick.at)).collect()
    }

    /// Zero, and powers of ten above the linear part.
    fn both_signs(self, (lo, hi): (f64, f64), power: i32, wanted: usize) -> Vec<Tick> {
        let at = |exponent: i32| self.position(10f64.powi(exponent)).unwrap_or(f64::INFINITY);
        let most = f64::max(-lo, hi);
        let last = (power + 1..).take_while(|exponent| at(*exponent) <= most).count();
        let signs = if lo < -at(power + 1) && hi > at(power + 1) { 2 } else { 1 };
        let step = (signs * last).div_ceil(wanted.max(1)).max(1);
        let tick = |exponent: i32| {
            let (at, label) = (at(exponent), power_of_ten(exponent));
            [Tick { at: -at, label: format!("−{label}") }, Tick { at, label }]
        };
        let powers = (power + 1..=power + last as i32).rev().step_by(step).flat_map(tick);
        let zero = Tick { at: 0.0, label: "0".into() };
        powers.chain([zero]).filter(|tick| (lo..=hi).contains(&tick.at)).collect()
    }
}

/// The smallest number of the form 1, 2 or 5 times a power of ten that is at least `rough`, for
/// positive `rough`.
pub fn round_step(rough: f64) -> f64 {
    let power = 10f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|m| m * power).into_iter().find(|step| *step >= rough);
    step.unwrap_or(10.0 * power)
}

fn round_numbers(lo: f64, hi: f64, wanted: usize) -> Vec<Tick> {
    let rough = (hi - lo) / wanted.max(1) as f64;
    let ends = |step: f64| ((lo / step).ceil(), (hi / step).floor());
    // Two ticks are too few to read a value.
    let is_enough = |step: &f64| ends(*step).1 - ends(*step).0 >= 2.0;
    let steps = [1.0, 2.0, 4.0].map(|part| round_step(rough / part));
    let step = steps.into_iter().find(is_enough).unwrap_or(steps[2]);
    let (first, last) = ends(step);
    if !(step > 0.0 && last - first <= 100.0) {
        return Vec::new();
    }
    let largest = lo.abs().max(hi.abs());
    let digits = (largest.log10().floor() - step.log10().floor()).clamp(0.0, 15.0) as usize + 1;
    (0..=(last - first) as i64)
        .map(|k| (first + k as f64) * step)
        .map(|at| Tick { at, label: readable(at, digits) })
        .collect()
}

fn decades(lo: f64, hi: f64, wanted: usize) -> Vec<Tick> {
    let (first, last) = (lo.ceil() as i32, hi.floor() as i32);
    let step = ((last - first) as usize).div_ceil(wanted.max(1)).max(1) as i32;
    (first..=last)
        .filter(|exponent| exponent.rem_euclid(step) == 0)
        .map(|exponent| Tick { at: exponent.into(), label: power_of_ten(exponent) })
        .collect()
}

fn parts_of_decades(lo: f64, hi: f64) -> Vec<Tick> {
    (lo.floor() as i32..=hi.ceil() as i32)
        .flat_map(|exponent| [1.0, 2.0, 5.0].map(|m| m * 10f64.powi(exponent)))
        .map(|value| Tick { at: value.log10(), label: readable(value, 1) })
        .filter(|tick| (lo..=hi).contains(&tick.at))
        .collect()
}

fn power_of_ten(exponent: i32) -> String {
    match exponent {
        0..=3 => format!("{}", 10i32.pow(exponent as u32)),
        _ => format!("10{}", superscript(exponent)),
    }
}
