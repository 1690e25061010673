//! Runs: the receipts of many steps, their quantiles, and the comparison with a recorded run.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde_json::{Map, Value, json};

use super::baseline::{self, Baseline, percent, quantile, without_numbers};
use super::finding::Stage;
use super::{Receipt, StepVerdict};
use crate::ci::{self, Case, Verdict};
use lcplab_lcp::file::number;
use lcplab_page::number::{counted, readable};

/// Frames are counted above these errors.
const LEVELS: [(&str, f64); 4] = [("1e-6", 1e-6), ("1e-5", 1e-5), ("1e-4", 1e-4), ("1e-3", 1e-3)];
const QUANTILES: [f64; 3] = [0.5, 0.9, 0.99];
/// The verdicts on frames whose solver was not checked.
const UNCHECKED: [StepVerdict; 3] =
    [StepVerdict::Unconverged, StepVerdict::NotChecked, StepVerdict::NoRows];
const WORST: usize = 10;
const LISTED: &str = "listed in the baseline";

/// The frames in which a part was not checked, with the text in the first of them.
pub(super) struct Unchecked {
    pub(super) count: usize,
    pub(super) text: String,
}

/// The receipts of a run, in the order of its steps, compared with a recorded run.
///
/// ```
/// use std::sync::Arc;
///
/// use lcplab_analysis::receipt::{Baseline, EngineStep, Receipt, Run};
/// use serde_json::json;
///
/// // 2 kg fall at 3 m/s on one contact of compliance ½ s/kg: x = 3 N s, v = −1.5 m/s.
/// let problem = json!({"b": [-3], "motion": {"mass": [[0, 0, 2]], "jacobian": [[0, 0, 1]],
///     "bias": [0], "compliance": [0.5], "target": [-3]}});
/// let frame = |name: &str, x: f64, v: f64| {
///     let step = EngineStep::read(&problem, &json!({"x": [x], "motion": [v]}), name)?;
///     let receipt = Arc::new(Receipt::new(step, None, None)?);
///     lcplab_lcp::error::Result::Ok((name.to_string(), receipt))
/// };
/// let recorded = Run::new(vec![frame("1", 3.0, -1.5)?, frame("2", 3.0, -1.5)?], None);
/// assert!(recorded.is_ok() && recorded.unchecked().is_none());
///
/// // A new release of the engine: frame 1 is wrong, and frame 2 is missing.
/// let text = serde_json::Value::Object(recorded.to_json()).to_string();
/// let baseline = Baseline::from_json("baseline.json", &text)?;
/// let other = baseline.clone().renamed(|name| format!("step {name}")); // other names of frames
/// assert_ne!(other, baseline);
/// let run = Run::new(vec![frame("1", 2.0, -2.0)?], Some(baseline));
/// assert!(!run.is_ok());
/// assert_eq!((run.missing(), run.frames().len()), (vec!["2"], 1));
/// assert_eq!(run.worst()[0].0, "1");
/// assert!(run.worse().is_empty()); // one frame is too few to compare the sizes of errors
/// assert_eq!(run.lost(), ["1 frame of the baseline is missing: 2"]);
/// assert!(run.clone().allowing_missing().lost().is_empty());
/// assert!(run.text().starts_with("not ok: 1 frame, 1 rejected (0 known)"));
/// assert!(run.junit().contains("<failure"));
/// assert!(run.sarif().contains("2.1.0"));
/// assert_eq!(run.summary()["ok"], false);
/// assert!(run.details()["receipts"].get("1").is_some());
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Run {
    frames: Vec<(String, Arc<Receipt>)>,
    /// The motion errors, or else residuals, sorted.
    errors: Vec<f64>,
    baseline: Option<Baseline>,
    allows_missing: bool,
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
            unique.iter().filter_map(|(_, receipt)| receipt.error()).collect();
        errors.sort_by(f64::total_cmp);
        Run { frames: unique, errors, baseline, allows_missing: false }
    }

    /// The run, which is also ok if frames of the baseline are missing.
    #[must_use]
    pub fn allowing_missing(self) -> Self {
        Run { allows_missing: true, ..self }
    }

    pub(super) fn allows_missing(&self) -> bool {
        self.allows_missing
    }

    /// The frames with their names.
    pub fn frames(&self) -> &[(String, Arc<Receipt>)] {
        &self.frames
    }

    /// The motion errors, or else residuals, sorted.
    pub(super) fn errors(&self) -> &[f64] {
        &self.errors
    }

    /// Whether the baseline lists all rejected frames, and there is no reason against the run as a
    /// whole.
    pub fn is_ok(&self) -> bool {
        self.reasons().is_empty() && self.new_rejections().next().is_none()
    }

    /// What is wrong with the run as a whole, as sentences: too little was checked, frames or
    /// checks of the baseline are missing, or errors are larger than the baseline's.
    fn reasons(&self) -> Vec<String> {
        self.unchecked().into_iter().chain(self.lost()).chain(self.worse()).collect()
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

    /// The number of frames whose solver was checked.
    pub(super) fn checked(&self) -> usize {
        self.frames.len() - self.solver_unchecked().len()
    }

    /// The frames whose solver was not checked.
    pub(super) fn solver_unchecked(&self) -> Vec<&str> {
        UNCHECKED.into_iter().flat_map(|verdict| self.with(verdict)).collect()
    }

    /// The frames whose solver was not checked, as counts by verdict.
    pub(super) fn kinds_unchecked(&self) -> String {
        let counts: Vec<String> = UNCHECKED
            .into_iter()
            .map(|verdict| (self.with(verdict).len(), verdict.name()))
            .filter(|(count, _)| *count > 0)
            .map(|(count, name)| format!("{count} {name}"))
            .collect();
        match counts.is_empty() {
            true => "there are no frames".into(),
            false => counts.join(", "),
        }
    }

    /// Why the run does not count as checked, as a sentence: no frame is ok or wrong or,
    /// without a baseline, in less than half of the frames with rows.
    pub fn unchecked(&self) -> Option<String> {
        let (checked, kinds) = (self.checked(), self.kinds_unchecked());
        let with_rows = self.frames.len() - self.with(StepVerdict::NoRows).len();
        if checked == 0 {
            return Some(format!("no frame is ok or wrong: {kinds}"));
        }
        (self.baseline.is_none() && 2 * checked < with_rows).then(|| {
            format!(
                "the solver was checked in {checked} of {with_rows} frames with rows, which is \
                 less than half: {kinds}; a baseline can accept this"
            )
        })
    }

    /// The parts that were not checked in some frames; the keys are without numbers.
    pub(super) fn not_checked(&self) -> BTreeMap<String, Unchecked> {
        let mut parts: BTreeMap<String, Unchecked> = BTreeMap::new();
        for part in self.frames.iter().flat_map(|(_, receipt)| receipt.not_checked()) {
            let first = || Unchecked { count: 0, text: part.clone() };
            parts.entry(without_numbers(part)).or_insert_with(first).count += 1;
        }
        parts
    }

    /// Why the solver was not checked in some frames: each reason with the number of its frames.
    fn reasons_unchecked(&self) -> Vec<String> {
        let mut reasons: BTreeMap<String, Unchecked> = BTreeMap::new();
        let of = self.frames.iter().filter(|own| own.1.verdict() == StepVerdict::NotChecked);
        for (_, receipt) in of {
            let reason = receipt.not_checked().iter().find(|part| part.starts_with("solver"));
            let reason = reason.map_or("solver", String::as_str);
            let first = || Unchecked { count: 0, text: reason.into() };
            reasons.entry(without_numbers(reason)).or_insert_with(first).count += 1;
        }
        let line = |own: Unchecked| {
            format!("not checked in {}: {}", counted(own.count, "frame"), own.text)
        };
        reasons.into_values().map(line).collect()
    }

    /// The frames of the baseline that are missing.
    pub fn missing(&self) -> Vec<&str> {
        self.baseline.as_ref().map(|baseline| baseline.missing(self)).unwrap_or_default()
    }

    /// What the baseline checked and this run does not, as sentences.
    pub fn lost(&self) -> Vec<String> {
        self.baseline.as_ref().map(|baseline| baseline.lost(self)).unwrap_or_default()
    }

    /// In which respects the errors are larger than the baseline's, as sentences.
    pub fn worse(&self) -> Vec<String> {
        self.baseline.as_ref().map(|baseline| baseline.worse(self)).unwrap_or_default()
    }

    /// Frames that the baseline lists as rejected, and that no longer are.
    fn fixed(&self) -> Vec<&str> {
        let listed =
            |name: &str| self.baseline.as_ref().is_some_and(|baseline| baseline.has_rejected(name));
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
            (!receipt.is_rejected(), -receipt.error().unwrap_or(0.0))
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

    /// The numbers of errors above fixed levels.
    fn counts_line(&self) -> String {
        let counts: Vec<String> =
            self.counts().iter().map(|(level, count)| format!("{level}: {count}")).collect();
        let residuals = self.frames.iter().filter(|own| own.1.residual().is_some()).count();
        let name = match residuals {
            0 => "motion error".into(),
            _ => format!("motion error (residual in {})", counted(residuals, "frame")),
        };
        let frames = counted(self.errors.len(), "frame");
        format!("{name} above {} of {frames}", counts.join(", "))
    }

    /// The run for people: counts, quantiles, and the receipts of the worst frames.
    pub fn text(&self) -> String {
        let count = |verdict| self.with(verdict).len();
        let known = self.rejected().filter(|frame| self.is_known(frame)).count();
        let mut lines = vec![format!(
            "{}: {}, {} rejected ({known} known), {} unconverged, {} not checked, {} without rows",
            if self.is_ok() { "ok" } else { "not ok" },
            counted(self.frames.len(), "frame"),
            self.rejected().count(),
            count(StepVerdict::Unconverged),
            count(StepVerdict::NotChecked),
            count(StepVerdict::NoRows)
        )];
        lines.extend(self.reasons());
        lines.push(self.counts_line());
        if !self.errors.is_empty() {
            let value = |part| readable(quantile(&self.errors, part).unwrap_or_default(), 2);
            let quantiles = QUANTILES.map(|part| format!("{}: {}", percent(part), value(part)));
            lines.push(format!("quantiles {}", quantiles.join(", ")));
        }
        lines.extend(self.baseline.as_ref().map(|baseline| baseline.comparison(self)));
        let stage = |(stage, count): (Stage, usize)| format!("rejected at {stage}: {count}");
        lines.extend(self.stages().into_iter().map(stage));
        lines.extend(self.reasons_unchecked());
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
        let value = |part| quantile(&self.errors, part).map(number);
        let value = |part: &f64| Some((part.to_string(), value(*part)?));
        let quantiles: Map<String, Value> = QUANTILES.iter().filter_map(value).collect();
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
        object.insert("quantiles".into(), Value::Object(quantiles));
        object.insert("rejected".into(), Value::Object(rejected));
        object.insert("unconverged".into(), json!(self.with(StepVerdict::Unconverged)));
        object.insert("versions".into(), json!(versions));
        object.extend(baseline::recorded(self));
        object
    }

    /// The run with its comparison: the baseline's keys, and `ok`, `known`, `fixed`, `missing`,
    /// `lost`, `worse`, `unchecked`, `stages` and `worst`.
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
        object.insert("missing".into(), json!(self.missing()));
        object.insert("lost".into(), json!(self.lost()));
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
            let number =
                |error: Option<f64>| error.map_or("–".into(), |error| format!("{error:e}"));
            let is_listed = || self.baseline.as_ref().is_some_and(|own| own.has_rejected(name));
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
                    ("motion_error", number(receipt.motion_error())),
                    ("residual", number(receipt.residual())),
                ],
                details,
                is_file: true,
            }
        };
        let mut cases: Vec<Case> = self.frames.iter().map(case).collect();
        let reasons = self.reasons();
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
