//! The smallest problem on which a solver is wrong.

use std::time::Duration;

use lcplab::hunt::{Finding, Friction, Given, Measure, Search, Trial};
use lcplab::lcp::friction::Model;
use lcplab::solver::{MatrixClass, Stop};
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::problem::Problem;
use crate::solving::SolverSettings;
use crate::waiting::wait;
use crate::{callable, refused};

/// What is hunted, and where.
#[derive(FromPyObject)]
pub struct Quarry {
    #[pyo3(item("measure"))]
    measure: String,
    #[pyo3(item("rows"))]
    rows: (usize, usize),
    #[pyo3(item("evaluations"))]
    evaluations: usize,
    #[pyo3(item("seed"))]
    seed: u64,
    #[pyo3(item("at_least"))]
    at_least: Option<f64>,
    #[pyo3(item("within"))]
    within: Option<String>,
    #[pyo3(item("model"))]
    model: Option<String>,
    #[pyo3(item("seconds"))]
    seconds: Option<f64>,
    #[pyo3(item("friction"))]
    friction: String,
}

/// What was found, or how many problems were tried in vain.
#[pyfunction]
pub fn hunt<'py>(
    py: Python<'py>,
    solver: Bound<'py, PyAny>,
    rival: Option<Bound<'py, PyAny>>,
    quarry: Quarry,
    given: SolverSettings,
    start: Vec<PyRef<'py, Problem>>,
) -> PyResult<Bound<'py, PyDict>> {
    let measure: Measure = quarry
        .measure
        .parse()
        .map_err(|reason: String| PyValueError::new_err(format!("measure: {reason}")))?;
    let within = quarry.within.as_deref().map(MatrixClass::by_word).transpose().map_err(refused)?;
    let model = quarry.model.as_deref().map(str::parse::<Model>).transpose().map_err(refused)?;
    let start: Vec<_> = start
        .iter()
        .enumerate()
        .map(|(k, problem)| match problem.0.name.as_str() {
            "" => (format!("problem {k}"), problem.0.clone()),
            name => (name.to_string(), problem.0.clone()),
        })
        .collect();
    let start = Given::new(&start, within, model).map_err(refused)?;
    let trial = Trial {
        measure,
        solver: callable::method(&solver, start.model)?,
        rival: rival.map(|rival| callable::method(&rival, start.model)).transpose()?,
        options: given.options()?,
        model: start.model,
        within: start.within,
        friction: match quarry.friction.as_str() {
            "only" => Friction::Only,
            "never" => Friction::Never,
            _ => Friction::Any,
        },
        allows_single_tangents: start.has_single_tangents,
        best_omega: true,
    };
    trial.validate().map_err(refused)?;
    let search = Search {
        rows: quarry.rows.0..=quarry.rows.1,
        evaluations: quarry.evaluations,
        seed: quarry.seed,
        at_least: quarry.at_least,
        from: start.problems,
    };
    search.validate(&trial).map_err(refused)?;
    let limit = quarry.seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    let stop = limit.map_or_else(Stop::default, Stop::after);
    let (searched, finding) = wait(py, &stop, || {
        let searched = search.run(&trial, &stop, &|_| ());
        let finding = searched.catch.as_ref().map(|catch| Finding::of(catch, &trial, quarry.seed));
        (searched, finding)
    })?;
    let told = PyDict::new(py);
    told.set_item("evaluations", searched.evaluations)?;
    told.set_item("solved", searched.solved)?;
    told.set_item("useless", searched.useless(trial.solver.name()))?;
    told.set_item("notes", start.notes)?;
    if let (Some(catch), Some(finding)) = (searched.catch, finding) {
        told.set_item("value", catch.value)?;
        told.set_item("evaluation", catch.evaluation)?;
        told.set_item("words", finding.words.clone())?;
        told.set_item("equations", finding.equations())?;
        told.set_item("answers", finding.answers())?;
        let vector = |x: &[f64]| PyArray1::from_slice(py, x);
        told.set_item("x", finding.answer.as_deref().map(vector))?;
        told.set_item("right_x", finding.right.as_ref().map(|right| vector(&right.x)))?;
        told.set_item("problem", Bound::new(py, Problem(finding.problem))?)?;
    }
    Ok(told)
}
