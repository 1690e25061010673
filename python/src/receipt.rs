//! Receipts of an engine's steps, and runs of them.

use std::path::PathBuf;
use std::sync::Arc;

use lcplab::error::{Error, Result};
use lcplab::frames::Frame;
use lcplab::lcp::Gauss;
use lcplab::memory::Memory;
use lcplab::report::study::receipt::{
    Baseline, EngineAnswer, EngineStep, Expected, FrictionRows, Receipt, Report, Run, StepFacts,
};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;
use serde_json::Value;

use crate::refused;

type Numbers<'py> = PyReadonlyArray1<'py, f64>;
type Indices<'py> = PyReadonlyArray1<'py, i64>;
/// Rows, columns and values of stored entries.
type Triplets<'py> = (Indices<'py>, Indices<'py>, Numbers<'py>);

/// The arrays of a step, and the rest as JSON.
#[derive(FromPyObject)]
pub struct Step<'py> {
    #[pyo3(item("mass"))]
    mass: Triplets<'py>,
    #[pyo3(item("jacobian"))]
    jacobian: Triplets<'py>,
    #[pyo3(item("bias"))]
    bias: Numbers<'py>,
    #[pyo3(item("compliance"))]
    compliance: Numbers<'py>,
    #[pyo3(item("target"))]
    target: Numbers<'py>,
    #[pyo3(item("lo"))]
    lo: Numbers<'py>,
    #[pyo3(item("hi"))]
    hi: Numbers<'py>,
    #[pyo3(item("friction_index"))]
    friction_index: Indices<'py>,
    #[pyo3(item("mu"))]
    mu: Numbers<'py>,
    #[pyo3(item("forces"))]
    forces: Numbers<'py>,
    #[pyo3(item("motion"))]
    motion: Numbers<'py>,
    #[pyo3(item("reported_push"))]
    reported_push: Option<Numbers<'py>>,
    #[pyo3(item("expected_jacobian"))]
    expected_jacobian: Option<Triplets<'py>>,
    #[pyo3(item("expected_bias"))]
    expected_bias: Option<Numbers<'py>>,
    #[pyo3(item("expected_target"))]
    expected_target: Option<Numbers<'py>>,
    #[pyo3(item("facts"))]
    facts: String,
}

/// The receipt of one step.
#[pyclass(frozen, module = "lcplab._lcplab")]
pub struct StepReceipt(Arc<Receipt>);

#[pymethods]
impl StepReceipt {
    /// The receipt as JSON.
    fn json(&self) -> String {
        self.0.to_json().to_string()
    }

    /// The receipt for people.
    fn text(&self, py: Python<'_>) -> String {
        py.detach(|| lcplab::number::plain(&self.0.text()))
    }

    /// A step with fewer rows that shows the same error, as the arrays and the rest as JSON.
    fn shrunk<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        py.detach(|| self.0.shrunk()).map(|step| fields(py, step)).transpose()
    }

    /// The names and texts of the files of its folder.
    fn folder(&self, py: Python<'_>) -> PyResult<Vec<(&'static str, String)>> {
        let files = || {
            let step = self.0.step();
            self.0.folder(&step.to_problem()?, &step.to_answer())
        };
        py.detach(files).map_err(refused)
    }

    /// Without a bound on the motion, its distance from that of lcplab's own answer.
    fn difference(&self, py: Python<'_>) -> Option<f64> {
        py.detach(|| self.0.difference())
    }
}

