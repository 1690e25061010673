//! Runs: the receipts of many steps, their quantiles, and the comparison with a recorded run.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde_json::{Map, Value, json};

use super::finding::Stage;
use super::{Receipt, StepVerdict};
use crate::ci::{self, Case, Verdict};
use lcplab_page::number::{counted, readable};
use lcplab_problem::error::{Error, Result};
use lcplab_problem::file::{as_number, number};
use lcplab_problem::json;

/// Frames are counted above these motion errors.
const LEVELS: [(&str, f64); 4] = [("1e-6", 1e-6), ("1e-5", 1e-5), ("1e-4", 1e-4), ("1e-3", 1e-3)];
const QUANTILES: [f64; 3] = [0.5, 0.9, 0.99];
/// The spread of a quantile is that of its rank within this number of standard deviations: 99 % of
/// samples.
const DEVIATIONS: f64 = 2.58;
/// Quantiles below this fraction of the limit never count as worse.
const FLOOR: f64 = 1e-3;
const WORST: usize = 10;
const LISTED: &str = "listed in the baseline";

/// A recorded run of a trusted release.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Baseline {
    /// The rejected frames, with their stages.
    rejected: BTreeMap<String, Option<String>>,
    /// The upper end of each quantile's range in samples of this size.
    spreads: BTreeMap<String, f64>,
}

impl Baseline {
    /// Reads a recorded run, as [`Run::to_json`] writes it.
    ///
    /// # Errors
    /// If the text is not one.
    pub fn from_json(input: &str, text: &str) -> Result<Baseline> {
        let reason = |cause: String| Error::invalid(input, "baseline", cause);
        let value = json::parse(text).map_err(|cause| reason(format!("is not JSON: {cause}")))?;
        let Some(rejected) = value.get("rejected").and_then(Value::as_object) else {
            let cause = match value.get("solvers") {
                Some(_) => "is a recorded run of the command test, which tests a solver",
                None => "the key rejected is missing: this file is not a recorded run",
            };
            return Err(reason(cause.into()));
        };
        let stage = |(name, stage): (&String, &Value)| {
            (name.clone(), stage.as_str().map(ToString::to_string))
        };
        let spreads = value.get("spreads").and_then(Value::as_object).into_iter().flatten();
        let spread = |(part, most): (&String, &Value)| Some((part.clone(), as_number(most)?));
        Ok(Baseline {
            rejected: rejected.iter().map(stage).collect(),
            spreads: spreads.filter_map(spread).collect(),
        })
    }

    /// Whether it lists this frame as rejected at the same stage.
    fn lists(&self, name: &str, receipt: &Receipt) -> bool {
        let stage = receipt.stage().map(Stage::name);
        self.rejected.get(name).is_some_and(|known| known.as_deref() == stage)
    }
}

/// The receipts of a run, in the order of its steps, compared with a recorded run.
#[derive(Debug, Clone)]
pub struct Run {
    frames: Vec<(String, Arc<Receipt>)>,
    /// The motion errors, sorted.
    errors: Vec<f64>,
    baseline: Option<Baseline>,
}

impl Run {
    /// The run of these frames; of several frames with one name the last counts.
    pub fn new(frames: Vec<(String, Arc<Receipt>)>, baseline: Option<Baseline>) -> Self {
        let mut places: BTreeMap<String, usize> = BTreeMap::new();
        let mut unique: Vec<(String, Arc<Receipt>)> = Vec::with_capacity(frames.len());
        for (name, receipt) in frames {
            match places.get(&name) {
                Some(&place) => unique[place] = (name, receipt),
                None => {
                    places.insert(name.clone(), unique.len());
                    unique.push((name, receipt));
                }
            }
        }
        let mut errors: Vec<f64> =
            unique.iter().filter_map(|(_, receipt)| receipt.motion_error()).collect();
        errors.sort_by(f64::total_cmp);
        Run { frames: unique, errors, baseline }
    }

    /// The frames with their names.
    pub fn frames(&self) -> &[(String, Arc<Receipt>)] {
        &self.frames
    }

    /// Whether some frames were checked, the baseline lists all rejected ones, and no quantile of
    /// the motion error is worse than the baseline's by more than the baseline's spread.
    pub fn is_ok(&self) -> bool {
        self.unchecked().is_none() && self.new_rejections().next().is_none() && {
            self.worse().is_empty()
        }
    }

