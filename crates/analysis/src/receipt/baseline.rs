//! Recorded runs of trusted releases, and what a later run lost against them.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Map, Value, json};

use super::Receipt;
use super::finding::Stage;
use super::frequency::Part;
use super::run::Run;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::{as_number, number};
use lcplab_lcp::json;
use lcplab_page::number::{counted, readable};

/// The quantiles of the baseline's errors at which a run is compared with it; the last one is the
/// largest error.
const QUANTILES: [f64; 4] = [0.5, 0.9, 0.99, 1.0];
/// Errors below this fraction of the limit never count as worse.
const FLOOR: f64 = 1e-3;
/// The number of missing frames that a message names.
const NAMED: usize = 3;

/// A recorded run of a trusted release.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Baseline {
    /// The rejected frames, with their stages.
    rejected: BTreeMap<String, Option<String>>,
    /// The motion error, or else the residual, of each frame, if it has one.
    errors: BTreeMap<String, Option<f64>>,
    /// The frames whose solver was not checked.
    solver_unchecked: BTreeSet<String>,
    /// The parts that were not checked in some frames, without the numbers in their texts.
    not_checked: BTreeSet<String>,
}

impl Baseline {
    /// Reads a recorded run, as [`Run::to_json`] writes it.
    ///
    /// # Errors
    /// If the text is not one.
    pub fn from_json(input: &str, text: &str) -> Result<Baseline> {
        let reason = |cause: String| Error::invalid(input, "baseline", cause);
        let value = json::parse(text).map_err(|cause| reason(format!("is not JSON: {cause}")))?;
        let get = |key: &str| {
            value.get(key).ok_or_else(|| {
                reason(match value.get("solvers") {
                    Some(_) => "is a recorded run of the command test, which tests a solver".into(),
                    None => format!(
                        "the key {key} is missing: this file is not a recorded run of this version \
                         of lcplab; record it again"
                    ),
                })
            })
        };
        let object = |key: &str| {
            let invalid = || reason(format!("the key {key} must be an object"));
            get(key)?.as_object().ok_or_else(invalid)
        };
        let stage = |(name, stage): (&String, &Value)| {
            (name.clone(), stage.as_str().map(ToString::to_string))
        };
        let error = |(name, error): (&String, &Value)| (name.clone(), as_number(error));
        let unchecked = get("solver_unchecked")?.as_array().into_iter().flatten();
        Ok(Baseline {
            rejected: object("rejected")?.iter().map(stage).collect(),
            errors: object("errors")?.iter().map(error).collect(),
            solver_unchecked: unchecked.filter_map(Value::as_str).map(Into::into).collect(),
            not_checked: object("not_checked")?.keys().map(|part| without_numbers(part)).collect(),
        })
    }

    /// The baseline with other names of its frames.
    #[must_use]
    pub fn renamed(self, name: fn(&str) -> String) -> Baseline {
        Baseline {
            rejected: self.rejected.into_iter().map(|(own, stage)| (name(&own), stage)).collect(),
            errors: self.errors.into_iter().map(|(own, error)| (name(&own), error)).collect(),
            solver_unchecked: self.solver_unchecked.iter().map(|own| name(own)).collect(),
            not_checked: self.not_checked,
        }
    }

    /// Whether it lists this frame as rejected at the same stage.
    pub(super) fn lists(&self, name: &str, receipt: &Receipt) -> bool {
        let stage = receipt.stage().map(Stage::name);
        self.rejected.get(name).is_some_and(|known| known.as_deref() == stage)
    }

    /// Whether it lists this frame as rejected.
    pub(super) fn has_rejected(&self, name: &str) -> bool {
        self.rejected.contains_key(name)
    }

    /// Its frames that a run does not have.
    pub(super) fn missing(&self, run: &Run) -> Vec<&str> {
        let names: BTreeSet<&str> = run.frames().iter().map(|(name, _)| name.as_str()).collect();
        let missing = self.errors.keys().filter(|name| !names.contains(name.as_str()));
        missing.map(String::as_str).collect()
    }

    /// The missing frames, the parts that were checked in all frames and no longer are, and the
    /// solver if it is checked in fewer frames, as sentences.
    pub(super) fn lost(&self, run: &Run) -> Vec<String> {
        let missing = self.missing(run);
        let mut lost = Vec::new();
        if !missing.is_empty() && !run.allows_missing() {
            let more = if missing.len() > NAMED { ", …" } else { "" };
            let named = missing.iter().take(NAMED).copied().collect::<Vec<_>>().join(", ");
            lost.push(format!(
                "{} of the baseline {} missing: {named}{more}",
                counted(missing.len(), "frame"),
                if missing.len() == 1 { "is" } else { "are" }
            ));
        }
        let (all, base) = (run.frames().len(), self.errors.len());
        let unchecked = Part { with: all - run.checked(), all };
        let recorded = Part { with: self.solver_unchecked.len().min(base), all: base };
        if unchecked.is_more_frequent_than(recorded) {
            lost.push(format!(
                "the solver was checked in {} of {all} frames, in the baseline in {} of {base}: {}",
                run.checked(),
                base - recorded.with,
                run.kinds_unchecked()
            ));
        }
        for (part, own) in run.not_checked() {
            // "assembly" includes "assembly: all but the bias".
            let whole = part.split(':').next().unwrap_or(&part);
            let is_new = !self.not_checked.contains(&part) && !self.not_checked.contains(whole);
            let never = Part { with: 0, all: base };
            let is_of_most = 2 * own.count >= all;
            let frequent = Part { with: own.count, all };
            if is_new && (is_of_most || frequent.is_more_frequent_than(never)) {
                lost.push(format!(
                    "no longer checked in {} of {all} frames: {}",
                    own.count, own.text
                ));
            }
        }
        lost
    }

