//! Frames: recorded steps of a physics engine, as files.
//!
//! | file | the engine's answer |
//! | --- | --- |
//! | `STEM.json`, a problem file with the key `motion` | the file `STEM.x.json`, or the key `answer` of the problem |
//! | `STEM.npz`, a frame as [`files`] reads it | the file `STEM.x.json`, or the arrays `x` and `v` |
//!
//! An answer is an object with the keys `x` (n forces or impulses), `motion` (the k entries of the
//! new velocity or acceleration) and `reported_push` (k generalized forces); the last two are
//! optional.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::error::{Defects, Error, Result};
use crate::file;
use crate::files;
use crate::json;
use crate::memory::Memory;
use crate::report::study::receipt::{EngineStep, answer_of};

/// The end of the name of a file with an answer.
const ANSWER: &str = ".x.json";
/// The file with a receipt, which is no frame.
const RECEIPT: &str = "receipt.json";

/// One recorded step.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// The problem.
    path: PathBuf,
}

impl Frame {
    /// The frames of a folder and of its folders, sorted by path; or the file itself.
    ///
    /// # Errors
    /// If the folder cannot be read, or a problem in it has no answer, or an answer no problem; one
    /// line for each.
    pub fn find(path: &Path, most: Memory) -> Result<Vec<Frame>> {
        if !path.is_dir() {
            return Ok(vec![Frame { path: path.into() }]);
        }
        let mut files = Vec::new();
        collect(path, &mut files)?;
        files.sort();
        let is_answer = |file: &&PathBuf| name_of(file).ends_with(ANSWER);
        let mut defects = Defects::default();
        for answer in files.iter().filter(is_answer) {
            let name = name_of(answer);
            let stem = name.trim_end_matches(ANSWER);
            let problem =
                [".json", ".npz"].map(|end| answer.with_file_name(format!("{stem}{end}")));
            if !problem.iter().any(|problem| files.contains(problem)) {
                let reason = format!("its problem {stem}.json is missing");
                defects.add(answer.display().to_string(), reason);
            }
        }
        let frames = files.iter().filter(|file| !is_answer(file));
        let frames: Vec<Frame> = frames.map(|path| Frame { path: path.clone() }).collect();
        for frame in frames.iter().filter(|frame| !files.contains(&frame.answer_path())) {
            if answer_of(&frame.problem(most)?).is_none() {
                let reason = format!("its answer {} is missing", name_of(&frame.answer_path()));
                defects.add(frame.name(), reason);
            }
        }
        defects.into_result(path.display().to_string())?;
        Ok(frames)
    }

    /// The path of the problem, as text.
    pub fn name(&self) -> String {
        self.path.display().to_string()
    }

    /// The problem and the engine's answer.
    ///
    /// # Errors
    /// If a file cannot be read within this memory or is not one of a frame, or there is no answer.
    pub fn read(&self, most: Memory) -> Result<(Value, Value)> {
        let problem = self.problem(most)?;
        let beside = self.answer_path();
        if file::is_there(&beside) {
            return Ok((problem, object(&beside, most)?));
        }
        let answer = answer_of(&problem).cloned().ok_or_else(|| {
            let reason = format!("its answer {} is missing", name_of(&beside));
            Error::invalid(self.name(), "answer", reason)
        })?;
        Ok((problem, answer))
    }

    /// The step.
    ///
    /// # Errors
    /// As [`read`](Frame::read), or if keys are missing or have another form or length.
    pub fn step(&self, most: Memory) -> Result<EngineStep> {
        let (problem, answer) = self.read(most)?;
        EngineStep::read(&problem, &answer, &self.name())
    }

    /// The path of the answer next to the problem.
    fn answer_path(&self) -> PathBuf {
        let stem = self.path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        self.path.with_file_name(format!("{stem}{ANSWER}"))
    }

    fn problem(&self, most: Memory) -> Result<Value> {
        match self.path.extension().is_some_and(|end| end == "npz") {
            true => Ok(files::read_within(&self.path, None, most)?.to_json()),
            false => object(&self.path, most),
        }
    }
}

/// The JSON and .npz files of a folder and of its folders.
fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> Result<()> {
    let entries = fs::read_dir(folder).map_err(|cause| Error::file(folder, &cause))?;
    for entry in entries {
        let path = entry.map_err(|cause| Error::file(folder, &cause))?.path();
        let is_frame = |end: &str| path.extension().is_some_and(|own| own == end);
        if path.is_dir() {
            collect(&path, files)?;
        } else if (is_frame("json") && name_of(&path) != RECEIPT) || is_frame("npz") {
            files.push(path);
        }
    }
    Ok(())
}

fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

fn object(path: &Path, most: Memory) -> Result<Value> {
    let input = path.display().to_string();
    let value = json::read(&file::read(path, most)?, &input)?;
    match value.is_object() {
        true => Ok(value),
        false => Err(Error::invalid(input, "file", "must be a JSON object")),
    }
}