    fn rejected(&self) -> impl Iterator<Item = &(String, Arc<Receipt>)> {
        self.frames.iter().filter(|(_, receipt)| receipt.is_rejected())
    }

    fn is_known(&self, (name, receipt): &(String, Arc<Receipt>)) -> bool {
        self.baseline.as_ref().is_some_and(|baseline| baseline.lists(name, receipt))
    }

    fn new_rejections(&self) -> impl Iterator<Item = &(String, Arc<Receipt>)> {
        self.rejected().filter(|frame| !self.is_known(frame))
    }

    fn with(&self, verdict: StepVerdict) -> Vec<&str> {
        let own = self.frames.iter().filter(|(_, receipt)| receipt.verdict() == verdict);
        own.map(|(name, _)| name.as_str()).collect()
    }

    /// Why no frame counts as checked, as a sentence: each is unconverged, or has no rows, or
    /// nothing of it was compared.
    pub fn unchecked(&self) -> Option<String> {
        let is_bare = |(_, receipt): &&(String, Arc<Receipt>)| {
            receipt.verdict() == StepVerdict::NotChecked && receipt.findings().is_empty()
        };
        let kinds = [
            (self.with(StepVerdict::Unconverged).len(), "unconverged"),
            (self.frames.iter().filter(is_bare).count(), "without any comparison"),
            (self.with(StepVerdict::NoRows).len(), "without rows"),
        ];
        if kinds.iter().map(|(count, _)| count).sum::<usize>() < self.frames.len() {
            return None;
        }
        let counts: Vec<String> = kinds
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, kind)| format!("{count} {kind}"))
            .collect();
        let counts = match counts.is_empty() {
            true => "there are no frames".into(),
            false => counts.join(", "),
        };
        Some(format!("no frame was checked: {counts}"))
    }

    /// Why frames have no bound on the motion: each reason with the number of its frames.
    fn without_bound(&self) -> Vec<String> {
        let mut reasons: BTreeMap<&str, usize> = BTreeMap::new();
        let of = self.frames.iter().filter(|own| own.1.verdict() == StepVerdict::NotChecked);
        for (_, receipt) in of {
            let reason = receipt.not_checked().iter().find(|part| part.starts_with("solver"));
            *reasons.entry(reason.map_or("solver", String::as_str)).or_default() += 1;
        }
        let line = |(reason, count): (&str, usize)| {
            format!("not checked in {}: {reason}", counted(count, "frame"))
        };
        reasons.into_iter().map(line).collect()
    }

    /// The quantiles that are worse than the baseline's, as sentences.
    pub fn worse(&self) -> Vec<String> {
        let Some(baseline) = &self.baseline else { return Vec::new() };
        let least = self.frames.iter().map(|(_, receipt)| receipt.limit());
        let floor = FLOOR * least.fold(f64::INFINITY, f64::min);
        let worse = |&part: &f64| {
            let most = *baseline.spreads.get(&part.to_string())?;
            let own = quantile(&self.errors, part)?;
            (own > most.max(floor)).then(|| {
                let (own, most) = (readable(own, 2), readable(most, 2));
                format!(
                    "worse than the baseline: {} of the motion errors are up to {own}, allowed {most}",
                    percent(part)
                )
            })
        };
        QUANTILES.iter().filter_map(worse).collect()
    }

    /// Frames that the baseline lists as rejected, and that no longer are.
    fn fixed(&self) -> Vec<&str> {
        let listed = |name: &str| {
            self.baseline.as_ref().is_some_and(|baseline| baseline.rejected.contains_key(name))
        };
        let fixed = self.frames.iter().filter(|(name, own)| !own.is_rejected() && listed(name));
        let mut fixed: Vec<&str> = fixed.map(|(name, _)| name.as_str()).collect();
        fixed.sort_unstable();
        fixed
    }

    /// The ten worst of the rejected and unconverged frames: first the rejected ones, then those
    /// with the largest motion errors.
    pub fn worst(&self) -> Vec<&(String, Arc<Receipt>)> {
        let is_bad = |(_, receipt): &&(String, Arc<Receipt>)| {
            receipt.is_rejected() || receipt.verdict() == StepVerdict::Unconverged
        };
        let mut frames: Vec<_> = self.frames.iter().filter(is_bad).collect();
        let size = |(_, receipt): &&(String, Arc<Receipt>)| {
            (!receipt.is_rejected(), -receipt.motion_error().unwrap_or(0.0))
        };
        frames.sort_by(|a, b| {
            let (a, b) = (size(a), size(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        });
        frames.truncate(WORST);
        frames
    }

    fn counts(&self) -> Map<String, Value> {
        let above = |level: f64| self.errors.iter().filter(|&&error| error > level).count();
        LEVELS.iter().map(|&(name, level)| (name.into(), json!(above(level)))).collect()
    }

    fn stages(&self) -> Vec<(Stage, usize)> {
        let count = |stage: Stage| {
            self.rejected().filter(|(_, receipt)| receipt.stage() == Some(stage)).count()
        };
        Stage::ALL.map(|stage| (stage, count(stage))).into_iter().filter(|own| own.1 > 0).collect()
    }

    /// The run for people: counts, quantiles, and the receipts of the worst frames.
    pub fn text(&self) -> String {
        let count = |verdict| self.with(verdict).len();
        let known = self.rejected().filter(|frame| self.is_known(frame)).count();
        let mut first = format!(
            "{}: {}, {} rejected ({known} known), {} unconverged, {} without rows",
            if self.is_ok() { "ok" } else { "not ok" },
            counted(self.frames.len(), "frame"),
            self.rejected().count(),
            count(StepVerdict::Unconverged),
            count(StepVerdict::NoRows)
        );
        if count(StepVerdict::NotChecked) > 0 {
            let count = count(StepVerdict::NotChecked);
            first += &format!(
                ", {count} without a bound on the motion, so that the solver was not checked"
            );
        }
        let mut lines = vec![first];
        let counts: Vec<String> =
            self.counts().iter().map(|(level, count)| format!("{level}: {count}")).collect();
        let counts = counts.join(", ");
        let frames = counted(self.errors.len(), "frame");
        lines.push(format!("motion error above {counts} of {frames}"));
        if !self.errors.is_empty() {
            let value = |part| readable(quantile(&self.errors, part).unwrap_or_default(), 2);
            let quantiles = QUANTILES.map(|part| format!("{}: {}", percent(part), value(part)));
            lines.push(format!("quantiles {}", quantiles.join(", ")));
        }
        let stage = |(stage, count): (Stage, usize)| format!("rejected at {stage}: {count}");
        lines.extend(self.stages().into_iter().map(stage));
        lines.extend(self.without_bound());
        lines.extend(self.unchecked());
        lines.extend(self.worse());
        let fixed = |name| format!("{name} is no longer rejected: record the baseline again");
        lines.extend(self.fixed().into_iter().map(fixed));
        for (name, receipt) in self.worst() {
            lines.push(name.clone());
            lines.extend(receipt.text().lines().map(|line| format!("  {line}")));
        }
        lines.join("\n")
    }

    /// The run as a baseline, with which later runs are compared.
    pub fn to_json(&self) -> Map<String, Value> {
        let of = |value: fn(&[f64], f64) -> Option<f64>| -> Map<String, Value> {
            let value = |part| value(&self.errors, part).map_or(Value::Null, number);
            match self.errors.is_empty() {
                true => Map::new(),
                false => QUANTILES.iter().map(|part| (part.to_string(), value(*part))).collect(),
            }
        };
        let rejected: Map<String, Value> =
            self.rejected().map(|(name, own)| (name.clone(), json!(own.stage()))).collect();
        let mut versions: Vec<String> = self
            .frames
            .iter()
            .map(|(_, receipt)| &receipt.step().source)
            .map(|source| format!("{} {}", source.engine, source.version).trim().to_string())
            .collect();
        versions.sort_unstable();
        versions.dedup();
        let mut object = Map::new();
        object.insert("frames".into(), json!(self.frames.len()));
        object.insert("counts".into(), Value::Object(self.counts()));
        object.insert("quantiles".into(), Value::Object(of(quantile)));
        object.insert("spreads".into(), Value::Object(of(spread)));
        object.insert("rejected".into(), Value::Object(rejected));
        object.insert("unconverged".into(), json!(self.with(StepVerdict::Unconverged)));
        object.insert("versions".into(), json!(versions));
        object
    }

    /// The run with its comparison: the baseline's keys, and `ok`, `known`, `fixed`, `worse`,
    /// `unchecked`, `stages` and `worst`.
    pub fn summary(&self) -> Map<String, Value> {
        let mut object = Map::new();
        object.insert("ok".into(), json!(self.is_ok()));
        object.extend(self.to_json());
        let known: Vec<&str> = self
            .rejected()
            .filter(|frame| self.is_known(frame))
            .map(|(name, _)| name.as_str())
            .collect();
        let stages: Map<String, Value> = self
            .stages()
            .into_iter()
            .map(|(stage, count)| (stage.name().into(), json!(count)))
            .collect();
        let worst: Vec<&str> = self.worst().iter().map(|(name, _)| name.as_str()).collect();
        object.insert("known".into(), json!(known));
        object.insert("fixed".into(), json!(self.fixed()));
        object.insert("worse".into(), json!(self.worse()));
        object.insert("unchecked".into(), json!(self.unchecked()));
        object.insert("stages".into(), Value::Object(stages));
        object.insert("worst".into(), json!(worst));
        object
    }

    /// The [`summary`](Run::summary) with the receipt of each frame.
    pub fn details(&self) -> Map<String, Value> {
        let mut object = self.summary();
        let receipts: Map<String, Value> =
            self.frames.iter().map(|(name, own)| (name.clone(), own.to_json())).collect();
        object.insert("receipts".into(), Value::Object(receipts));
        object
    }

    /// The frames as test cases; the run itself is one more if it fails as a whole.
    fn cases(&self) -> Vec<Case> {
        let case = |frame: &(String, Arc<Receipt>)| {
            let (name, receipt) = frame;
            let error = receipt.motion_error().map_or("–".into(), |error| format!("{error:e}"));
            let is_listed =
                || self.baseline.as_ref().is_some_and(|own| own.rejected.contains_key(name));
            let verdict = match receipt.rejected() {
                Some(_) if receipt.is_rejected() && self.is_known(frame) => {
                    Verdict::Known(LISTED.into())
                }
                Some(finding) if receipt.is_rejected() => {
                    Verdict::Failed(format!("{}: {}", finding.stage, finding.what))
                }
                _ if is_listed() => Verdict::Fixed,
                _ => Verdict::Passed,
            };
            let details = if receipt.is_rejected() { receipt.text() } else { String::new() };
            Case {
                class: "lcplab.receipts".into(),
                name: name.clone(),
                verdict,
                rule: rule(receipt.stage()),
                properties: vec![
                    ("verdict", receipt.verdict().name().into()),
                    ("motion_error", error),
                ],
                details,
                is_file: true,
            }
        };
        let mut cases: Vec<Case> = self.frames.iter().map(case).collect();
        let reasons: Vec<String> = self.unchecked().into_iter().chain(self.worse()).collect();
        if let Some(first) = reasons.first() {
            cases.push(Case {
                class: "lcplab.receipts".into(),
                name: "run".into(),
                verdict: Verdict::Failed(first.clone()),
                rule: "receipt/run".into(),
                properties: Vec::new(),
                details: reasons.join("\n"),
                is_file: false,
            });
        }
        cases
    }

    /// The run as JUnit XML: a test case for each frame; frames that the baseline lists are
    /// skipped.
    pub fn junit(&self) -> String {
        ci::junit("lcplab receipts", &self.cases())
    }

    /// The run as SARIF 2.1.0: a rule for each stage, a result for each rejected frame.
    pub fn sarif(&self) -> String {
        let text = |stage: Stage| format!("The stage {stage} of an engine's step");
        let mut rules: Vec<(String, String)> =
            Stage::ALL.map(|stage| (rule(Some(stage)), text(stage))).into();
        rules.push(("receipt/run".into(), "A run of an engine's steps".into()));
        ci::sarif(&rules, &self.cases())
    }
}

fn rule(stage: Option<Stage>) -> String {
    format!("receipt/{}", stage.map_or("run", Stage::name))
}

/// A fraction as text: 50 %.
fn percent(part: f64) -> String {
    format!("{} %", (100.0 * part).round())
}

/// The value that this fraction of the values does not exceed.
fn quantile(ordered: &[f64], part: f64) -> Option<f64> {
    let rank = (part * ordered.len() as f64).ceil() as usize;
    ordered.get(rank.clamp(1, ordered.len().max(1)) - 1).copied()
}

/// The upper end of the quantile's range in samples of this size; `None` where the largest value is
/// within it.
fn spread(ordered: &[f64], part: f64) -> Option<f64> {
    let count = ordered.len() as f64;
    let rank = (part * count + DEVIATIONS * (count * part * (1.0 - part)).sqrt()).ceil() as usize;
    (rank < ordered.len()).then(|| ordered[rank - 1])
}