    /// The recorded errors, sorted.
    fn sorted(&self) -> Vec<f64> {
        let mut errors: Vec<f64> = self.errors.values().flatten().copied().collect();
        errors.sort_by(f64::total_cmp);
        errors
    }

    /// The errors at which a run is compared, with their names: the floor, and the baseline's
    /// quantiles above it.
    fn levels(&self, floor: f64) -> Vec<(String, f64)> {
        let errors = self.sorted();
        let name = |part: f64| match part < 1.0 {
            true => format!("the baseline's {} quantile", percent(part)),
            false => "the baseline's largest error".to_string(),
        };
        let level = |&part: &f64| match quantile(&errors, part)? {
            error if error > floor => Some((name(part), error)),
            _ => Some(("the floor".to_string(), floor)),
        };
        let mut levels: Vec<(String, f64)> = QUANTILES.iter().filter_map(level).collect();
        levels.dedup_by(|later, earlier| later.1 == earlier.1);
        levels
    }

    /// The levels of the baseline's errors that more errors of the run exceed than chance explains,
    /// as sentences.
    pub(super) fn worse(&self, run: &Run) -> Vec<String> {
        let recorded = self.sorted();
        let part = |errors: &[f64], level: f64| Part {
            with: errors.iter().filter(|&&error| error > level).count(),
            all: errors.len(),
        };
        let worse = |(name, level): (String, f64)| {
            let (own, base) = (part(run.errors(), level), part(&recorded, level));
            own.is_more_frequent_than(base).then(|| {
                format!(
                    "worse than the baseline: {} of {} errors are above {name}, {}, in the \
                     baseline {} of {}",
                    own.with,
                    own.all,
                    readable(level, 2),
                    base.with,
                    base.all
                )
            })
        };
        self.levels(floor(run)).into_iter().filter_map(worse).collect()
    }

    /// How the run was compared, as a sentence.
    pub(super) fn comparison(&self, run: &Run) -> String {
        let (own, base) = (run.errors().len(), self.sorted().len());
        let all = Part { with: own, all: own };
        if !all.is_more_frequent_than(Part { with: 0, all: base }) {
            return format!("too few errors to compare with the baseline: {own}, there {base}");
        }
        let levels = self.levels(floor(run)).into_iter();
        let levels: Vec<String> =
            levels.map(|(name, level)| format!("{name} ({})", readable(level, 2))).collect();
        format!(
            "compared with {} in the baseline: how many are above {}",
            counted(base, "error"),
            levels.join(", ")
        )
    }
}

/// The run's part of a recorded run.
pub(super) fn recorded(run: &Run) -> Map<String, Value> {
    let mut object = Map::new();
    let error = |receipt: &Receipt| receipt.error().map_or(Value::Null, number);
    let errors: Map<String, Value> =
        run.frames().iter().map(|(name, own)| (name.clone(), error(own))).collect();
    let parts = run.not_checked().into_iter();
    let parts: Map<String, Value> = parts.map(|(part, own)| (part, json!(own.count))).collect();
    object.insert("solver_unchecked".into(), json!(run.solver_unchecked()));
    object.insert("not_checked".into(), Value::Object(parts));
    object.insert("errors".into(), Value::Object(errors));
    object
}

/// The error below which nothing counts as worse.
fn floor(run: &Run) -> f64 {
    let least = run.frames().iter().map(|(_, receipt)| receipt.limit());
    FLOOR * least.fold(f64::INFINITY, f64::min)
}

/// A text without the numbers of rows and actuators, which differ from frame to frame.
pub(super) fn without_numbers(text: &str) -> String {
    let is_number = |word: &str| word.trim_end().parse::<u64>().is_ok();
    let words = text.split_inclusive(' ');
    words.map(|word| if is_number(word) { "… " } else { word }).collect()
}

/// A fraction as text: 50 %.
pub(super) fn percent(part: f64) -> String {
    format!("{} %", (100.0 * part).round())
}

/// The value that this fraction of the values does not exceed.
pub(super) fn quantile(ordered: &[f64], part: f64) -> Option<f64> {
    let rank = (part * ordered.len() as f64).ceil() as usize;
    ordered.get(rank.clamp(1, ordered.len().max(1)) - 1).copied()
}
