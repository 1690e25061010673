//! `receipts`: checks recorded steps of a physics engine, and compares with a recorded run.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use lcplab::error::{Error, Result};
use lcplab::file;
use lcplab::report::study::receipt::{Baseline, Receipt, Run};
use serde_json::Value;

use super::limits::MemoryLimit;
use super::{Outcome, baseline_text, from_here, print, say};
use crate::frames::Frame;

/// Check recorded steps of a physics engine, and compare with a recorded run
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab receipts frames                                        # all steps in a folder
  lcplab receipts frames --baseline known.json --update         # record this run
  lcplab receipts frames --baseline known.json                  # in CI
  lcplab receipts stack.json step.npz --junit r.xml --sarif r.sarif

A frame is one step of an engine: a problem file with the key \"motion\" and the engine's answer. The answer is \
in the file STEM.x.json next to STEM.json or STEM.npz, in the key \"answer\" of the problem file, or in \
the arrays x and v of the .npz file. Record the baseline in the folder in which the check runs: frames are \
compared by their paths.

The run is compared with four levels: the 50 %, 90 % and 99 % quantiles of the baseline's errors, and its largest error. \
It is worse if, at one level, significantly more of its errors than of the baseline's are above the level (Fisher's exact \
test, 0.5 %; two runs of equal length need at least 5 values of the error each). Errors below a thousandth of the limit never count \
as worse.

Exit codes:
  0  the run is ok, or the baseline was written. A run is ok if each rejected frame is rejected at the same \
stage in the baseline (without a baseline: no frame is rejected), at least one frame (without a baseline: at least half \
of the frames with rows) has the verdict ok or wrong, no frame (except with --allow-missing) and no check of the baseline is \
missing, and the run is not worse
  1  the run is not ok
  2  invalid input or usage, such as a frame without an answer or a negative compliance")]
pub struct Receipts {
    /// Problem files with the key "motion", or folders of them
    #[arg(required = true)]
    frames: Vec<PathBuf>,
    /// Largest accepted motion error, or residual if the frame has no motion error; docs/ci.md
    /// defines both
    /// [default: that of the engine's kind of solver]
    #[arg(long, allow_negative_numbers = true)]
    limit: Option<f64>,
    /// Recorded run to compare with
    #[arg(long, value_name = "FILE")]
    baseline: Option<PathBuf>,
    /// Write this run to the baseline file
    #[arg(long, requires = "baseline")]
    update: bool,
    /// Do not fail if frames of the baseline are missing
    #[arg(long, requires = "baseline")]
    allow_missing: bool,
    /// Write the results as JUnit XML
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Write the failures as SARIF
    #[arg(long, value_name = "FILE")]
    sarif: Option<PathBuf>,
    /// Write a folder for each of the ten worst rejected or unconverged frames
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    #[command(flatten)]
    memory: MemoryLimit,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

/// The number of frames that are in memory as files at a time.
const TOGETHER: usize = 64;

impl Receipts {
    pub fn run(&self) -> Result<Outcome> {
        let baseline = self.recorded()?;
        let most = self.memory.max_memory;
        let mut frames = Vec::new();
        for path in &self.frames {
            frames.extend(Frame::find(path, most)?);
        }
        if frames.is_empty() {
            let reason = "has no frames. A frame is a file STEM.json or STEM.npz with its answer, \
                          such as STEM.x.json, in the same folder";
            let path = self.frames[0].display().to_string();
            return Err(Error::invalid(path, "frames", reason));
        }
        let mut receipts = Vec::with_capacity(frames.len());
        for together in frames.chunks(TOGETHER) {
            let steps = together.iter().map(|frame| Ok((frame.step(most)?, None)));
            let steps = steps.collect::<Result<Vec<_>>>()?;
            receipts.extend(Receipt::of_all(steps, self.limit)?);
        }
        let receipts = receipts.into_iter().map(Arc::new);
        let named = frames.iter().map(|frame| from_here(&frame.name())).zip(receipts).collect();
        let run = Run::new(named, baseline);
        let run = if self.allow_missing { run.allowing_missing() } else { run };
        self.write(&run, &frames)?;
        match self.json {
            true => print(&format!("{}\n", Value::Object(run.details())))?,
            false => print(&format!("{}\n", run.text()))?,
        }
        Ok(if run.is_ok() || self.update { Outcome::Good } else { Outcome::Rejected })
    }

    /// The baseline to compare with; none if this run becomes the baseline.
    fn recorded(&self) -> Result<Option<Baseline>> {
        let Some(path) = self.baseline.as_ref().filter(|_| !self.update) else { return Ok(None) };
        let baseline = Baseline::from_json(&path.display().to_string(), &baseline_text(path)?)?;
        Ok(Some(baseline.renamed(from_here)))
    }

    fn write(&self, run: &Run, frames: &[Frame]) -> Result<()> {
        if let (Some(path), true) = (&self.baseline, self.update) {
            file::write(path, format!("{:#}\n", Value::Object(run.to_json())))?;
        }
        if let Some(path) = &self.junit {
            file::write(path, run.junit())?;
        }
        if let Some(path) = &self.sarif {
            file::write(path, run.sarif())?;
        }
        let Some(out) = &self.out else { return Ok(()) };
        for (name, receipt) in run.worst() {
            if let Some(frame) = frames.iter().find(|frame| from_here(&frame.name()) == *name) {
                self.save(frame, receipt, out)?;
            }
        }
        Ok(())
    }

    /// Writes the folder of a frame: its problem and answer, its receipt, and a page.
    fn save(&self, frame: &Frame, receipt: &Receipt, out: &Path) -> Result<()> {
        let (problem, answer) = frame.read(self.memory.max_memory)?;
        let folder = folder_name(&frame.name());
        for (name, text) in receipt.folder(&problem, &answer)? {
            file::write_in(out, Path::new(&folder).join(name), text)?;
        }
        say(&format!("written: {}", out.join(folder).display()));
        Ok(())
    }
}

/// The name of a frame as the name of a folder.
fn folder_name(name: &str) -> String {
    let letter = |c: char| if c.is_ascii_alphanumeric() || "-_.".contains(c) { c } else { '-' };
    let folder: String = name.chars().map(letter).collect();
    match folder.trim_matches(['-', '.']) {
        "" => "frame".into(),
        folder => folder.into(),
    }
}