/// The receipts of many steps, computed on all processors; each step with the report on its
/// collision and assembly as JSON, if its engine allows one.
#[pyfunction]
pub fn step_receipts(
    py: Python<'_>,
    steps: Vec<(Step<'_>, Option<String>)>,
    limit: Option<f64>,
) -> PyResult<Vec<StepReceipt>> {
    let copied: Vec<_> = steps.into_iter().map(|(step, report)| (step.copied(), report)).collect();
    let read = |(step, report): (Copied, Option<String>)| Ok((step.read()?, reported(&report)?));
    let all = || {
        let steps: Vec<Result<_>> = copied.into_par_iter().map(read).collect();
        Receipt::of_all(steps.into_iter().collect::<Result<_>>()?, limit)
    };
    let receipts = py.detach(all).map_err(refused)?;
    Ok(receipts.into_iter().map(|receipt| StepReceipt(Arc::new(receipt))).collect())
}

fn reported(report: &Option<String>) -> Result<Option<Report>> {
    let read = |text: &String| serde_json::from_str(text).map_err(|cause| fault("report", cause));
    report.as_ref().map(read).transpose()
}

/// A run, compared with a recorded one.
#[pyclass(frozen, module = "lcplab._lcplab")]
pub struct RunReport(Run);

#[pymethods]
impl RunReport {
    /// The run of these frames; the baseline as the name of its file, and its text.
    #[staticmethod]
    fn of(
        frames: Vec<(String, PyRef<'_, StepReceipt>)>,
        baseline: Option<(String, String)>,
    ) -> PyResult<Self> {
        let read = |(input, text): (String, String)| Baseline::from_json(&input, &text);
        let baseline = baseline.map(read).transpose().map_err(refused)?;
        let frames = frames.into_iter().map(|(name, own)| (name, Arc::clone(&own.0))).collect();
        Ok(RunReport(Run::new(frames, baseline)))
    }

    /// The run with its comparison, as JSON.
    fn summary(&self) -> String {
        Value::Object(self.0.summary()).to_string()
    }

    /// The run as a baseline.
    fn baseline(&self) -> String {
        format!("{:#}\n", Value::Object(self.0.to_json()))
    }

    /// The run for people.
    fn text(&self, py: Python<'_>) -> String {
        py.detach(|| lcplab::number::plain(&self.0.text()))
    }
}

/// The paths of the frames of a folder, or the path itself.
#[pyfunction]
pub fn frame_files(path: PathBuf) -> PyResult<Vec<String>> {
    let frames = Frame::find(&path, Memory::default()).map_err(refused)?;
    Ok(frames.iter().map(Frame::name).collect())
}

/// The arrays of a frame's file, and the rest as JSON.
#[pyfunction]
pub fn read_frame(py: Python<'_>, path: PathBuf) -> PyResult<Bound<'_, PyDict>> {
    let most = Memory::default();
    let found = Frame::find(&path, most).map_err(refused)?;
    let frame = found.first().ok_or_else(|| refused(fault("path", "has no frame")))?;
    let step = frame.step(most).map_err(refused)?;
    fields(py, step)
}

/// The problem file of a step, and the file with its answer.
#[pyfunction]
pub fn step_files(py: Python<'_>, step: Step<'_>) -> PyResult<(String, String)> {
    let step = step.copied().read().map_err(refused)?;
    let problem = py.detach(|| step.to_problem()).map_err(refused)?;
    Ok((problem.to_string(), step.to_answer().to_string()))
}

/// The arrays of a step, and the rest as JSON.
fn fields(py: Python<'_>, step: EngineStep) -> PyResult<Bound<'_, PyDict>> {
    let fields = PyDict::new(py);
    let facts = serde_json::to_string(&StepFacts::of(&step));
    fields.set_item("facts", facts.map_err(|cause| refused(fault("facts", cause)))?)?;
    let EngineStep { gauss, friction, answer, expected, .. } = step;
    fields.set_item("mass", triplets(py, &gauss.mass))?;
    fields.set_item("jacobian", triplets(py, &entries_of_rows(&gauss.jacobian)))?;
    let EngineAnswer { forces, motion, reported_push } = answer;
    for (name, values) in [
        ("bias", gauss.bias),
        ("compliance", gauss.compliance),
        ("target", gauss.target),
        ("lo", gauss.lo),
        ("hi", gauss.hi),
        ("mu", friction.mu),
        ("forces", forces),
        ("motion", motion),
    ] {
        fields.set_item(name, PyArray1::from_vec(py, values))?;
    }
    let reported_push = reported_push.map(|values| PyArray1::from_vec(py, values));
    fields.set_item("reported_push", reported_push)?;
    let index = friction.index.iter().map(|normal| normal.map_or(-1, |normal| normal as i64));
    fields.set_item("friction_index", PyArray1::from_iter(py, index))?;
    let jacobian = expected.jacobian.map(|rows| entries_of_rows(&rows));
    fields.set_item("expected_jacobian", jacobian.map(|entries| triplets(py, &entries)))?;
    for (name, values) in [("expected_bias", expected.bias), ("expected_target", expected.target)] {
        fields.set_item(name, values.map(|values| PyArray1::from_vec(py, values)))?;
    }
    Ok(fields)
}

/// Copies of the arrays of a step, which need no interpreter.
struct Copied {
    mass: Entries,
    jacobian: Entries,
    bias: Vec<f64>,
    compliance: Vec<f64>,
    target: Vec<f64>,
    lo: Vec<f64>,
    hi: Vec<f64>,
    friction_index: Vec<i64>,
    mu: Vec<f64>,
    forces: Vec<f64>,
    motion: Vec<f64>,
    reported_push: Option<Vec<f64>>,
    expected_jacobian: Option<Entries>,
    expected_bias: Option<Vec<f64>>,
    expected_target: Option<Vec<f64>>,
    facts: String,
}

/// Rows, columns and values of stored entries.
type Entries = (Vec<i64>, Vec<i64>, Vec<f64>);

impl Step<'_> {
    fn copied(self) -> Copied {
        let indices = |array: &Indices<'_>| array.as_array().to_vec();
        let stored = |(rows, columns, values): &Triplets<'_>| {
            (indices(rows), indices(columns), numbers(values))
        };
        let optional = |array: &Option<Numbers<'_>>| array.as_ref().map(numbers);
        Copied {
            mass: stored(&self.mass),
            jacobian: stored(&self.jacobian),
            bias: numbers(&self.bias),
            compliance: numbers(&self.compliance),
            target: numbers(&self.target),
            lo: numbers(&self.lo),
            hi: numbers(&self.hi),
            friction_index: indices(&self.friction_index),
            mu: numbers(&self.mu),
            forces: numbers(&self.forces),
            motion: numbers(&self.motion),
            reported_push: optional(&self.reported_push),
            expected_jacobian: self.expected_jacobian.as_ref().map(stored),
            expected_bias: optional(&self.expected_bias),
            expected_target: optional(&self.expected_target),
            facts: self.facts,
        }
    }
}

impl Copied {
    fn read(self) -> Result<EngineStep> {
        let facts: StepFacts =
            serde_json::from_str(&self.facts).map_err(|cause| fault("facts", cause))?;
        let (n, k) = (self.bias.len(), self.target.len());
        let mass = entries("mass", &self.mass, k, k)?;
        let rows = |name: &str, triplets: &Entries| -> Result<_> {
            let mut rows = vec![Vec::new(); n];
            for (i, j, value) in entries(name, triplets, n, k)? {
                rows[i].push((j, value));
            }
            Ok(rows)
        };
        let jacobian = rows("jacobian", &self.jacobian)?;
        let expected = self.expected_jacobian.as_ref();
        let expected_jacobian = expected.map(|own| rows("expected_jacobian", own)).transpose()?;
        let gauss = Gauss {
            mass: mass.into_iter().filter(|(i, j, _)| i <= j).collect(),
            jacobian,
            bias: self.bias,
            compliance: self.compliance,
            target: self.target,
            lo: self.lo,
            hi: self.hi,
            level: Some(facts.level()?),
        };
        let model = facts.model()?;
        let index = self.friction_index.iter().map(|&normal| normal_row(normal));
        let index = index.collect::<Result<Vec<_>>>()?;
        let step = EngineStep {
            source: facts.source,
            gauss,
            friction: FrictionRows { index, mu: self.mu, model },
            answer: EngineAnswer {
                forces: self.forces,
                motion: self.motion,
                reported_push: self.reported_push,
            },
            expected: Expected {
                jacobian: expected_jacobian,
                bias: self.expected_bias,
                target: self.expected_target,
            },
            rows: facts.rows,
            dof_bodies: facts.dof_bodies,
            not_checked: facts.not_checked,
            no_bound: facts.no_bound,
            has_computed_motion: facts.has_computed_motion,
        };
        step.check("step")?;
        Ok(step)
    }
}

type Arrays<'py, T> = Bound<'py, PyArray1<T>>;

fn triplets<'py>(
    py: Python<'py>,
    entries: &[(usize, usize, f64)],
) -> (Arrays<'py, i64>, Arrays<'py, i64>, Arrays<'py, f64>) {
    (
        PyArray1::from_iter(py, entries.iter().map(|entry| entry.0 as i64)),
        PyArray1::from_iter(py, entries.iter().map(|entry| entry.1 as i64)),
        PyArray1::from_iter(py, entries.iter().map(|entry| entry.2)),
    )
}

fn entries_of_rows(rows: &[Vec<(usize, f64)>]) -> Vec<(usize, usize, f64)> {
    let rows = rows.iter().enumerate();
    rows.flat_map(|(i, row)| row.iter().map(move |&(j, value)| (i, j, value))).collect()
}

fn normal_row(normal: i64) -> Result<Option<usize>> {
    match normal {
        -1 => Ok(None),
        _ => usize::try_from(normal).map(Some).map_err(|cause| fault("friction_index", cause)),
    }
}

fn fault(part: &str, reason: impl ToString) -> Error {
    Error::invalid("step", part, reason.to_string())
}

fn numbers(array: &Numbers<'_>) -> Vec<f64> {
    array.as_array().to_vec()
}

/// The entries of a matrix of this size.
fn entries(
    name: &str,
    (rows, columns, values): &Entries,
    n: usize,
    k: usize,
) -> Result<Vec<(usize, usize, f64)>> {
    let places = rows.iter().zip(columns);
    let place = |index: i64, size: usize| usize::try_from(index).ok().filter(|&own| own < size);
    let entry = |((&i, &j), &value): ((&i64, &i64), &f64)| match (place(i, n), place(j, k)) {
        (Some(i), Some(j)) => Ok((i, j, value)),
        _ => Err(fault(name, format!("has an entry at {i}, {j}, outside {n} × {k}"))),
    };
    places.zip(values).map(entry).collect()
}
